using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// Balls that push on each other in a row: heavy and light ones in a shaft, and smooth ones on a rough one down a slope, at the edge of
/// slipping and of rolling.
/// </summary>
/// <remarks>
/// <para>In a square shaft of less than two balls' width they sit in opposite corners, each on the one below. Without friction, statics
/// gives the load of each contact, from the top down.</para>
/// <para>On a slope of angle a only the lowest of n balls has friction. It slips where mu is below n tan a, with g sin a - mu g cos a / n;
/// and with a resistance c it rolls, with (n g sin a - c g cos a) / (n + 2/5).</para>
/// </remarks>
internal sealed class ColumnCase : IHardCase
{
    private const double Standing = 1e-6, Sliding = 1e-7; // contact tolerances, in metres
    private const double Radius = 0.5;

    /// <summary>The time over which pushes are added up, in seconds.</summary>
    private const double Watched = 0.5;

    /// <summary>
    /// The distance of a ball in the shaft from its axis along either wall. A line of centres has the same slope to either wall.
    /// </summary>
    private const double Aside = 0.25;

    /// <summary>The height of the next ball above a ball, and its offset to the side relative to that.</summary>
    private static readonly double Rise = Math.Sqrt((4 * Radius * Radius) - (8 * Aside * Aside)), Slope = 2 * Aside / Rise;

    public string Name => "column";

    public string Title => "balls that push on each other: masses of a million to one in a shaft, and what each contact carries; a row"
        + " down a slope, at the edge of slipping and of rolling";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach (double[] masses in context.Sizes<double[]>(
            [[1, 1e6], [1e6, 1, 1e6]], [[1, 1e6], [1e6, 1], [1e6, 1, 1e6], [1, 1e6, 1], [1, 1e-6, 1, 1e6, 1]]))
        {
            foreach (double friction in context.Sizes([0.0], [0.0, 0.5]))
            {
                foreach (HardRow row in Stands(context, masses, masses, friction))
                {
                    yield return row;
                }
            }
        }

        foreach (int balls in context.Sizes([2], [2, 3, 5]))
        {
            foreach (double nearness in context.Sizes([1e-3, -1e-3], [0.1, 1e-3, -1e-3, -0.1]))
            {
                foreach (HardRow row in new[] { false, true }.SelectMany(rolls => Slides(context, balls, rolls, nearness, nearness)))
                {
                    yield return row;
                }
            }
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        foreach (HardRow row in Carried([1, 1e6], 0, 2, PlainSweeps(1e6), PlainSweeps(1e6), double.NaN).SkipLast(1))
        {
            yield return row with { Note = "200 plain sweeps a step, each of which passes on as much as the light ball weighs" };
        }

        foreach (double[] masses in new double[][] { [1, 1e6], [1e6, 1], [1e6, 1, 1e6] })
        {
            double[] others = [.. masses[..^1], masses[^1] * (1 + 1e-3)];
            yield return Stands(context, masses, others, 0).Last() with { Note = "as if a thousandth more were on top" };
        }

        foreach (double nearness in new[] { -1e-3, 1e-3 })
        {
            yield return Slides(context, 2, false, nearness, -nearness).First() with { Note = Other };
            foreach (HardRow row in Slides(context, 2, true, nearness, -nearness))
            {
                yield return row with { Note = Other };
            }
        }
    }

    private const string Other = "what moves taken for what stays, or the other way round";

