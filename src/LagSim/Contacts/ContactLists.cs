using System;

namespace LagSim.Contacts;

/// <summary>The contacts of each body, by number: ascending, so in canonical order if contacts are.</summary>
/// <remarks>
/// Filled in three passes: <see cref="Count"/> for all contacts, <see cref="Sum"/>, and <see cref="Put"/> for all from the last to the
/// first.
/// Cost: bodies and contacts. Allocates only when there are more than ever before.
/// </remarks>
internal sealed class ContactLists
{
    private int[] from = Array.Empty<int>();
    private int[] listed = Array.Empty<int>();
    private int bodies;

    /// <summary>Begins again, for so many bodies and contacts.</summary>
    internal void Clear(int bodyCount, int contactCount)
    {
        bodies = bodyCount;
        if (from.Length <= bodyCount)
        {
            from = new int[Math.Max(4, 2 * bodyCount)];
        }

        if (listed.Length < 2 * contactCount)
        {
            listed = new int[4 * contactCount];
        }

        Array.Clear(from, 0, bodyCount + 1);
    }

    /// <summary>Counts a contact; the second is <see cref="ContactPoint.Static"/> where it is no body.</summary>
    internal void Count(int first, int second)
    {
        from[first]++;
        if (second >= 0)
        {
            from[second]++;
        }
    }

    /// <summary>All are counted.</summary>
    internal void Sum()
    {
        int sum = 0;
        for (int b = 0; b <= bodies; b++)
        {
            sum += from[b];
            from[b] = sum; // the end of its list; filled from behind it becomes the beginning
        }
    }

    /// <summary>Lists a contact before those that are listed.</summary>
    internal void Put(int contact, int first, int second)
    {
        listed[--from[first]] = contact;
        if (second >= 0)
        {
            listed[--from[second]] = contact;
        }
    }

    /// <summary>Those of a body.</summary>
    internal Span<int> Of(int body) => listed.AsSpan(from[body], from[body + 1] - from[body]);
}
