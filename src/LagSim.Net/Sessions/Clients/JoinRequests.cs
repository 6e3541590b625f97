using System;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>Asks a host to let this peer in: connect request, cookie, join, and then a welcome or a refusal.</summary>
internal sealed class JoinRequests(
    JoinAttempts attempts, HostConnection connection, PlayerSeat seat, SharedWorld world, SessionStatus status,
    DatagramSender sender, SessionCounters counters, IClock clock, ClientOptions options)
{
    /// <summary>Asks if it is time to.</summary>
    internal void Tend(SimTime now)
    {
        if (attempts.Current is not JoinAttempt attempt || attempt.Due > now)
        {
            return;
        }

        if (attempt.Ask(now) is Token128 cookie)
        {
            Span<byte> bytes = stackalloc byte[WireFormat.JoinBytes];
            Token128 proof = JoinCookies.Prove(options.ConnectKey, attempt.Nonce, cookie);
            PlayerPass former = seat.Pass ?? default;
            Token128 playerProof = former.Number == 0 ? default : JoinCookies.Prove(former.Secret, attempt.Nonce, cookie);
            ulong sceneHash = world.Scene?.Hash ?? 0;
            JoinDatagram join = new(attempt.Nonce, cookie, proof, sceneHash, (uint)Simulation.FoldVersion, former.Number, playerProof);
            sender.Send(bytes.Slice(0, join.Encode(bytes)), connection.Host);
        }
        else
        {
            Span<byte> bytes = stackalloc byte[WireFormat.ConnectRequestBytes];
            sender.Send(bytes.Slice(0, new ConnectRequestDatagram(attempt.Nonce).Encode(bytes)), connection.Host);
        }
    }

    internal void OnChallenge(in ChallengeDatagram challenge)
    {
        if (connection.Link is UpdateLink link && challenge.Nonce == link.SessionId)
        {
            // The host sees an address it does not know for this peer. The host is alive, though it sends nothing else until the address is
            // confirmed.
            link.NoteHeard(clock.Now);
            Span<byte> bytes = stackalloc byte[WireFormat.MoveBytes];
            sender.Send(bytes.Slice(0, new MoveDatagram(link.SessionId, link.Self, challenge.Cookie).Encode(bytes)), link);
        }
        else if (attempts.Current is not JoinAttempt attempt || attempt.IsWelcome || challenge.Nonce != attempt.Nonce)
        {
            counters.DatagramsIgnored++;
        }
        else
        {
            attempt.Take(challenge.Cookie, clock.Now);
        }
    }

    internal void OnWelcome(in WelcomeDatagram welcome)
    {
        if (attempts.Current is not JoinAttempt attempt || welcome.Nonce != attempt.Nonce)
        {
            counters.DatagramsIgnored++;
        }
        else if (!attempt.IsWelcome)
        {
            SimTime now = clock.Now;
            attempt.Take(welcome, now);
            connection.Open(welcome, now);
            status.State = status.State == SessionState.Joining ? SessionState.Synchronising : status.State;
        }
    }

    internal void OnRefusal(in RefusalDatagram refusal) => OnRefusal(refusal.Nonce, refusal.Reason, Sentence(refusal.Reason));

    /// <summary>Handles a host that speaks another version of the protocol.</summary>
    internal void OnOtherVersion(ulong nonce, byte version) =>
        OnRefusal(nonce, null, $"it speaks version {version} of the protocol, this peer {WireFormat.Version}.");

    private static string Sentence(RefusalReason reason) => reason switch
    {
        RefusalReason.VersionDiffers => "it speaks another version of the protocol.",
        RefusalReason.SceneDiffers => "its scene is another one.",
        RefusalReason.WrongKey => "the key is wrong.",
        RefusalReason.Full => "the session is full.",
        RefusalReason.TooLarge => "its world is too large to be copied.",
        RefusalReason.FoldDiffers => $"it computes worlds by other rules than this peer, whose fold version is {Simulation.FoldVersion}."
            + " Both need the same version of LagSim.",
        RefusalReason.Banned => "it lets nobody in from this address.",
        RefusalReason.TooManyFromOneAddress =>
            "as many as may join from one address have joined from this one (the host's MaxClientsPerAddress).",
        _ => $"reason {(int)reason}.",
    };

    private void OnRefusal(ulong nonce, RefusalReason? reason, string why)
    {
        if (attempts.Current is not JoinAttempt attempt || nonce != attempt.Nonce)
        {
            counters.DatagramsIgnored++;
            return;
        }

        bool isKnown = status.IsRejoining || (options.Pass.Number > 0 && clock.Now - attempts.Began <= options.RejoinTime);
        if (isKnown && reason is RefusalReason.Full or RefusalReason.TooManyFromOneAddress)
        {
            attempts.Restart(clock.Now + SimDuration.FromSeconds(1)); // a place may become free
            connection.Close();
        }
        else
        {
            status.End(SessionEnd.Refused, $"The host at {connection.Host} refused: {why}");
        }
    }
}
