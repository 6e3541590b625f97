using System;

namespace LagSim.Rules;

/// <summary>A part of the state of rules that is the same after several calls, and kept once for all of them.</summary>
internal sealed class StatePage(int room)
{
    /// <summary>
    /// How many bytes one may have. A state of n bytes costs what a call changes, at least one page, and a reference of 8 bytes to each:
    /// least at sqrt(8 n), which is 0.5 to 3 kB for states of 40 kB to 1 MB.
    /// </summary>
    internal const int MostBytes = 1024;

    /// <summary>
    /// How many it has at least, unless it is the only one of its state: pages that are cut out of more than the most have at least half of
    /// that each.
    /// </summary>
    internal const int LeastBytes = MostBytes / 2;

    private readonly byte[] bytes = new byte[room];

    /// <summary>How many bytes there is room for.</summary>
    internal int Room => bytes.Length;

    /// <summary>How many bytes it has.</summary>
    internal int Length { get; private set; }

    /// <summary>How many versions have it.</summary>
    internal int Uses { get; set; }

    /// <summary>Its bytes.</summary>
    internal ReadOnlySpan<byte> Bytes => bytes.AsSpan(0, Length);

    /// <summary>Gives it its bytes.</summary>
    internal void Set(ReadOnlySpan<byte> part)
    {
        part.CopyTo(bytes);
        Length = part.Length;
    }
}
