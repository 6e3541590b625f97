using System;
using System.Linq;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Gives clients that have a snapshot and a clock their numbers: by key, by pass, or a free one.</summary>
/// <param name="roster">The clients.</param>
/// <param name="places">The numbers.</param>
/// <param name="budget">Where a number with a new holder gets another account.</param>
/// <param name="sender">Sends them their numbers.</param>
/// <param name="protection">Takes each connect token once; null in a session without protection.</param>
/// <param name="maxOfOneMachine">The most clients that may be in from one machine.</param>
/// <param name="watermark">Before it a client that comes in stamps nothing.</param>
internal sealed class Seating(
    ClientRoster roster, PlayerPlaces places, WorkBudget budget, DatagramSender sender, IHostProtection? protection, int maxOfOneMachine,
    Watermark watermark)
{
    /// <summary>Raised for each client that got its number, with its link.</summary>
    internal event Action<LinkTraffic>? Came;

    /// <summary>Returns why a client can get no number now; null if it can.</summary>
    /// <param name="who">Who it proved to be.</param>
    /// <param name="from">Its address.</param>
    /// <param name="now">The time by the local clock.</param>
    /// <param name="isSpectator">Whether it wants to be a spectator.</param>
    internal RefusalReason? WhyNone(JoinIdentity who, PeerAddress from, SimTime now, bool isSpectator)
    {
        if (protection is { RequiresToken: true } && !who.IsByToken && who.Claimed is null)
        {
            return RefusalReason.TokenMissing; // also for a pass that has become void since it was shown
        }

        if (who.Keyed > 0)
        {
            return who.Admission is not null && places.IsOfAnother(who.Admission) ? RefusalReason.Full : null; // it has one
        }

        // A client that proves to be an absent player has a number, but counts: otherwise a machine could collect passes, and then join
        // with all of them. Players whom a backend admits have one place each, wherever they are.
        byte own = who.Claimed?.Number ?? 0;
        int others = roster.All.Count(j => PlayerPlaces.IsFor(j.Peer, isSpectator) && j.Peer != own
            && !IsRestarted(j, from) && j.Link.Other.IsSameMachine(from));
        return others >= maxOfOneMachine && who.Admission is null ? RefusalReason.TooManyFromOneAddress
            : own == 0 && places.Free(now, 0, from.Machine, isSpectator) == 0
                && !roster.All.Exists(j => PlayerPlaces.IsFor(j.Peer, isSpectator) && IsRestarted(j, from))
                ? RefusalReason.Full
            : null;
    }

    /// <summary>Gives a number to a client that has its snapshot and its clock, and sends it.</summary>
    /// <returns>Why there is none; null if it has one.</returns>
    internal RefusalReason? TrySeat(Client client, SimTime now)
    {
        PeerAddress address = client.Link.Other;
        JoinClaim claim = client.Claim;
        JoinIdentity who = claim.Identity;
        if (who is { IsByToken: true, Admission: PlayerAdmission admission })
        {
            // It may have got a place since, by another of its tokens.
            who = who with { Claimed = places.OfPlayer(admission.PlayerId, claim.IsSpectator) };
        }

        PlayerPlaces.Place? claimed = who.Claimed;
        PlayerPlaces.Place? place = who.Keyed > 0 ? places[who.Keyed] : claimed;
        if (roster.All.Find(j => j.Peer > 0 && j.Peer != place?.Number && IsRestarted(j, address)) is Client gone)
        {
            roster.Disconnect(gone, LeaveReason.TimedOut); // restarted, or gone and its port reused: it may still come back
        }

        if (WhyNone(who, address, now, claim.IsSpectator) is RefusalReason reason)
        {
            return reason;
        }

        if (who.IsByToken && protection?.TryUseToken(claim.Token) == false)
        {
            return RefusalReason.TokenUsed;
        }

        place ??= places[places.Free(now, claim.Wanted, address.Machine, claim.IsSpectator)];
        if (who.Admission is PlayerAdmission player)
        {
            ReleaseOthers(player, place);
        }

        MakeRoom(place);
        places.CarryRate(place, address.Machine, now);
        place.Earliest = watermark.Now;
        client.Sit(place);
        if (claimed != place && !claim.IsSpectator)
        {
            budget.BeginAccount(place.Number);
        }

        // A token gives another pass.
        uint visit = places.NextVisit();
        place.Take(isSamePlayer: claimed == place && !who.IsByToken, address.Machine, who.Admission, visit, places.Ids.Of(who, visit));
        Tell(client);
        Came?.Invoke(client.Link.Traffic);
        return null;
    }

    /// <summary>
    /// Whether a client that is in has restarted, if one joins from its address. Only without protection: somebody on the path can join
    /// from anyone's address, and a protected link is known by its keys.
    /// </summary>
    private static bool IsRestarted(Client client, PeerAddress from) => client.Link.Seal is null && client.Link.Other == from;

    /// <summary>Gives up all places of a player but the one that it gets: it has one.</summary>
    private void ReleaseOthers(PlayerAdmission admission, PlayerPlaces.Place own)
    {
        while (places.OfPlayer(admission.PlayerId, except: own) is PlayerPlaces.Place other)
        {
            MakeRoom(other);
            other.Release();
        }
    }

    /// <summary>Lets the client go that has a place: its player joined from elsewhere.</summary>
    private void MakeRoom(PlayerPlaces.Place place)
    {
        if (roster.Seated(place.Number) is Client before)
        {
            roster.Dismiss(before, LeaveReason.Replaced);
        }
    }

    /// <summary>Sends a client its number.</summary>
    internal void Tell(Client client)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.SeatBytes];
        PlayerPlaces.Place place = places[client.Peer];
        SeatDatagram seat = new(client.Link.SessionId, client.Peer, client.FirstSequence, place.Pass!.Value);
        seat = watermark.Pace > SimDuration.Zero ? seat.WithPromises(place.Earliest, watermark.Pace, watermark.PacedFor) : seat;
        sender.Send(bytes.Slice(0, seat.Encode(bytes)), client.Link);
    }
}
