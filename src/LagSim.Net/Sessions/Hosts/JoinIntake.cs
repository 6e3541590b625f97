using System;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// Takes joins whose cookie is good: repeats the answer to one that comes again, and has a new one decided on. In a protected session it
/// reads the handshake first, a few a second from each machine and not too many from all.
/// </summary>
internal sealed class JoinIntake(
    HostOptions options, AddressChallenge challenge, ClientRoster roster, Admission admission, DatagramSender sender,
    SessionCounters counters, IClock clock)
{
    private readonly IHostProtection? protection = options.Protection;
    private readonly MachineRates handshakesOfOne = new(options.JoinLimits.HandshakesPerSecond, options.JoinLimits.HandshakeBurst);
    private readonly RateLimit handshakesOfAll = new(
        options.JoinLimits.HandshakesPerSecondOfAll, options.JoinLimits.HandshakesPerSecondOfAll, clock.Now);

    /// <summary>Takes a join in clear text.</summary>
    internal void OnJoin(in JoinDatagram join, PeerAddress from)
    {
        if (!IsNew(join.Nonce, join.Cookie, default, from))
        {
            return;
        }

        using JoinReply reply = new(join.Nonce, from, null, null, sender);
        if (protection is null)
        {
            Decide(join, default, from, reply);
        }
        else
        {
            counters.DatagramsIgnored++;
            reply.Refuse(RefusalReason.ProtectedOnly);
        }
    }

    /// <summary>Takes an encrypted join.</summary>
    internal void OnJoin(in SecureJoinDatagram join, PeerAddress from)
    {
        if (protection is null)
        {
            counters.DatagramsIgnored++; // the client saw no identity of this host, so it is not one of LagSim's
        }
        else if (IsNew(join.Nonce, join.Cookie, join.Handshake, from))
        {
            Read(join, from, protection);
        }
    }

    /// <summary>Tells a client that it speaks another version of the protocol.</summary>
    internal void RefuseVersion(ulong nonce, PeerAddress to)
    {
        using JoinReply reply = new(nonce, to, null, null, sender);
        reply.Refuse(RefusalReason.VersionDiffers);
    }

    /// <summary>Whether a join is to be decided on. If not, its address is not proved, or it was answered before and is again.</summary>
    private bool IsNew(ulong nonce, Token128 cookie, Token128 handshake, PeerAddress from)
    {
        if (!challenge.IsMet(from, nonce, cookie))
        {
            counters.DatagramsIgnored++; // no answer: the address may be forged
            return false;
        }

        Client? known = roster.All.Find(
            j => j.Link.Other == from && j.Claim.Nonce == nonce && j.Claim.Cookie == cookie && j.Claim.Handshake == handshake);
        if (known?.Snapshot is not null)
        {
            SendWelcome(known);
        }

        return known is null;
    }

    private void Read(in SecureJoinDatagram join, PeerAddress from, IHostProtection by)
    {
        if (!MayRead(from, clock.Now))
        {
            counters.DatagramsIgnored++; // it asks again
            return;
        }

        Span<byte> claims = stackalloc byte[join.Message.Length - IHostProtection.HandshakeOverhead];
        IHostHandshake? handshake = by.TryRead(JoinCookies.KeyOf(join.Cookie), join.Prologue, join.Message, claims);
        if (handshake is null)
        {
            counters.DatagramsForged++;
            return;
        }

        using JoinReply reply = new(join.Nonce, from, by, handshake, sender) { Handshake = join.Handshake };
        bool isWellFormed = JoinDatagram.TryDecodeClaims(
            claims, join.Nonce, join.Cookie, out JoinDatagram claimed, out int length);
        if (counters.IsWellFormed(isWellFormed))
        {
            Decide(claimed, claims.Slice(length), from, reply);
        }
    }

    /// <summary>Whether a handshake may be read, which is counted for its machine and for all.</summary>
    private bool MayRead(PeerAddress from, SimTime now) =>
        handshakesOfAll.Left(now) >= 1 && handshakesOfOne.TrySpend(from, now) && handshakesOfAll.TrySpend(now);

    private void Decide(in JoinDatagram join, ReadOnlySpan<byte> token, PeerAddress from, JoinReply reply)
    {
        if (admission.Admit(join, token, from, reply, clock.Now) is Client admitted)
        {
            SendWelcome(admitted);
        }
    }

    private void SendWelcome(Client client)
    {
        sender.Send(client.Welcome, client.Link.Other);
        client.Link.CountSent(client.Welcome.Length);
    }
}
