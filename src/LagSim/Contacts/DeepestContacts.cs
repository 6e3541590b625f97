using System;

namespace LagSim.Contacts;

/// <summary>
/// Leaves contacts out of the solution of a step where bodies lie inside one another: each body keeps those that are deepest.
/// </summary>
/// <remarks>
/// <para>n bodies put into one place touch in n² / 2 pairs, which no solver gets through in time. Spheres of whatever sizes that lie side by side
/// touch in no more than 7.47 pairs a body, so this changes no heap.</para>
/// <para>Overlap ends all the same: as long as a body overlaps anything, its deepest contact overlaps, and is in the solution. What is left out
/// goes on to hold the two together where they overlap, so that the next step asks again. Where bodies are equally deep, as in one point, those that are nearest in
/// the canonical order are kept; they are a chain, which is what parts them.</para>
/// <para>A pure function of the contacts. Cost: their number. Allocates only when there are more than ever before.</para>
/// </remarks>
internal sealed class DeepestContacts(ContactProblem problem)
{
    /// <summary>
    /// How many a body keeps at least. Half of 8 + 4 sqrt(3), the most that spheres side by side touch in the mean (Kuperberg and Schramm 1994,
    /// Math. Res. Lett. 1, 339-344), for a pair is of two bodies.
    /// </summary>
    private const int Kept = 7;

    private readonly int[] deepest = new int[Kept]; // of one body
    private bool[] isKept = Array.Empty<bool>(); // by contact
    private SolverContact[] left = Array.Empty<SolverContact>();
    private int[] places = Array.Empty<int>(); // of those left out among all
    private int leftCount;

    /// <summary>Begins again, with nothing left out.</summary>
    internal void Clear() => leftCount = 0;

    /// <summary>Leaves out what lies among deeper ones, if there are more pairs than in any heap of as many bodies.</summary>
    internal void LeaveOut()
    {
        if (leftCount > 0 || problem.ShareOfSweeps() == 1)
        {
            return;
        }

        Mark();
        int kept = 0;
        for (int i = 0; i < problem.ContactCount; i++)
        {
            ref SolverContact c = ref problem.Contacts[i];
            if (isKept[i])
            {
                problem.Contacts[kept++] = c;
                continue;
            }

            c.IsLeftOut = true;
            c.DropImpulses();
            places[leftCount] = i;
            left[leftCount++] = c;
        }

        problem.Keep(kept);
    }

    /// <summary>Puts back what was left out, where it was.</summary>
    internal void PutBack()
    {
        int from = problem.ContactCount - 1;
        problem.Keep(problem.ContactCount + leftCount);
        for (int to = problem.ContactCount - 1; leftCount > 0; to--)
        {
            problem.Contacts[to] = places[leftCount - 1] == to ? left[--leftCount] : problem.Contacts[from--];
        }
    }

    private void Mark()
    {
        int count = problem.ContactCount;
        if (isKept.Length < count)
        {
            int size = problem.Contacts.Length;
            (isKept, left, places) = (new bool[size], new SolverContact[size], new int[size]);
        }

        Array.Clear(isKept, 0, count);
        problem.List();
        for (int b = 0; b < problem.BodyCount; b++)
        {
            int found = 0;
            foreach (int i in problem.ListOf(b))
            {
                if (problem.Contacts[i].Second < 0)
                {
                    isKept[i] = true;
                    continue;
                }

                found = Note(i, found);
            }

            for (int n = 0; n < found; n++)
            {
                isKept[deepest[n]] = true;
            }
        }
    }

    /// <summary>Notes a contact among the deepest so far of a body; returns how many there are.</summary>
    private int Note(int contact, int found)
    {
        if (found == Kept && !IsDeeper(contact, deepest[found - 1]))
        {
            return found;
        }

        found = Math.Min(found + 1, Kept);
        int at = found - 1;
        while (at > 0 && IsDeeper(contact, deepest[at - 1]))
        {
            deepest[at] = deepest[at - 1];
            at--;
        }

        deepest[at] = contact;
        return found;
    }

    /// <summary>Whether a contact comes before another; equals come in their order.</summary>
    private bool IsDeeper(int contact, int other)
    {
        ref readonly SolverContact a = ref problem.Contacts[contact];
        ref readonly SolverContact b = ref problem.Contacts[other];
        return a.Gap < b.Gap || (a.Gap == b.Gap && a.Second - a.First < b.Second - b.First);
    }
}