    /// <summary>A column in a shaft that never rests, compared with the loads of these or other masses.</summary>
    private IEnumerable<HardRow> Stands(HardContext context, double[] masses, double[] expected, double friction)
    {
        const double Wall = -Aside - Radius;
        SceneBuilder builder = new SceneBuilder("shaft").WithGravity(Vector3D.Zero).WithContactTolerance(Standing)
            .AddForce(Force.Supplied(new SuppliedWeight())).AddPlane("floor", Vector3D.Up, 0.0, 0)
            .AddPlane("west", V(1), Wall, 0).AddPlane("east", V(-1), Wall, 0)
            .AddPlane("north", V(0, 0, 1), Wall, 0).AddPlane("south", V(0, 0, -1), Wall, 0);
        for (int n = 0; n < masses.Length; n++)
        {
            double aside = n % 2 == 0 ? -Aside : Aside;
            BodySpec ball = new(Radius, masses[n], 0, MotionLaw.Automatic, forces: ForceSet.Of(0), tolerance: 1e-9, friction: friction);
            builder.AddBody($"ball {n}", ball, V(aside, Radius + (n * Rise), aside));
        }

        Simulation simulation = context.Simulate(builder.Build());
        double seconds = context.Size(1.0, 2.0), step = ContactSteps.Step(Standing);
        int steps = (int)(Watched / step);
        Dictionary<(BodyId Body, BodyId Partner, int Surface), Vector3D> forces = [];
        for (int n = 0; n < steps; n++)
        {
            SimTime at = SimTime.FromSeconds(seconds - Watched + ((n + 0.5) * step));
            simulation.AdvanceTo(at);
            foreach (BodySnapshot body in simulation.Snapshot(at).Bodies)
            {
                foreach (PersistentContact contact in body.Contacts)
                {
                    (BodyId, BodyId, int) key = (body.Id, contact.Partner, contact.Surface);
                    forces[key] = forces.GetValueOrDefault(key) + (contact.Push / (steps * step));
                }
            }

            context.Report(n / (double)steps);
        }

        simulation.AdvanceTo(SimTime.FromSeconds(seconds));
        Vector3D[] ends = [.. Enumerable.Range(0, masses.Length).Select(n => Read(simulation, n, seconds).Position)];
        double drift = Worst(ends.Select((end, n) => (end - simulation.Scene.Bodies[n].Position).Length));
        double depth = Worst(ends.Select((end, n) => n == 0 ? Radius - end.Y : (2 * Radius) - (end - ends[n - 1]).Length));
        IEnumerable<HardRow> rows = Carried(masses, friction, seconds, drift, depth, friction > 0 ? double.NaN : Amiss(expected, forces));
        return friction > 0 ? rows.SkipLast(1) : rows; // with friction, walls carry an unknown part
    }

    /// <summary>
    /// Returns how far the force at a contact is from that of statics, relative to the weight of its upper ball and all above.
    /// </summary>
    private static double Amiss(double[] masses, Dictionary<(BodyId Body, BodyId Partner, int Surface), Vector3D> forces)
    {
        List<double> errors = [];
        double above = 0;
        for (int n = masses.Length - 1; n >= 0; n--)
        {
            BodyId body = BodyId.OfScene(n);
            double weight = above + (Gravity * masses[n]), sign = n % 2 == 0 ? 1 : -1, aside = -sign * weight * Slope;
            double wall = sign * Slope * (n == 0 ? above : above + weight);
            Vector3D below = n == 0 ? Of(body, 0) - V(0, weight)
                : Of(BodyId.OfScene(n - 1), PersistentContact.NoSurface) - V(aside, weight, aside);
            Vector3D besideX = Of(body, n % 2 == 0 ? 1 : 2) - V(wall), besideZ = Of(body, n % 2 == 0 ? 3 : 4) - V(0, 0, wall);
            errors.AddRange(new[] { below, besideX, besideZ }.Select(error => error.Length / weight));
            above = weight;

            Vector3D Of(BodyId partner, int surface) => forces.GetValueOrDefault((body, partner, surface));
        }

        return Worst(errors);
    }

    private IEnumerable<HardRow> Carried(double[] masses, double friction, double seconds, double drift, double depth, double amiss)
    {
        string size = FormattableString.Invariant($"{string.Join(", ", masses)} kg upwards in a shaft, mu {friction}, {seconds} s");
        double most = ContactSteps.Closing * Standing * 3 * masses.Length;
        yield return new HardRow(
            Name, size, drift, "drift_m", most,
            "a tenth of d, 1e-6 m, a contact, two walls and what is below for each ball: twice what impacts may leave, and a"
                + " step later it is put right",
            "nothing moves");
        yield return new HardRow(
            Name, size, depth, "depth_m", 2 * Standing, "two of d, 1e-6 m: a fall in a step, and the turning of a line of centres in one",
            "no ball is in another or in the floor");
        double step = ContactSteps.Step(Standing), part = 1 + (2 * Slope);
        yield return new HardRow(
            Name, size, amiss, "force_over_weight_above",
            part * ((ContactSteps.Closing * Standing / step / Watched / Gravity) + (2 * most / Radius)),
            "the 0.05 d at which a step leaves what is above, at both ends of the half second that is watched, and the turning of two"
                + " lines of centres by that drift; for the weight, and for its two parts along a wall",
            "the weight above, and times the tangent of a line of centres");
    }

