using System;
using LagSim.Net.Carriers;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Net.Sessions;

/// <content>Getting in, the first time and again: knock, cookie, join, copy, clock, number.</content>
public sealed partial class JoinerSession
{
    /// <summary>The longest round trip that is assumed before one is measured.</summary>
    private static readonly SimDuration MostGuessed = SimDuration.FromMilliseconds(400);

    private JoinAttempt? attempt; // null once it is in

    private protected override void OnOtherVersion(ReadOnlySpan<byte> datagram, PeerAddress sender)
    {
        if (sender == host && RefusalDatagram.TryReadAnyVersion(datagram, out ulong itsNonce, out byte version))
        {
            OnRefusal(itsNonce, null, $"it speaks version {version} of the protocol, this peer {WireFormat.Version}.");
        }
    }

    private static string Sentence(RefusalReason reason) => reason switch
    {
        RefusalReason.VersionDiffers => "it speaks another version of the protocol.",
        RefusalReason.SceneDiffers => "its scene is another one.",
        RefusalReason.WrongKey => "the key is wrong.",
        RefusalReason.Full => "the session is full.",
        RefusalReason.TooLarge => "its world is too large to be copied.",
        RefusalReason.FoldDiffers => $"it computes worlds by other rules than this peer, whose fold version is {Simulation.FoldVersion}. Both need the same version of LagSim.",
        RefusalReason.Banned => "it lets nobody in from this address.",
        RefusalReason.TooManyFromOneAddress => "as many as may join from one address have joined from this one (the host's MaxJoinersPerAddress).",
        _ => $"reason {(int)reason}.",
    };

    private void AskToJoin(JoinAttempt joining, SimTime now)
    {
        if (joining.Ask(now) is Token128 cookie)
        {
            Span<byte> bytes = stackalloc byte[WireFormat.JoinBytes];
            Token128 proof = JoinCookies.Prove(Options.ConnectKey, joining.Nonce, cookie);
            PlayerPass former = Pass ?? default;
            Token128 playerProof = former.Number == 0 ? default : JoinCookies.Prove(former.Secret, joining.Nonce, cookie);
            JoinDatagram join = new(joining.Nonce, cookie, proof, Scene?.Hash ?? 0, (uint)Simulation.FoldVersion, former.Number, playerProof);
            Send(bytes.Slice(0, join.Encode(bytes)), host);
        }
        else
        {
            Span<byte> bytes = stackalloc byte[WireFormat.KnockBytes];
            Send(bytes.Slice(0, new KnockDatagram(joining.Nonce).Encode(bytes)), host);
        }
    }

    private void OnChallenge(in ChallengeDatagram challenge)
    {
        if (link is not null && challenge.Nonce == link.SessionId)
        {
            // The host hears this peer from an address that it does not know it to have: it is there, though it says nothing else until that is shown.
            link.NoteHeard(Clock.Now);
            Span<byte> bytes = stackalloc byte[WireFormat.MoveBytes];
            Send(bytes.Slice(0, new MoveDatagram(link.SessionId, link.Self, challenge.Cookie).Encode(bytes)), link);
        }
        else if (attempt is null || attempt.IsWelcome || challenge.Nonce != attempt.Nonce)
        {
            Counters.DatagramsIgnored++;
        }
        else
        {
            attempt.Take(challenge.Cookie, Clock.Now);
        }
    }

    private void OnWelcome(in WelcomeDatagram welcome)
    {
        if (attempt is null || welcome.Nonce != attempt.Nonce)
        {
            Counters.DatagramsIgnored++;
        }
        else if (!attempt.IsWelcome)
        {
            SimTime now = Clock.Now;
            History = welcome.History;
            logStart = welcome.LogIndex;
            attempt.Take(welcome, now);
            Counters.EventsUnanswered += unjudged.Count;
            unjudged = new OwnEvents(0);
            incoming = new ReceiveWindow(logStart); // of the link that begins now
            link = LinkTo(host, welcome.SessionId, 0, 0, now);
            link.Self = 0;
            State = State == SessionState.Joining ? SessionState.Synchronising : State;
        }
    }

    private void OnRefusal(ulong itsNonce, RefusalReason? reason, string why)
    {
        if (attempt is null || itsNonce != attempt.Nonce)
        {
            Counters.DatagramsIgnored++;
        }
        else if ((State == SessionState.Rejoining || (Options.Pass.Number > 0 && Clock.Now - began <= Options.RejoinTime)) && reason is RefusalReason.Full or RefusalReason.TooManyFromOneAddress)
        {
            attempt = new JoinAttempt(NextNonce(), Clock.Now + SimDuration.FromSeconds(1)); // somebody may leave
            link = null;
        }
        else
        {
            End(SessionEnd.Refused, $"The host at {host} refused: {why}");
        }
    }

