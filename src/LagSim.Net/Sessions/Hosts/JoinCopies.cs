using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
///  Makes what those who join request, and shares it among them, so that many who come cost one copy a second and a bounded amount of
/// memory.
/// </summary>
internal sealed class JoinCopies
{
    /// <summary>A copy this fresh serves the next client too.</summary>
    private static readonly SimDuration CopyAge = SimDuration.FromSeconds(1);

    private readonly ClientRoster roster;
    private readonly AuthoritativeLog log;
    private readonly SharedWorld world;
    private readonly DoorLimits door;
    private readonly SimDuration timeout;
    private readonly byte[] sceneCopy;
    private JoinCopy? newest;

    /// <param name="roster">The clients, who fetch copies.</param>
    /// <param name="log">The log, which goes on where a copy ends.</param>
    /// <param name="world">What is copied.</param>
    /// <param name="door">How much memory copies may take.</param>
    /// <param name="timeout">No copy that is older is given to somebody new.</param>
    /// <exception cref="SceneException">The scene is too large to be shared.</exception>
    internal JoinCopies(ClientRoster roster, AuthoritativeLog log, SharedWorld world, DoorLimits door, SimDuration timeout)
    {
        this.roster = roster;
        this.log = log;
        this.world = world;
        this.door = door;
        this.timeout = timeout;
        sceneCopy = WorldCopy.Encode(world.Scene!, null);
    }

    /// <summary>The lines of the log from the one after this on are needed by who gets the newest copy.</summary>
    internal uint NeededAfter => newest?.LogIndex ?? uint.MaxValue;

    /// <summary>How many bytes the copies take that these clients are fetching; a shared one counts once.</summary>
    internal static long BytesOf(IEnumerable<Client> some) =>
        some.Select(j => j.Copy).OfType<JoinCopy>().Distinct().Sum(copy => (long)copy.Bytes.Length);

    /// <summary>How much memory copies of that size may take, in bytes; see <see cref="DoorLimits.CopyBytes"/>.</summary>
    internal long RoomForCopiesLike(JoinCopy copy) => Math.Max(door.CopyBytes, (long)copy.Bytes.Length * door.CopiesAtLeast);

    /// <summary>
    /// What someone who joins now has to fetch: the scene, and once what is committed lies past the start the state then. Null while the
    /// world is behind what it had committed to.
    /// </summary>
    /// <exception cref="SceneException">The world is too large to be copied.</exception>
    internal JoinCopy? For(SimTime now)
    {
        Forget(now);
        if (newest is null || !Serves(newest, now))
        {
            // One instant for both: the log goes on from where the state ends, however the clock runs on meanwhile.
            log.Settle();
            SimTime settledTo = log.SettledTo;
            Simulation? simulation = world.Live?.Simulation;
            bool hasState = simulation is not null && settledTo > simulation.Start;
            if (hasState && (settledTo > simulation!.SimulatedTo || settledTo < simulation.HistoryEdge))
            {
                return null;
            }

            byte[] bytes = hasState ? WorldCopy.Encode(world.Scene!, simulation!.Snapshot(settledTo)) : sceneCopy;
            newest = new JoinCopy(bytes, log.Lines.Settled, now);
        }

        return newest;
    }

    /// <summary>Lets go of copies that nobody needs any more.</summary>
    internal void Forget(SimTime now)
    {
        foreach (Client client in roster.All)
        {
            client.Copy = client.IsReady ? null : client.Copy;
        }

        bool isFetched = roster.All.Exists(j => j.Copy == newest);
        newest = newest is not null && now - newest.Made <= (isFetched ? timeout : CopyAge) ? newest : null;
    }

    /// <summary>
    /// Whether a new client can be given this copy. A copy is shared for a second; and while there is no memory for another one, until it
    /// is as old as the time-out.
    /// So clients are not dropped each time that another one comes, and no client gets a world older than that because others keep fetching
    /// it.
    /// </summary>
    private bool Serves(JoinCopy copy, SimTime now) =>
        now - copy.Made <= CopyAge || copy.Bytes.Length + BytesOf(roster.All) > RoomForCopiesLike(copy);
}