    /// <summary>A wrong method: a heavy ball on one of a kilogram on a floor, by 200 plain sweeps a step without warm starting.</summary>
    /// <returns>How far the heavy ball has sunk in two seconds.</returns>
    private static double PlainSweeps(double mass)
    {
        double step = ContactSteps.Step(Standing), lower = 0, upper = 0, depth = 0;
        for (double t = 0; t < 2; t += step)
        {
            (lower, upper) = (lower - (Gravity * step), upper - (Gravity * step));
            for (int sweep = 0; sweep < 200; sweep++)
            {
                lower = Math.Max(lower, 0);
                double impulse = Math.Max(0, lower - upper) / (1 + (1 / mass));
                (lower, upper) = (lower - impulse, upper + (impulse / mass));
            }

            depth -= upper * step;
        }

        return depth;
    }

    /// <summary>
    /// A row down a slope between smooth walls, compared with theory at a friction or resistance of the lowest ball. A control has another
    /// one. Both are relative to the one that would hold the row.
    /// </summary>
    private IEnumerable<HardRow> Slides(HardContext context, int balls, bool rolls, double nearness, double actual)
    {
        const double Edge = 0.6; // of friction or resistance, relative to the one that holds
        double seconds = context.Size(1.0, 2.0), tangent = Edge / balls;
        double cosine = 1 / Math.Sqrt(1 + (tangent * tangent)), sine = tangent * cosine;
        double brake = Math.Min(1, 1 + nearness) * Edge * Gravity * cosine;
        double a = ((balls * Gravity * sine) - brake) / (rolls ? balls + 0.4 : balls), has = Edge * (1 + actual);
        BodySpec rough = new(Radius, 1, 0, friction: rolls ? 2 : has, rollingResistance: rolls ? has : 1);
        SceneBuilder builder = new SceneBuilder("row").WithContactTolerance(Sliding).WithGravity(V(Gravity * sine, -Gravity * cosine))
            .AddPlane("slope", Vector3D.Up, 0.0, 0)
            .AddPlane("left", V(0, 0, 1), -Radius, 0, 0).AddPlane("right", V(0, 0, -1), -Radius, 0, 0)
            .AddBody("rough", rough, V(0, Radius));
        for (int n = 1; n < balls; n++)
        {
            builder.AddBody($"smooth {n}", new BodySpec(Radius, 1, 0), V(-2 * Radius * n, Radius));
        }

        Simulation simulation = context.Run(builder.Build(), seconds);
        double step = ContactSteps.Step(Sliding);
        Vector3D way = V(nearness > 0 ? 0 : a * seconds * seconds / 2);
        double off = Worst(simulation.Scene.Bodies
            .Select((ball, n) => (Read(simulation, n, seconds).Position - ball.Position - way).Length));
        int contacts = (2 * balls) - 1; // walls carry nothing
        double speed = (contacts * ContactSteps.Closing / 2 * Sliding / step) + (brake / balls * step / 2);
        string what = rolls ? "resistance" : "friction";
        string size = FormattableString.Invariant($"{balls} in a row down a slope, {what} {1 + nearness} of what holds, {seconds} s");
        yield return nearness > 0 ? new HardRow(
            Name, size, off, "drift_m", contacts * ContactSteps.Closing * Sliding,
            "a tenth of d, 1e-7 m, a contact: a step leaves it to close by half of that at most, and a step later it is put right", "nothing moves")
            : new HardRow(
                Name, size, off, "position_m", (speed * seconds) + Sliding,
                "as a speed, for as long as is watched, 0.05 d a step of each contact, as much as it may leave, and the friction of the first"
                    + " half step; and d, 1e-7 m",
                rolls ? "(n g sin a - c g cos a)/(n + 2/5) t^2/2" : "(g sin a - mu g cos a/n) t^2/2");
        double turning = rolls && nearness < 0 ? a * seconds / Radius : 0;
        yield return new HardRow(
            Name, size, (ContactSteps.AtTick(simulation, 0, seconds, step).Spin + V(0, 0, turning)).Length, "spin_rad_per_s",
            2.5 * speed / Radius, "5/2 of that speed, over the radius",
            rolls ? "no slip, or no motion" : "it does not turn, for friction is no more than what resists");
    }
}
