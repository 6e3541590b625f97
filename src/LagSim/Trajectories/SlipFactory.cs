using System;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Trajectories;

/// <summary>Opens motion on a plane with friction: slipping, rolling, rest.</summary>
/// <remarks>
/// <para>A solid sphere that moves with v, turns with q = r w x n, as fast as it would have to move to roll so, and slips with u = v - q is
/// slowed down by mu g_n against u and turned by 5/2 as much, with g_n and g_t what gravity has across and along the plane. Rolling
/// resistance c takes 5/2 c g_n from q. So v' = g_t - mu g_n u/|u|, q' = 5/2 mu g_n u/|u| - 5/2 c g_n q/|q|. Both are constant as long
/// as the directions of u and q are; these turn unless gravity pulls along them. A sphere that does not turn yet begins to with q' along
/// u, since c counts for no more than mu.</para>
/// <para>Once u is zero it rolls, with 5/7 of g_t - c g_n v/|v|, if 2/7 g_t + 5/7 c g_n v/|v|, which friction then has to give, is no more
/// than mu g_n. Resistance holds at rest what gravity pulls by no more than c g_n. From what turns about the normal it takes 5/2 c g_n / r,
/// whether the sphere slips, rolls or stays where it is.</para>
/// </remarks>
internal sealed class SlipFactory(Scene scene, BodyTable bodies, TimelineStore timelines, StateLimits limits)
{
    /// <summary>
    /// The largest turn, in radians, of the direction of slip or rolling in one segment, where gravity does not pull along it.
    /// </summary>
    private const double MaxTurn = 1.0 / 128;

    /// <summary>A slip, motion or turning on a surface slower than this, in m/s, counts as the rounding of zero.</summary>
    private const double RoundingSlip = 1e-10;

    private readonly StaticSurfaces surfaces = scene.Surfaces;

    /// <summary>The coefficient of friction of a body on a plane: the lesser of the two.</summary>
    internal double On(int slot, int plane) => Math.Min(bodies.Spec(slot).Friction, surfaces.Plane(plane).Friction);

    /// <summary>Opens slipping, rolling or rest on the one plane that carries a body.</summary>
    internal void Open(
        int slot, in EventKey key, in Vector3D position, in Vector3D velocity, in Vector3D spin, SupportSet supports, in Vector3D pull,
        SimDuration left)
    {
        ref readonly BodySpec spec = ref bodies.Spec(slot);
        Vector3D n = surfaces.Plane(supports[0]).Normal;
        double pressing = -Vector3D.Dot(n, scene.Gravity), mu = On(slot, supports[0]);
        SlidingContact at = new()
        {
            Position = position,
            Velocity = velocity,
            Spin = spin,
            Radius = spec.Radius,
            Normal = n,
            Pull = pull,
            Grip = mu * pressing,
            Resistance = Math.Min(spec.RollingResistance, mu) * pressing,
            Turn = Vector3D.Cross(spin, n) * spec.Radius,
            Supports = supports,
        };

        // The change of a speed in a tick: times are rounded to ticks.
        double tick = SimDuration.OneTick.ToSeconds() * (pull.Length + (3.5 * at.Grip) + (2.5 * at.Resistance));
        at.Pivot = n * Vector3D.Dot(n, spin);
        at.Slowing = Slowing(ref at.Pivot, 2.5 * at.Resistance / spec.Radius, RoundingSlip / spec.Radius);
        Vector3D slip = velocity - at.Turn;
        slip -= n * Vector3D.Dot(n, slip);
        bool slips = slip.Length > RoundingSlip + (1e-12 * velocity.Length) + tick;
        bool moves = velocity.Length > RoundingSlip + tick;
        Vector3D heading = moves ? velocity / velocity.Length : pull.Length > at.Resistance ? pull / pull.Length : Vector3D.Zero;
        bool holds = ((pull * (2.0 / 7)) + (heading * (5.0 / 7 * at.Resistance))).Length <= at.Grip;
        if (slips || !holds)
        {
            Vector3D push = pull + (heading * (2.5 * at.Resistance)); // what makes it slip if it does not yet
            Vector3D along = slips ? slip / slip.Length : push / push.Length;
            Vector3D over = at.Resistance > 0 && at.Turn.Length > RoundingSlip + tick ? at.Turn / at.Turn.Length : along;
            OpenSlipping(slot, key, at, slip, along, over);
        }
        else if (!moves && pull.Length <= at.Resistance)
        {
            OpenStill(slot, key, at, left);
        }
        else
        {
            OpenRolling(slot, key, at, moves ? velocity : Vector3D.Zero, heading);
        }
    }

