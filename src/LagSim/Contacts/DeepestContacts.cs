using System;

namespace LagSim.Contacts;

/// <summary>
/// Chooses, where bodies lie inside one another, the pairs that take part in a solution: each body keeps those that are deepest.
/// </summary>
/// <remarks>
/// <para>n bodies put into one place touch in n² / 2 pairs, which no solver gets through in time, and no timeline can carry. Spheres of
/// whatever
/// sizes that lie side by side touch in no more than 7.47 pairs a body (Kuperberg and Schramm 1994, Math. Res. Lett. 1, 339-344: 14.93
/// neighbours in the mean), so this changes no heap.</para>
/// <para>Overlap ends all the same: as long as a body overlaps anything, its deepest contact overlaps, and is in the solution. Where
/// bodies are
/// equally deep, as in one point, those that are nearest in the canonical order are kept; they are a chain, which is what parts
/// them.</para>
/// <para>A pure function of the pairs, in whatever order they come. Cost: their number. Allocates only when there are more than ever
/// before.</para>
/// </remarks>
internal sealed class DeepestContacts
{
    /// <summary>How many pairs a body keeps at least: half of 8 + 4 sqrt(3), for a pair is of two bodies.</summary>
    internal const int Kept = 7;

    /// <summary>The most pairs that touch, for each of many spheres that do not overlap.</summary>
    private const double MostPairs = 7.47;

    private Pair[] pairs = Array.Empty<Pair>();
    private bool[] isKept = Array.Empty<bool>(); // by pair
    private int[] deepest = Array.Empty<int>(); // so many for each body
    private int[] found = Array.Empty<int>(); // how many of those there are, by body
    private int count;
    private int overlapping;

    /// <summary>Begins again, without pairs.</summary>
    internal void Clear() => count = overlapping = 0;

    /// <summary>Adds a pair of bodies, by their numbers in canonical order, with the distance between them in metres, negative where they
    /// overlap.</summary>
    internal void Add(int first, int second, double gap)
    {
        if (count == pairs.Length)
        {
            Array.Resize(ref pairs, Math.Max(8, 2 * count));
        }

        pairs[count++] = new Pair(first, second, gap);
        overlapping += gap < 0 ? 1 : 0;
    }

    /// <summary>Whether more pairs overlap than could touch if none did: only then is anything left out.</summary>
    internal bool IsCrowd(int bodies) => MayBeCrowd(overlapping, bodies);

    /// <summary>Whether so many contacts are more than could touch if nothing overlapped.</summary>
    internal static bool MayBeCrowd(int contacts, int bodies) => contacts > MostPairs * bodies;

    /// <summary>Chooses among the pairs of so many bodies.</summary>
    internal void Choose(int bodies)
    {
        if (isKept.Length < count)
        {
            isKept = new bool[pairs.Length];
        }

        if (found.Length < bodies)
        {
            (found, deepest) = (new int[2 * bodies], new int[2 * bodies * Kept]);
        }

        Array.Clear(isKept, 0, count);
        Array.Clear(found, 0, bodies);
        for (int i = 0; i < count; i++)
        {
            Note(i, pairs[i].First);
            Note(i, pairs[i].Second);
        }

        for (int b = 0; b < bodies; b++)
        {
            for (int n = 0; n < found[b]; n++)
            {
                isKept[deepest[(b * Kept) + n]] = true;
            }
        }
    }

    /// <summary>Whether a pair was chosen, by the order in which pairs were added.</summary>
    internal bool IsKept(int pair) => isKept[pair];

    /// <summary>Whether the two of a pair are deeper in each other than so many metres.</summary>
    internal bool IsDeep(int pair, double depth) => pairs[pair].Gap < -depth;

    /// <summary>Notes a pair among the deepest so far of a body.</summary>
    private void Note(int pair, int body)
    {
        Span<int> its = deepest.AsSpan(body * Kept, Kept);
        if (found[body] == Kept && !IsDeeper(pairs[pair], pairs[its[Kept - 1]]))
        {
            return;
        }

        found[body] = Math.Min(found[body] + 1, Kept);
        int at = found[body] - 1;
        while (at > 0 && IsDeeper(pairs[pair], pairs[its[at - 1]]))
        {
            its[at] = its[at - 1];
            at--;
        }

        its[at] = pair;
    }

    /// <summary>Whether a pair comes before another: the deeper, then the nearer in the canonical order, then the first in it.</summary>
    private static bool IsDeeper(in Pair a, in Pair b) =>
        a.Gap != b.Gap ? a.Gap < b.Gap
        : a.Second - a.First != b.Second - b.First ? a.Second - a.First < b.Second - b.First
        : a.First < b.First;

    private readonly struct Pair(int first, int second, double gap)
    {
        internal readonly int First = first;
        internal readonly int Second = second;
        internal readonly double Gap = gap;
    }
}
