using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// Arches of balls that stand only by friction or rolling resistance, a hundredth above what statics requires; and an inverted hanging
/// chain, with its thrust.
/// </summary>
/// <remarks>
/// <para>A link is the line of centres of two touching balls; it slopes by an angle t. Each contact transmits a horizontal thrust H, the
/// same through all, and a vertical V, the weight between it and the top. So its normal force is N = H cos t + V sin t, and its friction T
/// = V cos t - H sin t.</para>
/// <para>A ball does not turn if its friction forces and the moments of its two contacts cancel: the moment of the next link is that of the
/// one before less r times the T of both. Friction allows T up to mu N, and rolling resistance a moment up to c r N.</para>
/// </remarks>
internal sealed class ArchCase : IHardCase
{
    private const double Tolerance = 1e-6, Radius = 0.5;

    /// <summary>How far the arches are from the edge of falling, as a fraction.</summary>
    private const double Near = 0.01;

    /// <summary>The rolling resistance of the chain whose thrust is measured, and the duration in seconds.</summary>
    private const double Resistance = 0.01, Watched = 0.5;

    private const double Degree = Math.PI / 180;

    /// <summary>
    /// The friction required by a ball on three touching ones: the tangent of half the angle whose sine is the root of a third.
    /// </summary>
    private static readonly double OnThree = Math.Sqrt(3) - Math.Sqrt(2);

    public string Name => "arch";

    public string Title => "arches of balls, a hundredth above what statics asks for: a ball on three and unlike balls over a gap by"
        + " friction, round arches by rolling resistance; and the thrust of an inverted hanging chain";

    public IEnumerable<HardRow> Rows(HardContext context) => Standing(context, 1 + Near).Concat(
        context.Sizes([3], [1, 3, 5]).SelectMany(side => Hanging(context, side, 1)));

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        foreach (HardRow row in Standing(context, 1 - Near))
        {
            yield return row with { Note = "a hundredth less than what statics asks for" };
        }

