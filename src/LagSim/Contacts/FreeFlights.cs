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

    private readonly Vector3D gravity;
    private readonly PeriodicBox box;
    private readonly double near;
    private Flight[] flights = new Flight[16];

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

    private static double Size(in Vector3D v) => Math.Abs(v.X) + Math.Abs(v.Y) + Math.Abs(v.Z);

    private struct Flight
    {
        internal Vector3D Position;
        internal Vector3D Velocity;
        internal SimTime From;
        internal double Radius;
    }
}
