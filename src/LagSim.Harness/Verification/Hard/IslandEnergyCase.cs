using System;
using System.Collections.Generic;
using LagSim.Harness.SceneFiles.Runs;
using LagSim.Scenes;
using LagSim.Time;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// Three balls that springs press together oscillate over a floor, as one island, for a long time. The energy error of a symplectic method
/// stays what it was in the first period.
/// </summary>
/// <remarks>
/// Each is held by its own spring to the middle of the row across which they oscillate, so the outer ones push on the inner one for ever,
/// and the floor carries all. Contact steps are leapfrog (Hairer, Lubich and Wanner, Geometric Numerical Integration, I.1.4): for an
/// oscillator it conserves v^2 + (1 - (omega h)^2/4) omega^2 x^2 at ticks, v being the mean of both sides, so the energy is off by up to
/// (omega h)^2/4 of itself, however long it runs, and its phase by (omega h)^2/24 of itself. Within a step its velocity is that of the
/// middle, off by up to a h/2, and so the energy by omega h/2.
/// </remarks>
internal sealed class IslandEnergyCase : IHardCase
{
    private const double Tolerance = 1e-4;
    private const double Omega = 4; // rad/s
    private const double Swing = 1; // m/s

    public string Name => "island-energy";

    public string Title =>
        "three balls pressed together swing over a floor as one island, for long: the energy neither grows nor falls, and the contacts stay closed";

    private static readonly double Step = ContactSteps.Step(Tolerance);

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach (double seconds in context.Sizes([10.0], [10, 100, 1000]))
        {
            foreach (HardRow row in Rows(seconds, Errors(context, seconds, Tolerance, Step)))
            {
                yield return row;
            }
        }

