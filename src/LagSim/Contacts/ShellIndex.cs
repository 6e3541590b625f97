using System;
using System.Collections.Generic;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Contacts;

/// <summary>
/// Verlet lists: around every body a shell that it stays in for a while, and for every body a list of those whose shells are so near that the two could touch. A list
/// holds until one of the two leaves its shell, however often they collide meanwhile.
/// </summary>
/// <remarks>
/// <para>Where a body's shell is can be told of the past too: a shell that is left is kept, with the span of time in which it held, until that lies before the history. So
/// what is healed finds who was near then, whatever he did since.</para>
/// <para>A list may name too many, for what is healed sees the past and the present at once; and never too few: of two shells whichever was made later found the other.</para>
/// <para>How far a body may stray is its own: who leaves a shell before long gets a larger one, and who stays for many predictions a smaller one with fewer to look at. Who is too wide or too
/// fast for the cells is listed apart, and looked at whenever a shell is made.</para>
/// <para>Cost: the length of a list for a prediction, and what lies in the 27 cells around for a shell, which holds for some ten predictions.</para>
/// </remarks>
internal sealed class ShellIndex : IPairIndex
{
    /// <summary>Who would leave the widest shell that fits the cells in less than this is too fast for them: 1/512 s, or what is far less than the others take.</summary>
    private const double ShortestStay = 1.0 / 512;

    private const double FarLess = 1.0 / 64;
    private const double FewTicks = 16;

    /// <summary>Who would have to look into more cells looks at everybody.</summary>
    private const double MostCells = 512;

    /// <summary>Who has been asked for less often in a shell gets a larger one next, and who more often a smaller one.</summary>
    private const int FewPredictions = 6;
    private const int ManyPredictions = 24;
    private const double Larger = 1.25;
    private const double Smaller = 0.9;

    /// <summary>A shell's least radius, in parts of the cell's size.</summary>
    private const double LeastStray = 1.0 / 32;

    private const int None = -1;

    private readonly TimelineStore timelines;
    private readonly CellGrid grid;
    private readonly PeriodicBox box;
    private readonly double cell;
    private readonly double near;
    private readonly double tick;
    private readonly double shortestStay;
    private readonly NeighbourLists lists = new();
    private readonly PastShells past = new();
    private readonly List<int> wide = new(); // who is in no cell
    private int[] heads; // by the cell's number: the first slot whose shell's centre is in it
    private Place[] places = new Place[16]; // what is looked at of others
    private Stay[] stays = new Stay[16]; // the rest
    private int[] found = new int[64];
    private int foundCount;
    private uint[] foundBy = new uint[16]; // slot -> the query that found it last
    private uint query;
    private int listed;
    private double widest; // extent of what is listed in cells

    /// <summary>An empty index.</summary>
    /// <param name="timelines">The paths.</param>
    /// <param name="cell">The least size of a cell, in metres: about two diameters of most bodies.</param>
    /// <param name="speed">How fast most bodies are at most, in m/s.</param>
    /// <param name="near">How far apart two bodies may be, in metres, that are still candidates.</param>
    /// <param name="tickLength">How far a body moves in a tick at most, in metres.</param>
    /// <param name="box">The box whose sides meet; empty if there is none.</param>
    internal ShellIndex(TimelineStore timelines, double cell, double speed, double near, double tickLength, in PeriodicBox box)
    {
        this.timelines = timelines;
        this.cell = cell;
        this.near = near;
        this.box = box;
        grid = new CellGrid(cell, box);
        tick = tickLength;
        shortestStay = Math.Max(FewTicks * TickConversion.SecondsPerTick, Math.Min(ShortestStay, FarLess * cell / speed)); // of the two the first if nobody moves
        heads = new int[64];
        Array.Fill(heads, None);
    }

    /// <summary>How many bodies are in no cell; if they are many, other cells would serve better.</summary>
    internal int WideCount => wide.Count;

    public Span<int> Candidates(int slot, double radius, SimTime from, long heal, out SimTime until)
    {
        Reserve(slot);
        ref readonly MotionSegment path = ref timelines.Segment(timelines.Last(slot));
        DenseOutput dense = timelines.Dense(timelines.Last(slot));
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
        Shell shell = new(timelines.Segment(segment).PositionAt(time.SecondsSince(timelines.Segment(segment).Epoch), timelines.Dense(segment)), 0, radius + tick);
        Begin();
        Look(shell);
        LookBack(shell, time, time);
        return found.AsSpan(0, foundCount);
    }

    public void Add(int slot, double radius, int segment, SimTime from, SimTime until)
    {
        ref readonly MotionSegment path = ref timelines.Segment(segment);
        DenseOutput dense = timelines.Dense(segment);
        for (SimTime at = from; ;)
        {
            Shell shell = NewShell(path, dense, at, radius, 0.5 * cell);
            SimTime leaves = SimTime.Min(until, shell.Leaves(path, dense, at, box));
            past.Add(IsWide(shell) ? PastShells.Wide : grid.NumberAt(shell.Centre), slot, shell, at, leaves);
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
            Leave(slot);
            lists.Clear(slot);
        }
    }

