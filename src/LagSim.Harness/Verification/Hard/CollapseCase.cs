using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// Inelastic collapse: three balls in a line, or two and a wall, meet infinitely often below a known restitution, and finitely often above
/// it.
/// </summary>
internal sealed class CollapseCase : IHardCase
{
    private const int Infinite = 100_000;

    /// <summary>The speed in m/s below which the rules for persistent contact apply, and positions of some metres are too coarse.</summary>
    private const double Resolved = 1e-7;

    private static readonly double ThreeBalls = 7 - (4 * Math.Sqrt(3));
    private static readonly double TwoAndWall = 3 - (2 * Math.Sqrt(2));

    public string Name => "collapse";

    public string Title => "inelastic collapse of three balls and of two and a wall: thresholds 7 - 4 sqrt 3 and 3 - 2 sqrt 2";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach ((bool isWall, double threshold) in new[] { (false, ThreeBalls), (true, TwoAndWall) })
        {
            foreach (double factor in context.Sizes([0.7, 1.2], [0.3, 0.7, 0.95, 0.99, 1.01, 1.05, 1.2, 2, 4]))
            {
                yield return Row(isWall, threshold * factor, Run(context, isWall, threshold * factor));
            }
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        yield return Row(false, 1.2 * ThreeBalls, Run(context, false, 0.5)) with { Note = "another restitution" };
        yield return Row(true, 0.7 * TwoAndWall, Run(context, true, 0.5)) with { Note = "another restitution" };
    }

    private static (long Impacts, double Apart) Run(HardContext context, bool isWall, double e)
    {
        SceneBuilder builder = Floating("collapse");
        if (isWall)
        {
            builder.AddPlane("wall", V(1), V(0)).AddBody("near", Ball(e: e), V(1.5), V(-1)).AddBody("far", Ball(e: e), V(4), V(-2));
        }
        else
        {
            builder.AddBody("left", Ball(e: e), V(-2), V(1)).AddBody("middle", Ball(e: e), default).AddBody("right", Ball(e: e), V(2.25), V(-1));
        }

        Simulation simulation = context.Run(builder.Build(), 10);
        double[] v = Enumerable.Range(0, simulation.BodyCount).Select(n => Read(simulation, n, 10).Velocity.X).ToArray();
        return (simulation.ImpactsProcessed, isWall ? v.Max(Math.Abs) : v.Max() - v.Min());
    }

    private HardRow Row(bool isWall, double e, (long Impacts, double Apart) seen)
    {
        int exact = Count(isWall, e, out double apart, out double slowest);
        string size = FormattableString.Invariant($"{(isWall ? "two and a wall" : "three balls")}, e {e:0.0000}, ");
        return exact == Infinite
            ? new HardRow(
                Name, size + "below the threshold", seen.Impacts < 10_000 ? seen.Apart : double.NaN, "speed_apart_m_per_s", 1e-6,
                "what still closes slower than 1 um/s is left alone: the rule by which a collapse ends; more than 10,000 events is no end and fails",
                "McNamara and Young 1992: infinitely many impacts in finite time, all together after it")
            {
                Note = FormattableString.Invariant($"{seen.Impacts} impacts"),
            }
            : slowest < Resolved ? new HardRow(
                Name, size + "above the threshold", seen.Impacts < 10_000 ? Math.Abs(seen.Apart - apart) : double.NaN, "speed_apart_m_per_s", 1e-12,
                "the last of them close in one instant, and slower than rounding in the others' speeds can tell; so their number cannot be told",
                FormattableString.Invariant($"the recursion of the speeds alone: {exact} impacts, the last at {slowest:0.0e0} m/s"))
            {
                Note = FormattableString.Invariant($"{seen.Impacts} impacts"),
            }
            : new HardRow(
                Name, size + "above the threshold", Math.Max(Math.Abs(seen.Impacts - exact), Math.Abs(seen.Apart - apart) > 1e-9 ? 1 : 0), "count", 0,
                "a count is right or wrong, and so is what they part with, to 1 nm/s",
                    FormattableString.Invariant($"the recursion of the speeds alone: {exact} impacts, at the end {apart:0.000e0} m/s apart"))
            {
                Note = FormattableString.Invariant($"{seen.Impacts} impacts, {seen.Apart:0.000e0} m/s apart"),
            };
    }

    /// <summary>
    /// Returns how often they meet, from their speeds alone: contacts alternate, and each is a linear map of the two rates at which the
    /// gaps grow.
    /// </summary>
    private static int Count(bool isWall, double e, out double apart, out double slowest)
    {
        // The gap between the first two (or the wall and the near ball) closes first.
        double first = -1, second = -1, scale = 1; // the speeds are first and second times scale, which never underflow
        slowest = 1;
        double half = (1 + e) / 2;
        int count = 0;
        for (bool isFirst = true; (isFirst ? first : second) < 0 && count < Infinite; isFirst = !isFirst, count++)
        {
            slowest = -scale * (isFirst ? first : second);
            (first, second) = (isFirst, isWall) switch
            {
                (true, true) => (-e * first, second + ((1 + e) * first)),
                (true, false) => (-e * first, second + (half * first)),
                _ => (first + (half * second), -e * second),
            };
            double larger = Math.Max(Math.Abs(first), Math.Abs(second));
            (first, second, scale) = (first / larger, second / larger, scale * larger);
        }

        apart = scale * Math.Max(Math.Max(isWall ? 0 : Math.Abs(second), Math.Abs(first)), Math.Abs(first + second));
        return count;
    }
}