    /// <summary>Opens a segment of slipping in one direction and turning in another.</summary>
    private void OpenSlipping(int slot, in EventKey key, in SlidingContact at, in Vector3D slip, Vector3D along, Vector3D over)
    {
        Vector3D push = at.Pull + (over * (2.5 * at.Resistance)), rate = push - (along * (3.5 * at.Grip)), drive = along * (2.5 * at.Grip);
        SimTime end = SimTime.Min(EndOfTurning(key.Time, slip, along, push, Vector3D.Dot(along, rate)), EndOfPivoting(key.Time, at.Pivot, at.Slowing));
        if (!over.Equals(along))
        {
            end = SimTime.Min(end, EndOfFollowing(key.Time, at.Turn, over, drive, 2.5 * at.Resistance));
            over = Following(at.Turn, drive, key.Time, end);
        }

        along = Midway(slip, along, rate, key.Time, end);
        Vector3D held = along * at.Grip;
        Vector3D turning = (Vector3D.Cross(at.Normal, held - (over * at.Resistance)) * (2.5 / at.Radius)) - at.Slowing;
        Vector3D acceleration = (at.Pull - held).WithoutNegativeZero();
        end = SimTime.Min(end, limits.EndOfRange(key.Time, at.Velocity, acceleration));
        MotionSegment path = new(MotionLaw.Sliding, key.Time, end, at.Position, at.Velocity, acceleration, at.Supports);
        timelines.Append(slot, bodies.Id(slot), key, path, default, spin: new Spin(at.Spin, turning));
    }

    /// <summary>
    /// Opens a segment of staying in place, turning on the spot or not, or bouncing by less than counts, for a given time.
    /// </summary>
    private void OpenStill(int slot, in EventKey key, in SlidingContact at, SimDuration left)
    {
        SimTime still = EndOfPivoting(key.Time, at.Pivot, at.Slowing);
        bool turns = at.Slowing != Vector3D.Zero;
        Vector3D slowing = at.Slowing;
        MotionSegment path;
        if (left > SimDuration.Zero)
        {
            // A body that has stopped turning before the bounces that are left out would have been over stops with them.
            slowing = still < key.Time + left ? at.Pivot * (1 / left.ToSeconds()) : slowing;
            path = new MotionSegment(MotionLaw.Sliding, key.Time, key.Time + left, at.Position, Vector3D.Zero, Vector3D.Zero, at.Supports);
        }
        else
        {
            path = turns ? new MotionSegment(MotionLaw.Rolling, key.Time, still, at.Position, Vector3D.Zero, Vector3D.Zero, at.Supports)
                : MotionSegment.AtRest(key.Time, at.Position, at.Supports);
        }

        timelines.Append(slot, bodies.Id(slot), key, path, default, spin: new Spin(at.Pivot, -slowing));
    }

    /// <summary>Opens a segment of rolling in one direction.</summary>
    private void OpenRolling(int slot, in EventKey key, in SlidingContact at, in Vector3D start, Vector3D heading)
    {
        Vector3D change = (at.Pull - (heading * at.Resistance)) * (5.0 / 7);
        SimTime stop = SimTime.Min(EndOfTurning(key.Time, start, heading, at.Pull, Vector3D.Dot(heading, change)), EndOfPivoting(key.Time, at.Pivot, at.Slowing));
        heading = Midway(start, heading, change, key.Time, stop);
        change = ((at.Pull - (heading * at.Resistance)) * (5.0 / 7)).WithoutNegativeZero();
        stop = SimTime.Min(stop, limits.EndOfRange(key.Time, start, change));
        MotionSegment path = new(MotionLaw.Rolling, key.Time, stop, at.Position, start, change, at.Supports);
        timelines.Append(
            slot, bodies.Id(slot), key, path, default,
            spin: new Spin((Vector3D.Cross(at.Normal, start) / at.Radius) + at.Pivot, (Vector3D.Cross(at.Normal, change) / at.Radius) - at.Slowing));
    }

    /// <summary>A sphere on a plane with friction.</summary>
    private struct SlidingContact
    {
        internal Vector3D Position;
        internal Vector3D Velocity;
        internal Vector3D Spin;
        internal double Radius;
        internal Vector3D Normal;
        internal Vector3D Pull; // of gravity, along the plane
        internal double Grip; // mu times what gravity has across it
        internal double Resistance; // and the coefficient of rolling resistance times that
        internal Vector3D Turn; // as fast as it would have to move to roll
        internal Vector3D Pivot; // what turns about the normal
        internal Vector3D Slowing; // and what resistance takes from that
        internal SupportSet Supports;
    }

    /// <summary>
    /// The deceleration by rolling resistance of a body that turns about the normal, in rad/s². If it turns slower than
    /// <paramref name="least"/>, or than a tick takes, it turns no more.
    /// </summary>
    private static Vector3D Slowing(ref Vector3D pivot, double rate, double least)
    {
        if (!(rate > 0))
        {
            return Vector3D.Zero; // and continues to turn
        }

        double speed = pivot.Length;
        bool turns = speed > least + (rate * SimDuration.OneTick.ToSeconds());
        pivot = turns ? pivot : Vector3D.Zero;
        return turns ? pivot * (rate / speed) : Vector3D.Zero;
    }

