using System;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Collisions;

/// <summary>
/// The number of times two bodies were struck within one instant while they did not part: the clock cannot distinguish such impacts.
/// </summary>
/// <remarks>A pure function of the segments given.</remarks>
internal sealed class StrikeCounts(TimelineStore timelines, BodyTable bodies, StaticSurfaces surfaces, PeriodicBox box)
{
    /// <summary>
    /// A contact that was struck twice in an instant and closes again slower than this, in m/s, waits for <see cref="ContactTime.Soon"/>.
    /// One that parts slower than this may as well count as closing: rounding decides.
    /// </summary>
    internal const double CollapseSpeed = 1e-6;

    private const int StrikesKnown = 64; // a power of two

    private readonly Paths paths = new(timelines);
    private KnownStrikes[]? knownStrikes;

    /// <summary>
    /// How many impacts of this instant were on a body while it did not part from a surface that it touches; two where it is more.
    /// </summary>
    internal int On(int piece, int surface, SimTime time)
    {
        if (timelines.Key(piece).Time != time)
        {
            return 0;
        }

        ref KnownStrikes known = ref Known(timelines.Owner(piece), ~surface);
        ContactTime tick = ContactTime.At(time);
        int at = piece;
        int strikes = 0;
        while (strikes < 2 && timelines.Key(at).Time == time && timelines.Previous(at) != TimelineStore.None)
        {
            if (known.First == timelines.Serial(at) && known.Second == ~surface)
            {
                strikes += known.Strikes;
                break;
            }

            bool isImpact = timelines.Key(at).Kind == EventKind.Impact;
            at = timelines.Previous(at);
            Vector3D normal = surfaces.Normal(surface, paths.PositionAt(at, tick));
            strikes += isImpact && Vector3D.Dot(normal, paths.VelocityAt(at, tick)) <= CollapseSpeed ? 1 : 0;
        }

        strikes = Math.Min(strikes, 2);
        known = new KnownStrikes(timelines.Serial(piece), ~surface, strikes);
        return strikes;
    }

    /// <summary>
    /// How many impacts of this instant were on two bodies that touch, while they did not part from each other; two where it is more.
    /// </summary>
    internal int Between(int first, int second, SimTime time)
    {
        if (timelines.Key(first).Time != time || timelines.Key(second).Time != time)
        {
            return 0;
        }

        if (bodies.Id(timelines.Owner(first)) > bodies.Id(timelines.Owner(second)))
        {
            (first, second) = (second, first);
        }

        ref KnownStrikes known = ref Known(timelines.Owner(first), timelines.Owner(second));
        ContactTime tick = ContactTime.At(time);
        int a = first;
        int b = second;
        int strikes = 0;
        while (strikes < 2 && timelines.Key(a).Time == time && timelines.Key(b).Time == time
            && timelines.Previous(a) != TimelineStore.None && timelines.Previous(b) != TimelineStore.None)
        {
            if (known.First == timelines.Serial(a) && known.Second == timelines.Serial(b))
            {
                strikes += known.Strikes;
                break;
            }

            int order = EventKey.Compare(timelines.Key(a), timelines.Key(b));
            bool isImpact = order == 0 && timelines.Key(a).Kind == EventKind.Impact;
            a = order >= 0 ? timelines.Previous(a) : a;
            b = order <= 0 ? timelines.Previous(b) : b;
            Vector3D normal = box.Nearest(paths.PositionAt(a, tick) - paths.PositionAt(b, tick)).Direction;
            strikes += isImpact && Vector3D.Dot(normal, paths.VelocityAt(a, tick) - paths.VelocityAt(b, tick)) <= CollapseSpeed ? 1 : 0;
        }

        strikes = Math.Min(strikes, 2);
        known = new KnownStrikes(timelines.Serial(first), timelines.Serial(second), strikes);
        return strikes;
    }

    /// <summary>The place of what was last found out about two.</summary>
    private ref KnownStrikes Known(int first, int second)
    {
        knownStrikes ??= new KnownStrikes[StrikesKnown];
        return ref knownStrikes[((first * 31) + second) & (StrikesKnown - 1)];
    }

    /// <summary>
    /// The cached result for two segments, at which a walk back through an instant ends. It only saves time: the same two segments always
    /// give the same. Without it the cost of an instant grows with the square of its rounds.
    /// </summary>
    private readonly struct KnownStrikes(long first, long second, int strikes)
    {
        /// <summary>The serial number of the first segment. Serial numbers begin at 0, so 0 and 0 is no pair.</summary>
        internal readonly long First = first;

        /// <summary>That of the second, or the complement of the surface.</summary>
        internal readonly long Second = second;

        internal readonly int Strikes = strikes;
    }
}
