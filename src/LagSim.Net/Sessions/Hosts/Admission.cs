using System;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Answers requests to join: welcomes a client with a link and a snapshot to download, or refuses it with the reason.</summary>
internal sealed class Admission(
    ulong sessionId, HostOptions options, JoinCookies cookies, AddressChallenge challenge, JoinRules rules,
    PlayerPlaces places, ClientRoster roster, WaitingRoom room, JoinSnapshots snapshots, ClientTimeouts timeouts,
    LinkFactory links, DatagramSender sender, SessionCounters counters, IClock clock)
{
    private readonly IHostProtection? protection = options.Protection;
    private readonly MachineRates handshakes = new(options.JoinLimits.HandshakesPerSecond, options.JoinLimits.HandshakeBurst);
    private ulong joins;

    /// <summary>Answers a join in clear text.</summary>
    internal void OnJoin(in JoinDatagram join, PeerAddress from)
    {
        if (IsAnswered(join.Nonce, join.Cookie, from))
        {
            return;
        }

        using JoinReply reply = new(join.Nonce, from, null, null, sender);
        if (protection is null)
        {
            Answer(join, from, reply);
        }
        else
        {
            counters.DatagramsIgnored++;
            reply.Refuse(RefusalReason.ProtectedOnly);
        }
    }

    /// <summary>Answers an encrypted join.</summary>
    internal void OnJoin(in SecureJoinDatagram join, PeerAddress from)
    {
        if (protection is null)
        {
            counters.DatagramsIgnored++; // the client saw no identity of this host, so it is not one of LagSim's
        }
        else if (!IsAnswered(join.Nonce, join.Cookie, from))
        {
            Read(join, from, protection);
        }
    }

    /// <summary>Sends a client that speaks another version of the protocol the reason why it is not let in.</summary>
    internal void RefuseVersion(ulong nonce, PeerAddress to)
    {
        using JoinReply reply = new(nonce, to, null, null, sender);
        reply.Refuse(RefusalReason.VersionDiffers);
    }

    /// <summary>
    /// Whether nothing more is to be done about a join: its address is not proved, or it was answered before, and is again.
    /// </summary>
    private bool IsAnswered(ulong nonce, Token128 cookie, PeerAddress from)
    {
        Client? known = roster.All.Find(j => j.Link.Other == from && j.Claim.Nonce == nonce && j.Claim.Cookie == cookie);
        if (!challenge.IsMet(from, nonce, cookie))
        {
            counters.DatagramsIgnored++; // no answer: the address may be forged
            return true;
        }

        if (known?.Snapshot is not null)
        {
            SendWelcome(known);
        }

        return known is not null;
    }

    private void Read(in SecureJoinDatagram join, PeerAddress from, IHostProtection by)
    {
        if (!handshakes.TrySpend(from, clock.Now))
        {
            counters.DatagramsIgnored++; // it asks again
            return;
        }

        Span<byte> claims = stackalloc byte[WireFormat.JoinClaimBytes];
        IHostHandshake? handshake = by.TryRead(join.Prologue, join.Message, claims);
        if (handshake is null)
        {
            counters.DatagramsForged++;
            return;
        }

        using JoinReply reply = new(join.Nonce, from, by, handshake, sender);
        if (JoinDatagram.TryDecodeClaims(claims, join.Nonce, join.Cookie, out JoinDatagram claimed))
        {
            Answer(claimed, from, reply);
        }
        else
        {
            counters.DatagramsMalformed++;
        }
    }

    private void SendWelcome(Client client)
    {
        sender.Send(client.Welcome, client.Link.Other);
        client.Link.CountSent(client.Welcome.Length);
    }

    private void Answer(in JoinDatagram join, PeerAddress from, JoinReply reply)
    {
        if (Admit(join, from, reply, clock.Now) is Client admitted)
        {
            SendWelcome(admitted);
        }
    }

    /// <summary>Admits a client that has proved its address; null if it may not join and was refused, or if it has to ask again.</summary>
    private Client? Admit(in JoinDatagram join, PeerAddress from, JoinReply reply, SimTime now)
    {
        byte keyed = rules.NumberByKey(join);
        PlayerPlaces.Place? claimed = places.Claimed(join, keyed);
        if (rules.WhyNot(join, keyed, claimed, from, now) is RefusalReason reason)
        {
            counters.DatagramsIgnored++;
            reply.Refuse(reason);
            return null;
        }

        JoinSnapshot? made;
        try
        {
            made = snapshots.For(now);
        }
        catch (SceneException)
        {
            reply.Refuse(RefusalReason.TooLarge);
            return null;
        }

        if (made is null)
        {
            return null; // the world is being re-simulated; the client asks again
        }

        if (protection is null)
        {
            // The same address, proved by the cookie, under a new nonce: the client restarted. One that is in stays until the new one gets
            // its number: if it had only fallen silent, it may be heard again first, and goes on. A protected link has keys to tell it by.
            roster.DropAll(j => j.Peer == 0 && j.Link.Other == from);
        }

        room.MakeRoom(from, made);
        ulong session = cookies.SessionId(sessionId, joins++);
        WelcomeDatagram terms = new(join.Nonce, session, options.Window.History, made.Bytes.Length, made.Hash, made.LogIndex);
        byte[] welcome = reply.Welcome(terms, rules.KeyOf(keyed), out LinkSeal? seal);
        UpdateLink link = links.To(from, session, made.LogIndex, now, seal);
        Client admitted = new(new JoinClaim(join, keyed, claimed, now + timeouts.TimeoutWithCopy(made)), link, made, welcome);
        roster.All.Add(admitted);
        return admitted;
    }
}