    private static SimTime EndOfPivoting(SimTime from, in Vector3D pivot, in Vector3D slowing) =>
        slowing != Vector3D.Zero && TryTicks(from, pivot.Length / slowing.Length, out SimDuration turns) ? from + turns : SimTime.MaxValue;

    /// <summary>
    /// When something that slips or rolls with that velocity has stopped doing so, or has turned so far that a new segment is due; never,
    /// if neither comes.
    /// </summary>
    private SimTime EndOfTurning(SimTime from, in Vector3D velocity, in Vector3D along, in Vector3D pull, double rate) =>
        TryTicks(from, SecondsOfTurning(velocity, along, pull, rate), out SimDuration turns) ? from + turns : SimTime.MaxValue;

    private double SecondsOfTurning(in Vector3D velocity, in Vector3D along, in Vector3D pull, double rate)
    {
        double seconds = rate < 0 ? -velocity.Length / rate : double.PositiveInfinity;
        double aslant = Vector3D.Cross(along, pull).Length;
        return aslant > 1e-13 * pull.Length && velocity.Length > 0 ? Math.Min(seconds, Turn(velocity.Length, pull) * velocity.Length / aslant) : seconds;
    }

    /// <summary>Some seconds from then on, a tick at least; false if that is beyond all time.</summary>
    private static bool TryTicks(SimTime from, double seconds, out SimDuration span)
    {
        bool fits = TickConversion.TryFromSeconds(seconds, out long ticks) && ticks <= SimTime.MaxValue.Ticks - Math.Max(0, from.Ticks);
        span = SimDuration.FromTicks(Math.Max(1, ticks));
        return fits;
    }

    /// <summary>
    /// By how much, in radians, the direction of something so fast may turn in a segment. A segment is off by its speed times the cube of
    /// that; so what is slower than a hundred times what it gets within the scene's restitution threshold, some 14 mm/s, may turn more, as
    /// the inverse of the fourth root, and is off by less than that is all the same, some 7 nm/s. Else what starts from next to nothing
    /// would take thousands of segments, and what hops again and again would each time.
    /// </summary>
    private double Turn(double speed, in Vector3D pull)
    {
        double slow = 100 * Math.Sqrt(2 * scene.RestitutionThreshold * pull.Length);
        return speed < slow ? Math.Min(0.5, MaxTurn * Math.Sqrt(Math.Sqrt(slow / speed))) : MaxTurn;
    }

    /// <summary>
    /// The time when a body that slips and turns with that surface speed has stopped turning, or when a new segment is due because the
    /// direction in which it turns follows that of the slip, at the rate of drive / speed.
    /// </summary>
    /// <remarks>
    /// Once less of that is left than may turn in a segment, the rest fades away within some speed / drive. A segment is at most a quarter
    /// of that, but not below 2^-8 s: <see cref="Following"/> works for any length. A slow direction follows at once, and stays slow as
    /// long as resistance lets it gain little.
    /// </remarks>
    private SimTime EndOfFollowing(SimTime from, in Vector3D turn, in Vector3D over, in Vector3D drive, double resistance)
    {
        double rate = Vector3D.Dot(over, drive) - resistance;
        double aslant = Vector3D.Cross(over, drive).Length;
        double most = Turn(turn.Length, drive);
        bool follows = Vector3D.Dot(over, drive) > 0 && aslant <= most * drive.Length;
        double seconds = rate < 0 ? -turn.Length / rate : double.PositiveInfinity;
        seconds = follows ? Math.Min(seconds, Math.Max(0.25 * turn.Length / drive.Length, 1.0 / 256)) : Math.Min(seconds, most * turn.Length / aslant);
        return TryTicks(from, seconds, out SimDuration turns) ? from + turns : SimTime.MaxValue;
    }

    /// <summary>
    /// The direction in which a body turns in a segment under a constant drive: the one at its middle, which is right to second order; or,
    /// for a segment long against speed / drive, the one at its end, which works for any length.
    /// </summary>
    private static Vector3D Following(in Vector3D turn, in Vector3D drive, SimTime from, SimTime end)
    {
        double seconds = end == SimTime.MaxValue ? double.PositiveInfinity : end.SecondsSince(from);
        double part = seconds * drive.Length > 2 * turn.Length ? seconds : 0.5 * seconds;
        Vector3D then = double.IsPositiveInfinity(part) ? drive : turn + (drive * part);
        double length = then.Length;
        return length > 0 ? then / length : turn / turn.Length;
    }

    /// <summary>
    /// The direction at the middle of a segment, which makes it right to the second order; as it was where it does not turn.
    /// </summary>
    private static Vector3D Midway(in Vector3D velocity, in Vector3D along, in Vector3D rate, SimTime from, SimTime end)
    {
        if (end == SimTime.MaxValue || Vector3D.Cross(along, rate).Length <= 1e-13 * rate.Length)
        {
            return along;
        }

        Vector3D middle = velocity + (rate * (0.5 * end.SecondsSince(from)));
        double length = middle.Length;
        return length > 0 ? middle / length : along;
    }
}
