using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// The host's log: every event it said yes or no to, in that order, counted from 1; its beginning is forgotten once nobody needs it.
/// </summary>
internal sealed class LogLines
{
    private readonly List<(LogEntry Entry, SimTime Watermark, SimTime At)> entries = new();
    private uint forgotten;
    private uint settled;

    /// <summary>How many entries there have been; the number of the last.</summary>
    internal uint Count => forgotten + (uint)entries.Count;

    /// <summary>
    /// How many entries, from the first on, are stamped before the watermark: whoever has the committed state needs none of them.
    /// </summary>
    internal uint Settled => settled;

    /// <summary>How many of them are kept.</summary>
    internal int Kept => entries.Count;

    internal LogEntry this[uint number] => entries[(int)(number - forgotten - 1)].Entry;

    /// <param name="external">The event.</param>
    /// <param name="verdict">What the host says.</param>
    /// <param name="watermark">The time before which there is no accepted event from this entry on.</param>
    /// <param name="at">When it says so, by its own clock.</param>
    internal void Add(in ExternalEvent external, Verdict verdict, SimTime watermark, SimTime at) =>
        entries.Add((new LogEntry(Count + 1, verdict, external), watermark, at));

    /// <summary>When an entry that is kept was added, by the host's own clock.</summary>
    internal SimTime AddedAt(uint number) => entries[(int)(number - forgotten - 1)].At;

    /// <summary>The time before which there is, and will be, no accepted event after the entries up to a number.</summary>
    /// <param name="number">Below <see cref="Count"/>, of an entry whose next one is kept.</param>
    internal SimTime WatermarkAfter(uint number) => entries[(int)(number - forgotten)].Watermark;

    /// <summary>Moves on what is settled.</summary>
    internal void Settle(SimTime watermark)
    {
        while (settled < Count && (this[settled + 1].Verdict != Verdict.Accepted || this[settled + 1].Event.Time < watermark))
        {
            settled++;
        }
    }

    /// <summary>Forgets the entries up to a number, as far as they are settled.</summary>
    internal void ForgetUpTo(uint number)
    {
        int most = (int)(Math.Min(number, settled) - Math.Min(forgotten, Math.Min(number, settled)));
        if (most > entries.Count / 2)
        {
            entries.RemoveRange(0, most); // half at least, so that an entry is moved once in the mean
            forgotten += (uint)most;
        }
    }
}
