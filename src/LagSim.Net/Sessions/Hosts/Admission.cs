using System;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Answers requests to join: welcomes a client with a link and a snapshot to download, or refuses it with the reason.</summary>
internal sealed class Admission(
    ulong sessionId, SimDuration history, JoinCookies cookies, AddressChallenge challenge, JoinRules rules,
    PlayerPlaces places, ClientRoster roster, WaitingRoom room, JoinSnapshots snapshots, ClientTimeouts timeouts,
    LinkFactory links, DatagramSender sender, SessionCounters counters, IClock clock)
{
    private ulong joins;

    internal void OnJoin(in JoinDatagram join, PeerAddress from)
    {
        ulong nonce = join.Nonce;
        Client? known = roster.All.Find(j => j.Link.Other == from && j.Claim.Nonce == nonce);
        if (!challenge.IsMet(from, nonce, join.Cookie))
        {
            counters.DatagramsIgnored++; // no answer: the address may be forged
            return;
        }

        known ??= Admit(join, from, clock.Now);
        if (known?.Snapshot is JoinSnapshot snapshot)
        {
            Span<byte> bytes = stackalloc byte[WireFormat.WelcomeBytes];
            WelcomeDatagram welcome = new(nonce, known.Link.SessionId, history, snapshot.Bytes.Length, snapshot.Hash, snapshot.LogIndex);
            sender.Send(bytes.Slice(0, welcome.Encode(bytes)), known.Link);
        }
    }

    /// <summary>Sends a client the reason why it is not let in.</summary>
    internal void Refuse(ulong nonce, RefusalReason reason, PeerAddress to)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.RefusalBytes];
        sender.Send(bytes.Slice(0, new RefusalDatagram(nonce, reason).Encode(bytes)), to);
    }

    /// <summary>Admits a client that has proved its address; null if it may not join and was refused, or if it has to ask again.</summary>
    private Client? Admit(in JoinDatagram join, PeerAddress from, SimTime now)
    {
        byte keyed = rules.NumberByKey(join);
        PlayerPlaces.Place? claimed = places.Claimed(join, keyed);
        if (rules.WhyNot(join, keyed, claimed, from, now) is RefusalReason reason)
        {
            counters.DatagramsIgnored++;
            Refuse(join.Nonce, reason, from);
            return null;
        }

        JoinSnapshot? made;
        try
        {
            made = snapshots.For(now);
        }
        catch (SceneException)
        {
            Refuse(join.Nonce, RefusalReason.TooLarge, from);
            return null;
        }

        if (made is null)
        {
            return null; // the world is being re-simulated; the client asks again
        }

        // The same address, proved by the cookie, under a new nonce: the client restarted. One that is in stays until the new one gets its
        // number: if it had only fallen silent, it may be heard again first, and goes on.
        roster.All.RemoveAll(j => j.Peer == 0 && j.Link.Other == from);
        room.MakeRoom(from, made);
        UpdateLink link = links.To(from, cookies.SessionId(sessionId, joins++), made.LogIndex, now);
        Client admitted = new(new JoinClaim(join, keyed, claimed, now + timeouts.TimeoutWithCopy(made)), link, made);
        roster.All.Add(admitted);
        return admitted;
    }
}