    public void DropBefore(SimTime edge) => past.DropBefore(edge);

    /// <summary>Makes the body's shell anew around where it is, and its list with it.</summary>
    private void Move(int slot, double radius, in MotionSegment path, in DenseOutput dense, SimTime from, long heal)
    {
        ref Stay stay = ref stays[slot];
        if (stay.IsListed)
        {
            if (from > stay.From)
            {
                ref readonly Place place = ref places[slot];
                past.Add(place.IsWide ? PastShells.Wide : place.Cell, slot, stay.Shell, stay.From, from);
            }

            stay.Wanted *= heal != 0 ? 1 : stay.Predictions < FewPredictions ? Larger : stay.Predictions > ManyPredictions ? Smaller : 1;
            Leave(slot);
            lists.Clear(slot);
        }

        stay.Wanted = stay.Wanted == 0 ? 0.125 * cell : Math.Min(0.5 * cell, Math.Max(LeastStray * cell, stay.Wanted));
        Shell shell = NewShell(path, dense, from, radius, stay.Wanted);
        stay.Shell = shell;
        stay.Radius = radius;
        stay.From = from;
        stay.LookedTo = SlabRing.EndOf(SlabRing.NumberOf(from) + 1);
        stay.Heal = heal;
        stay.Predictions = 0;
        Begin();
        foundBy[slot] = query; // nobody is his own neighbour
        Look(shell);
        for (int i = 0; i < foundCount; i++)
        {
            lists.Add(slot, found[i]);
            lists.AddOnce(found[i], slot);
        }

        if (heal != 0)
        {
            int present = foundCount;
            LookBack(shell, from, stay.LookedTo);
            for (int i = present; i < foundCount; i++)
            {
                lists.Add(slot, found[i]);
            }
        }

        Enter(slot, shell);
    }

    /// <summary>A shell around where a path is, so wide, but no wider than fits the cells, unless the path would lead out of it in no time.</summary>
    private Shell NewShell(in MotionSegment path, in DenseOutput dense, SimTime at, double radius, double wanted)
    {
        double seconds = at.SecondsSince(path.Epoch);
        double speed = path.VelocityAt(seconds, dense).Length;
        double acceleration = CellGrid.LargestAcceleration(path, dense, seconds, seconds + shortestStay);
        double least = 2 * ((speed * shortestStay) + (2 * acceleration * shortestStay * shortestStay)); // twice, for three quarters are for the velocity
        double stray = Math.Max(least, Math.Min(wanted, Math.Max(LeastStray * cell, (0.5 * cell * (1 - 1e-9)) - radius)));
        return new Shell(path.PositionAt(seconds, dense), stray < double.MaxValue ? stray : double.PositiveInfinity, radius);
    }

    private bool IsWide(in Shell shell) => shell.Extent > 0.5 * cell;

    private void Enter(int slot, in Shell shell)
    {
        ref Place place = ref places[slot];
        place.Centre = shell.Centre;
        place.Extent = shell.Extent;
        place.IsWide = IsWide(shell);
        if (++listed > heads.Length)
        {
            GrowHeads();
        }

        stays[slot].IsListed = true;
        if (place.IsWide)
        {
            wide.Add(slot);
            return;
        }

        widest = Math.Max(widest, shell.Extent);
        place.Cell = grid.NumberAt(shell.Centre);
        Link(slot);
    }

    private void Link(int slot)
    {
        ref Place place = ref places[slot];
        ref int head = ref heads[Bucket(place.Cell)];
        place.Previous = None;
        place.Next = head;
        if (head != None)
        {
            places[head].Previous = slot;
        }

        head = slot;
    }

    /// <summary>Takes the body out of its cell, and out of the lists of others.</summary>
    private void Leave(int slot)
    {
        ref Place place = ref places[slot];
        stays[slot].IsListed = false;
        listed--;
        if (place.IsWide)
        {
            wide.Remove(slot);
        }
        else
        {
            if (place.Previous == None)
            {
                heads[Bucket(place.Cell)] = place.Next;
            }
            else
            {
                places[place.Previous].Next = place.Next;
            }

            if (place.Next != None)
            {
                places[place.Next].Previous = place.Previous;
            }
        }

        foreach (int other in lists.Of(slot))
        {
            lists.Remove(other, slot);
        }
    }

    private void Begin()
    {
        foundCount = 0;
        if (++query == 0)
        {
            Array.Clear(foundBy, 0, foundBy.Length);
            query = 1;
        }
    }

