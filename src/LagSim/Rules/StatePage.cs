using System;

namespace LagSim.Rules;

/// <summary>A part of the state of rules that is the same after several calls, and kept once for all of them.</summary>
internal sealed class StatePage
{
    /// <summary>
    /// How many bytes it has. A state of n bytes costs what a call changes, at least one page, and a reference of 8 bytes to each: least at
    /// sqrt(8 n), which is 0.5 to 3 kB for states of 40 kB to 1 MB.
    /// </summary>
    internal const int Size = 1024;

    /// <summary>Its bytes; those after the end of the state are of no meaning. A state's last page has no more than it needs.</summary>
    internal byte[] Bytes { get; set; } = Array.Empty<byte>();

    /// <summary>How many versions have it.</summary>
    internal int Uses { get; set; }
}
