using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Peers;

/// <summary>Records when the last peer showed each event, by its own shared clock, and which events the host accepted.</summary>
/// <remarks>
/// In virtual time a step takes none, so a received event is shown at once. In real time each session reports on its own thread, and an
/// event counts as shown once that peer has published its next frame. A peer's own actions publish frames too, so only peers that do
/// nothing are measured to the millisecond.
/// </remarks>
internal sealed class LateEventWatch
{
    private readonly PeerGroup peers;
    private readonly bool isReal;
    private readonly object gate = new(); // guards everything below
    private readonly List<((byte Peer, uint Sequence) Which, SimTime Heard)>[] unshown;
    private readonly Dictionary<(byte Peer, uint Sequence), (int Heard, SimTime Last)> heard = [];
    private readonly List<ExternalEvent> done = [];
    private readonly List<ExternalEvent> accepted = [];

    /// <summary>Subscribes to every session of a connected group.</summary>
    internal LateEventWatch(PeerGroup peers)
    {
        this.peers = peers;
        isReal = peers is RealPeers;
        unshown = Enumerable.Range(0, peers.PeerCount).Select(_ => new List<((byte, uint), SimTime)>()).ToArray();
        for (int place = 0; place < peers.PeerCount; place++)
        {
            int own = place;
            peers.Session(place).Logged += entry => Hear(own, entry);
        }
    }

    /// <summary>The accepted events, in the order of the host's log. Read it once the run has ended.</summary>
    internal IReadOnlyList<ExternalEvent> Accepted => accepted;

    /// <summary>
    /// For each event its stamp, and the time at which the last peer showed it; the end of time if one never did. Read it once the run has
    /// ended.
    /// </summary>
    internal IReadOnlyList<(SimTime Stamp, SimTime Dealt)> Windows
    {
        get
        {
            for (int place = 0; place < unshown.Length; place++)
            {
                Show(place);
            }

            return done.Select(e => (e.Time, Dealt(e))).ToList();
        }
    }

    /// <summary>Records an action of a player.</summary>
    internal void Did(in ExternalEvent external) => done.Add(external);

    /// <summary>
    /// Returns the phase of an instant: "during" from an event's stamp until all peers show it, else before the first event, or after.
    /// </summary>
    internal static Phase PhaseAt(IReadOnlyList<(SimTime Stamp, SimTime Dealt)> windows, SimTime time) =>
        windows.All(w => time < w.Stamp) ? Phase.Before : windows.Any(w => time >= w.Stamp && time < w.Dealt) ? Phase.During : Phase.After;

    private void Hear(int place, in LogEntry entry)
    {
        Session session = peers.Session(place);
        lock (gate)
        {
            if (place == 0 && entry.IsAccepted)
            {
                accepted.Add(entry.Event);
            }

            if (session.Peer == entry.Event.Peer && entry.Verdict == Verdict.Accepted)
            {
                return; // its author already has it, unless the host refuses it
            }

            (byte, uint) which = (entry.Event.Peer, entry.Event.Sequence);
            if (isReal)
            {
                Show(place);
                unshown[place].Add((which, session.SharedTime.Now));
            }
            else
            {
                Count(which, session.SharedTime.Now);
            }
        }
    }

    /// <summary>A peer's newest frame shows every event that the peer had received when it published the frame.</summary>
    private void Show(int place)
    {
        SimTime shown = peers.Session(place).Counters.LastShown;
        foreach (((byte, uint) which, SimTime _) in unshown[place].Where(e => e.Heard <= shown))
        {
            Count(which, shown);
        }

        unshown[place].RemoveAll(e => e.Heard <= shown);
    }

    private void Count((byte, uint) which, SimTime shown)
    {
        (int count, SimTime last) = heard.GetValueOrDefault(which, (0, SimTime.MinValue));
        heard[which] = (count + 1, SimTime.Max(last, shown));
    }

    private SimTime Dealt(in ExternalEvent external)
    {
        (int count, SimTime last) = heard.GetValueOrDefault((external.Peer, external.Sequence), (0, SimTime.MinValue));
        return count >= peers.PeerCount - 1 ? SimTime.Max(last, external.Time + peers.DisplayDelay) : SimTime.MaxValue;
    }
}
