using System;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim;

/// <content>Friction on a plane: slipping, rolling, rest.</content>
/// <remarks>
/// <para>A solid sphere that moves with v, turns with q = r w x n, as fast as it would have to move to roll so, and slips with u = v - q is slowed down by mu
/// g_n against u and turned by 5/2 as much, with g_n and g_t what gravity has across and along the plane. Rolling resistance c takes 5/2 c g_n from q. So v' =
/// g_t - mu g_n u/|u|, q' = 5/2 mu g_n u/|u| - 5/2 c g_n q/|q|: even, but for the two directions, which turn where they and gravity are aslant. What does not
/// turn yet begins to do so with q' along u, for c counts for no more than mu.</para>
/// <para>Once u is zero it rolls, with 5/7 of g_t - c g_n v/|v|, if 2/7 g_t + 5/7 c g_n v/|v|, which friction then has to give, is no more than mu g_n.
/// Resistance holds at rest what gravity pulls by no more than c g_n. From what turns about the normal it takes 5/2 c g_n / r, whether the sphere slips, rolls
/// or stays where it is.</para>
/// </remarks>
public sealed partial class Simulation
{
    /// <summary>Slower than this, in m/s, is what rounding times and states leave of zero.</summary>
    private const double Stopped = 1e-10;

    /// <summary>By how much a direction of slip or rolling may turn in one piece of path, in radians, where gravity pulls aslant.</summary>
    private const double MostTurn = 1.0 / 128;

    private double FrictionOn(int slot, int plane) => Math.Min(bodies[slot].Spec.Friction, Scene.PlaneArray[plane].Friction);

    /// <summary>Opens slipping, rolling or rest on the one plane that carries a body.</summary>
    private void OpenRubbing(
        int slot, in EventKey key, in Vector3D position, in Vector3D velocity, in Vector3D spin, SupportSet supports, in Vector3D pull, int crowding,
        SimDuration left)
    {
        ref readonly BodySpec spec = ref bodies[slot].Spec;
        Vector3D n = Scene.PlaneArray[supports[0]].Normal;
        double pressing = -Vector3D.Dot(n, Scene.Gravity);
        double mu = FrictionOn(slot, supports[0]);
        double resistance = Math.Min(spec.RollingResistance, mu) * pressing;
        Vector3D turn = Vector3D.Cross(spin, n) * spec.Radius; // as fast as it would have to move to roll
        Vector3D slip = velocity - turn;
        slip -= n * Vector3D.Dot(n, slip);

        // What a tick changes of a speed: times are rounded to ticks.
        double tick = SimDuration.OneTick.ToSeconds() * (pull.Length + (3.5 * mu * pressing) + (2.5 * resistance));
        Vector3D pivot = n * Vector3D.Dot(n, spin); // what turns about the normal
        Vector3D slowing = Slowing(ref pivot, 2.5 * resistance / spec.Radius, Stopped / spec.Radius);
        bool slips = slip.Length > Stopped + (1e-12 * velocity.Length) + tick;
        bool moves = velocity.Length > Stopped + tick;
        Vector3D heading = moves ? velocity / velocity.Length : pull.Length > resistance ? pull / pull.Length : Vector3D.Zero;
        bool holds = ((pull * (2.0 / 7)) + (heading * (5.0 / 7 * resistance))).Length <= mu * pressing;
        if (slips || !holds)
        {
            Vector3D push = pull + (heading * (2.5 * resistance)); // what makes it slip if it does not yet
            Vector3D along = slips ? slip / slip.Length : push / push.Length;
            bool turns = resistance > 0 && turn.Length > Stopped + tick;
            Vector3D over = turns ? turn / turn.Length : along;
            push = pull + (over * (2.5 * resistance));
            Vector3D rate = push - (along * (3.5 * mu * pressing));
            Vector3D drive = along * (2.5 * mu * pressing);
            Vector3D turnRate = drive - (over * (2.5 * resistance));
            SimTime end = SimTime.Min(EndOfTurning(key.Time, slip, along, push, Vector3D.Dot(along, rate)), EndOfPivoting(key.Time, pivot, slowing));
            if (turns && TryTicks(key.Time, SecondsOfTurning(turn, over, drive, Vector3D.Dot(over, turnRate)), out SimDuration until))
            {
                end = SimTime.Min(end, key.Time + until);
            }

            along = Midway(slip, along, rate, key.Time, end);
            over = turns ? Midway(turn, over, turnRate, key.Time, end) : along;
            Vector3D held = along * (mu * pressing);
            Vector3D turning = (Vector3D.Cross(n, held - (over * resistance)) * (2.5 / spec.Radius)) - slowing;
            Append(
                slot, key, new MotionSegment(MotionLaw.Sliding, key.Time, end, position, velocity, (pull - held).WithoutNegativeZero(), supports, crowding),
                default, spin: new Spin(spin, turning));
            return;
        }

        if (!moves && pull.Length <= resistance)
        {
            SimTime still = EndOfPivoting(key.Time, pivot, slowing);
            if (left > SimDuration.Zero)
            {
                // Until the bounces that are left out would have been over; what has stopped turning by then stops with them.
                slowing = still < key.Time + left ? pivot * (1 / left.ToSeconds()) : slowing;
                Append(
                    slot, key, new MotionSegment(MotionLaw.Sliding, key.Time, key.Time + left, position, Vector3D.Zero, Vector3D.Zero, supports, crowding),
                    default, spin: new Spin(pivot, -slowing));
                return;
            }

            Append(
                slot, key, slowing == Vector3D.Zero ? MotionSegment.AtRest(key.Time, position, supports).WithCrowding(crowding)
                    : new MotionSegment(MotionLaw.Rolling, key.Time, still, position, Vector3D.Zero, Vector3D.Zero, supports, crowding),
                default, spin: new Spin(pivot, -slowing));
            return;
        }

        Vector3D start = moves ? velocity : Vector3D.Zero;
        Vector3D change = (pull - (heading * resistance)) * (5.0 / 7);
        SimTime stop = SimTime.Min(EndOfTurning(key.Time, start, heading, pull, Vector3D.Dot(heading, change)), EndOfPivoting(key.Time, pivot, slowing));
        heading = Midway(start, heading, change, key.Time, stop);
        change = ((pull - (heading * resistance)) * (5.0 / 7)).WithoutNegativeZero();
        Append(
            slot, key, new MotionSegment(MotionLaw.Rolling, key.Time, stop, position, start, change, supports, crowding), default,
            spin: new Spin((Vector3D.Cross(n, start) / spec.Radius) + pivot, (Vector3D.Cross(n, change) / spec.Radius) - slowing));
    }

