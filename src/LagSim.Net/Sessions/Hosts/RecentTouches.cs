using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// Remembers what players recently did to bodies of others, so that these bodies can be stopped if the player is expelled.
/// </summary>
/// <param name="isKept">Whether to remember anything; without a budget it is not needed.</param>
/// <param name="many">The number above which old ones are looked for.</param>
internal sealed class RecentTouches(bool isKept, int many)
{
    private readonly List<ExternalEvent> acts = new();

    /// <summary>Remembers an accepted event if it is on a body that is not the player's own.</summary>
    internal void Note(in ExternalEvent external)
    {
        if (isKept && external.Body.Peer != external.Peer)
        {
            acts.Add(external);
        }
    }

    /// <summary>Forgets events before a time, if there are enough to look.</summary>
    internal void Forget(SimTime before)
    {
        if (acts.Count > 0 && (acts[0].Time < before || acts.Count > many))
        {
            acts.RemoveAll(act => act.Time < before);
        }
    }

    /// <summary>Returns when a player acted from a time on, by body.</summary>
    internal ILookup<BodyId, SimTime> Of(byte player, SimTime from) =>
        acts.Where(act => act.Peer == player && act.Time >= from).ToLookup(act => act.Body, act => act.Time);
}
