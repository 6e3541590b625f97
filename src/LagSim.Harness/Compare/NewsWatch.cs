using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.Metrics;
using LagSim.Harness.Peers;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Harness.Compare;

/// <summary>Notes when the last peer had heard of each event, by its own shared clock, and what the host accepted.</summary>
internal sealed class NewsWatch
{
    private readonly PeerGroup peers;
    private readonly Dictionary<(byte Peer, uint Sequence), (int Heard, SimTime Last)> heard = [];
    private readonly List<ExternalEvent> done = [];
    private readonly List<ExternalEvent> accepted = [];

    /// <summary>Listens to every session of a group that is connected.</summary>
    internal NewsWatch(PeerGroup peers)
    {
        this.peers = peers;
        for (int peer = 0; peer < peers.PeerCount; peer++)
        {
            Session session = peers.Session(peer);
            session.Logged += entry => Hear(session.Peer, entry, session.SharedTime.Now);
        }
    }

    /// <summary>What the host accepted, in the order of its log.</summary>
    internal IReadOnlyList<ExternalEvent> Accepted => accepted;

    /// <summary>Of each event that was done its stamp, and when the last peer showed it; the end of time if one never did.</summary>
    internal IReadOnlyList<(SimTime Stamp, SimTime Dealt)> Windows => done.Select(e => (e.Time, Dealt(e))).ToList();

    /// <summary>Says that a player has done this.</summary>
    internal void Did(in ExternalEvent external) => done.Add(external);

    /// <summary>The phase of an instant: during any event that has happened and is not shown by all, else before the first, or after.</summary>
    internal static Phase PhaseAt(IReadOnlyList<(SimTime Stamp, SimTime Dealt)> windows, SimTime time) =>
        windows.All(w => time < w.Stamp) ? Phase.Before : windows.Any(w => time >= w.Stamp && time < w.Dealt) ? Phase.During : Phase.After;

    private void Hear(int peer, in LogEntry entry, SimTime now)
    {
        if (peer == 0 && entry.Verdict == Verdict.Accepted)
        {
            accepted.Add(entry.Event);
        }

        if (peer != entry.Event.Peer || entry.Verdict != Verdict.Accepted) // who did it has it already, unless it is taken back
        {
            (byte, uint) which = (entry.Event.Peer, entry.Event.Sequence);
            (int count, SimTime last) = heard.GetValueOrDefault(which, (0, SimTime.MinValue));
            heard[which] = (count + 1, SimTime.Max(last, now));
        }
    }

    private SimTime Dealt(in ExternalEvent external)
    {
        (int count, SimTime last) = heard.GetValueOrDefault((external.Peer, external.Sequence), (0, SimTime.MinValue));
        return count >= peers.PeerCount - 1 ? SimTime.Max(last, external.Time + peers.DisplayDelay) : SimTime.MaxValue;
    }
}
