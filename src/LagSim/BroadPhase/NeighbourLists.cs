using System;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.BroadPhase;

/// <summary>
/// Verlet lists: every body has a shell that it stays in for a while, and a list of the bodies whose shells are so near that the two could
/// touch. A list holds until one of the two leaves its shell, however often they collide meanwhile.
/// </summary>
/// <remarks>
/// <para>Past shells are kept too: a shell that a body has left stays, with the span of time in which it held, until that lies before the
/// history. So a heal finds which bodies were near then, whatever they did since.</para>
/// <para>A list may name too many bodies, because a heal sees the past and the present at once. It never names too few: of two shells the
/// one made later found the other, and a list made in a heal keeps bodies that move on ahead of it.</para>
/// <para>Each body has its own shell size: a body that soon leaves its shell gets a larger one, and one that stays for many predictions
/// gets a smaller one with fewer neighbours. Bodies that are too wide or too fast for the cells are listed separately, and tested whenever
/// a shell is made.</para>
/// <para>Cost: for a prediction, the length of a list; for a shell, the contents of the 27 cells around it. A shell holds for some ten
/// predictions.</para>
/// </remarks>
internal class NeighbourLists : IBroadPhase
{
    /// <summary>
    /// A body that would leave the widest shell that fits the cells in less than this is too fast for them: 1/512 s, or far less than the
    /// others take.
    /// </summary>
    private const double ShortestStay = 1.0 / 512;

    private const double FarLess = 1.0 / 64;
    private const double FewTicks = 16;

    /// <summary>A body with fewer predictions than this in a shell gets a larger one next, and one with more a smaller one.</summary>
    private const int FewPredictions = 6;
    private const int ManyPredictions = 24;
    private const double Larger = 1.25;
    private const double Smaller = 0.9;

    /// <summary>A shell's radius at first and at least, in parts of the cell's size.</summary>
    private const double FirstStray = 1.0 / 8;
    private const double MinStray = 1.0 / 32;

    private const int NeighboursExpected = 8;

    private readonly TimelineStore timelines;
    private readonly PeriodicBox box;
    private readonly double cell;
    private readonly double near;
    private readonly double tick;
    private readonly double shortestStay;
    private readonly PresentShells present;
    private readonly PastShells past;
    private readonly SlotSet found;
    private readonly PooledLists<int> lists;
    private Stay[] stays;
    // The number of bodies with one-sided neighbours: their shells were made in a heal, so the others may not list them.
    private int lookingBack;

    /// <summary>Empty neighbour lists.</summary>
    /// <param name="timelines">The paths.</param>
    /// <param name="cell">The least size of a cell, in metres: about two diameters of most bodies.</param>
    /// <param name="speed">How fast most bodies are at most, in m/s.</param>
    /// <param name="near">The largest distance, in metres, at which two bodies are still candidates.</param>
    /// <param name="tickLength">How far a body moves in a tick at most, in metres.</param>
    /// <param name="box">The periodic box; empty if there is none.</param>
    /// <param name="expected">The number of bodies that there is room for at first.</param>
    internal NeighbourLists(TimelineStore timelines, double cell, double speed, double near, double tickLength, in PeriodicBox box, int expected = 0)
    {
        this.timelines = timelines;
        this.cell = cell;
        this.near = near;
        this.box = box;
        tick = tickLength;
        double shortest = Math.Min(ShortestStay, FarLess * cell / speed); // the first of the two if no body moves
        shortestStay = Math.Max(FewTicks * TickConversion.SecondsPerTick, shortest);
        CellGrid grid = new(cell, box);
        found = new SlotSet(expected);
        lists = new PooledLists<int>(expected, NeighboursExpected * expected);
        stays = new Stay[expected];
        present = new PresentShells(grid, box, 0.5 * cell, expected);
        past = new PastShells(grid, box, 0.5 * cell);
    }

    /// <summary>How many bodies are in no cell; if they are many, other cells would serve better.</summary>
    internal int WideCount => present.WideCount;

    public Span<int> Candidates(int slot, double radius, SimTime from, long heal, out SimTime until)
    {
        Reserve(slot);
        int segment = timelines.Last(slot);
        ref readonly MotionSegment path = ref timelines.Segment(segment);
        DenseOutput dense = timelines.Dense(segment);
        ref Stay stay = ref stays[slot];
        bool holds = stay.IsListed && stay.Radius == radius && from >= stay.From && (heal == 0 || (heal == stay.Heal && from < stay.LookedTo));
        until = holds ? stay.Shell.Leaves(path, dense, from, box) : from;
        if (until <= from)
        {
            Move(slot, radius, path, dense, from, heal);
            until = stay.Shell.Leaves(path, dense, from, box);
        }

        stay.Predictions++;
        until = heal == 0 ? until : SimTime.Min(until, stay.LookedTo);
        return lists.Of(slot);
    }

    public Span<int> CandidatesAt(int slot, double radius, SimTime time, bool isHealing)
    {
        if (!isHealing)
        {
            return lists.Of(slot);
        }

        int segment = timelines.Last(slot);
        Vector3D place = timelines.Segment(segment).PositionAt(time.SecondsSince(timelines.Segment(segment).Epoch), timelines.Dense(segment));
        Shell shell = new(place, 0, radius + tick);
        found.Clear();
        present.Look(shell, near, found);
        found.Mark();
        past.Look(shell, near, time, time, found);
        return found.Slots;
    }

