using System;
using System.Collections.Generic;
using System.Linq;
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

    /// <summary>So many joins of one machine are remembered: more than that a minute come from nobody honest.</summary>
    private const int MaxRecentJoinsOfOne = 32;

    /// <summary>A joiner gets pieces of its copy at this rate, 2.3 MB/s, and after a pause four windows of them at once.</summary>
    private const double PiecesPerSecond = 2000;

    private const int PiecesAtOnce = 4 * FetchDatagram.MaxChunks;

    /// <summary>How often every piece of a copy can be asked for in the mean, before no more of it is given.</summary>
    private const int MostRepeats = 8;

    /// <summary>A place that was asked for is given up after this long, or the timeout if that is shorter, if its joiner then says nothing.</summary>
    private static readonly SimDuration SilentPlace = SimDuration.FromSeconds(5);

    /// <summary>A copy this fresh serves the next joiner too.</summary>
    private static readonly SimDuration CopyAge = SimDuration.FromSeconds(1);

    private static readonly SimDuration CookieAge = SimDuration.FromSeconds(60);

    private readonly JoinCookies cookies;
    private readonly byte[] sceneCopy;
    private readonly Queue<(ulong Nonce, PeerAddress From, SimTime At)> recentJoins = new();
    private readonly RateLimit?[] eventLimits = new RateLimit?[SessionOptions.MaxJoiners + 1]; // by number: to come again starts none anew
    private Copy? newestCopy;
    private SimTime settledTo = SimTime.MinValue;

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
            RefusalReason? refusal = !TryNumber(join, from, out byte number) ? RefusalReason.WrongKey
                : join.SceneHash != 0 && join.SceneHash != Scene!.Hash ? RefusalReason.SceneDiffers
                : number == 0 || HasJoinedTooOften(from) ? RefusalReason.Full
                : null;
            if (refusal is RefusalReason reason)
            {
                Counters.DatagramsIgnored++;
                Refuse(nonce, reason, from);
                return;
            }

            Copy? made;
            try
            {
                made = CopyFor(now);
            }
            catch (SceneException)
            {
                Refuse(nonce, RefusalReason.TooLarge, from);
                return;
            }

            if (made is null)
            {
                return; // the world is being simulated again; the joiner asks once more
            }

            LetGo(j => j.Link.Other == from); // the same address, shown by the cookie, under a new nonce: it started again
            Replace(number);
            recentJoins.Enqueue((nonce, from, now));
            RateLimit events = eventLimits[number] ??= new RateLimit(Options.MaxEventsPerSecond, Options.MaxEventsPerSecond, now);
            UpdateLink way = new(cookies.SessionId(sessionId, joins++), 0, number, from, now);
            known = new Joiner(nonce, way, made, lastSequences[number], events, new RateLimit(PiecesPerSecond, PiecesAtOnce, now));
            joiners.Add(known);
            JoinerCame?.Invoke(known.Link.Traffic);
        }

        if (known.Copy is Copy copy)
        {
            Span<byte> bytes = stackalloc byte[WireFormat.WelcomeBytes];
            WelcomeDatagram welcome = new(
                nonce, known.Link.SessionId, known.Peer, known.FirstSequence, Options.Window.History, copy.Bytes.Length, copy.Hash, copy.LogIndex);
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

    /// <summary>Whether so many joins are remembered, of this machine or of all, that no more come in until their cookies are stale.</summary>
    private bool HasJoinedTooOften(PeerAddress from) =>
        recentJoins.Count >= MaxRecentJoins || recentJoins.Count(join => join.From.IsSameMachine(from)) >= MaxRecentJoinsOfOne;

    /// <summary>
    /// The number that a player's key gives, or for the connect key the least that is free, 0 if there is none; false if it is no key of ours.
    /// </summary>
    private bool TryNumber(in JoinDatagram join, PeerAddress from, out byte number)
    {
        foreach (KeyValuePair<byte, string> player in Options.PlayerKeys)
        {
            if (JoinCookies.IsProof(player.Value, join))
            {
                number = player.Key;
                return true;
            }
        }

        number = FreeNumber(from);
        return JoinCookies.IsProof(Options.ConnectKey, join);
    }

    /// <summary>The least number that neither another address nor a player with a key has; 0 if there is none.</summary>
    private byte FreeNumber(PeerAddress from)
    {
        for (byte number = 1; number <= SessionOptions.MaxJoiners; number++)
        {
            bool isTaken = Options.PlayerKeys.ContainsKey(number) || joiners.Exists(j => j.Peer == number && j.Link.Other != from);
            if (!isTaken && lastSequences[number] < uint.MaxValue)
            {
                return number;
            }
        }

        return 0;
    }

    /// <summary>Tells who has the number that its player came in from elsewhere.</summary>
    private void Replace(byte number)
    {
        if (joiners.Find(j => j.Peer == number) is Joiner before)
        {
            SayGoodbye(before.Link, LeaveReason.Replaced);
            LetGo(j => j == before);
        }
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

        SimTime now = Clock.Now;
        joiner.Fetches = fetch.Number;
        joiner.Link.NoteHeard(now);
        joiner.Link.CountReceived(WireFormat.FetchBytes);
        Span<byte> bytes = stackalloc byte[WireFormat.MaxBytes];
        ReadOnlySpan<byte> copy = joiner.Copy.Bytes;
        for (int n = 0; n < FetchDatagram.MaxChunks; n++)
        {
            long index = (long)fetch.First + n;
            if ((fetch.Wanted >> n & 1) != 0 && index * ChunkDatagram.MaxData < copy.Length)
            {
                if (joiner.PiecesGiven >= MostRepeats * ((copy.Length / ChunkDatagram.MaxData) + FetchDatagram.MaxChunks) || !joiner.Pieces.TrySpend(now))
                {
                    return; // what is still missing is asked for again
                }

                joiner.PiecesGiven++;
                int at = (int)index * ChunkDatagram.MaxData;
                ChunkDatagram chunk = new(session, (uint)index, copy.Slice(at, Math.Min(ChunkDatagram.MaxData, copy.Length - at)));
                Send(bytes.Slice(0, chunk.Encode(bytes)), joiner.Link);
            }
        }
    }

    /// <summary>
    /// What someone who joins now has to fetch: the scene, and once what is committed lies past the start the state then. Null while the
    /// world is behind what it had committed to.
    /// </summary>
    private Copy? CopyFor(SimTime now)
    {
        ForgetCopies(now);
        if (newestCopy is null)
        {
            // One instant for both: the log goes on from where the state ends, however the clock runs on meanwhile.
            SettleLog();
            Simulation? world = World?.Simulation;
            bool hasState = world is not null && settledTo > world.Start;
            if (hasState && (settledTo > world!.SimulatedTo || settledTo < world.HistoryEdge))
            {
                return null;
            }

            newestCopy = new Copy(hasState ? WorldCopy.Encode(Scene!, world!.Snapshot(settledTo)) : sceneCopy, log.Settled, now);
        }

        return newestCopy;
    }

    /// <summary>Moves on what nobody who joins from now on needs: what the watermark and the world have both passed.</summary>
    private void SettleLog()
    {
        SimTime watermark = Watermark;
        settledTo = SimTime.Max(settledTo, World is null ? watermark : SimTime.Min(watermark, World.Simulation.SimulatedTo));
        log.Settle(settledTo);
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
