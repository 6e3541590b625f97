using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <content>Slipping against rolling resistance, by closed form and in an island's steps; turning on the spot in steps.</content>
internal sealed partial class RollingCase
{
    /// <summary>
    /// The contact tolerance of bodies in steps, and the length of these: the weight is a user-defined force, as large as gravity in the
    /// other cases.
    /// </summary>
    private const double Tolerance = 1e-5;
    private static readonly double Step = ContactSteps.Step(Tolerance);

    /// <summary>
    /// A throw along the floor: friction, resistance, speed, and the speed at which its spin would roll.
    /// </summary>
    private static readonly (double Mu, double C, double Speed, double Turn)[] Throws = [(0.3, 0.1, 2, 0), (0.3, 0.02, 2, -3), (0.2, 0.1, 1, 4), (0.3, 0.3, 2, 0), (0.5, 0.4, 3, -1)];

    private IEnumerable<HardRow> ResistedRows(HardContext context)
    {
        foreach ((double mu, double c, double speed, double turn) in context.Sizes(Throws[..2], Throws))
        {
            foreach (HardRow row in ResistedSlipping(context, mu, c, speed, turn, c).Concat(InSteps(context, mu, c, speed, turn, c)))
            {
                yield return row;
            }
        }

        foreach (bool isSlope in new[] { false, true })
        {
            foreach (double c in context.Sizes([0.2], [0.2, 0.3999, 0.4]))
            {
                foreach (HardRow row in Aslant(context, isSlope, c, c))
                {
                    yield return row;
                }
            }
        }

        foreach (double c in context.Sizes([0.02], [1e-3, 0.02, 0.5]))
        {
            foreach (HardRow row in TurningInSteps(context, c, c))
            {
                yield return row;
            }
        }
    }

    private IEnumerable<HardRow> ResistedControls(HardContext context)
    {
        foreach (HardRow row in Slope(context, -1e-2, 1e-2, 0.05))
        {
            yield return row with { Note = "what rolls taken for what slips" };
        }

        const string More = "a resistance that is a millionth too strong", None = "no resistance";
        foreach (HardRow row in ResistedSlipping(context, 0.3, 0.1, 2, 0, 0.1 * (1 + 1e-6)))
        {
            yield return row with { Note = More };
        }

        foreach (HardRow row in InSteps(context, 0.3, 0.1, 2, 0, 0).Concat(Aslant(context, false, 0.2, 0)))
        {
            yield return row with { Note = None };
        }

        foreach (HardRow row in TurningInSteps(context, 0.02, 0.022))
        {
            yield return row with { Note = "a resistance that is a tenth too strong" };
        }
    }

    private static BodySpec Resisting(double mu, double c, bool inSteps = false) =>
        new(Radius, 1, 0, MotionLaw.Automatic, forces: inSteps ? ForceSet.Of(0) : ForceSet.None, tolerance: 1e-9, friction: mu, rollingResistance: c);

    /// <summary>The weight is a user-defined force, so even a single ball moves in steps.</summary>
    private static Simulation OnFloorInSteps(HardContext context, BodySpec ball, Vector3D velocity, Vector3D spin, double seconds) => context.Run(
        new SceneBuilder("steps").WithGravity(Vector3D.Zero).WithContactTolerance(Tolerance)
            .AddForce(Force.Supplied(new SuppliedWeight())).AddPlane("floor", Vector3D.Up, Vector3D.Zero)
            .AddBody("ball", ball, V(0, Radius), velocity, spin: spin).Build(),
        seconds);

    private static string Thrown(double mu, double c, double speed, double turn) =>
        FormattableString.Invariant($"mu {mu}, resistance {c}, thrown at {speed} m/s, turning as if rolling at {turn} m/s");

    /// <summary>A ball thrown along the floor, until it rests.</summary>
    private IEnumerable<HardRow> ResistedSlipping(HardContext context, double mu, double c, double speed, double turn, double actual)
    {
        ResistedSlip.OnALine rest = ResistedSlip.After(double.MaxValue, mu, c, speed, turn);
        double rests = (speed + Math.Abs(turn)) / (5.0 / 7 * c * Gravity), tick = Rounding.Tick * 2.5 * (mu + c) * Gravity;
        Simulation simulation = OnFloor(context, Resisting(mu, actual), V(speed), V(0, 0, -turn / Radius), rests);
        double rolls = simulation.Timeline(First).Where(entry => entry.State.Motion == MotionLaw.Rolling).Select(entry => entry.Key.Time.ToSeconds()).FirstOrDefault(double.NaN);
        BodyState state = Read(simulation, 0, rests);
        string size = Thrown(mu, c, speed, turn);
        if (!double.IsNaN(rest.Rolls))
        {
            yield return new HardRow(
                Name, size, Math.Abs(rolls - rest.Rolls), "time_s", (4 * Rounding.Tick) + (16 * Rounding.Unit * rest.Rolls),
                "a tick where the turning ends, of which the slip makes up to three, one where the slip ends, and 16 roundings", "even motion between slip, turning and way becoming nothing");
        }

        yield return new HardRow(
            Name, size + ", to rest", state.Motion == MotionLaw.Resting ? Math.Abs(state.Position.X - rest.Way) : double.NaN, "position_m",
            (2 * tick * rests) + (16 * Rounding.Unit * rests * (speed + Math.Abs(turn))),
            "what two ticks of friction and resistance change, for as long as it moves, and 16 roundings", "even motion between slip, turning and way becoming nothing");
    }

