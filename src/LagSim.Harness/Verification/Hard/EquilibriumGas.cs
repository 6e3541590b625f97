using System;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// A gas of hard spheres in a periodic box that has forgotten its lattice, with the predictions of kinetic theory and the measurements.
/// </summary>
internal static class EquilibriumGas
{
    internal const double Radius = GasScene.Radius;
    internal const double Diameter = 2 * Radius;

    /// <summary>
    /// The mean number of impacts of a body until the lattice is forgotten.
    /// </summary>
    private const int ImpactsToForget = 10;

    /// <summary>The contact value of the pair correlation (Carnahan and Starling 1969).</summary>
    internal static double ContactValue(double fraction) => (1 - (fraction / 2)) / Math.Pow(1 - fraction, 3);

    /// <summary>
    /// The compressibility factor by the virial series in the volume fraction, coefficients B2 to B10 (Clisby and McCoy, J. Stat. Phys.
    /// 122, 15, 2006).
    /// </summary>
    internal static double VirialPressure(double fraction, out double rest)
    {
        double[] coefficients = [4, 10, 18.364768, 28.2245, 39.815, 53.34, 68.53, 85.8, 105.8];
        double sum = 1, power = 1, term = 0;
        foreach (double coefficient in coefficients)
        {
            power *= fraction;
            term = coefficient * power;
            sum += term;
        }

        // Successive coefficients grow by about a fifth here, so the remainder is nearly geometric.
        double ratio = 1.2 * fraction;
        rest = term * ratio / (1 - ratio);
        return sum + rest;
    }

    /// <summary>Impacts per second of each sphere, by Enskog: 4 sqrt(pi) n d^2 g sqrt(T/m), T in joules; for spheres of 1 kg.</summary>
    internal static double Frequency(double fraction, double temperature) =>
        24 * fraction * ContactValue(fraction) / Diameter * Math.Sqrt(temperature / Math.PI);

    /// <summary>
    /// Two thirds of the kinetic energy for each body, in the frame of their centre of mass, which takes one body's share.
    /// </summary>
    internal static double Temperature(Simulation simulation, SimTime time)
    {
        Vector3D mean = Vector3D.Zero;
        double squares = 0;
        int bodies = simulation.BodyCount;
        for (int n = 0; n < bodies; n++)
        {
            Vector3D v = Read(simulation, BodyId.OfScene(n), time).Velocity;
            mean += v;
            squares += v.LengthSquared;
        }

        return (squares - (mean.LengthSquared / bodies)) / (3 * (bodies - 1));
    }

    /// <summary>Returns the same bodies at their simulated positions, in the same box, with another restitution.</summary>
    internal static Scene WithRestitution(Simulation simulation, double e)
    {
        SceneBuilder builder = Floating("granular").WithPeriodicBox(simulation.Scene.Box.Size);
        for (int n = 0; n < simulation.BodyCount; n++)
        {
            BodyState state = Read(simulation, BodyId.OfScene(n), simulation.SimulatedTo);
            builder.AddBody($"ball {n}", new BodySpec(Radius, 1, e), state.Position, state.Velocity);
        }

        return builder.Build();
    }

    /// <summary>Runs until each body has met some others.</summary>
    internal static Simulation Settle(HardContext context, Scene scene, ImpactSums? sums = null)
    {
        SimulationOptions options = new(default, SimDuration.FromSeconds(1e-3), cancellation: context.Cancellation);
        Simulation simulation = new(scene, sums is null ? options : options.WithObserver(sums));
        AdvanceByImpacts(context, simulation, (long)ImpactsToForget * scene.Bodies.Count / 2, 0, 0.2);
        return simulation;
    }

    /// <summary>Runs for at least a number of further impacts.</summary>
    internal static void AdvanceByImpacts(HardContext context, Simulation simulation, long impacts, double from, double to)
    {
        long before = simulation.ImpactsProcessed, done;
        SimDuration some = SimDuration.FromSeconds(0.02);
        while ((done = simulation.ImpactsProcessed - before) < impacts)
        {
            context.Report(from + ((to - from) * done / impacts));
            simulation.AdvanceTo(simulation.SimulatedTo + some);
        }
    }

    /// <summary>Returns the number of contacts, and their closing speeds.</summary>
    internal sealed class ImpactSums : IImpactObserver
    {
        internal long Contacts { get; private set; }

        internal double ClosingSpeeds { get; private set; }

        public void OnContact(in EventKey impact, in ImpactContact contact)
        {
            Contacts++;
            ClosingSpeeds += contact.ClosingSpeed;
        }

        public void OnCut(in EventKey impact) => throw new InvalidOperationException("Nothing comes late here.");
    }
}