    private void OnChunk(in ChunkDatagram chunk, int length)
    {
        SimTime now = Clock.Now;
        if (link is null || attempt?.Fetch is not CopyFetch fetch || chunk.SessionId != link.SessionId || !fetch.Take(chunk, now))
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
        if (CopyFetch.HashOf(fetch.Bytes) != attempt.CopyHash)
        {
            error = "its hash is another one than was announced.";
        }
        else if (WorldCopy.TryDecode(fetch.Bytes, Options.Accelerations, Scene, out WorldCopy? copy, out error))
        {
            attempt.Copy = copy;
            Scene = copy.Scene;
            link.Hasten(now);
        }

        attempt.Fetch = null;
        if (error is not null)
        {
            Farewell();
            End(SessionEnd.Failed, $"The copy of the world that the host at {host} sent cannot be used: {error}");
        }
    }

    private void TendFetch(SimTime now)
    {
        if (attempt?.Fetch is not CopyFetch fetch || fetch.Due > now)
        {
            return;
        }

        SimDuration guessed = attempt.Took < MostGuessed ? attempt.Took : MostGuessed;
        Span<byte> bytes = stackalloc byte[WireFormat.FetchBytes];
        Send(bytes.Slice(0, fetch.Ask(link!.SessionId, link.Self, now, link.Trips, guessed).Encode(bytes)), link);
    }

    private void OnSeat(in SeatDatagram seat)
    {
        if (link is null || attempt is null || seat.SessionId != link.SessionId || !attempt.IsReady)
        {
            Counters.DatagramsIgnored++;
            return;
        }

        link.CountReceived(WireFormat.SeatBytes);
        if (attempt.Seat is not null)
        {
            return;
        }

        attempt.Seat = seat;
        Peer = seat.Peer;
        link.Self = seat.Peer;
        LastSequence = firstSequence = seat.LastSequence;
        lastUrgent = firstSequence;
        unjudged = new OwnEvents(firstSequence);
        link.StartAfter(firstSequence);
        LogStart = logStart;
        Pass = new PlayerPass(seat.Peer, seat.Pass);
        ClockSync = attempt.Clock;
        SharedTime.Restart();
        SharedTime.Adjust(ClockSync.Estimate);
        State = State == SessionState.Synchronising ? SessionState.Waiting : State;
        link.Hasten(Clock.Now);
        PassGiven?.Invoke(new PlayerPass(seat.Peer, seat.Pass));
    }

    /// <summary>Makes the world once scene, state or start, the shared time, and the number are there.</summary>
    private void TryBegin(SimTime start)
    {
        if (attempt?.Seat is null || attempt.Copy is not WorldCopy copy)
        {
            return;
        }

        if (copy.Snapshot is WorldSnapshot snapshot)
        {
            try
            {
                from = snapshot.Time;
                Begin(snapshot);
            }
            catch (SceneException failure)
            {
                Farewell();
                End(SessionEnd.Failed, $"The state that the host at {host} sent is no world of its scene. {failure.Message}");
                return;
            }
        }
        else if (start == SimTime.MinValue)
        {
            return; // it is not decided
        }
        else if (start < EarliestStart())
        {
            Farewell();
            End(SessionEnd.Failed, FormattableString.Invariant(
                $"The host at {host} says that the session began {(SharedTime.Now - start).ToSeconds():0} s ago and sent no state of it: that is more than")
                + " history and time-out allow.");
            return;
        }
        else
        {
            from = SimTime.MinValue;
            Begin(start);
        }

        attempt = null;
        agreed = SimTime.MinValue;
        if (State == SessionState.Rejoining)
        {
            renewed = Clock.Now;
            State = SessionState.Waiting;
        }
    }

    /// <summary>
    /// Whoever joins later than the history after the start gets a state with the scene. The start of one who got none lies at most the history before it
    /// asked to be let in, and the time-out for clocks and copies; before that nothing is simulated, however long it would take.
    /// </summary>
    private SimTime EarliestStart() =>
        SharedTime.Now - (Clock.Now - attempt!.Began) - Options.Timeout
        - (History < LatencyCompensationWindow.MaxHistory ? History : LatencyCompensationWindow.MaxHistory);
}
