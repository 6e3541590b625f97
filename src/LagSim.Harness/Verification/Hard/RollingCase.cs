using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;
using LagSim.Time;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// A solid sphere on a plane with friction: from slipping to rolling, from rolling to rest, spinning on the spot, and down a slope, against
/// the textbook's formulas.
/// </summary>
/// <remarks>
/// Slip, the velocity of the surface, loses 7/2 mu g a second and is gone after 2 v/(7 mu g), with 5/7 of the speed left. Down a slope it
/// rolls with 5/7 g (sin a - c cos a) if 2/7 tan a + 5/7 c is at most mu, else it slips with g (sin a - mu cos a). All segments are
/// parabolas, so the only error besides rounding is that a change of segments happens at a tick.
/// </remarks>
internal sealed partial class RollingCase : IHardCase
{
    private const double Radius = 0.5;

    public string Name => "rolling";

    public string Title => "a sphere on a plane with friction: slipping to rolling, rolling or turning to rest, rolling or slipping down a slope";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach ((double mu, double speed) in context.Sizes([(0.3, 2.0)], [(0.01, 0.1), (0.3, 2), (1, 100.0)]))
        {
            foreach (HardRow row in Slipping(context, mu, speed, 0))
            {
                yield return row;
            }
        }

        foreach (double resistance in context.Sizes([0.02], [1e-4, 0.02, 0.5]))
        {
            yield return Resisted(context, resistance, resistance);
            foreach (HardRow row in Turning(context, resistance, resistance))
            {
                yield return row;
            }
        }

        foreach (double nearness in context.Sizes([1e-6, -1e-6], [0.5, 1e-2, 1e-6, 1e-12, -1e-12, -1e-6, -1e-2, -0.5]))
        {
            foreach (HardRow row in Slope(context, nearness, nearness, 0).Concat(Slope(context, nearness, nearness, 0.05)))
            {
                yield return row;
            }
        }

        foreach (HardRow row in ResistedRows(context))
        {
            yield return row;
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        foreach (HardRow row in Slipping(context, 0.3, 2, 1e-6))
        {
            yield return row with { Note = "thrown with a little spin" };
        }

        yield return Resisted(context, 0.02, 0.02 * (1 + 1e-6)) with { Note = "a resistance that is a millionth too strong" };
        foreach (HardRow row in Turning(context, 0.02, 0.02 * (1 + 1e-6)))
        {
            yield return row with { Note = "a resistance that is a millionth too strong" };
        }

        foreach (HardRow row in Slope(context, -1e-2, 1e-2, 0))
        {
            yield return row with { Note = "what rolls taken for what slips" };
        }

        foreach (HardRow row in ResistedControls(context))
        {
            yield return row;
        }
    }

    private static Simulation OnFloor(HardContext context, BodySpec ball, Vector3D velocity, Vector3D spin, double seconds) => context.Run(
        new SceneBuilder("floor").AddPlane("floor", Vector3D.Up, Vector3D.Zero).AddBody("ball", ball, V(0, Radius), velocity, spin: spin).Build(), seconds);

    /// <summary>A ball thrown along the floor, with no spin except in the control, simulated for twice the duration of the slip.</summary>
    private IEnumerable<HardRow> Slipping(HardContext context, double mu, double speed, double spin)
    {
        double slips = 2 * speed / (7 * mu * Gravity), end = SimTime.FromSeconds(2 * slips).ToSeconds();
        Simulation simulation = OnFloor(context, new BodySpec(Radius, 2, 0, friction: mu), V(speed), V(0, 0, spin), end);
        double rolls = double.NaN;
        foreach (Timelines.TimelineEntry entry in simulation.Timeline(First))
        {
            rolls = entry.State.Motion == MotionLaw.Rolling && double.IsNaN(rolls) ? entry.Key.Time.ToSeconds() : rolls;
        }

        BodyState state = Read(simulation, 0, end);
        string size = FormattableString.Invariant($"mu {mu}, thrown at {speed} m/s");
        double way = (speed * slips) - (mu * Gravity * slips * slips / 2) + (5.0 / 7 * speed * (end - slips));
        double tick = mu * Gravity * Rounding.Tick, rounding = 16 * Rounding.Unit;
        yield return new HardRow(
            Name, size, Math.Abs(rolls - slips), "time_s", Rounding.Tick + (rounding * slips), "a tick, and 16 roundings", "2 v/(7 mu g)");
        yield return new HardRow(
            Name, size, Math.Max((state.Velocity - V(5.0 / 7 * speed)).Length, ((state.Spin * Radius) - V(0, 0, -5.0 / 7 * speed)).Length), "velocity_m_per_s",
            (2.5 * tick) + (rounding * speed), "what friction does in a tick, 5/2 of it to the turning, and 16 roundings", "5/7 v, and as much over r of spin");
        yield return new HardRow(
            Name, size, (state.Position - V(way, Radius)).Length, "position_m", (tick * end) + (rounding * way),
            "what friction does in a tick, for as long as is watched, and 16 roundings", "v t - mu g t^2/2, then 5/7 v t");
    }

