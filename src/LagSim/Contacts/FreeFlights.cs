using System;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Contacts;

/// <summary>
/// Of each body whose newest piece of path is free flight under the scene's gravity what is needed of it, side by side: two of them move along a straight
/// line as seen from each other, so that most pairs are seen at once to stay apart.
/// </summary>
/// <remarks>
/// It answers no in doubt, and then the pair is looked at as ever; so it changes no bit of what happens. It is there for speed alone: a look at a pair's segments
/// is several loads from far apart, and nearly all pairs that an index names do not meet.
/// </remarks>
internal sealed class FreeFlights
{
    /// <summary>What rounding may have moved, in parts of what was added up; four thousand times of what it does.</summary>
    private const double Slack = 1e-12;

    /// <summary>Two that touch surely part if the cosine between their distance and their opening is above this.</summary>
    private const double Parting = 1e-9;

    private readonly Vector3D gravity;
    private readonly PeriodicBox box;
    private readonly double near;
    private Flight[] flights = new Flight[16];
    private Approach[] approaches = new Approach[64];

    /// <summary>Nobody yet.</summary>
    /// <param name="gravity">The acceleration of free flight, in m/s².</param>
    /// <param name="near">How far apart two may be, in metres, that are not to be called apart.</param>
    /// <param name="box">The box whose sides meet; empty if there is none.</param>
    internal FreeFlights(in Vector3D gravity, double near, in PeriodicBox box)
    {
        this.gravity = gravity;
        this.near = near;
        this.box = box;
    }

    /// <summary>Makes room for a body.</summary>
    internal void AddSlot(int slot, double radius)
    {
        if (slot >= flights.Length)
        {
            Array.Resize(ref flights, Math.Max(slot + 1, flights.Length * 2));
        }

        flights[slot] = new Flight { Radius = radius, From = SimTime.MaxValue };
    }

    /// <summary>The body's radius, in metres.</summary>
    internal void SetRadius(int slot, double radius) => flights[slot].Radius = radius;

    /// <summary>The body's newest piece of path, and when it was opened.</summary>
    internal void Set(int slot, in MotionSegment path, SimTime opened)
    {
        ref Flight flight = ref flights[slot];
        bool isFree = path.Law == MotionLaw.Ballistic && path.Epoch == opened && path.Acceleration == gravity;
        flight.From = isFree ? opened : SimTime.MaxValue;
        flight.Position = path.Position;
        flight.Velocity = path.Velocity;
    }

    /// <summary>The body has no path.</summary>
    internal void Clear(int slot) => flights[slot].From = SimTime.MaxValue;

    /// <summary>
    /// Whether two bodies surely come nowhere near each other from a time on, on the pieces of path that are their newest, those opened by then; false if it cannot be told
    /// so easily. A tick more on both sides is looked at.
    /// </summary>
    internal bool AreApart(int slot, int other, SimTime from, SimTime until)
    {
        ref readonly Flight a = ref flights[slot];
        ref readonly Flight b = ref flights[other];
        if (a.From > from || b.From > from)
        {
            return false;
        }

        double sinceA = from.SecondsSince(a.From);
        double sinceB = from.SecondsSince(b.From);
        Vector3D fallA = gravity * (0.5 * sinceA);
        Vector3D fallB = gravity * (0.5 * sinceB);
        Vector3D wayA = (a.Velocity + fallA) * sinceA;
        Vector3D wayB = (b.Velocity + fallB) * sinceB;
        Vector3D apart = box.Nearest(a.Position + wayA - (b.Position + wayB));
        Vector3D opening = a.Velocity - b.Velocity + (gravity * (sinceA - sinceB));

        double along = Vector3D.Dot(apart, opening);
        double square = Vector3D.Dot(opening, opening);
        double span = until.SecondsSince(from) + TickConversion.SecondsPerTick;
        double nearest = along >= 0 ? -TickConversion.SecondsPerTick : square * span < -along ? span : -along / square;
        Vector3D least = apart + (opening * nearest);
        double reach = a.Radius + b.Radius + near + (Slack * (Size(a.Position) + Size(b.Position) + Size(wayA) + Size(wayB)
            + (Size(gravity) * ((sinceA * sinceA) + (sinceB * sinceB)))));
        return Vector3D.Dot(least, least) > reach * reach * (1 + 1e-6); // not so of what is not a number
    }

    /// <summary>Whether the body's newest piece of path is free flight.</summary>
    internal bool IsFree(int slot) => flights[slot].From != SimTime.MaxValue;

