using System;
using System.Collections.Generic;
using LagSim.Harness.SceneFiles.Runs;
using LagSim.Scenes;
using LagSim.Time;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// Bodies at rest on a plane, on a slope, on another ball, and in a small pile. No drift, no gain of energy, a finite number of events.
/// </summary>
internal sealed class RestCase : IHardCase
{
    /// <summary>The contact tolerance of the balls on each other.</summary>
    private const double Tolerance = 1e-5;

    public string Name => "rest";

    public string Title => "at rest on a plane, on another ball, in a small pile: no drift, no gain of energy, finitely many events; down a slope as the"
        + " formula says";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        double seconds = context.Size(2.0, 20.0);
        foreach (HardRow row in Plane(context, 10 * seconds))
        {
            yield return row;
        }

        yield return SlopeRow(Slope(context, Gravity));
        // Contacts: the floor and each other; the floor twice, a wall each, and the two below.
        foreach ((string what, Scene scene, int contacts) in new[] { ("two balls, one on the other", Stack(), 2), ("three balls in a bin", Pile(), 6) })
        {
            foreach (HardRow row in Persistent(what, contacts, seconds, Gravity * scene.Bodies.Count, Watch(context, scene, seconds)))
            {
                yield return row;
            }
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        yield return SlopeRow(Slope(context, Gravity * (1 + 1e-6))) with { Note = "gravity off by a millionth" };

        (double drift, _) = Tremble(1e-3);
        (_, long impacts) = Tremble(5e-5);
        foreach (HardRow row in Persistent("one ball on a plane", 1, 2, Gravity, (drift, Gravity * drift, impacts)))
        {
            yield return row with { Note = "a step at a time: a millisecond for drift and energy, 50 us for the number of impacts" };
        }
    }

    /// <summary>
    /// Steps that push a sunken ball out to the same height above the surface, with half its speed: it trembles, and has an impact every
    /// other step or so.
    /// </summary>
    private static (double Drift, long Impacts) Tremble(double step)
    {
        double worst = 0, v = 0, y = 0;
        long impacts = 0;
        for (double t = 0; t < 2; t += step)
        {
            v -= Gravity * step;
            y += v * step;
            if (y < 0)
            {
                (y, v) = (-y, -0.5 * v);
                impacts++;
            }

            worst = Math.Max(worst, y);
        }

        return (worst, impacts);
    }

    private IEnumerable<HardRow> Plane(HardContext context, double seconds)
    {
        Scene scene = new SceneBuilder("rest").AddPlane("floor", Vector3D.Up, Vector3D.Zero).AddBody("ball", Ball(e: 0.5), V(0, 1)).Build();
        Simulation simulation = context.Simulate(scene);
        simulation.AdvanceTo(SimTime.FromSeconds(2));
        (BodyState state, long events) = (Read(simulation, 0, 2), simulation.EventsProcessed);
        simulation.AdvanceTo(SimTime.FromSeconds(2 + seconds));
        string size = FormattableString.Invariant($"on a plane, {seconds} s");
        yield return new HardRow(Name, size, (Read(simulation, 0, 2 + seconds).Position - state.Position).Length, "drift_m", 0, "a body at rest is a constant",
            "nothing moves");
        yield return new HardRow(Name, size, simulation.EventsProcessed - events, "events", 0, "a body at rest asks for nothing", "nothing happens");
    }

    /// <summary>Returns how far a ball slides down 30 degrees in 3 s.</summary>
    private static BodyState Slope(HardContext context, double gravity)
    {
        Vector3D normal = V(0.5, Math.Sqrt(0.75));
        Scene scene = new SceneBuilder("slope").WithGravity(V(0, -gravity)).AddPlane("slope", normal, Vector3D.Zero).AddBody("ball", Ball(e: 0),
            normal * 0.5).Build();
        return Read(context.Run(scene, 3), 0, 3);
    }

    private HardRow SlopeRow(BodyState seen)
    {
        double way = 0.5 * Gravity * 0.5 * 9;
        Vector3D expected = (V(0.5, Math.Sqrt(0.75)) * 0.5) + (V(Math.Sqrt(0.75), -0.5) * way);
        return new HardRow(
            Name, "down a slope of 30 degrees for 3 s", (seen.Position - expected).Length, "position_m", SceneBuilder.DefaultRestitutionThreshold
                + (32 * Rounding.Unit * way),
            "the scene's restitution threshold, below which a contact is taken to last, and 32 roundings", "g sin(a) t^2/2 along the slope");
    }

    private static Scene Stack() => new SceneBuilder("stack").WithContactTolerance(Tolerance)
        .AddPlane("floor", Vector3D.Up, Vector3D.Zero, 0.5)
        .AddBody("below", Ball(e: 0.5), V(0, 0.5)).AddBody("above", Ball(e: 0.5), V(0, 1.5)).Build();

    /// <summary>A ball on two others, between two walls.</summary>
    private static Scene Pile()
    {
        const double half = 0.55;
        double up = 0.5 + Math.Sqrt(1 - (half * half));
        return new SceneBuilder("pile").WithContactTolerance(Tolerance).AddPlane("floor", Vector3D.Up, Vector3D.Zero, 0.5)
            .AddPlane("west", V(1), -half - 0.5, 0.5).AddPlane("east", V(-1), -half - 0.5, 0.5)
            .AddBody("left", Ball(e: 0.5), V(-half, 0.5)).AddBody("right", Ball(e: 0.5), V(half, 0.5)).AddBody("top", Ball(e: 0.5), V(0, up)).Build();
    }

    private static (double Drift, double Gain, long Events) Watch(HardContext context, Scene scene, double seconds)
    {
        Simulation simulation = context.Simulate(scene);
        double start = SceneEnergy.Of(simulation, SimTime.Zero), drift = 0, gain = 0;
        for (int n = 1; n <= 400; n++)
        {
            SimTime at = SimTime.FromSeconds(seconds * n / 400);
            simulation.AdvanceTo(at);
            gain = Math.Max(gain, SceneEnergy.Of(simulation, at) - start);
            for (int body = 0; body < scene.Bodies.Count; body++)
            {
                drift = Math.Max(drift, (Read(simulation, BodyId.OfScene(body), at).Position - scene.Bodies[body].Position).Length);
            }

            context.Report(n / 400.0);
        }

        return (drift, gain, simulation.EventsProcessed);
    }

    private IEnumerable<HardRow> Persistent(
        string what, int contacts, double seconds, double weight, (double Drift, double Gain, long Events) seen)
    {
        string size = FormattableString.Invariant($"{what}, {seconds} s");
        double drift = ContactSteps.Closing * Tolerance * contacts;
        yield return new HardRow(
            Name, size, seen.Drift, "drift_m", drift, "a tenth of d, 1e-5 m, a contact: a step leaves it to close by half of that at most, and a"
                + " step later it is put right",
            "nothing moves");
        yield return new HardRow(
            Name, size, seen.Gain, "energy_gain_j", weight * drift, "that all of the weight is lifted by as much", "the energy at the"
                + " start");
        yield return new HardRow(
            Name, size, seen.Events, "events", (0.5 / ContactSteps.Step(Tolerance)) + 1 + (2 * contacts),
            "the steps of the half second after which it sleeps, the one at which it does; an impact a contact, as it is found, and as"
                + " many steps until all is still",
            "nothing happens any more");
    }
}
