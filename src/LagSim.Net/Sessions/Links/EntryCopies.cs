using System;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>Decides in how many updates in a row an entry goes: as many as the losses of the link ask for, whatever its distance.</summary>
/// <remarks>
/// Entries are taken in order, so one that was lost with all its copies holds up those that are sent until that is known and it has come
/// again: a round trip of them. The more there are, the seldomer it may happen.
/// </remarks>
internal sealed class EntryCopies
{
    /// <summary>How fast the mean distance between updates follows.</summary>
    private const int Smoothing = 8;

    private static readonly SimDuration LongestGap = SimDuration.FromSeconds(1);

    private readonly LossRuns runs = new();
    private SimDuration gap = LongestGap; // the mean distance of updates with new entries
    private SimTime sent = SimTime.MinValue; // when the last of them went

    /// <summary>
    /// Returns how long entries wait before they go again for lack of new ones: where those come often, until the next; on a bad link as
    /// short as can be, since a run of losses lasts for a number of datagrams.
    /// </summary>
    /// <param name="interval">How long they wait where new ones are rare.</param>
    internal SimDuration RepeatDelay(SimDuration interval) => runs.IsBad && interval > SendPacer.Together ? SendPacer.Together
        : gap * 3 / 2 is SimDuration next && next > interval && next <= interval * 2 ? next
        : interval;

    /// <summary>Takes in which updates have arrived at the other end.</summary>
    internal void NoteArrived(UpdateDatagram update) => runs.Note(update.EchoNumber, update.EchoBits);

    /// <summary>Records that an update with new entries was sent.</summary>
    internal void NoteSent(SimTime now)
    {
        SimDuration since = sent == SimTime.MinValue || now - sent > LongestGap ? LongestGap : now - sent;
        gap += (since - gap) / Smoothing;
        sent = now;
    }

    /// <summary>Returns in how many updates in a row an entry goes, from 1.</summary>
    /// <param name="trip">How long it takes until the answer arrives.</param>
    internal int Count(SimDuration trip)
    {
        double apart = Math.Max(gap.ToSeconds(), SendPacer.Together.ToSeconds());
        return runs.Copies(1 + (trip.ToSeconds() / apart));
    }
}