    /// <summary>Finds whose shells are near now.</summary>
    private void Look(in Shell shell)
    {
        double reach = shell.Extent + near;
        foreach (int slot in wide)
        {
            FindIfNear(slot, shell.Centre, reach);
        }

        CellBlock cells = grid.Around(shell.Centre, reach + widest);
        if (cells.Count > MostCells)
        {
            for (int slot = 0; slot < places.Length; slot++)
            {
                if (stays[slot].IsListed && !places[slot].IsWide)
                {
                    FindIfNear(slot, shell.Centre, reach);
                }
            }

            return;
        }

        for (long x = cells.X.From; x <= cells.X.To; x++)
        {
            for (long y = cells.Y.From; y <= cells.Y.To; y++)
            {
                for (long z = cells.Z.From; z <= cells.Z.To; z++)
                {
                    ulong number = grid.Number(x, y, z);
                    for (int slot = heads[Bucket(number)]; slot != None; slot = places[slot].Next)
                    {
                        if (places[slot].Cell == number)
                        {
                            FindIfNear(slot, shell.Centre, reach);
                        }
                    }
                }
            }
        }
    }

    /// <summary>Finds whose shells were near in a span of the past.</summary>
    private void LookBack(in Shell shell, SimTime from, SimTime until)
    {
        CellBlock cells = grid.Around(shell.Centre, shell.Extent + near + (0.5 * cell));
        long first = past.SlabsFrom(from, out int count);
        for (int i = 0; i < count; i++)
        {
            if (past.Slab(first + i) is not { } slab)
            {
                continue;
            }

            if (cells.Count > MostCells)
            {
                for (int entry = 0; entry < slab.Count; entry++)
                {
                    FindIfWasNear(slab.Value(entry), shell, from, until);
                }

                continue;
            }

            FindIn(slab, PastShells.Wide, shell, from, until);
            for (long x = cells.X.From; x <= cells.X.To; x++)
            {
                for (long y = cells.Y.From; y <= cells.Y.To; y++)
                {
                    for (long z = cells.Z.From; z <= cells.Z.To; z++)
                    {
                        FindIn(slab, grid.Number(x, y, z), shell, from, until);
                    }
                }
            }
        }
    }

    private void FindIn(CellTable<PastShells.Stay> slab, ulong number, in Shell shell, SimTime from, SimTime until)
    {
        for (int entry = slab.First(number); entry != CellTable<PastShells.Stay>.None; entry = slab.Next(entry))
        {
            if (slab.Cell(entry) == number)
            {
                FindIfWasNear(slab.Value(entry), shell, from, until);
            }
        }
    }

    private void FindIfWasNear(in PastShells.Stay stay, in Shell shell, SimTime from, SimTime until)
    {
        double reach = shell.Extent + stay.Shell.Extent + near;
        if (stay.Until >= from && stay.From <= until && timelines.IsKnown(stay.Slot) && !(box.Nearest(stay.Shell.Centre - shell.Centre).LengthSquared > reach * reach))
        {
            Find(stay.Slot);
        }
    }

    private void FindIfNear(int slot, in Vector3D centre, double reach)
    {
        ref readonly Place place = ref places[slot];
        double both = reach + place.Extent;
        if (!(box.Nearest(place.Centre - centre).LengthSquared > both * both))
        {
            Find(slot);
        }
    }

    private void Find(int slot)
    {
        if (foundBy[slot] == query)
        {
            return; // found already
        }

        foundBy[slot] = query;
        if (foundCount == found.Length)
        {
            Array.Resize(ref found, foundCount * 2);
        }

        found[foundCount++] = slot;
    }

    private int Bucket(ulong number) => (int)((number * 0x9E3779B97F4A7C15UL) >> 32) & (heads.Length - 1);

    private void GrowHeads()
    {
        heads = new int[heads.Length * 2];
        Array.Fill(heads, None);
        for (int slot = 0; slot < places.Length; slot++)
        {
            if (stays[slot].IsListed && !places[slot].IsWide)
            {
                Link(slot);
            }
        }
    }

    private void Reserve(int slot)
    {
        lists.AddSlot(slot);
        if (slot >= places.Length)
        {
            int size = Math.Max(slot + 1, places.Length * 2);
            Array.Resize(ref places, size);
            Array.Resize(ref stays, size);
            Array.Resize(ref foundBy, size);
        }
    }

    /// <summary>Of a body's shell what those look at who make theirs.</summary>
    private struct Place
    {
        internal Vector3D Centre;
        internal double Extent;
        internal ulong Cell;
        internal int Next;
        internal int Previous;
        internal bool IsWide;
    }

    /// <summary>Since when a body is in its shell, and what is known of the others there.</summary>
    private struct Stay
    {
        internal Shell Shell;
        internal SimTime From;
        internal SimTime LookedTo; // up to when it was looked at what others did, if that was in a heal
        internal double Radius; // of the body
        internal double Wanted; // how far it may stray
        internal long Heal; // the heal in which the shell was made, or 0
        internal int Predictions;
        internal bool IsListed;
    }
}
