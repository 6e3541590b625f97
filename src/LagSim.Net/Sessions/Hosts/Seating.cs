using System;
using System.Linq;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Gives those who have a copy and a clock their numbers: the one that a key or a pass shows, or one that is free.</summary>
/// <param name="roster">The clients.</param>
/// <param name="places">The numbers.</param>
/// <param name="budget">Where a number that gets another holder begins another account.</param>
/// <param name="sender">What they are told through.</param>
/// <param name="mostOfOneMachine">How many may be in from one machine.</param>
internal sealed class Seating(ClientRoster roster, PlayerPlaces places, WorkBudget budget, DatagramSender sender, int mostOfOneMachine)
{
    /// <summary>Raised for each client that got its number, with its link.</summary>
    internal event Action<LinkTraffic>? Came;

    /// <summary>Why somebody can get no number now; null if it can.</summary>
    /// <param name="keyed">The number that its key gives; 0 for none.</param>
    /// <param name="claimed">The place of the player that it shows it was; null for none.</param>
    /// <param name="from">Where it is.</param>
    /// <param name="now">By the own clock.</param>
    internal RefusalReason? WhyNone(byte keyed, PlayerPlaces.Place? claimed, PeerAddress from, SimTime now)
    {
        if (keyed > 0)
        {
            return null; // it has one
        }

        // Who shows that it is a player whom nobody else is has a number, but counts: else a machine could collect passes, and then come
        // with all of them.
        byte own = claimed?.Number ?? 0;
        int others = roster.All.Count(j => j.Peer > 0 && j.Peer != own && j.Link.Other != from && j.Link.Other.IsSameMachine(from));
        return others >= mostOfOneMachine ? RefusalReason.TooManyFromOneAddress
            : own == 0 && places.Free(now, 0, from.Machine) == 0 && !roster.All.Exists(j => j.Peer > 0 && j.Link.Other == from)
                ? RefusalReason.Full
            : null;
    }

    /// <summary>Gives one that has its copy and its clock a number, and tells it.</summary>
    /// <returns>Why there is none, and it is forgotten; null if it has one.</returns>
    internal RefusalReason? TrySeat(Client client, SimTime now)
    {
        PeerAddress address = client.Link.Other;
        JoinClaim claim = client.Claim;
        PlayerPlaces.Place? claimed = claim.Former;
        PlayerPlaces.Place? place = claim.Keyed > 0 ? places[claim.Keyed] : claimed;
        if (roster.All.Find(j => j.Peer > 0 && j.Peer != place?.Number && j.Link.Other == address) is Client gone)
        {
            roster.Disconnect(gone, LeaveReason.TimedOut); // started again, or gone, and another got its port: it may still come back
        }

        if (WhyNone(claim.Keyed, claimed, address, now) is RefusalReason reason)
        {
            roster.All.Remove(client);
            return reason;
        }

        place ??= places[places.Free(now, claim.Wanted, address.Machine)];
        if (roster.Seated(place.Number) is Client before)
        {
            roster.Dismiss(before, LeaveReason.Replaced); // its player came in from elsewhere
        }

        client.Sit(place);
        if (claimed != place)
        {
            budget.BeginAccount(place.Number);
        }

        place.Take(isSamePlayer: claimed == place, address.Machine);
        Tell(client);
        Came?.Invoke(client.Link.Traffic);
        return null;
    }

    /// <summary>Tells a client the number that it has.</summary>
    internal void Tell(Client client)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.SeatBytes];
        SeatDatagram seat = new(client.Link.SessionId, client.Peer, client.FirstSequence, places[client.Peer].Pass!.Value);
        sender.Send(bytes.Slice(0, seat.Encode(bytes)), client.Link);
    }
}