    public void Add(int slot, double radius, int segment, SimTime from, SimTime until)
    {
        Reserve(slot);
        ref readonly MotionSegment path = ref timelines.Segment(segment);
        DenseOutput dense = timelines.Dense(segment);
        for (SimTime at = from; ;)
        {
            Shell shell = NewShell(path, dense, at, radius, 0.5 * cell);
            SimTime leaves = SimTime.Min(until, shell.Leaves(path, dense, at, box));
            past.AddAgain(present.CellOf(shell), slot, shell, at, leaves);
            if (leaves >= until)
            {
                return;
            }

            at = leaves;
        }
    }

    public void Forget(int slot)
    {
        if (slot < stays.Length && stays[slot].IsListed)
        {
            Leave(slot, heal: 0);
        }
    }

    public void DropBefore(SimTime edge) => past.DropBefore(edge);

    /// <summary>Makes a new shell around the body's present place, and its list.</summary>
    private void Move(int slot, double radius, in MotionSegment path, in DenseOutput dense, SimTime from, long heal)
    {
        ref Stay stay = ref stays[slot];
        if (stay.IsListed)
        {
            // A body that is put elsewhere twice in a tick was at the first place for rounds of that tick, in which others may meet it.
            bool wasThere = from > stay.From || (from == stay.From && stay.Shell.Leaves(path, dense, from, box) <= from);
            if (wasThere && stay.Heal == 0)
            {
                past.Add(stay.Cell, slot, stay.Shell, stay.From, from);
            }
            else if (wasThere)
            {
                past.AddAgain(stay.Cell, slot, stay.Shell, stay.From, from);
            }

            stay.Wanted *= heal != 0 ? 1 : stay.Predictions < FewPredictions ? Larger : stay.Predictions > ManyPredictions ? Smaller : 1;
            Leave(slot, heal);
        }

        stay.Wanted = stay.Wanted == 0 ? FirstStray * cell : Math.Min(0.5 * cell, Math.Max(MinStray * cell, stay.Wanted));
        Shell shell = NewShell(path, dense, from, radius, stay.Wanted);
        found.Clear();
        present.Look(shell, near, found);
        foreach (int other in found.Slots)
        {
            lists.Add(slot, other);
            if (lookingBack == 0 || lists.Of(other).IndexOf(slot) < 0)
            {
                lists.Add(other, slot);
            }
        }

        stay.LookedTo = SlabRing.EndOf(SlabRing.NumberOf(from) + 1);
        if (heal != 0)
        {
            int now = found.Count;
            found.Mark();
            past.Look(shell, near, from, stay.LookedTo, found);
            foreach (int other in found.Slots.Slice(now))
            {
                if (other != slot)
                {
                    lists.Add(slot, other); // the past body takes no further part
                }
            }
        }

        stay.Shell = shell;
        stay.Cell = present.CellOf(shell);
        stay.Radius = radius;
        stay.From = from;
        stay.Heal = heal;
        lookingBack += heal != 0 ? 1 : 0;
        stay.Predictions = 0;
        stay.IsListed = true;
        present.Add(slot, shell, stay.Cell);
    }

    /// <summary>
    /// Removes the body from its cell, and from the lists of others. It stays in lists that the current heal has made: it may be ahead of
    /// their bodies, which then still have to meet it where it was.
    /// </summary>
    private void Leave(int slot, long heal)
    {
        stays[slot].IsListed = false;
        lookingBack -= stays[slot].Heal != 0 ? 1 : 0;
        present.Remove(slot, stays[slot].Cell);
        bool keeps = heal != 0 && KeepsListsOfOneHeal;
        foreach (int other in lists.Of(slot))
        {
            int at = keeps && stays[other].Heal == heal ? -1 : lists.Of(other).IndexOf(slot);
            if (at >= 0)
            {
                lists.RemoveAt(other, at);
            }
        }

        lists.Clear(slot);
    }

    /// <summary>Whether a list that a heal has made keeps a body that the same heal moves on.</summary>
    private protected virtual bool KeepsListsOfOneHeal => true;

    /// <summary>
    /// A shell around where a path is, so wide, but no wider than fits the cells, unless the path would lead out of it in no time.
    /// </summary>
    private Shell NewShell(in MotionSegment path, in DenseOutput dense, SimTime at, double radius, double wanted)
    {
        double seconds = at.SecondsSince(path.Epoch);
        double speed = path.VelocityAt(seconds, dense).Length;
        double acceleration = Shell.LargestAcceleration(path, dense, seconds, shortestStay);
        double least = 2 * ((speed * shortestStay) + (2 * acceleration * shortestStay * shortestStay)); // twice, for three quarters are for the velocity
        double stray = Math.Max(least, Math.Min(wanted, Math.Max(MinStray * cell, (0.5 * cell * (1 - 1e-9)) - radius)));
        return new Shell(path.PositionAt(seconds, dense), stray < double.MaxValue ? stray : double.PositiveInfinity, radius);
    }

    private void Reserve(int slot)
    {
        if (slot >= stays.Length)
        {
            int size = Math.Max(slot + 1, stays.Length * 2);
            Array.Resize(ref stays, size);
            lists.Grow(size);
        }

        found.AddSlot(slot);
    }

    /// <summary>Since when a body is in its shell, and what is known of the others there.</summary>
    private struct Stay
    {
        internal Shell Shell;
        internal ulong Cell; // that the shell is listed in
        internal SimTime From;
        internal SimTime LookedTo; // up to when other bodies' paths were tested, if that was in a heal
        internal double Radius; // of the body
        internal double Wanted; // how far it may stray
        internal long Heal; // the heal in which the shell was made, or 0
        internal int Predictions;
        internal bool IsListed;
    }
}
