using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Carriers;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// Limits the number of joining clients and the size of their snapshots. A newcomer displaces the oldest joining client of the machine with
/// the most.
/// </summary>
internal sealed class WaitingRoom(ClientRoster roster, JoinSnapshots snapshots, JoinLimits limits)
{
    /// <summary>
    /// Drops the oldest joining clients of the machine with the most, while there are too many or their snapshots take too much memory.
    /// </summary>
    /// <param name="from">The address of the newcomer.</param>
    /// <param name="made">The snapshot that the newcomer will request. Others that download the same one take no extra memory.</param>
    internal void MakeRoom(PeerAddress from, JoinSnapshot made)
    {
        List<Client> coming = roster.All.FindAll(j => j.Peer == 0); // the oldest first
        List<Client> ofOne = coming.FindAll(j => j.Link.Other.IsSameMachine(from));
        if (ofOne.Count >= limits.ComingOfOne)
        {
            LeaveOut(ofOne[0]);
        }

        while (coming.Count >= limits.Coming)
        {
            LeaveOut(OldestOf(coming));
        }

        while (coming.FindAll(j => j.Snapshot != made) is { Count: > 0 } others
            && made.Bytes.Length + JoinSnapshots.BytesOf(others) > snapshots.RoomForSnapshotsLike(made))
        {
            LeaveOut(OldestOf(others));
        }

        void LeaveOut(Client client)
        {
            roster.Drop(client);
            coming.Remove(client);
        }

        Client OldestOf(List<Client> some) => some.GroupBy(j => j.Link.Other.Machine)
            .OrderByDescending(machine => machine.Count() + (machine.Key == from.Machine ? 1 : 0)).First().First();
    }
}
