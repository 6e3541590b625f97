using System;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.BroadPhase;

/// <summary>Which bodies are asked whether they meet: all of them while they are few, those that come near once they are many.</summary>
/// <remarks>No bit depends on which of the two it is, nor on when one takes the other's place.</remarks>
internal class AdaptiveBroadPhase(Scene scene, BodyTable bodies, TimelineStore timelines, int bruteForceLimit)
{
    /// <summary>The size of a cell in radii of a body that nine tenths are not larger than: two diameters.</summary>
    private const double CellInRadii = 4;

    private int outgrownAt; // number of bodies too wide or fast for the cells at which other cells are tried

    /// <summary>At about so many others a body looks, however many there are.</summary>
    internal const int UsualCandidates = 64;

    /// <summary>The broad phase in use; not to be called before <see cref="Begin"/>.</summary>
    internal IBroadPhase Current { get; private set; } = null!;

    /// <summary>Whether the bodies have become so many, or so much larger, that another serves them better.</summary>
    internal bool IsOutgrown => Current is NeighbourLists shells
        ? shells.WideCount > Math.Max(outgrownAt, bodies.Count / 8)
        : bodies.Count > bruteForceLimit;

    /// <summary>Chooses the broad phase of a world that begins and has no path listed yet.</summary>
    internal void Begin() => Current = bodies.Count > bruteForceLimit ? NewLists() : MakeBruteForce();

    /// <summary>Makes neighbour lists of all that is kept.</summary>
    /// <param name="from">From when on paths are kept.</param>
    /// <param name="until">Up to when bodies are on the newest segments of their paths at least.</param>
    internal void Rebuild(SimTime from, SimTime until)
    {
        NeighbourLists lists = NewLists();
        Current = lists;
        foreach (int slot in bodies)
        {
            List(slot, from, until);
        }

        outgrownAt = 2 * Math.Max(32, lists.WideCount);
    }

    /// <summary>Lists the segments of a body's path, of which prediction has not asked.</summary>
    /// <param name="slot">The body.</param>
    /// <param name="from">From when on.</param>
    /// <param name="until">Up to when the body is on the newest of them.</param>
    internal void List(int slot, SimTime from, SimTime until)
    {
        int piece = timelines.Last(slot);
        while (timelines.Key(piece).Time >= from && timelines.Previous(piece) != TimelineStore.None)
        {
            piece = timelines.Previous(piece);
        }

        for (; piece != TimelineStore.None; piece = timelines.Next(piece))
        {
            int next = timelines.Next(piece);
            SimTime begin = SimTime.Max(from, timelines.Key(piece).Time);
            SimTime end = next == TimelineStore.None ? SimTime.Max(begin, until) : timelines.Key(next).Time;
            if (timelines.Segment(piece).IsPresent && end >= begin)
            {
                Current.Add(slot, bodies.Spec(slot).Radius, piece, begin, end);
            }
        }
    }

    /// <summary>Makes the broad phase for few bodies.</summary>
    private protected virtual BruteForce MakeBruteForce() => new();

    /// <summary>Makes the broad phase for many bodies; see <see cref="NeighbourLists"/>.</summary>
    private protected virtual NeighbourLists MakeLists(double cell, double speed, double tickLength) =>
        new(timelines, cell, speed, scene.RestitutionThreshold, tickLength, scene.Box, bodies.SlotCount);

    private NeighbourLists NewLists()
    {
        double[] radii = new double[bodies.Count];
        double[] speeds = new double[bodies.Count];
        int count = 0;
        int present = 0;
        foreach (int slot in bodies)
        {
            double radius = bodies.Spec(slot).Radius;
            radii[count] = radius;
            count += radius > 0 ? 1 : 0; // none yet: only the body's name is known
            ref readonly MotionSegment path = ref timelines.Segment(timelines.Last(slot));
            speeds[present] = path.Velocity.Length;
            present += path.IsPresent ? 1 : 0;
        }

        Array.Sort(radii, 0, count);
        Array.Sort(speeds, 0, present);
        double usual = count == 0 ? scene.SmallestRadius : radii[count * 9 / 10];
        double usualSpeed = present == 0 ? 0 : speeds[present * 9 / 10];
        double tick = Limits.MaxSpeed(scene.SmallestRadius) * TickConversion.SecondsPerTick;
        return MakeLists(CellInRadii * usual, usualSpeed, tick);
    }
}
