using System;
using System.Collections.Generic;
using LagSim.Net.Carriers;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <content>Letting joiners in: cookie, key, number, and the copy of scene and world that they fetch.</content>
public sealed partial class HostSession
{
    /// <summary>So many joins are remembered until their cookies are stale; until then no more come in.</summary>
    private const int MaxRecentJoins = 1024;

    /// <summary>A copy this fresh serves the next joiner too.</summary>
    private static readonly SimDuration CopyAge = SimDuration.FromSeconds(1);

    private static readonly SimDuration CookieAge = SimDuration.FromSeconds(60);

    private readonly JoinCookies cookies;
    private readonly byte[] sceneCopy;
    private readonly Queue<(ulong Nonce, PeerAddress From, SimTime At)> recentJoins = new();
    private Copy? newestCopy;

    private protected override void OnOtherVersion(ReadOnlySpan<byte> datagram, PeerAddress from)
    {
        if (State != SessionState.Ended && KnockDatagram.TryReadAnyVersion(datagram, out ulong nonce))
        {
            Refuse(nonce, RefusalReason.VersionDiffers, from);
        }
    }

    private void Challenge(ulong nonce, PeerAddress from)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.ChallengeBytes];
        Send(bytes.Slice(0, new ChallengeDatagram(nonce, cookies.Make(from, nonce, Clock.Now)).Encode(bytes)), from);
    }

    private void OnJoin(in JoinDatagram join, PeerAddress from)
    {
        SimTime now = Clock.Now;
        ulong nonce = join.Nonce;
        Joiner? known = joiners.Find(j => j.Link.Other == from && j.Nonce == nonce);
        if (!cookies.IsGood(from, nonce, join.Cookie, now) || (known is null && IsPlayedAgain(nonce, from, now)))
        {
            Counters.DatagramsIgnored++; // whoever it is gets no answer: its address may not be its own
            return;
        }

        if (known is null)
        {
            byte number = FreeNumber(from);
            RefusalReason? refusal = !cookies.IsProof(join) ? RefusalReason.WrongKey
                : join.SceneHash != 0 && join.SceneHash != Scene!.Hash ? RefusalReason.SceneDiffers
                : number == 0 || recentJoins.Count >= MaxRecentJoins ? RefusalReason.Full
                : null;
            if (refusal is RefusalReason reason)
            {
                Counters.DatagramsIgnored++;
                Refuse(nonce, reason, from);
                return;
            }

            Copy made;
            try
            {
                made = CopyFor(now);
            }
            catch (SceneException)
            {
                Refuse(nonce, RefusalReason.TooLarge, from);
                return;
            }

            joiners.RemoveAll(j => j.Link.Other == from); // the same address, shown by the cookie, under a new nonce: it started again
            recentJoins.Enqueue((nonce, from, now));
            known = new Joiner(
                nonce, new UpdateLink(sessionId + joins++, 0, number, from, now), made, lastSequences[number],
                new EventBudget(Options.MaxEventsPerSecond, now));
            joiners.Add(known);
        }

        if (known.Copy is Copy copy)
        {
            Span<byte> bytes = stackalloc byte[WireFormat.WelcomeBytes];
            WelcomeDatagram welcome = new(
                nonce, known.Link.SessionId, known.Peer, known.FirstSequence, Options.History, copy.Bytes.Length, copy.Hash, copy.LogIndex);
            Send(bytes.Slice(0, welcome.Encode(bytes)), known.Link);
        }
    }

    /// <summary>Whether a join came before, from one who has left since: somebody plays it again.</summary>
    private bool IsPlayedAgain(ulong nonce, PeerAddress from, SimTime now)
    {
        while (recentJoins.TryPeek(out (ulong Nonce, PeerAddress From, SimTime At) oldest) && now - oldest.At > CookieAge)
        {
            recentJoins.Dequeue();
        }

        foreach ((ulong Nonce, PeerAddress From, SimTime At) join in recentJoins)
        {
            if (join.Nonce == nonce && join.From == from)
            {
                return true;
            }
        }

        return false;
    }

    private void Refuse(ulong nonce, RefusalReason reason, PeerAddress to)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.RefusalBytes];
        Send(bytes.Slice(0, new RefusalDatagram(nonce, reason).Encode(bytes)), to);
    }

    /// <summary>The least number that no other address has; 0 if there is none.</summary>
    private byte FreeNumber(PeerAddress from)
    {
        for (byte number = 1; number <= SessionOptions.MaxJoiners; number++)
        {
            if (!joiners.Exists(j => j.Peer == number && j.Link.Other != from) && lastSequences[number] < uint.MaxValue)
            {
                return number;
            }
        }

        return 0;
    }

    private void OnFetch(in FetchDatagram fetch, PeerAddress from)
    {
        (ulong session, byte peer) = (fetch.SessionId, fetch.Peer);
        Joiner? joiner = joiners.Find(j => j.Link.Other == from && j.Link.SessionId == session && j.Peer == peer);
        if (joiner?.Copy is null || fetch.Number <= joiner.Fetches)
        {
            Counters.DatagramsIgnored++;
            return;
        }

        joiner.Fetches = fetch.Number;
        joiner.Link.NoteHeard(Clock.Now);
        joiner.Link.CountReceived(WireFormat.FetchBytes);
        Span<byte> bytes = stackalloc byte[WireFormat.MaxBytes];
        ReadOnlySpan<byte> copy = joiner.Copy.Bytes;
        for (int n = 0; n < FetchDatagram.MaxChunks; n++)
        {
            long index = (long)fetch.First + n;
            if ((fetch.Wanted >> n & 1) != 0 && index * ChunkDatagram.MaxData < copy.Length)
            {
                int at = (int)index * ChunkDatagram.MaxData;
                ChunkDatagram chunk = new(session, (uint)index, copy.Slice(at, Math.Min(ChunkDatagram.MaxData, copy.Length - at)));
                Send(bytes.Slice(0, chunk.Encode(bytes)), joiner.Link);
            }
        }
    }

    /// <summary>What someone who joins now has to fetch: the scene, and once the watermark is past the start the state that it commits to.</summary>
    private Copy CopyFor(SimTime now)
    {
        ForgetCopies(now);
        if (newestCopy is null)
        {
            bool hasState = World is not null && Watermark > World.Simulation.Start;
            World?.Advance(SharedTime.Now);
            SimTime watermark = hasState ? SimTime.Max(Watermark, World!.Simulation.HistoryEdge) : Watermark;
            byte[] bytes = hasState ? WorldCopy.Encode(Scene!, World!.Simulation.Snapshot(watermark)) : sceneCopy;
            log.Settle(watermark);
            newestCopy = new Copy(bytes, log.Settled, now);
        }

        return newestCopy;
    }

    private void ForgetCopies(SimTime now)
    {
        newestCopy = newestCopy is not null && now - newestCopy.Made <= CopyAge ? newestCopy : null;
        foreach (Joiner joiner in joiners)
        {
            joiner.Copy = joiner.IsReady ? null : joiner.Copy;
        }
    }

    private sealed class Copy
    {
        internal Copy(byte[] bytes, uint logIndex, SimTime made)
        {
            Bytes = bytes;
            Hash = CopyFetch.HashOf(bytes);
            LogIndex = logIndex;
            Made = made;
        }

        internal byte[] Bytes { get; }

        internal ulong Hash { get; }

        /// <summary>How many entries of the log are in it, or can be left out for another reason.</summary>
        internal uint LogIndex { get; }

        internal SimTime Made { get; }
    }
}