    /// <summary>A ball that rolls along the floor until it rests.</summary>
    private HardRow Resisted(HardContext context, double resistance, double actual)
    {
        const double speed = 1;
        double brake = 5.0 / 7 * resistance * Gravity, stops = speed / brake;
        Simulation simulation = OnFloor(
            context, new BodySpec(Radius, 1, 0, friction: 1, rollingResistance: actual), V(speed), V(0, 0, -speed / Radius), 2 * stops);
        BodyState state = Read(simulation, 0, 2 * stops);
        double way = speed * speed / (2 * brake), off = Math.Abs(state.Position.X - way);
        return new HardRow(
            Name, FormattableString.Invariant($"rolls with resistance {resistance} to rest"), state.Motion == MotionLaw.Resting ? off : double.NaN,
            "position_m",
            (Rounding.Tick * Rounding.Tick * brake) + (16 * Rounding.Unit * way), "what is left of the way in a tick, and 16 roundings", "7 v^2/(10 c g)");
    }

    /// <summary>A ball that spins about the normal, on the spot, until it rests.</summary>
    private IEnumerable<HardRow> Turning(HardContext context, double resistance, double actual)
    {
        const double turning = 4;
        double rate = 2.5 * resistance * Gravity / Radius, stops = turning / rate, middle = SimTime.FromSeconds(stops / 2).ToSeconds();
        Simulation simulation = OnFloor(context, new BodySpec(Radius, 1, 0, friction: 1, rollingResistance: actual), default, V(0, turning), 2 * stops);
        double rests = double.NaN;
        foreach (Timelines.TimelineEntry entry in simulation.Timeline(First))
        {
            rests = entry.State.Motion == MotionLaw.Resting ? entry.Key.Time.ToSeconds() : rests;
        }

        string size = FormattableString.Invariant($"turns on the spot with resistance {resistance} to rest");
        yield return new HardRow(
            Name, size, Math.Abs(Read(simulation, 0, middle).Spin.Y - (turning - (rate * middle))), "spin_rad_per_s", 16 * Rounding.Unit * turning, "16 roundings", "w - 5 c g t/(2 r)");
        yield return new HardRow(
            Name, size, Math.Abs(rests - stops), "time_s", Rounding.Tick + (16 * Rounding.Unit * stops), "a tick, and 16 roundings", "2 w r/(5 c g)");
    }

    /// <summary>
    /// A ball released on a slope of 3 in 4, with friction above or below what rolling needs, which is more with rolling resistance.
    /// </summary>
    private IEnumerable<HardRow> Slope(HardContext context, double nearness, double actual, double c)
    {
        const double sine = 0.6, cosine = 0.8, seconds = 2;
        Vector3D normal = V(-sine, cosine), down = V(-cosine, -sine);
        double needed = (2.0 / 7 * sine / cosine) + (5.0 / 7 * c), mu = needed * (1 + nearness);
        Scene scene = new SceneBuilder("slope").AddPlane("slope", normal, 0.0)
            .AddBody("ball", new BodySpec(Radius, 1, 0, friction: needed * (1 + actual), rollingResistance: c), normal * Radius).Build();
        BodyState state = Read(context.Run(scene, seconds), 0, seconds);
        double a = nearness >= 0 ? 5.0 / 7 * Gravity * (sine - (c * cosine)) : Gravity * (sine - (mu * cosine));
        double turning = nearness >= 0 ? a / Radius : 2.5 * (mu - c) * Gravity * cosine / Radius;
        string size = FormattableString.Invariant($"slope of 3 in 4, friction {1 + nearness:0.############} times what rolling needs{(c > 0 ? $", resistance {c}" : "")}");
        string law = nearness >= 0 ? "5/7 g (sin a - c cos a)" : "g (sin a - mu cos a)";
        double way = a * seconds * seconds / 2;
        yield return new HardRow(
            Name, size, (state.Position - (normal * Radius) - (down * way)).Length, "position_m", 32 * Rounding.Unit * Gravity * seconds * seconds,
            "one parabola: 32 roundings of g t^2", law + " t^2/2");
        yield return new HardRow(
            Name, size, Math.Abs(state.Spin.Z - (turning * seconds)), "spin_rad_per_s", 32 * Rounding.Unit * Gravity * seconds / Radius,
            "32 roundings of g t/r", nearness >= 0 ? law + " t/r" : "5/2 (mu - c) g cos a t/r");
        yield return new HardRow(
            Name, size, state.Motion == (nearness >= 0 ? MotionLaw.Rolling : MotionLaw.Sliding) ? 0 : 1, "count", 0, "it rolls or it slips",
            "it rolls if 2/7 tan a + 5/7 c is at most mu");
    }
}
