using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Experiments.Peers;
using LagSim.Net.Sessions;

namespace LagSim.Harness.Experiments.Hold;

/// <summary>
/// A recorder of the hand's events as each peer receives them. Each list belongs to its session's thread until that has ended.
/// </summary>
internal sealed class HandWatch
{
    private readonly List<HandUpdate>[] heard;

    /// <summary>Subscribes to every session of a connected group.</summary>
    internal HandWatch(PeerGroup peers)
    {
        heard = Enumerable.Range(0, peers.PeerCount).Select(_ => new List<HandUpdate>()).ToArray();
        for (int place = 0; place < peers.PeerCount; place++)
        {
            Session session = peers.Session(place);
            List<HandUpdate> own = heard[place];
            session.Logged += entry =>
            {
                if (entry.IsAccepted)
                {
                    own.Add(new HandUpdate(session.SharedTime.Now, entry.Event));
                }
            };
        }
    }

    /// <summary>The events that a peer received, by its place in the group, in the order of the log.</summary>
    internal IReadOnlyList<HandUpdate> HeardBy(int place) => heard[place];
}
