using System;
using System.Collections.Generic;
using LagSim.Harness.Runs;
using LagSim.Scenes;
using LagSim.Time;
using static LagSim.Harness.Hard.HardWorlds;

namespace LagSim.Harness.Hard;

/// <summary>Three balls that a spring presses together swing to and fro over a floor, as one island, for a long time: the energy of a method that keeps it is off by what it was in the first period.</summary>
/// <remarks>
/// A spring of its own holds each to the middle of the row across which they swing, so the outer ones push on the inner one for ever, and the floor carries all. Without friction RATTLE (Hairer,
/// Lubich and Wanner, Geometric Numerical Integration, VII.1.4) is velocity Verlet along the floor. Of an oscillator that keeps v^2 + (1 - (omega h)^2/4) omega^2 x^2 at the ends of steps, so the
/// energy is off by up to (omega h)^2/4 of itself, however long it swings. Between two ends the path is the cubic with the places and velocities of both; half way its velocity is v0 + (5 a0 - a1) h/8 where
/// v0 + a0 h/2 + a' h^2/8 is right, so off by a' h^2/4 = (omega h)^2/4 v, and the energy by twice that part.
/// </remarks>
internal sealed class IslandEnergyCase : IHardCase
{
    private const double Step = 1.0 / 512;
    private const double Omega = 4; // rad/s
    private const double Swing = 1; // m/s

    public string Name => "island-energy";

    public string Title =>
        "three balls pressed together swing over a floor as one island, for long: the energy neither grows nor falls, and the contacts stay closed";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach (double seconds in context.Sizes([10.0], [10, 100, 1000]))
        {
            Simulation simulation = context.Simulate(Scene());
            double start = SceneEnergy.Of(simulation, SimTime.Zero), worst = 0, apart = 0;
            bool isIsland = true;
            int samples = (int)(seconds * 20);
            for (int n = 1; n <= samples; n++)
            {
                SimTime at = SimTime.FromSeconds(seconds * n / samples);
                simulation.AdvanceTo(at);
                worst = Math.Max(worst, Math.Abs(SceneEnergy.Of(simulation, at) - start));
                for (int body = 0; body < 3; body++)
                {
                    BodyState state = Read(simulation, BodyId.OfScene(body), at);
                    isIsland &= state.Motion == MotionLaw.Constrained;
                    apart = Math.Max(apart, Math.Abs(state.Position.Y - 0.5));
                    apart = Math.Max(apart, body == 0 ? 0 : Math.Abs((state.Position - Read(simulation, BodyId.OfScene(body - 1), at).Position).Length - 1));
                }

                context.Report(n / (double)samples);
            }

            foreach (HardRow row in Rows(seconds, isIsland ? worst / Kinetic : double.NaN, apart))
            {
                yield return row;
            }
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        // Euler's steps, which put the contact right only by how fast it opens: the energy grows with each, and what is off stays off.
        double z = 0, v = Swing, apart = 0, y = 0, fall = 0;
        for (double t = 0; t < 10; t += Step)
        {
            (z, v) = (z + (v * Step), v - (Omega * Omega * z * Step));
            fall -= Gravity * Step;
            y += fall * Step;
            fall = 0;
            apart = Math.Max(apart, -y);
        }

        double energy = ((v * v) + (Omega * Omega * z * z)) / (Swing * Swing);
        foreach (HardRow row in Rows(10, Math.Abs(energy - 1), apart))
        {
            yield return row with { Note = "Euler's steps, and contacts closed by their speed alone" };
        }
    }

    /// <summary>What swings, in J, of three balls of 1 kg.</summary>
    private static double Kinetic => 1.5 * Swing * Swing;

    private static Scene Scene() => new SceneBuilder("swing").AddPlane("floor", Vector3D.Up, Vector3D.Zero, 0).AddForce(Force.Spring("spring", V(0, 0.5), Omega * Omega))
        .AddBody("left", Body(), V(-1, 0.5), V(0, 0, Swing)).AddBody("middle", Body(), V(0, 0.5), V(0, 0, Swing)).AddBody("right", Body(), V(1, 0.5), V(0, 0, Swing)).Build();

    private static BodySpec Body() => new(0.5, 1, 0, MotionLaw.Automatic, forces: ForceSet.Of(0));

    private IEnumerable<HardRow> Rows(double seconds, double energy, double apart)
    {
        string size = FormattableString.Invariant($"{seconds} s, {seconds * Omega / (2 * Math.PI):0} swings");
        yield return new HardRow(
            Name, size, energy, "energy_relative", 0.75 * Omega * Step * Omega * Step,
            "(omega h)^2/4, which Verlet's energy is off at the ends of steps, and (omega h)^2/2, which the cubic between them adds, however long it swings",
            "the energy at the start; NaN where they were no island");
        yield return new HardRow(
            Name, size, apart, "distance_m", 1000 * SceneBuilder.DefaultResolution,
            "a thousand resolutions, within which a contact lasts; no drift is added from step to step", "the radii");
    }
}
