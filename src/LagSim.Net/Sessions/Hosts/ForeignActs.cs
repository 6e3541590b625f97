using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>What players did lately to bodies that are not their own: these bodies can be stopped should the player be sent away.</summary>
/// <param name="isKept">Whether anybody will ask; without a budget nobody does.</param>
/// <param name="many">With more than this, old ones are looked for.</param>
internal sealed class ForeignActs(bool isKept, int many)
{
    private readonly List<ExternalEvent> acts = new();

    /// <summary>Remembers an accepted act, if it is on a body that is not the player's own.</summary>
    internal void Note(in ExternalEvent external)
    {
        if (isKept && external.Body.Peer != external.Peer)
        {
            acts.Add(external);
        }
    }

    /// <summary>Forgets what was done before a time, if there is reason to look.</summary>
    internal void Forget(SimTime before)
    {
        if (acts.Count > 0 && (acts[0].Time < before || acts.Count > many))
        {
            acts.RemoveAll(act => act.Time < before);
        }
    }

    /// <summary>When a player did something from a time on, by body.</summary>
    internal ILookup<BodyId, SimTime> Of(byte player, SimTime from) =>
        acts.Where(act => act.Peer == player && act.Time >= from).ToLookup(act => act.Body, act => act.Time);
}