        Seen coarse = Errors(context, 10, ContactSteps.ToleranceOf(Coarse), Coarse),
            fine = Errors(context, 10, ContactSteps.ToleranceOf(Fine), Fine);
        foreach (HardRow row in Orders(coarse, fine))
        {
            yield return row;
        }
    }

    private const double Coarse = 1.0 / 128, Fine = 1.0 / 1024;

    private IEnumerable<HardRow> Orders(Seen coarse, Seen fine)
    {
        const double Share = 0.05;
        const string Next = "the next order is (omega h)^2, a thousandth, of this one; samples are that near to the largest";
        yield return ContactSteps.Order(Name, "energy at ticks", coarse.AtTicks, fine.AtTicks, Coarse / Fine, 2, Share, Next);
        yield return ContactSteps.Order(Name, "energy within steps", coarse.Within, fine.Within, Coarse / Fine, 1, Share, "the next order"
            + " is omega h/2 of this one, 0.016, over ln 8");
        yield return ContactSteps.Order(Name, "place", coarse.Place, fine.Place, Coarse / Fine, 2, Share, Next);
    }

    private static Seen Errors(HardContext context, double seconds, double tolerance, double step)
    {
        Simulation simulation = context.Simulate(Scene(tolerance));
        double start = SceneEnergy.Of(simulation, SimTime.Zero), within = 0, atTicks = 0, place = 0, apart = 0;
        bool isIsland = true;
        int samples = (int)(seconds * 20);
        for (int n = 1; n <= samples; n++)
        {
            double at = seconds * n / samples, tick = ContactSteps.TickBefore(at, step), energy = 0;
            simulation.AdvanceTo(SimTime.FromSeconds(at));
            within = Math.Max(within, Math.Abs(SceneEnergy.Of(simulation, SimTime.FromSeconds(at)) - start));
            for (int body = 0; body < 3; body++)
            {
                BodyState state = ContactSteps.AtTick(simulation, body, tick, step);
                energy += (0.5 * state.Velocity.LengthSquared)
                    + (0.5 * Omega * Omega * (state.Position - V(0, 0.5)).LengthSquared) + (Gravity * state.Position.Y);
                isIsland &= state.Motion == MotionLaw.Constrained;
                place = Math.Max(place, Math.Abs(state.Position.Z - (Swing / Omega * Math.Sin(Omega * tick))));
                apart = Math.Max(apart, Math.Abs(state.Position.Y - 0.5));
                apart = Math.Max(apart, body == 0 ? 0 : Math.Abs((state.Position - Read(simulation, body - 1, tick).Position).Length - 1));
            }

            atTicks = Math.Max(atTicks, Math.Abs(energy - start));
            context.Report(n / (double)samples);
        }

        return isIsland ? new Seen(atTicks / Kinetic, within / Kinetic, place, apart)
            : new Seen(double.NaN, double.NaN, double.NaN, double.NaN);
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        Seen same = Errors(context, 10, ContactSteps.ToleranceOf(Coarse), Coarse);
        foreach (HardRow row in Orders(same, same))
        {
            yield return row with { Note = ContactSteps.SameSteps };
        }

        // Euler's steps, which correct the contact only by its opening speed: the energy grows with each step, and errors stay.
        double z = 0, v = Swing, apart = 0, y = 0, fall = 0, place = 0;
        for (double t = 0; t < 10; t += Step)
        {
            (z, v) = (z + (v * Step), v - (Omega * Omega * z * Step));
            fall -= Gravity * Step;
            y += fall * Step;
            fall = 0;
            apart = Math.Max(apart, -y);
            place = Math.Max(place, Math.Abs(z - (Swing / Omega * Math.Sin(Omega * (t + Step)))));
        }

        double energy = ((v * v) + (Omega * Omega * z * z)) / (Swing * Swing);
        foreach (HardRow row in Rows(10, new Seen(Math.Abs(energy - 1), Math.Abs(energy - 1), place, apart)))
        {
            yield return row with { Note = "Euler's steps, and contacts closed by their speed alone" };
        }
    }

    /// <summary>Returns the energy of the oscillation, in J, of three balls of 1 kg.</summary>
    private static double Kinetic => 1.5 * Swing * Swing;

    private static Scene Scene(double tolerance) =>
        new SceneBuilder("swing").WithContactTolerance(tolerance).AddPlane("floor", Vector3D.Up, Vector3D.Zero, 0)
        .AddForce(Force.Spring("spring", V(0, 0.5), Omega * Omega))
        .AddBody("left", Body(), V(-1, 0.5), V(0, 0, Swing)).AddBody("middle", Body(), V(0, 0.5), V(0, 0, Swing)).AddBody("right", Body(), V(1, 0.5), V(0, 0, Swing)).Build();

    private static BodySpec Body() => new(0.5, 1, 0, MotionLaw.Automatic, forces: ForceSet.Of(0));

    private IEnumerable<HardRow> Rows(double seconds, Seen seen)
    {
        string size = FormattableString.Invariant($"{seconds} s, {seconds * Omega / (2 * Math.PI):0} swings");
        double square = Omega * Step * Omega * Step, closing = ContactSteps.Closing * Tolerance;
        double contacts = closing / 2 * ((2 * Omega * Omega) + (3 * Gravity)) / Kinetic;
        yield return new HardRow(
            Name, size, seen.AtTicks, "energy_at_ticks_relative", (0.25 * square) + contacts,
            "(omega h)^2/4, which leapfrog's energy is off at ticks, and the work of springs and weight on the 0.05 d, of 1e-4 m, that"
                + " sweeps leave; however long it swings",
            "the energy at the start; NaN where they were no island");
        yield return new HardRow(
            Name, size, seen.Within, "energy_within_steps_relative", (0.5 * Omega * Step) + (0.25 * square) + contacts,
            "omega h/2 more: within a step the velocity is that of its middle", "the energy at the start");
        yield return new HardRow(
            Name, size, seen.Place, "place_m", Swing * square * ((seconds / 24) + (0.125 / Omega)),
            "(omega h)^2/24 of the phase, and an eighth of the square of the swing's size", "v sin(omega t)/omega");
        yield return new HardRow(
            Name, size, seen.Apart, "distance_m", closing,
            "a tenth of d: a step leaves a contact to close by half of that at most, and a step later it is put right; no drift is added from step"
                + " to step", "the radii");
    }

    private readonly record struct Seen(double AtTicks, double Within, double Place, double Apart);
}
