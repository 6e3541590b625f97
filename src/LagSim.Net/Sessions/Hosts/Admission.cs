using System;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// Answers those who ask to be let in: welcomes them, each with a link of its own and a copy to request, or tells why not.
/// </summary>
internal sealed class Admission(
    ulong sessionId, SimDuration history, JoinCookies cookies, AddressChallenge challenge, JoinRules rules,
    PlayerPlaces places, ClientRoster roster, WaitingRoom room, JoinCopies copies, ClientTimeouts timeouts,
    LinkFactory links, DatagramSender sender, SessionCounters counters, IClock clock)
{
    private ulong joins;

    internal void OnJoin(in JoinDatagram join, PeerAddress from)
    {
        ulong nonce = join.Nonce;
        Client? known = roster.All.Find(j => j.Link.Other == from && j.Claim.Nonce == nonce);
        if (!challenge.IsMet(from, nonce, join.Cookie))
        {
            counters.DatagramsIgnored++; // whoever it is gets no answer: its address may not be its own
            return;
        }

        known ??= Admit(join, from, clock.Now);
        if (known?.Copy is JoinCopy copy)
        {
            Span<byte> bytes = stackalloc byte[WireFormat.WelcomeBytes];
            WelcomeDatagram welcome = new(nonce, known.Link.SessionId, history, copy.Bytes.Length, copy.Hash, copy.LogIndex);
            sender.Send(bytes.Slice(0, welcome.Encode(bytes)), known.Link);
        }
    }

    /// <summary>Tells somebody why it is not let in.</summary>
    internal void Refuse(ulong nonce, RefusalReason reason, PeerAddress to)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.RefusalBytes];
        sender.Send(bytes.Slice(0, new RefusalDatagram(nonce, reason).Encode(bytes)), to);
    }

    /// <summary>One who has shown where it is, as one that is coming in; null if it may not, and was told so, or is to ask again.</summary>
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

        JoinCopy? made;
        try
        {
            made = copies.For(now);
        }
        catch (SceneException)
        {
            Refuse(join.Nonce, RefusalReason.TooLarge, from);
            return null;
        }

        if (made is null)
        {
            return null; // the world is being simulated again; the client asks once more
        }

        // The same address, shown by the cookie, under a new nonce: it started again. One that is in stays until the new one gets its
        // number: if it had only
        // fallen silent, it may be heard again first, and goes on.
        roster.All.RemoveAll(j => j.Peer == 0 && j.Link.Other == from);
        room.MakeRoom(from, made);
        UpdateLink link = links.To(from, cookies.SessionId(sessionId, joins++), made.LogIndex, now);
        Client admitted = new(new JoinClaim(join, keyed, claimed, now + timeouts.TimeoutWithCopy(made)), link, made);
        roster.All.Add(admitted);
        return admitted;
    }
}
