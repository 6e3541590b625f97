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

    /// <summary>Its pages, of which the first <see cref="PageCount"/> are in use.</summary>
    internal StatePage[] Pages { get; set; } = Array.Empty<StatePage>();

    internal int PageCount => (Length + StatePage.Size - 1) / StatePage.Size;

    /// <summary>The encoded state's first bytes, with the head and the first timer.</summary>
    internal ReadOnlySpan<byte> Head => Part(0);

    /// <summary>The encoded state; valid until that of another version is asked for.</summary>
    internal ReadOnlySpan<byte> Bytes => owner.Whole(this);

    /// <summary>The bytes of a page.</summary>
    internal ReadOnlySpan<byte> Part(int page) => Pages[page].Bytes.AsSpan(0, Math.Min(StatePage.Size, Length - (page * StatePage.Size)));

    /// <summary>Whether it is the same state, to the bit.</summary>
    internal bool IsSameAs(StateVersion other)
    {
        bool isSame = Length == other.Length;
        for (int page = 0; page < PageCount && isSame && !ReferenceEquals(this, other); page++)
        {
            isSame = ReferenceEquals(Pages[page], other.Pages[page]) || Part(page).SequenceEqual(other.Part(page));
        }

        return isSame;
    }

    /// <summary>The same for an encoded state.</summary>
    internal bool IsSameAs(ReadOnlySpan<byte> state)
    {
        bool isSame = Length == state.Length;
        for (int page = 0; page < PageCount && isSame; page++)
        {
            isSame = Part(page).SequenceEqual(state.Slice(page * StatePage.Size, Part(page).Length));
        }

        return isSame;
    }
}
