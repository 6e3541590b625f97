using System;
using System.Linq;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>
/// A fluid of equal elastic spheres in a periodic box, run until it has forgotten its lattice: a simple cubic one, which melts at once at any density that
/// fits it.
/// </summary>
internal sealed class HardSpheres
{
    /// <summary>So many spheres that fill that part of the box, after so many collisions of each.</summary>
    internal HardSpheres(int bodies, double fraction, SimDuration history, int collisionsEach)
    {
        Scene scene = BuiltInScenes.Gas(bodies, fraction);
        Bodies = bodies;
        double size = scene.Box.Size.X * scene.Box.Size.Y * scene.Box.Size.Z;
        EnskogRate = Enskog(bodies / size, fraction, scene.Bodies[0].Spec.Radius, scene.Bodies.Sum(b => b.Velocity.LengthSquared) / (3 * bodies));
        Simulation = new Simulation(scene, new SimulationOptions(default, history));
        Collide(collisionsEach);
    }

    internal Simulation Simulation { get; }

    internal int Bodies { get; }

    /// <summary>How often each collides in a second by Enskog's theory, with the contact value of Carnahan and Starling.</summary>
    internal double EnskogRate { get; }

    /// <summary>Lets each collide so often, in the mean; returns how often they did, all together.</summary>
    internal long Collide(double each)
    {
        long before = Simulation.ImpactsProcessed;
        long until = before + (long)(0.5 * each * Bodies);
        SimDuration step = SimDuration.FromSeconds(0.05 / EnskogRate);
        while (Simulation.ImpactsProcessed < until)
        {
            Simulation.AdvanceTo(Simulation.SimulatedTo + step);
        }

        return Simulation.ImpactsProcessed - before;
    }

    /// <summary>4 n d^2 g sqrt(pi kT / m), with g = (1 - f/2) / (1 - f)^3.</summary>
    private static double Enskog(double density, double fraction, double radius, double temperature)
    {
        double contact = (1 - (fraction / 2)) / Math.Pow(1 - fraction, 3);
        return 16 * density * radius * radius * contact * Math.Sqrt(Math.PI * temperature);
    }
}
