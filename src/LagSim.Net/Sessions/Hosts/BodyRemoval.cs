using System.Collections.Generic;
using LagSim.Events;
using LagSim.Net.Sessions.Core;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Removes bodies that players spawned, by events of the host.</summary>
internal sealed class BodyRemoval(SharedWorld world, HostActions actions, Watermark watermark)
{
    /// <summary>
    /// Removes a player's spawned bodies, all if none are named, as of an instant, and those spawned later at their spawn.
    /// </summary>
    /// <returns>The number of bodies removed.</returns>
    internal int RemoveSpawned(IEnumerable<BodyId>? some, byte player, SimTime from)
    {
        HashSet<BodyId>? named = some is null ? null : [.. some];
        int removed = 0;
        watermark.Hold();
        try
        {
            foreach ((BodyId body, SimTime since) in world.Limits.Spawned(player, named))
            {
                actions.Do(PlayerAction.Remove(body), SimTime.Max(from, since));
                removed++;
            }
        }
        finally
        {
            watermark.Resume();
        }

        return removed;
    }
}
