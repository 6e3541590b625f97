using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// Creates and shares the snapshots for joining clients, so that many of them cost one snapshot per second and a bounded amount of memory.
/// </summary>
internal sealed class JoinSnapshots
{
    /// <summary>The age up to which a snapshot serves the next client too.</summary>
    private static readonly SimDuration SharedAge = SimDuration.FromSeconds(1);

    private readonly ClientRoster roster;
    private readonly AuthoritativeLog log;
    private readonly SharedWorld world;
    private readonly JoinLimits limits;
    private readonly SimDuration timeout;
    private readonly byte[] sceneSnapshot;
    private JoinSnapshot? newest;

    /// <param name="roster">The clients, which download snapshots.</param>
    /// <param name="log">The log, which continues where a snapshot ends.</param>
    /// <param name="world">The world to snapshot.</param>
    /// <param name="limits">The memory limits for snapshots.</param>
    /// <param name="timeout">The age above which a snapshot is not given to a new client.</param>
    /// <exception cref="SceneException">The scene is too large to be shared.</exception>
    internal JoinSnapshots(ClientRoster roster, AuthoritativeLog log, SharedWorld world, JoinLimits limits, SimDuration timeout)
    {
        this.roster = roster;
        this.log = log;
        this.world = world;
        this.limits = limits;
        this.timeout = timeout;
        sceneSnapshot = SessionSnapshot.Encode(world.Scene!, null);
    }

    /// <summary>The last log entry that a client with the newest snapshot does not need.</summary>
    internal uint NeededAfter => newest?.LogIndex ?? uint.MaxValue;

    /// <summary>The size in bytes of the snapshots that these clients download; a shared one counts once.</summary>
    internal static long BytesOf(IEnumerable<Client> some) =>
        some.Select(j => j.Snapshot).OfType<JoinSnapshot>().Distinct().Sum(snapshot => (long)snapshot.Bytes.Length);

    /// <summary>The memory that snapshots of that size may take, in bytes; see <see cref="JoinLimits.SnapshotBytes"/>.</summary>
    internal long RoomForSnapshotsLike(JoinSnapshot snapshot) =>
        Math.Max(limits.SnapshotBytes, (long)snapshot.Bytes.Length * limits.MinSnapshots);

    /// <summary>
    /// Returns the snapshot for a client that joins now: the scene, and the committed state once that lies past the start. Null while the
    /// world is behind what was already committed.
    /// </summary>
    /// <exception cref="SceneException">The world is too large to be copied.</exception>
    internal JoinSnapshot? For(SimTime now)
    {
        Forget(now);
        if (newest is null || !Serves(newest, now))
        {
            // One instant for both, so that the log continues where the state ends, however the clock advances meanwhile.
            log.Settle();
            SimTime settledTo = log.SettledTo;
            Simulation? simulation = world.Live?.Simulation;
            bool hasState = simulation is not null && settledTo > simulation.Start;
            if (hasState && (settledTo > simulation!.SimulatedTo || settledTo < simulation.HistoryEdge))
            {
                return null;
            }

            byte[] bytes = hasState ? SessionSnapshot.Encode(world.Scene!, simulation!.Snapshot(settledTo)) : sceneSnapshot;
            newest = new JoinSnapshot(bytes, log.Lines.Settled, now);
        }

        return newest;
    }

    /// <summary>Drops snapshots that are no longer needed.</summary>
    internal void Forget(SimTime now)
    {
        foreach (Client client in roster.All)
        {
            client.Snapshot = client.IsReady ? null : client.Snapshot;
        }

        bool isFetched = roster.All.Exists(j => j.Snapshot == newest);
        newest = newest is not null && now - newest.Made <= (isFetched ? timeout : SharedAge) ? newest : null;
    }

    /// <summary>
    /// Whether a new client can be given this snapshot. It is shared for a second, or up to the timeout while there is no memory for
    /// another.
    /// </summary>
    /// <remarks>
    /// So clients are not dropped each time that another joins, and none gets an older world because others keep downloading it.
    /// </remarks>
    private bool Serves(JoinSnapshot snapshot, SimTime now) =>
        now - snapshot.Made <= SharedAge || snapshot.Bytes.Length + BytesOf(roster.All) > RoomForSnapshotsLike(snapshot);
}
