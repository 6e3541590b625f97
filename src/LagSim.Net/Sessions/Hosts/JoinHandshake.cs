using System;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// The host's dealings with clients that are not in yet, write from another address, or want fresh keys: challenge, join, snapshot, number.
/// </summary>
internal sealed class JoinHandshake
{
    private readonly ClientRoster roster;
    private readonly JoinCookies cookies = new();
    private readonly AddressChallenge challenge;
    private readonly JoinIntake intake;
    private readonly StrayReply stray;
    private readonly SnapshotServer server;
    private readonly DatagramSender sender;
    private readonly SessionCounters counters;
    private readonly IClock clock;

    /// <param name="parts">The parts of every session.</param>
    /// <param name="options">How the host takes part.</param>
    /// <param name="sessionId">The number from which the session ids of links are derived.</param>
    /// <param name="roster">The clients.</param>
    /// <param name="places">The numbers.</param>
    /// <param name="log">The log, which continues where a snapshot ends.</param>
    /// <param name="budget">Where a client with a new number gets an account.</param>
    /// <param name="timeouts">How long a client may take to join.</param>
    /// <param name="watermark">Before it a client that comes in stamps nothing.</param>
    /// <exception cref="SceneException">The scene is too large to be shared.</exception>
    internal JoinHandshake(
        SessionParts parts, HostOptions options, ulong sessionId, ClientRoster roster, PlayerPlaces places, AuthoritativeLog log,
        WorkBudget budget, ClientTimeouts timeouts, Watermark watermark)
    {
        this.roster = roster;
        sender = parts.Sender;
        counters = parts.Counters;
        clock = parts.Clock;
        challenge = new AddressChallenge(options.Protection, cookies, parts.Sender, clock);
        BanList = new BanList(options.JoinLimits);
        Seating = new Seating(roster, places, budget, parts.Sender, options.Protection, options.MaxClientsPerAddress, watermark);
        Snapshots = new JoinSnapshots(roster, log, parts.World, options.JoinLimits, options.Timeout);
        MachineRates chunks = new(options.JoinLimits.ChunksPerSecond, options.JoinLimits.ChunkBurst);
        server = new SnapshotServer(roster, chunks, challenge, parts.Sender, counters, clock);
        WrongKeys = new WrongKeys(options.JoinLimits, clock.Now);
        JoinRules rules = new(parts.World.Scene!.HashButSeed, BanList, Seating);
        WaitingRoom room = new(roster, Snapshots, options.JoinLimits);
        Admission admission = new(
            sessionId, options, cookies, new JoinIdentification(options, places), rules, roster, room, Snapshots, timeouts, parts.Links,
            counters, WrongKeys);
        intake = new JoinIntake(options, challenge, roster, admission, sender, counters, clock);
        Keys = new KeyAnswers(roster, sender, counters, clock);
        stray = new StrayReply(places, parts.Status, options.Protection, sender, parts.Clock);
    }

    /// <summary>Who is let in no more.</summary>
    internal BanList BanList { get; }

    /// <summary>The wrong connect keys that came.</summary>
    internal WrongKeys WrongKeys { get; }

    /// <summary>The snapshots for joining clients.</summary>
    internal JoinSnapshots Snapshots { get; }

    /// <summary>Agrees with clients on fresh keys for their links.</summary>
    internal KeyAnswers Keys { get; }

    /// <summary>Gives joining clients their numbers.</summary>
    internal Seating Seating { get; }

    /// <summary>Makes a sender that wants to join prove its address before it is answered.</summary>
    internal void Challenge(in ConnectRequestDatagram request, PeerAddress from) => challenge.Send(request.Nonce, request.Wanted, from);

    /// <summary>Makes a client prove the new address from which it wrote.</summary>
    internal void Challenge(UpdateLink link, PeerAddress from) => challenge.Send(link, from);

    internal void OnJoin(in JoinDatagram join, PeerAddress from) => intake.OnJoin(join, from);

    internal void OnJoin(in SecureJoinDatagram join, PeerAddress from) => intake.OnJoin(join, from);

    internal void OnSnapshotRequest(in SnapshotRequestDatagram request, PeerAddress from) => server.OnSnapshotRequest(request, from);

    /// <summary>Tells a sender that the host has no link with its session id.</summary>
    internal void OnStray(ulong sessionId, PeerAddress from) => stray.Send(from, sessionId);

    /// <summary>Handles a client that proves a new address.</summary>
    internal void OnMove(in MoveDatagram move, PeerAddress from)
    {
        if (roster.Of(move.SessionId) is Client client && (client.Peer == move.Peer || move.Peer == 0)
            && challenge.IsMet(from, move.SessionId, move.Cookie))
        {
            SimTime now = clock.Now;
            client.Link.Other = from;
            client.Link.CountReceived(WireFormat.MoveBytes);
            client.Link.NoteHeard(now);
            client.Link.Flush(now);
        }
        else
        {
            counters.DatagramsIgnored++;
        }
    }

    /// <summary>Handles a client that speaks another version of the protocol.</summary>
    internal void OnOtherVersion(ulong nonce, PeerAddress from) => intake.RefuseVersion(nonce, from);

    /// <summary>Gives a number to a client that has its snapshot and its clock; if there is none, refuses it and returns false.</summary>
    internal bool TrySeat(Client client, SimTime now)
    {
        bool isOut = BanList.IsShutOut(client.Claim.Identity.Known, client.Link.Other.Machine, now); // since it was admitted
        if ((isOut ? RefusalReason.Banned : Seating.TrySeat(client, now)) is RefusalReason reason)
        {
            Span<byte> bytes = stackalloc byte[WireFormat.RefusalBytes];
            sender.Send(bytes.Slice(0, new RefusalDatagram(client.Link.SessionId, reason).Encode(bytes)), client.Link);
            roster.Drop(client);
            return false;
        }

        return true;
    }
}
