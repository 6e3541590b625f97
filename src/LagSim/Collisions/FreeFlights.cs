using System;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Collisions;

/// <summary>The packed data of each body whose newest segment is free flight under the scene's gravity. Seen from each other, two such
/// bodies move along a straight line, so most pairs are quickly found to stay apart. So are two that rest or slide straight on.</summary>
/// <remarks>In doubt it answers no, and the pair is then tested in the general way, so it changes no bit of the result. It only saves time:
/// reading a pair's segments takes several loads from far apart, and nearly all pairs that a broad phase names do not meet.</remarks>
internal sealed class FreeFlights : INewestSegmentObserver
{
    /// <summary>A bound on rounding, relative to the summed terms; four thousand times the true rounding.</summary>
    internal const double Slack = 1e-12;

    /// <summary>Two that touch surely part only if the cosine between their distance and their opening is above this.</summary>
    private const double Parting = 1e-9;

    /// <summary>A bound on the rounding of the square of a distance, and of a miss, relative to the distance's square; thirty times the
    /// true rounding.</summary>
    private const double FarSlack = 1e-14;

    private readonly Vector3D gravity;
    private readonly PeriodicBox box;
    private readonly double near;
    private readonly double sunk;
    private readonly Vector3D halfBox; // half its sides; infinite if there is none
    private readonly bool hasBox;
    private readonly bool falls;
    private Flight[] flights;
    private double[] radii;
    private Approach[] approaches = Array.Empty<Approach>();
    private SimTime[] straightFrom = Array.Empty<SimTime>(); // only once something rests or slides: since when on a line, or never

    /// <summary>No body yet.</summary>
    /// <param name="gravity">The acceleration of free flight, in m/s².</param>
    /// <param name="near">The largest distance, in metres, at which two bodies do not count as apart.</param>
    /// <param name="box">The periodic box; empty if there is none.</param>
    /// <param name="expected">The number of bodies that there is room for at first.</param>
    /// <param name="sunk">The largest overlap of two bodies, in metres, that needs no closer test while they part.</param>
    internal FreeFlights(in Vector3D gravity, double near, in PeriodicBox box, int expected = 0, double sunk = double.PositiveInfinity)
    {
        flights = new Flight[expected];
        radii = new double[expected];
        this.gravity = gravity;
        this.near = near;
        this.sunk = sunk;
        this.box = box;
        hasBox = box.Exists;
        halfBox = hasBox ? box.Size * 0.5 : new Vector3D(double.PositiveInfinity, double.PositiveInfinity, double.PositiveInfinity);
        falls = gravity != Vector3D.Zero;
    }

    /// <summary>Makes room for a body.</summary>
    internal void AddSlot(int slot, double radius)
    {
        if (slot >= flights.Length)
        {
            int size = Math.Max(slot + 1, flights.Length * 2);
            Array.Resize(ref flights, size);
            Array.Resize(ref radii, size);
        }

        flights[slot] = new Flight { Margin = radius, From = SimTime.MaxValue };
        radii[slot] = radius;
    }

    /// <summary>The body's radius, in metres.</summary>
    internal void SetRadius(int slot, double radius)
    {
        radii[slot] = radius;
        flights[slot].Margin = MarginOf(slot);
    }

    /// <summary>The body's newest segment, and when it was opened.</summary>
    public void Set(int slot, in MotionSegment path, SimTime opened)
    {
        ref Flight flight = ref flights[slot];
        bool isFree = path.Law == MotionLaw.Ballistic && path.Epoch == opened && path.Acceleration == gravity;
        flight.From = isFree ? opened : SimTime.MaxValue;
        flight.Position = path.Position;
        flight.Velocity = path.Velocity;
        flight.Margin = MarginOf(slot);
        bool isStraight = !isFree && path.Law is (MotionLaw.Sliding or MotionLaw.Resting or MotionLaw.Constrained) && path.Epoch == opened && path.Acceleration == Vector3D.Zero;
        if (isStraight || slot < straightFrom.Length)
        {
            SetStraight(slot, isStraight ? opened : SimTime.MaxValue);
        }
    }

    /// <summary>The body has no path.</summary>
    public void Clear(int slot)
    {
        flights[slot].From = SimTime.MaxValue;
        if (slot < straightFrom.Length)
        {
            straightFrom[slot] = SimTime.MaxValue;
        }
    }

