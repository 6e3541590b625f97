using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Verification.References;
using LagSim.Scenes;
using LagSim.Timelines;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>When bodies enter and leave sensors: parabolas, lines, drag, an orbit, and regions that are barely touched or missed.</summary>
/// <remarks>
/// A path that is off by some length crosses a boundary off by that length over the speed across it. The rest is half a tick of rounding
/// the instant, and the roundings of the reference.
/// </remarks>
internal sealed class CrossingCase : IHardCase
{
    private const double Tick = 1.0 / (1L << 40);
    private const double K = 0.5;

    private static readonly LinearDragFall Fall = new(Gravity, K);

    public string Name => "crossing";

    public string Title => "bodies cross sensors: the time of each crossing, and every graze found or missed";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        yield return Throw(context, 12);
        yield return Line(context, 1);
        foreach (HardFlight flight in context.Sizes([HardFlight.Closed(1e-9)], [HardFlight.Closed(1e-9), HardFlight.Controlled(1e-9), HardFlight.Steps(1.0 / 128)]))
        {
            yield return Drag(context, flight, K);
        }

        yield return Orbit(context, 1);
        yield return Carried(context, 1);
        yield return Graze(context, off => off);
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        yield return Throw(context, 12 * (1 + 1e-9)) with { Note = "thrown 1e-9 too fast" };
        yield return Line(context, 1 + 1e-9) with { Note = "a radius 1e-9 too large" };
        yield return Drag(context, HardFlight.Closed(1e-9), K * (1 + 1e-6)) with { Note = "a drag 1e-6 too strong" };
        yield return Orbit(context, 1 + 1e-6) with { Note = "a radius 1e-6 too large" };
        yield return Carried(context, 1 + 1e-7) with { Note = "a radius 1e-7 too large" };
        yield return Graze(context, off => off - 1e-9) with { Note = "a region a nanometre too near" };
    }

    private HardRow Throw(HardContext context, double speed)
    {
        double root = Math.Sqrt((12.0 * 12) - (2 * Gravity * 3));
        Simulation world = context.Run(new SceneBuilder("throw").AddBody("ball", Ball(), default, V(0, speed)).AddSensorPlane("over", V(0, -1), V(0, 3)).Build(), 3);
        return Row("thrown through a plane and back", world, [(12 - root) / Gravity, (12 + root) / Gravity], Tick, "a tick: half of it, and roundings of the reference",
            "the roots of the parabola");
    }

    private HardRow Line(HardContext context, double radius)
    {
        double half = Math.Sqrt(0.75);
        Simulation world = context.Run(Floating("line").AddBody("ball", Ball(), V(-3, 0.5), V(2)).AddSensorSphere("ring", default, radius).Build(), 4);
        return Row("straight through a sphere", world, [(3 - half) / 2, (3 + half) / 2], Tick, "a tick: half of it, and roundings of the reference", "the chord");
    }

    private HardRow Drag(HardContext context, HardFlight flight, double k)
    {
        Simulation world = context.Run(
            new SceneBuilder("drag").AddForce(Force.LinearDrag("air", k)).AddBody("ball", flight.Ball(), default, V(0, 12)).AddSensorPlane("over", V(0, -1), V(0, 3)).Build(), 4);
        double apex = Math.Log((12 - Fall.Terminal) / -Fall.Terminal) / K;
        double up = Root(t => Fall.Height(-3, 12, t), 0, apex);
        double down = Root(t => -Fall.Height(-3, 12, t), apex, 10);
        double slowest = Math.Min(Fall.Speed(12, up), -Fall.Speed(12, down));
        int pieces = world.Timeline(First).Count;

        // The classical method's local error is (kh)^5/120 of the difference to the terminal velocity a step, and place is off by it over k.
        double h = flight.Step;
        double stepped = h > 0 ? Math.Pow(K * h, 5) / 120 * (12 - Fall.Terminal) * (down / h) * (down + (1 / K)) : 0;
        double bound = Tick + ((flight.ErrorOf(pieces, 24) + stepped) * (1 + down) / slowest);
        return Row($"up and down under drag, {flight.Text}", world, [up, down], bound, $"{flight.Argument}, over the speed across", "exponentials; the roots by bisection");
    }

    private HardRow Orbit(HardContext context, double radius)
    {
        KeplerOrbit orbit = new(0.5, 4);
        BodySpec planet = new(0.01, 1, 1, MotionLaw.Automatic, forces: ForceSet.Of(0), tolerance: 1e-10);
        Simulation world = context.Run(
            Floating("orbit").AddForce(orbit.Pull).AddBody("planet", planet, orbit.Position(0), orbit.StartVelocity).AddSensorSphere("near", default, radius).Build(), 4);
        double enters = Root(t => 1 - orbit.Position(t).Length, 0, 2);
        double leaves = Root(t => orbit.Position(t).Length - 1, 2, 4);
        int pieces = world.Timeline(First).Count;

        // At r = a the speed is the mean motion times a, and the part of it towards the centre e times that. KeplerCase has the factor.
        double across = orbit.E * orbit.Motion;
        double bound = Tick + (HardFlight.Closed(1e-10).ErrorOf(pieces, 4) * 10 / (1 - orbit.E) / across);
        return Row("in and out of a sphere on an ellipse", world, [enters, leaves], bound, "the tolerance once, 40 roundings a piece, times 10/(1 - e), over the speed across",
            "Kepler's equation; the roots by bisection");
    }

    /// <summary>Two that fall under the same drag: what is between them slows down as if there were no gravity. They pass 3 m beside each other.</summary>
    private HardRow Carried(HardContext context, double radius)
    {
        const double apart = 6;
        const double closing = 8;
        BodySpec ball = HardFlight.Closed(1e-9).Ball();
        Simulation world = context.Run(
            new SceneBuilder("reach").AddForce(Force.LinearDrag("air", K)).AddBody("carrier", ball, V(1), V(-1, 12))
                .AddBody("ball", ball, V(1 - apart, 0, 3), V(closing - 1, 12)).AddSensorSphere("reach", V(0, 2, 3), radius: Math.Sqrt(4 + (radius * radius)), carrier: "carrier").Build(), 4);
        double[] expected = [.. new[] { apart - 1, apart + 1 }.Select(way => -Math.Log(1 - (K * way / closing)) / K)];
        double slowest = closing * Math.Exp(-K * expected[1]) / Math.Sqrt(5); // the way in is oblique: one beside two
        double bound = Tick + (2 * HardFlight.Closed(1e-9).ErrorOf(Math.Max(world.Timeline(First).Count, world.Timeline(BodyId.OfScene(1)).Count), 24) * (1 + expected[1]) / slowest);
        return Row("a sphere that another carries, both under drag", world, expected, bound, "twice the tolerance and 24 m, over the speed across", "the logarithm");
    }

    /// <summary>Deeper and shallower by 1e-2 m down to where rounding decides, and exactly touching, which is no crossing.</summary>
    private HardRow Graze(HardContext context, Func<double, double> seen)
    {
        List<double> wrong = [];
        List<double> tries = [0];
        for (double off = 1e-2; off > 0.9e-14; off /= 10)
        {
            tries.AddRange([off, -off]);
        }

        foreach (double off in tries)
        {
            int expected = off < 0 ? 2 : 0;
            Scene line = Floating("graze").AddBody("ball", Ball(), V(-3, 1 + seen(off)), V(2)).AddSensorSphere("ring", default, 1).Build();
            Scene apex = new SceneBuilder("apex").WithGravity(V(0, -10)).AddBody("ball", Ball(), default, V(0, 10)).AddSensorPlane("over", V(0, -1), V(0, 5 + seen(off))).Build();
            wrong.AddRange(new[] { line, apex }.Where(scene => Crossings(context.Run(scene, 2.5)).Count != expected).Select(_ => off));
        }

        return new HardRow(
            Name, FormattableString.Invariant($"grazing a sphere and a plane, off by 0 and 1e-2 to 1e-14 m, {2 * tries.Count} tries"), wrong.Count, "wrong", 0,
            "each is further off than 16 roundings of a place of 5 m; exactly touching is no crossing", "the sign of how far it is off")
        {
            Note = wrong.Count == 0 ? "" : "wrong when off by " + string.Join(", ", wrong.Select(off => FormattableString.Invariant($"{off:0e0} m"))),
        };
    }

    private HardRow Row(string size, Simulation world, double[] expected, double bound, string argument, string reference)
    {
        IReadOnlyList<Crossing> seen = Crossings(world);
        bool areAll = seen.Count == expected.Length && seen.Select((crossing, n) => crossing.Entered == (n % 2 == 0)).All(isRight => isRight);
        double error = areAll ? Worst(seen.Select((crossing, n) => Math.Abs(crossing.Time.ToSeconds() - expected[n]))) : double.NaN;
        return new HardRow(Name, size, error, "time_s", bound, argument, reference) { Note = areAll ? "" : $"{seen.Count} crossings" };
    }

    private static IReadOnlyList<Crossing> Crossings(Simulation world) => world.Crossings(world.Start, world.SimulatedTo);

    /// <summary>Returns the time at which a function rises through zero, by bisection.</summary>
    private static double Root(Func<double, double> f, double low, double high)
    {
        for (int n = 0; n < 200; n++)
        {
            double middle = 0.5 * (low + high);
            (low, high) = f(middle) < 0 ? (middle, high) : (low, middle);
        }

        return high;
    }
}
