using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Carriers;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// Keeps those who are coming in to a number and to a size of their copies: who comes makes the oldest of the machine with the most go.
/// </summary>
internal sealed class WaitingRoom(ClientRoster roster, JoinCopies copies, DoorLimits door)
{
    /// <summary>
    /// Lets go of the oldest of those that are coming in, of the machine with the most: while there are too many, or their copies take too
    /// much memory.
    /// </summary>
    /// <param name="from">Who comes.</param>
    /// <param name="made">What it is to request. Others who fetch the same copy take no more memory for it.</param>
    internal void MakeRoom(PeerAddress from, JoinCopy made)
    {
        List<Client> coming = roster.All.FindAll(j => j.Peer == 0); // the oldest first
        List<Client> ofOne = coming.FindAll(j => j.Link.Other.IsSameMachine(from));
        if (ofOne.Count >= door.ComingOfOne)
        {
            LeaveOut(ofOne[0]);
        }

        while (coming.Count >= door.Coming)
        {
            LeaveOut(OldestOf(coming));
        }

        while (coming.FindAll(j => j.Copy != made) is { Count: > 0 } others
            && made.Bytes.Length + JoinCopies.BytesOf(others) > copies.RoomForCopiesLike(made))
        {
            LeaveOut(OldestOf(others));
        }

        void LeaveOut(Client client)
        {
            roster.All.Remove(client);
            coming.Remove(client);
        }

        Client OldestOf(List<Client> some) => some.GroupBy(j => j.Link.Other.Machine)
            .OrderByDescending(machine => machine.Count() + (machine.Key == from.Machine ? 1 : 0)).First().First();
    }
}
