using System;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <content>Getting in: knock, cookie, join, and fetching the copy of scene and world.</content>
public sealed partial class JoinerSession
{
    /// <summary>A cookie that was of no use for so long is stale: another one is asked for.</summary>
    private static readonly SimDuration CookieAge = SimDuration.FromSeconds(20);

    /// <summary>The least time after which pieces that did not come are asked for again.</summary>
    private static readonly SimDuration LeastPatience = SimDuration.FromMilliseconds(50);

    /// <summary>The longest round trip that is assumed before one is measured.</summary>
    private static readonly SimDuration MostGuessed = SimDuration.FromMilliseconds(400);

    private Token128? cookie;
    private SimTime challenged;
    private SimDuration joinTook; // a round trip at least, and more where something was lost
    private CopyFetch? fetch;
    private ulong copyHash;
    private WorldCopy? copy;

    private protected override void OnOtherVersion(ReadOnlySpan<byte> datagram, Carriers.PeerAddress sender)
    {
        if (sender == host && RefusalDatagram.TryReadAnyVersion(datagram, out ulong itsNonce, out byte version))
        {
            OnRefusal(itsNonce, $"it speaks version {version} of the protocol, this peer {WireFormat.Version}.");
        }
    }

    private static string Sentence(RefusalReason reason) => reason switch
    {
        RefusalReason.VersionDiffers => "it speaks another version of the protocol.",
        RefusalReason.SceneDiffers => "its scene is another one.",
        RefusalReason.WrongKey => "the key is wrong.",
        RefusalReason.Full => "the session is full.",
        RefusalReason.TooLarge => "its world is too large to be copied.",
        _ => $"reason {(int)reason}.",
    };

    private void AskToJoin(SimTime now)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.JoinBytes];
        if (cookie is Token128 given && now - challenged <= CookieAge)
        {
            Token128 proof = JoinCookies.Prove(Options.ConnectKey, nonce, given);
            Send(bytes.Slice(0, new JoinDatagram(nonce, given, proof, Scene?.Hash ?? 0).Encode(bytes)), host);
        }
        else
        {
            Send(bytes.Slice(0, new KnockDatagram(nonce).Encode(bytes)), host);
        }
    }

    private void OnChallenge(in ChallengeDatagram challenge)
    {
        if (State != SessionState.Joining || challenge.Nonce != nonce)
        {
            Counters.DatagramsIgnored++;
        }
        else if (cookie != challenge.Cookie || Clock.Now - challenged > CookieAge)
        {
            cookie = challenge.Cookie;
            challenged = Clock.Now;
            joinDue = challenged;
        }
    }

    private void OnWelcome(in WelcomeDatagram welcome)
    {
        if (welcome.Nonce != nonce)
        {
            Counters.DatagramsIgnored++;
        }
        else if (State == SessionState.Joining)
        {
            SimTime now = Clock.Now;
            Peer = welcome.Peer;
            LastSequence = firstSequence = welcome.LastSequence;
            History = welcome.History;
            LogStart = welcome.LogIndex;
            unjudged = new OwnEvents(firstSequence);
            outgoing = new SendWindow(firstSequence);
            incoming = new ReceiveWindow(LogStart);
            copyHash = welcome.CopyHash;
            joinTook = now - challenged;
            fetch = new CopyFetch(welcome.CopyLength, now);
            link = new UpdateLink(welcome.SessionId, welcome.Peer, 0, host, now);
            State = SessionState.Synchronising;
        }
    }

    private void OnRefusal(ulong itsNonce, string why)
    {
        if (itsNonce == nonce && State == SessionState.Joining)
        {
            End(SessionEnd.Refused, $"The host at {host} refused: {why}");
        }
        else
        {
            Counters.DatagramsIgnored++;
        }
    }

    private void OnChunk(in ChunkDatagram chunk, int length)
    {
        SimTime now = Clock.Now;
        if (link is null || fetch is null || chunk.SessionId != link.SessionId || !fetch.Take(chunk, now))
        {
            Counters.DatagramsIgnored++;
            return;
        }

        link.NoteHeard(now);
        link.CountReceived(length);
        if (!fetch.IsComplete)
        {
            return;
        }

        string? error = null;
        if (CopyFetch.HashOf(fetch.Bytes) != copyHash)
        {
            error = "its hash is another one than was announced.";
        }
        else if (WorldCopy.TryDecode(fetch.Bytes, Options.Accelerations, Scene, out copy, out error))
        {
            Scene = copy.Scene;
            link.Hasten(now);
        }

        fetch = null;
        if (error is not null)
        {
            Farewell();
            End(SessionEnd.Failed, $"The copy of the world that the host at {host} sent cannot be used: {error}");
        }
    }

    private void TendFetch(SimTime now)
    {
        if (fetch is null || fetch.Due > now)
        {
            return;
        }

        SimDuration roundTrip = link!.Traffic.RoundTrip;
        if (roundTrip == SimDuration.Zero)
        {
            roundTrip = joinTook < MostGuessed ? joinTook : MostGuessed;
        }

        SimDuration patience = roundTrip + (roundTrip / 2) > LeastPatience ? roundTrip + (roundTrip / 2) : LeastPatience;
        Span<byte> bytes = stackalloc byte[WireFormat.FetchBytes];
        Send(bytes.Slice(0, fetch.Ask(link.SessionId, Peer, now, patience).Encode(bytes)), link);
    }
}