    /// <summary>The same in steps, sampled in the middle of the slip, and during rolling.</summary>
    private IEnumerable<HardRow> InSteps(HardContext context, double mu, double c, double speed, double turn, double actual)
    {
        double slips = ResistedSlip.After(double.MaxValue, mu, c, speed, turn).Rolls;
        slips = double.IsNaN(slips) ? speed / (mu * Gravity) : slips;
        Simulation simulation = OnFloorInSteps(context, Resisting(mu, actual, true), V(speed), V(0, 0, -turn / Radius), 1.5 * slips);
        foreach ((double part, string when) in new[] { (0.5, "slipping in steps"), (1.5, "rolling after it in steps") })
        {
            double at = SimTime.FromSeconds(part * slips).ToSeconds();
            ResistedSlip.OnALine line = ResistedSlip.After(at, mu, c, speed, turn);
            BodyState state = Read(simulation, 0, at);
            double most = 2.5 * (mu + c) * Gravity * Step, off = Math.Max(Math.Abs(state.Velocity.X - line.V), Math.Abs((-state.Spin.Z * Radius) - line.Q));
            yield return new HardRow(
                Name, $"{Thrown(mu, c, speed, turn)}, {when}", state.Motion == MotionLaw.Constrained ? off : double.NaN, "velocity_m_per_s", 2 * most,
                "what friction and resistance change in a step, where the turning and where the slip ends", "even motion between slip, turning and way becoming nothing");
            if (part < 1)
            {
                continue; // its path is that without resistance
            }

            yield return new HardRow(
                Name, $"{Thrown(mu, c, speed, turn)}, {when}", Math.Abs(state.Position.X - line.Way), "position_m", 2 * most * at,
                "the same for as long as is watched", "even motion between slip, turning and way becoming nothing");
        }
    }

    /// <summary>Slip and spin at an angle to each other, on a floor or a slope, where both directions turn.</summary>
    private IEnumerable<HardRow> Aslant(HardContext context, bool isSlope, double c, double actual)
    {
        const double mu = 0.4, piece = 1.0 / 128;
        Vector3D normal = isSlope ? V(-0.6, 0.8) : V(0, 1), pull = isSlope ? V(-0.8, -0.6) * (0.6 * Gravity) : Vector3D.Zero;
        Vector3D v = V(0, 0, 3), q = isSlope ? V(0.8, 0.6) * 4 : V(4), x = normal * Radius;
        double pressing = normal.Y * Gravity, seconds = SimTime.FromSeconds(0.9 * (v - q).Length / (pull.Length + (((3.5 * mu) + (2.5 * c)) * pressing))).ToSeconds();
        Scene scene = new SceneBuilder("aslant").AddPlane("plane", normal, 0.0).AddBody("ball", Resisting(mu, actual), x, v, spin: Vector3D.Cross(normal, q) / Radius).Build();
        BodyState state = Read(context.Run(scene, seconds), 0, seconds);
        (Vector3D way, v, q) = ResistedSlip.After(seconds, 20_000, mu, c, pressing, pull, v, q);
        string size = FormattableString.Invariant($"mu {mu}, resistance {c}, turning aslant to the slip, {(isSlope ? "across a slope of 3 in 4" : "on a floor")}");
        double bound = piece * piece / 8 * ((3.5 * mu) + (2.5 * c)) * pressing * seconds;
        const string Argument = "a direction is that of a piece's middle, up to a square of the 1/128 rad that it may turn in one: an eighth of that, of all that friction and resistance change";
        yield return new HardRow(Name, size, (state.Velocity - v).Length, "velocity_m_per_s", bound, Argument, "20000 Runge-Kutta steps");
        yield return new HardRow(Name, size, ((Vector3D.Cross(state.Spin, normal) * Radius) - q).Length, "surface_velocity_m_per_s", bound, Argument, "20000 Runge-Kutta steps");
        yield return new HardRow(Name, size, (state.Position - x - way).Length, "position_m", bound * seconds, Argument + ", for as long as is watched", "20000 Runge-Kutta steps");
    }

    /// <summary>A ball that spins about the normal in contact steps, until it stops.</summary>
    private IEnumerable<HardRow> TurningInSteps(HardContext context, double resistance, double actual)
    {
        const double turning = 4;
        double rate = 2.5 * resistance * Gravity / Radius, stops = turning / rate, middle = ContactSteps.TickBefore(stops / 2, Step);
        Simulation simulation = OnFloorInSteps(context, Resisting(1, actual, true), default, V(0, turning), stops + (4 * Step));
        double still = double.NaN;
        foreach (TimelineEntry entry in simulation.Timeline(First))
        {
            bool isStill = entry.State.Spin.Length <= 16 * Rounding.Unit * turning;
            still = !isStill ? double.NaN : double.IsNaN(still) ? entry.Key.Time.ToSeconds() : still;
        }

        BodyState state = ContactSteps.AtTick(simulation, 0, middle, Step);
        string size = FormattableString.Invariant($"turns on the spot with resistance {resistance} in steps");
        yield return new HardRow(
            Name, size, state.Motion == MotionLaw.Constrained ? Math.Abs(state.Spin.Y - (turning - (rate * middle))) : double.NaN, "spin_rad_per_s",
            middle / Step * 16 * Rounding.Unit * turning, "at a tick, the mean of both sides: 16 roundings a step", "w - 5 c g t/(2 r)");
        yield return new HardRow(
            Name, size, Math.Abs(still - stops), "time_s", (Step / 2) + Rounding.Tick,
            "half a step: a step in whose middle nothing is left of it has none; 16 roundings of it count as nothing", "2 w r/(5 c g)");
    }
}