    /// <summary>
    /// Which of the others a body in free flight may touch in a span that begins at its opening or later, and from when on: in seconds from the beginning, never too many. Nobody is left out
    /// who is touched; who is not in free flight may be touched at once.
    /// </summary>
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
        double placeX = place.X, placeY = place.Y, placeZ = place.Z;
        double velocityX = velocity.X, velocityY = velocity.Y, velocityZ = velocity.Z;
        double gravityX = gravity.X, gravityY = gravity.Y, gravityZ = gravity.Z;
        double sideX = box.Size.X, sideY = box.Size.Y, sideZ = box.Size.Z;
        double sizes = Size(a.Position) + Size(place) + (Size(gravity) * since * since);
        double radius = a.Radius + near;
        double span = until.SecondsSince(from) + TickConversion.SecondsPerTick;
        bool isOpened = a.From == from;
        bool hasBox = box.Exists;
        Span<Flight> all = flights;
        for (int i = 0; i < others.Length; i++)
        {
            int other = others[i];
            ref Flight b = ref all[other];
            if (b.From > from)
            {
                approaches[count++] = new Approach(other, 0);
                continue;
            }

            // Scalars: what this loop does is most of what a prediction costs.
            double time = from.SecondsSince(b.From);
            double halfTime = 0.5 * time;
            double bX = b.Position.X + ((b.Velocity.X + (gravityX * halfTime)) * time);
            double bY = b.Position.Y + ((b.Velocity.Y + (gravityY * halfTime)) * time);
            double bZ = b.Position.Z + ((b.Velocity.Z + (gravityZ * halfTime)) * time);
            double x = placeX - bX, y = placeY - bY, z = placeZ - bZ;
            if (hasBox)
            {
                x = PeriodicBox.Nearest(x, sideX);
                y = PeriodicBox.Nearest(y, sideY);
                z = PeriodicBox.Nearest(z, sideZ);
            }

            double u = velocityX - (b.Velocity.X + (gravityX * time));
            double v = velocityY - (b.Velocity.Y + (gravityY * time));
            double w = velocityZ - (b.Velocity.Z + (gravityZ * time));
            double along = (x * u) + (y * v) + (z * w);
            double slack = Slack * (sizes + Math.Abs(b.Position.X) + Math.Abs(b.Position.Y) + Math.Abs(b.Position.Z) + Math.Abs(bX) + Math.Abs(bY) + Math.Abs(bZ)
                + (Size(gravity) * time * time));
            double opening = Math.Abs(u) + Math.Abs(v) + Math.Abs(w);
            double reach = radius + b.Radius + slack + (TickConversion.SecondsPerTick * opening);
            double limit = reach * reach * (1 + 1e-6);
            if ((x * x) + (y * y) + (z * z) > limit)
            {
                if (along >= 0)
                {
                    continue;
                }

                double square = (u * u) + (v * v) + (w * w);
                double nearest = -along / square;
                double miss = Square(x + (u * nearest), y + (v * nearest), z + (w * nearest));
                if (miss > limit)
                {
                    continue;
                }

                double seconds = nearest - Math.Sqrt((limit - miss) / square);
                if (!(seconds > span))
                {
                    approaches[count++] = new Approach(other, seconds);
                }
            }
            else if (other != slot && !((isOpened || b.From == from) && along > opening * ((Parting * (Math.Abs(x) + Math.Abs(y) + Math.Abs(z))) + slack)))
            {
                approaches[count++] = new Approach(other, 0);
            }
        }

        return approaches.AsSpan(0, count);
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
        double gap = plane.Gap(a.Position + way, a.Radius);
        double opening = Vector3D.Dot(plane.Normal, a.Velocity + (gravity * since));
        double curve = Vector3D.Dot(plane.Normal, gravity);
        double span = until.SecondsSince(from) + TickConversion.SecondsPerTick;
        double atEnd = gap + ((opening + (0.5 * curve * span)) * span);
        double least = curve > 0 && opening < 0 && -opening < curve * span ? gap - (opening * opening / (2 * curve)) : Math.Min(gap, atEnd);
        double slack = Slack * (Size(a.Position) + Size(way) + (Size(gravity) * since * since) + Math.Abs(plane.Offset) + a.Radius);
        return least > near + slack + (TickConversion.SecondsPerTick * Math.Abs(opening)); // not so of what is not a number
    }

    private static double Size(in Vector3D v) => Math.Abs(v.X) + Math.Abs(v.Y) + Math.Abs(v.Z);

    private static double Square(double x, double y, double z) => (x * x) + (y * y) + (z * z);

    private struct Flight
    {
        internal Vector3D Position;
        internal Vector3D Velocity;
        internal SimTime From;
        internal double Radius;
    }
}
