using System;
using System.Collections.Generic;
using LagSim.Time;

namespace LagSim.Hosting;

/// <summary>Finds which of the notices that a heal took out and of those that it put in are the same, moved.</summary>
/// <remarks>
/// Two notices can be the same if they are of one series, such as the contacts of one pair, and no more than <see cref="Within"/> apart. Of
/// each series as many as possible are paired, in order; where that leaves a choice, each is paired with the nearer one.
/// </remarks>
internal class NoticePairing<T>
    where T : struct, INotice<T>
{
    /// <summary>What has no partner, or none yet.</summary>
    internal const int None = -1;

    /// <summary>What was taken out: told before, and not found any more.</summary>
    internal List<Candidate> Gone { get; } = new();

    /// <summary>What was put in, and has not been told.</summary>
    internal List<Candidate> Made { get; } = new();

    /// <summary>
    /// How far a notice may move at once: half a second. Of 167 notices of a match over a bad link that came again after a heal, 163 did so
    /// within that time; and what comes later is heard as another bounce.
    /// </summary>
    internal SimDuration Within { get; } = SimDuration.FromSeconds(0.5);

    /// <summary>Sets the partners; both lists are then in the order of their series.</summary>
    internal virtual void Pair()
    {
        Gone.Sort(Candidate.Compare);
        Made.Sort(Candidate.Compare);
        int made = 0;
        for (int from = 0, end; from < Gone.Count && made < Made.Count; from = end)
        {
            for (end = from + 1; end < Gone.Count && Gone[from].CompareSeries(Gone[end]) == 0; end++)
            {
            }

            while (made < Made.Count && Made[made].CompareSeries(Gone[from]) < 0)
            {
                made++;
            }

            int madeFrom = made;
            while (made < Made.Count && Made[made].CompareSeries(Gone[from]) == 0)
            {
                made++;
            }

            PairInOrder(from, end, madeFrom, made);
            Slide(Made, madeFrom, made, Gone, end);
            Slide(Gone, from, end, Made, made);
        }
    }

    /// <summary>Pairs as many as can be, the earliest first.</summary>
    private void PairInOrder(int gone, int goneEnd, int made, int madeEnd)
    {
        while (gone < goneEnd && made < madeEnd)
        {
            SimTime before = Gone[gone].Time;
            SimTime now = Made[made].Time;
            if (Distance(before, now) <= Within)
            {
                Link(Gone, gone++, Made, made++);
            }
            else if (before < now)
            {
                gone++;
            }
            else
            {
                made++;
            }
        }
    }

    /// <summary>Lets each of one side, the last first, go on to a later partner that is free and no further away.</summary>
    private static void Slide(List<Candidate> side, int from, int end, List<Candidate> other, int otherEnd)
    {
        for (int n = end - 1; n >= from; n--)
        {
            while (side[n].Partner is int at && at != None && at + 1 < otherEnd && other[at + 1].Partner == None
                && Distance(side[n].Time, other[at + 1].Time) <= Distance(side[n].Time, other[at].Time))
            {
                other[at] = other[at].With(None);
                Link(side, n, other, at + 1);
            }
        }
    }

    private static void Link(List<Candidate> side, int n, List<Candidate> other, int at)
    {
        side[n] = side[n].With(at);
        other[at] = other[at].With(n);
    }

    private static SimDuration Distance(SimTime a, SimTime b) => a < b ? b - a : a - b;

    /// <summary>A notice that a heal took out or put in.</summary>
    internal readonly struct Candidate
    {
        internal Candidate(in T notice, int place, int partner = None)
        {
            Notice = notice;
            Place = place;
            Partner = partner;
        }

        internal static Comparison<Candidate> Compare { get; } = static (a, b) =>
        {
            int bySeries = a.CompareSeries(b);
            int byKey = bySeries != 0 ? bySeries : a.Notice.CompareWith(b.Notice);
            return byKey != 0 ? byKey : a.Place.CompareTo(b.Place);
        };

        internal T Notice { get; }

        /// <summary>Where it is in the list that it is from.</summary>
        internal int Place { get; }

        /// <summary>The place of the other in its list; <see cref="None"/> for none.</summary>
        internal int Partner { get; }

        internal SimTime Time => Notice.Key.Time;

        internal int CompareSeries(in Candidate other) => Notice.CompareSeries(other.Notice);

        internal Candidate With(int partner) => new(Notice, Place, partner);
    }
}