    /// <summary>Whether two bodies surely stay apart from a time on, on their newest segments, opened by then; false if that is not easily
    /// decided. A tick more on both sides is included. It is decided for two free flights, and for two bodies that rest or slide straight
    /// on. For one of each it is decided where they begin at rest to each other, or come no nearer within the span however the one
    /// falls.</summary>
    internal bool AreApart(int slot, int other, SimTime from, SimTime until)
    {
        bool isFree = IsFree(slot);
        bool isOtherFree = IsFree(other);
        SimTime fromA = isFree ? flights[slot].From : StraightFrom(slot);
        SimTime fromB = isOtherFree ? flights[other].From : StraightFrom(other);
        if (fromA > from || fromB > from)
        {
            return false;
        }

        // Scalars: among few this is most of what an impact costs.
        ref readonly Flight a = ref flights[slot];
        ref readonly Flight b = ref flights[other];
        double reach = a.Margin + b.Margin + near;
        double since = fromA == from ? 0 : from.SecondsSince(fromA);
        StateAt(a, since, isFree && falls, ref reach, out double x, out double y, out double z, out double u, out double v, out double w);
        reach += Slack * (Math.Abs(x) + Math.Abs(y) + Math.Abs(z));
        since = fromB == from ? 0 : from.SecondsSince(fromB);
        StateAt(b, since, isOtherFree && falls, ref reach, out double p, out double q, out double r, out double k, out double m, out double n);
        x -= p;
        y -= q;
        z -= r;
        u -= k;
        v -= m;
        w -= n;
        if (hasBox)
        {
            x = PeriodicBox.Nearest(x, box.Size.X);
            y = PeriodicBox.Nearest(y, box.Size.Y);
            z = PeriodicBox.Nearest(z, box.Size.Z);
        }

        double span = until == from ? TickConversion.SecondsPerTick : until.SecondsSince(from) + TickConversion.SecondsPerTick;
        if (isFree != isOtherFree && falls)
        {
            if (u == 0 && v == 0 && w == 0 && fromA == from && fromB == from)
            {
                // From rest to each other it is a line in the square of time.
                double pull = isFree ? 0.5 : -0.5;
                (u, v, w) = (gravity.X * pull, gravity.Y * pull, gravity.Z * pull);
                span *= span;
            }
            else
            {
                reach += gravity.Taxicab * span * span;
            }
        }

        double along = (x * u) + (y * v) + (z * w);
        double nearest = -TickConversion.SecondsPerTick;
        if (along < 0)
        {
            double square = Square(u, v, w);
            nearest = square * span < -along ? span : -along / square;
        }

        return Square(x + (u * nearest), y + (v * nearest), z + (w * nearest)) > reach * reach * (1 + 1e-6); // not so of what is not a number
    }

    /// <summary>Since when the body rests or slides straight on; never if it does not.</summary>
    private SimTime StraightFrom(int slot) => slot < straightFrom.Length ? straightFrom[slot] : SimTime.MaxValue;

    /// <summary>Where a body is so many seconds after its path was opened, and how fast; what rounding may do to it there widens the
    /// reach.</summary>
    private void StateAt(
        in Flight flight, double since, bool isFalling, ref double reach, out double x, out double y, out double z, out double u, out double v, out double w)
    {
        (u, v, w) = (flight.Velocity.X, flight.Velocity.Y, flight.Velocity.Z);
        (x, y, z) = (flight.Position.X, flight.Position.Y, flight.Position.Z);
        if (since == 0)
        {
            return;
        }

        double half = isFalling ? 0.5 * since : 0;
        x += (u + (gravity.X * half)) * since;
        y += (v + (gravity.Y * half)) * since;
        z += (w + (gravity.Z * half)) * since;
        if (isFalling)
        {
            u += gravity.X * since;
            v += gravity.Y * since;
            w += gravity.Z * since;
            reach += FallSlack(since);
        }
    }

    private void SetStraight(int slot, SimTime from)
    {
        if (slot >= straightFrom.Length)
        {
            int known = straightFrom.Length;
            Array.Resize(ref straightFrom, flights.Length);
            Array.Fill(straightFrom, SimTime.MaxValue, known, straightFrom.Length - known);
        }

        straightFrom[slot] = from;
    }

    /// <summary>Whether the body's newest segment is free flight.</summary>
    internal bool IsFree(int slot) => flights[slot].From != SimTime.MaxValue;