    /// <summary>
    /// What rolling resistance takes from what turns about the normal, in rad/s²; where it is slower than <paramref name="least"/>, or than a tick takes, it
    /// turns no more.
    /// </summary>
    private static Vector3D Slowing(ref Vector3D pivot, double rate, double least)
    {
        if (!(rate > 0))
        {
            return Vector3D.Zero; // and goes on turning
        }

        double speed = pivot.Length;
        bool turns = speed > least + (rate * SimDuration.OneTick.ToSeconds());
        pivot = turns ? pivot : Vector3D.Zero;
        return turns ? pivot * (rate / speed) : Vector3D.Zero;
    }

    private static SimTime EndOfPivoting(SimTime from, in Vector3D pivot, in Vector3D slowing) =>
        slowing != Vector3D.Zero && TryTicks(from, pivot.Length / slowing.Length, out SimDuration turns) ? from + turns : SimTime.MaxValue;

    /// <summary>
    /// When something that slips or rolls with that velocity has stopped doing so, or has turned so far that a new piece is due; never, if neither comes.
    /// </summary>
    private SimTime EndOfTurning(SimTime from, in Vector3D velocity, in Vector3D along, in Vector3D pull, double rate) =>
        TryTicks(from, SecondsOfTurning(velocity, along, pull, rate), out SimDuration turns) ? from + turns : EndOfRange(from, velocity, pull);

    private double SecondsOfTurning(in Vector3D velocity, in Vector3D along, in Vector3D pull, double rate)
    {
        double seconds = rate < 0 ? -velocity.Length / rate : double.PositiveInfinity;
        double aslant = Vector3D.Cross(along, pull).Length;
        return aslant > 1e-13 * pull.Length && velocity.Length > 0 ? Math.Min(seconds, Turn(velocity.Length, pull) * velocity.Length / aslant) : seconds;
    }

    /// <summary>So many seconds from then on, a tick at least; false if that is beyond all time.</summary>
    private static bool TryTicks(SimTime from, double seconds, out SimDuration span)
    {
        bool fits = TickConversion.TryFromSeconds(seconds, out long ticks) && ticks <= SimTime.MaxValue.Ticks - Math.Max(0, from.Ticks);
        span = SimDuration.FromTicks(Math.Max(1, ticks));
        return fits;
    }

    /// <summary>
    /// By how much, in radians, the direction of something so fast may turn in a piece. A piece is off by its speed times the cube of that; so what is slower
    /// than a hundred times what it gets within the scene's resolution, some 14 mm/s, may turn more, as the inverse of the fourth root, and is off by less than
    /// that is all the same, some 7 nm/s. Else what starts from next to nothing would take thousands of pieces, and what hops again and again would each time.
    /// </summary>
    private double Turn(double speed, in Vector3D pull)
    {
        double slow = 100 * Math.Sqrt(2 * Scene.Resolution * pull.Length);
        return speed < slow ? Math.Min(0.5, MostTurn * Math.Sqrt(Math.Sqrt(slow / speed))) : MostTurn;
    }

    /// <summary>The direction at the middle of a piece, which makes it right to the second order; as it was where it does not turn.</summary>
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
