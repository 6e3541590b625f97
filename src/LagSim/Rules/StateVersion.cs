using System;

namespace LagSim.Rules;

/// <summary>The state of rules after a call, in its one encoding. Calls that change nothing share it, and others share its pages.</summary>
internal sealed class StateVersion(StateVersions owner)
{
    /// <summary>How many keep it.</summary>
    internal int Uses { get; set; }

    /// <summary>A number that no other state of this world ever has; 0 before the first.</summary>
    internal long Serial { get; set; }

    /// <summary>How many bytes the encoded state has.</summary>
    internal int Length { get; set; }

    /// <summary>Its pages, of which the first <see cref="PageCount"/> are in use; one after the other they are the state.</summary>
    internal StatePage[] Pages { get; set; } = Array.Empty<StatePage>();

    internal int PageCount { get; set; }

    /// <summary>The encoded state's first bytes, with the head and the first timer.</summary>
    internal ReadOnlySpan<byte> Head => Pages[0].Bytes;

    /// <summary>The encoded state; valid until that of another version is asked for.</summary>
    internal ReadOnlySpan<byte> Bytes => owner.Whole(this);

    /// <summary>Whether it is the same state, to the bit.</summary>
    internal bool IsSameAs(StateVersion other)
    {
        if (ReferenceEquals(this, other) || Length != other.Length)
        {
            return Length == other.Length;
        }

        bool isSame = true;
        int mine = 0, its = 0; // pages
        int from = 0, start = 0; // within them
        while (isSame && mine < PageCount && its < other.PageCount)
        {
            StatePage a = Pages[mine];
            StatePage b = other.Pages[its];
            int count = Math.Min(a.Length - from, b.Length - start);
            isSame = (ReferenceEquals(a, b) && from == start) || a.Bytes.Slice(from, count).SequenceEqual(b.Bytes.Slice(start, count));
            (mine, from) = from + count == a.Length ? (mine + 1, 0) : (mine, from + count);
            (its, start) = start + count == b.Length ? (its + 1, 0) : (its, start + count);
        }

        return isSame;
    }

    /// <summary>The same for an encoded state.</summary>
    internal bool IsSameAs(ReadOnlySpan<byte> state)
    {
        bool isSame = Length == state.Length;
        for (int page = 0; page < PageCount && isSame; page++)
        {
            isSame = state.StartsWith(Pages[page].Bytes);
            state = state.Slice(Pages[page].Length);
        }

        return isSame;
    }
}