    /// <summary>Which of the other bodies a body in free flight may touch in a span that begins at its opening or later, and from when on:
    /// in seconds from the beginning, never too many. No body that is touched is left out. A body that is not in free flight may be touched
    /// at once.</summary>
    internal Span<Approach> Approaches(int slot, Span<int> others, SimTime from, SimTime until)
    {
        if (others.Length > approaches.Length)
        {
            approaches = new Approach[Math.Max(others.Length, approaches.Length * 2)];
        }

        int count = 0;
        ref readonly Flight a = ref flights[slot];
        double since = from.SecondsSince(a.From);
        Vector3D place = a.Position + ((a.Velocity + (gravity * (0.5 * since))) * since);
        Vector3D velocity = a.Velocity + (gravity * since);
        double radius = a.Margin + near + FallSlack(since) + (Slack * place.Taxicab);
        double span = until.SecondsSince(from) + TickConversion.SecondsPerTick;
        double speed = velocity.Taxicab;
        bool isOpened = a.From == from;
        Vector3D half = halfBox;
        Span<Flight> all = flights;
        Span<Approach> into = approaches;
        for (int i = 0; i < others.Length; i++)
        {
            int other = others[i];
            ref Flight b = ref all[other];
            long ticks = unchecked(from.Ticks - b.From.Ticks);
            if (b.From > from || ticks < 0)
            {
                into[count++] = new Approach(other, 0); // not in free flight yet, or for longer than a span can be
                continue;
            }

            // Scalars, and as few steps as can be: what this loop does is most of what a prediction costs.
            double time = ticks * TickConversion.SecondsPerTick;
            double u = b.Velocity.X, v = b.Velocity.Y, w = b.Velocity.Z;
            double x = u * time, y = v * time, z = w * time;
            double reach = radius + b.Margin;
            if (falls)
            {
                double mean = 0.5 * time;
                x = (u + (gravity.X * mean)) * time;
                y = (v + (gravity.Y * mean)) * time;
                z = (w + (gravity.Z * mean)) * time;
                u += gravity.X * time;
                v += gravity.Y * time;
                w += gravity.Z * time;
                reach += FallSlack(time);
            }

            x = b.Position.X + x - place.X;
            y = b.Position.Y + y - place.Y;
            z = b.Position.Z + z - place.Z;
            x = Math.Abs(x) > half.X ? PeriodicBox.Nearest(x, box.Size.X) : x;
            y = Math.Abs(y) > half.Y ? PeriodicBox.Nearest(y, box.Size.Y) : y;
            z = Math.Abs(z) > half.Z ? PeriodicBox.Nearest(z, box.Size.Z) : z;
            u -= velocity.X;
            v -= velocity.Y;
            w -= velocity.Z;
            double along = (x * u) + (y * v) + (z * w);
            double distance = Square(x, y, z);
            double square = Square(u, v, w);
            double limit = reach * reach * (1 + 2e-6);
            double beyond = (distance * (1 - FarSlack)) - limit;
            if (beyond > 0)
            {
                bool parts = along >= 0;
                bool misses = beyond * square > along * along;
                if (parts | misses)
                {
                    continue; // one test: which of the two holds cannot be predicted, but that one of them holds nearly always can
                }

                double nearest = -along / square;
                double miss = Square(x + (u * nearest), y + (v * nearest), z + (w * nearest));
                double seconds = nearest - Math.Sqrt(Math.Max(0, (limit + (FarSlack * distance)) - miss) / square);
                into[count] = new Approach(other, seconds);
                count += seconds > span ? 0 : 1; // no branch: it cannot be predicted, and it would wait for the root
            }
            else if (other != slot)
            {
                // The narrow phase's result for the two at the later opening, by the same signs: they part, by far more than rounding can
                // reverse.
                double opening = Math.Abs(u) + Math.Abs(v) + Math.Abs(w);
                double query = (opening * ((Parting * reach) + (reach - (radii[slot] + radii[other] + near)))) + (Slack * reach * ((2 * speed) + opening));
                double nearest = Math.Max(0, radii[slot] + radii[other] - sunk); // what is deeper may have to be pushed out though it parts
                if (!((isOpened || b.From == from) && along > query) || distance < nearest * nearest * (1 + 2e-6))
                {
                    into[count++] = new Approach(other, 0);
                }
            }
        }

        return into.Slice(0, count);
    }

    /// <summary>The place and velocity of a body in free flight at a tick plus some seconds: the same bits as its segment gives.</summary>
    internal void StateAt(int slot, SimTime time, double after, out Vector3D position, out Vector3D velocity)
    {
        ref readonly Flight flight = ref flights[slot];
        double seconds = time.SecondsSince(flight.From) + after;
        position = PositionAt(flight, seconds);
        velocity = flight.Velocity + (gravity * seconds);
    }

