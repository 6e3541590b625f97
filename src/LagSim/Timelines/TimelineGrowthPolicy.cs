using System;
using LagSim.Time;

namespace LagSim.Timelines;

/// <summary>For how many segments a store of timelines takes memory: little more than its window needs, and seldom.</summary>
/// <param name="origin">When the world began.</param>
/// <param name="history">How long a history the store keeps.</param>
internal class TimelineGrowthPolicy(SimTime origin, SimDuration history)
{
    /// <summary>A store doubles below this, and grows by one part in <see cref="Part"/> above.</summary>
    private const int Large = 1024;

    private const int Part = 64;
    private const int MinRoom = 4;

    /// <summary>The number of segments in the last eighth of the window foretells how many a whole one will have.</summary>
    private const ulong RecentPart = 8;

    /// <summary>With this many segments of each body the number foretells how it goes on, however short the time.</summary>
    private const int Many = 64;

    /// <summary>The room of a new store: for each body's first segment, and for a second of a few.</summary>
    internal static int First(int bodies)
    {
        int room = MinRoom;
        while (room < 2 * bodies && room < Large)
        {
            room *= 2;
        }

        return Math.Max(room, bodies + (bodies / Part));
    }

    /// <summary>The room a full store gets.</summary>
    /// <param name="room">What it has.</param>
    /// <param name="bodies">How many bodies it has room for.</param>
    /// <param name="now">When it is full.</param>
    /// <param name="edge">Where its window begins.</param>
    /// <param name="recent">How many segments were closed since <see cref="RecentStart"/>.</param>
    internal int Next(int room, int bodies, SimTime now, SimTime edge, int recent) =>
        room < Large ? room * 2 : Math.Max(room + (room / Part), Expected(room, bodies, now, edge, recent));

    /// <summary>
    /// When the last part of the window began. Its span may exceed the range of a long; as an unsigned difference it never does.
    /// </summary>
    internal static SimTime RecentStart(SimTime now, SimTime edge) =>
        now <= edge ? now : SimTime.FromTicks(now.Ticks - (long)(((ulong)now.Ticks - (ulong)edge.Ticks) / RecentPart));

    /// <summary>
    /// For how many segments room will be needed, as far as can be foretold. Once a whole history has gone by: if as many are opened as in
    /// the last part of the window, less two standard deviations of such a number, so that where it goes on evenly that is no more than
    /// there is. Before: if as many are opened for the rest of it, from an eighth of it on, or from where each body has many. No more than
    /// a quarter above what there is, for what begins need not go on. To grow by little where more and more are opened would be to copy
    /// everything some hundred times.
    /// </summary>
    private protected virtual int Expected(int room, int bodies, SimTime now, SimTime edge, int recent)
    {
        double opened = (recent - (2 * Math.Sqrt(recent))) * RecentPart;
        if (edge <= origin)
        {
            double passed = now.SecondsSince(origin), whole = history.ToSeconds();
            int soFar = room - bodies;
            bool isEnough = passed < whole && (passed > whole / 8 || soFar > Many * bodies);
            opened = isEnough ? soFar * (whole / passed) : 0; // infinite at the very beginning
        }

        return (int)Math.Min(bodies + opened, room * 1.25);
    }
}
