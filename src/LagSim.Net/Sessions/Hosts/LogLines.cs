using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// The entries of the host's log: every validated event in order, counted from 1. The oldest are dropped once they are not needed.
/// </summary>
internal sealed class LogLines
{
    private readonly List<(LogEntry Entry, SimTime Watermark, SimTime At)> entries = new();
    private uint forgotten;
    private uint settled;

    /// <summary>The number of entries so far, which is also the number of the last.</summary>
    internal uint Count => forgotten + (uint)entries.Count;

    /// <summary>The number of leading entries stamped before the watermark; a client with the committed state needs none of them.</summary>
    internal uint Settled => settled;

    /// <summary>The number of entries kept.</summary>
    internal int Kept => entries.Count;

    internal LogEntry this[uint number] => entries[(int)(number - forgotten - 1)].Entry;

    /// <param name="external">The event.</param>
    /// <param name="verdict">The host's verdict.</param>
    /// <param name="watermark">The time before which there is no accepted event from this entry on.</param>
    /// <param name="at">The time of the verdict, by the host's clock.</param>
    internal void Add(in ExternalEvent external, Verdict verdict, SimTime watermark, SimTime at) =>
        entries.Add((new LogEntry(Count + 1, verdict, external), watermark, at));

    /// <summary>When a kept entry was added, by the host's clock.</summary>
    internal SimTime AddedAt(uint number) => entries[(int)(number - forgotten - 1)].At;

    /// <summary>The time before which there is, and will be, no accepted event after the entries up to a number.</summary>
    /// <param name="number">A number below <see cref="Count"/> whose next entry is kept.</param>
    internal SimTime WatermarkAfter(uint number) => entries[(int)(number - forgotten)].Watermark;

    /// <summary>Advances what is settled.</summary>
    internal void Settle(SimTime watermark)
    {
        while (settled < Count && (!this[settled + 1].IsAccepted || this[settled + 1].Event.Time < watermark))
        {
            settled++;
        }
    }

    /// <summary>Drops the entries up to a number, as far as they are settled.</summary>
    internal void ForgetUpTo(uint number)
    {
        int most = (int)(Math.Min(number, settled) - Math.Min(forgotten, Math.Min(number, settled)));
        if (most > entries.Count / 2)
        {
            entries.RemoveRange(0, most); // half at least, so that an entry is moved once on average
            forgotten += (uint)most;
        }
    }
}