    /// <summary>Whether two bodies in free flight touch, however late, and when: the bits that <see cref="TimeOfImpact"/> gives for their
    /// segments, with the body of lesser identity first. False if they touch so soon after both hold that the general way is
    /// needed.</summary>
    internal bool TryTouch(int first, int second, out bool touches, out ContactTime contact)
    {
        ref readonly Flight a = ref flights[first];
        ref readonly Flight b = ref flights[second];
        SimTime from = SimTime.Max(a.From, b.From);
        Vector3D positionB = b.Position;
        if (hasBox)
        {
            Vector3D at = PositionAt(b, from.SecondsSince(b.From));
            Vector3D apart = at - PositionAt(a, from.SecondsSince(a.From));
            positionB += box.Nearest(apart) - apart;
        }

        touches = TimeOfImpact.OfParabolas(
            a.Position, a.Velocity, from.SecondsSince(a.From), positionB, b.Velocity, from.SecondsSince(b.From), gravity, radii[first] + radii[second],
            from, SimTime.MaxValue, out contact);
        return !touches || !contact.IsSoonAfter(from);
    }

    /// <summary>Whether two bodies in free flight are so deep in each other, once both are open, that it has to be looked whether they
    /// part.</summary>
    internal bool AreSunk(int first, int second)
    {
        ref readonly Flight a = ref flights[first];
        ref readonly Flight b = ref flights[second];
        SimTime from = SimTime.Max(a.From, b.From);
        double nearest = Math.Max(0, radii[first] + radii[second] - sunk);
        return (PositionAt(a, from.SecondsSince(a.From)) - PositionAt(b, from.SecondsSince(b.From))).LengthSquared < nearest * nearest;
    }

    /// <summary>Whether so many seconds after a time is surely after another.</summary>
    internal static bool IsLater(double seconds, SimTime from, SimTime time) =>
        seconds > (time.SecondsSince(from) * (1 + Slack)) + TickConversion.SecondsPerTick;

    /// <summary>Whether a body in free flight surely does not touch a plane in a span that begins at its opening or later.</summary>
    internal bool Misses(int slot, in StaticPlane plane, SimTime from, SimTime until)
    {
        ref readonly Flight a = ref flights[slot];
        double since = from.SecondsSince(a.From);
        Vector3D way = (a.Velocity + (gravity * (0.5 * since))) * since;
        double gap = plane.Gap(a.Position + way, radii[slot]);
        double span = until.SecondsSince(from) + TickConversion.SecondsPerTick;
        double fall = gravity.Taxicab;
        double slack = near + (Slack * (a.Position.Taxicab + way.Taxicab + (fall * since * since) + Math.Abs(plane.Offset) + radii[slot]));
        double speed = a.Velocity.Taxicab + (fall * (since + span));
        if (gap > slack + (speed * span * (1 + Slack)))
        {
            return true; // it does not come that far, in whatever direction it flies
        }

        double opening = Vector3D.Dot(plane.Normal, a.Velocity + (gravity * since));
        double curve = Vector3D.Dot(plane.Normal, gravity);
        double atEnd = gap + ((opening + (0.5 * curve * span)) * span) - (Slack * speed * span);
        double least = curve > 0 && opening < 0 && -opening < curve * span ? gap - (opening * opening / (2 * curve)) : Math.Min(gap, atEnd);
        return least > slack + (TickConversion.SecondsPerTick * Math.Abs(opening)); // not so of what is not a number
    }

    /// <summary>The radius, plus how far rounding and a tick may move a body in flight that is read at another time, apart from its
    /// fall.</summary>
    private double MarginOf(int slot) =>
        radii[slot] + (2 * Slack * flights[slot].Position.Taxicab) + (2 * TickConversion.SecondsPerTick * flights[slot].Velocity.Taxicab);

    private double FallSlack(double time) => 2 * gravity.Taxicab * time * ((Slack * time) + TickConversion.SecondsPerTick);

    private Vector3D PositionAt(in Flight flight, double seconds) => flight.Position + ((flight.Velocity + (gravity * (0.5 * seconds))) * seconds);

    private static double Square(double x, double y, double z) => (x * x) + (y * y) + (z * z);

    private struct Flight
    {
        internal Vector3D Position;
        internal Vector3D Velocity;
        internal SimTime From;
        internal double Margin;
    }
}