        yield return Hanging(context, 3, 1.05).Last() with { Note = "a twentieth steeper" };
    }

    /// <summary>Arches that stand by friction or resistance, at a multiple of what statics requires.</summary>
    private IEnumerable<HardRow> Standing(HardContext context, double part)
    {
        yield return Stays("a ball on three that touch, friction of balls", OnThree, OnBalls(part * OnThree, 1), 6);
        yield return Stays("a ball on three that touch, friction of the floor", OnThree / 4, OnBalls(1, part * OnThree / 4), 6);
        foreach ((double unlike, double degrees) in context.Sizes([(0.5, 60.0)], [(0.5, 60.0), (0.5, 30.0), (0.9, 45.0)]))
        {
            double friction = unlike * Math.Tan(degrees * Degree / 2);
            string what = FormattableString.Invariant(
                $"balls of {1 + unlike} and {1 - unlike:0.#} kg over a gap, links at {degrees} degrees, friction");
            yield return Stays(what, friction, Pair(unlike, degrees * Degree, part * friction), 3);
        }

        foreach ((double upper, double lower) in context.Sizes([(60.0, 85.0)], [(60.0, 85.0), (60.0, 89.0), (20.0, 60.0)]))
        {
            double friction = OnTwo(upper * Degree, lower * Degree);
            string what = FormattableString.Invariant($"a ball on two over a gap, links at {upper} and {lower} degrees, friction");
            yield return Stays(what, friction, Arch([upper * Degree, lower * Degree], part * friction, 0), 5);
        }

        foreach ((int side, double turn) in context.Sizes([(2, 20.0)], [(2, 20.0), (2, 30.0), (3, 20.0), (3, 25.0), (4, 15.0), (5, 14.0)]))
        {
            double[] slopes = [.. Enumerable.Range(0, side + 1).Select(n => (n + 0.5) * turn * Degree)];
            double resistance = MinResistance(slopes);
            string what = FormattableString.Invariant($"a round arch of {(2 * side) + 1}, {turn} degrees a link, resistance");
            yield return Stays(what, resistance, Arch(slopes, 0.6, part * resistance), (2 * side) + 2);
        }

        HardRow Stays(string what, double asked, Scene scene, int contacts) => new(
            Name, FormattableString.Invariant($"{what} {part} of {asked:0.0000}, {Seconds(context)} s"),
            Drift(context.Run(scene, Seconds(context)), Seconds(context)), "drift_m", contacts * 2 * ContactSteps.Sweep / Near * Tolerance,
            "0.005 d, 1e-6 m, which sweeps leave each contact to close by in a step, and as much to slip by; a hundredth from the edge"
                + " a sweep makes up a hundredth of what is lacking, so that what is left sums to a hundred times that: d a contact",
            "what statics asks for of friction, or of rolling resistance");
    }

    private static double Seconds(HardContext context) => context.Size(1.0, 2.0);

    private static double Drift(Simulation simulation, double seconds) => Worst(Enumerable.Range(0, simulation.BodyCount)
        .Select(n => (Read(simulation, n, seconds).Position - simulation.Scene.Bodies[n].Position).Length));

    /// <summary>A ball on three touching ones, on a floor.</summary>
    /// <remarks>
    /// The force from above passes through the point where a lower ball touches the floor, or that ball would turn. So its angle to the
    /// normal is half that between the line of centres and the vertical. A third of a weight comes down that way, and four thirds press on
    /// the floor.
    /// </remarks>
    private static Scene OnBalls(double friction, double floor)
    {
        BodySpec ball = new(Radius, 1, 0, friction: friction);
        SceneBuilder builder = new SceneBuilder("three").WithContactTolerance(Tolerance).AddPlane("floor", Vector3D.Up, 0.0, 0, floor)
            .AddBody("top", ball, V(0, Radius * (1 + Math.Sqrt(8.0 / 3))));
        for (int n = 0; n < 3; n++)
        {
            double at = 2 * Math.PI * n / 3, away = 2 * Radius / Math.Sqrt(3);
            builder.AddBody($"ball {n}", ball, V(away * Math.Cos(at), Radius, away * Math.Sin(at)));
        }

        return builder.Build();
    }

    /// <summary>Two balls with a level link between two static spheres; their masses differ by a fraction of their sum.</summary>
    /// <remarks>
    /// The friction T between them equals that on either sphere. The weights give T (1 + cos t) = half their difference times cos t, and H
    /// is half their sum over tan t. The level link has the least normal force, H, so mu is that fraction times tan(t/2).
    /// </remarks>
    private static Scene Pair(double unlike, double slope, double friction)
    {
        Vector3D right = V(Radius * (1 + (2 * Math.Cos(slope))), -2 * Radius * Math.Sin(slope));
        return Between(new SceneBuilder("pair").WithContactTolerance(Tolerance), right, friction)
            .AddBody("heavy", new BodySpec(Radius, 1 + unlike, 0, friction: friction), V(-Radius))
            .AddBody("light", new BodySpec(Radius, 1 - unlike, 0, friction: friction), V(Radius)).Build();
    }

    /// <summary>
    /// The friction required by a ball on two others, each on a static sphere, without resistance: the T of a lower ball's two links
    /// cancel, which gives H.
    /// </summary>
    private static double OnTwo(double upper, double lower)
    {
        double thrust = 0.5 * (Math.Cos(upper) + (3 * Math.Cos(lower))) / (Math.Sin(upper) + Math.Sin(lower));
        return Math.Max(Needs(upper, 0.5), Needs(lower, 1.5));

        double Needs(double slope, double weight) => Math.Abs((weight * Math.Cos(slope)) - (thrust * Math.Sin(slope)))
            / ((thrust * Math.Cos(slope)) + (weight * Math.Sin(slope)));
    }

    /// <summary>The rolling resistance required by an arch with enough friction.</summary>
    /// <remarks>
    /// Moments are m - r S at all links, with S the sum of both T of each ball down to there, for any one m. They are within c r N if any
    /// two links have |S - S'| at most c (N + N'). At one thrust the c of the worst two is least; on either side of it, it is larger.
    /// </remarks>
    private static double MinResistance(double[] slopes)
    {
        double low = 1e-3, high = 1e3; // of the thrust, in weights of a ball
        for (int n = 0; n < 200; n++)
        {
            double third = (high - low) / 3;
            (low, high) = Asked(low + third) < Asked(high - third) ? (low, high - third) : (low + third, high);
        }

        return Asked(low);

        double Asked(double thrust)
        {
            double most = 0, rubbed = 0, sum = 0;
            List<(double Sum, double Press)> above = [];
            for (int n = 0; n < slopes.Length; n++)
            {
                (double sine, double cosine) = Math.SinCos(slopes[n]);
                double frictionImpulse = ((n + 0.5) * cosine) - (thrust * sine), press = (thrust * cosine) + ((n + 0.5) * sine);
                sum += n == 0 ? 0 : rubbed + frictionImpulse;
                most = above.Aggregate(most, (worst, link) => Math.Max(worst, Math.Abs(link.Sum - sum) / (link.Press + press)));
                above.Add((sum, press));
                rubbed = frictionImpulse;
            }

            return most;
        }
    }

    private static Scene Arch(double[] slopes, double friction, double resistance) =>
        Arch(new SceneBuilder("arch"), slopes, new BodySpec(Radius, 1, 0, friction: friction, rollingResistance: resistance));

    /// <summary>A ball at the top, and links of given slopes from there down to a static sphere on either side.</summary>
    private static Scene Arch(SceneBuilder builder, double[] slopes, BodySpec ball)
    {
        Vector3D at = V(0);
        builder.WithContactTolerance(Tolerance).AddBody("top", ball, at);
        for (int n = 0; n < slopes.Length; n++)
        {
            at += V(2 * Radius * Math.Cos(slopes[n]), -2 * Radius * Math.Sin(slopes[n]));
            if (n < slopes.Length - 1)
            {
                builder.AddBody($"left {n}", ball, V(-at.X, at.Y)).AddBody($"right {n}", ball, at);
            }
        }

        return Between(builder, at, ball.Friction).Build();
    }

    /// <summary>Two static spheres that carry an arch, and smooth walls, without load, that keep it in its plane.</summary>
    private static SceneBuilder Between(SceneBuilder builder, Vector3D right, double friction) => builder
        .AddPlane("front", V(0, 0, 1), -Radius, 0, 0).AddPlane("back", V(0, 0, -1), -Radius, 0, 0)
        .AddStaticSphere("left", V(-right.X, right.Y), Radius, 0, friction).AddStaticSphere("right", right, Radius, 0, friction);

    /// <summary>An inverted hanging chain that never rests. Its thrust is the weight of as many balls as are on either side.</summary>
    private IEnumerable<HardRow> Hanging(HardContext context, int side, double steeper)
    {
        BodySpec ball = new(
            Radius, 1, 0, MotionLaw.Automatic, forces: ForceSet.Of(0), tolerance: 1e-9, friction: 0.1, rollingResistance: Resistance);
        Scene scene = Arch(
            new SceneBuilder("chain").WithGravity(Vector3D.Zero).AddForce(Force.Supplied(new SuppliedWeight())),
            [.. Enumerable.Range(0, side + 1).Select(n => Math.Atan(steeper * (n + 0.5) / side))], ball);
        Simulation simulation = context.Simulate(scene);
        double step = ContactSteps.Step(Tolerance), seconds = Seconds(context), sum = 0;
        int steps = (int)(Watched / step), contacts = (2 * side) + 2;
        for (int n = 0; n < steps; n++)
        {
            SimTime at = SimTime.FromSeconds(seconds - Watched + ((n + 0.5) * step));
            simulation.AdvanceTo(at);
            foreach (BodySnapshot body in simulation.Snapshot(at).Bodies)
            {
                foreach (PersistentContact contact in body.Contacts)
                {
                    sum += contact.Surface >= 0 ? Math.Abs(contact.Push.X) / 2 : 0; // of both static spheres
                }
            }

            context.Report(n / (double)steps);
        }

        simulation.AdvanceTo(SimTime.FromSeconds(seconds));
        string size = FormattableString.Invariant($"an inverted hanging chain of {(2 * side) + 1}, {seconds} s");
        yield return new HardRow(
            Name, size, Drift(simulation, seconds), "drift_m", contacts * ContactSteps.Closing * Tolerance,
            "a tenth of d, 1e-6 m, a contact: a step leaves it to close by half of that at most, and a step later it is put right", "nothing moves");
        yield return new HardRow(
            Name, size, Math.Abs((sum / (steps * step) / (side * Gravity)) - 1), "thrust_relative",
            Allowed(side) + (ContactSteps.Closing * Tolerance / step / Watched / Gravity),
            "what rolling resistance c allows by statics, of the two links that allow least: c (1/cos t + 1/cos t') / (sum of the sines"
                + " - c (cos t + cos t')); and the 0.05 d at which a step leaves it, at both ends of the half second that is watched",
            "the weight above a link over its tangent");
    }

    /// <summary>The fraction by which rolling resistance allows an inverted hanging chain another thrust.</summary>
    /// <remarks>
    /// At H there is no friction. At H' the moments of two links differ by r (H - H') times the sum of both sines of each ball between,
    /// which c r (N + N') bounds. There N is H / cos t + (H' - H) cos t.
    /// </remarks>
    private static double Allowed(int side)
    {
        double least = double.PositiveInfinity;
        for (int upper = 0; upper < side; upper++)
        {
            double sines = 0;
            for (int lower = upper + 1; lower <= side; lower++)
            {
                sines += Math.Sin(Slope(lower - 1)) + Math.Sin(Slope(lower));
                double cosines = Math.Cos(Slope(upper)) + Math.Cos(Slope(lower));
                double presses = (1 / Math.Cos(Slope(upper))) + (1 / Math.Cos(Slope(lower)));
                least = Math.Min(least, Resistance * presses / (sines - (Resistance * cosines)));
            }
        }

        return least;

        double Slope(int link) => Math.Atan((link + 0.5) / side);
    }
}
