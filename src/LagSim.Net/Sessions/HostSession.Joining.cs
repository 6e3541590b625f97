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
    /// <summary>How often every piece of a copy can be asked for in the mean, before no more of it is given.</summary>
    private const int MostRepeats = 8;

    /// <summary>Who was welcomed is given up after this long, or the timeout if that is shorter, if it then says nothing.</summary>
    private static readonly SimDuration SilentPlace = SimDuration.FromSeconds(5);

    /// <summary>A copy this fresh serves the next joiner too.</summary>
    private static readonly SimDuration CopyAge = SimDuration.FromSeconds(1);

    private readonly DoorLimits door;
    private readonly CopyPaces paces;
    private readonly JoinCookies cookies;
    private readonly byte[] sceneCopy;
    private JoinCopy? newestCopy;
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
        if (!cookies.IsGood(from, nonce, join.Cookie, now))
        {
            Counters.DatagramsIgnored++; // whoever it is gets no answer: its address may not be its own
            return;
        }

        if (known is null)
        {
            byte keyed = NumberByKey(join);
            PlayerPlaces.Place? claimed = places.Claimed(join, keyed);
            RefusalReason? refusal = banned.Contains(from.Machine) || IsShutOut(from.Machine, now) ? RefusalReason.Banned
                : keyed == 0 && !JoinCookies.IsProof(Options.ConnectKey, join) ? RefusalReason.WrongKey
                : join.FoldVersion != (uint)Simulation.FoldVersion ? RefusalReason.FoldDiffers
                : join.SceneHash != 0 && join.SceneHash != Scene!.Hash ? RefusalReason.SceneDiffers
                : WhyNoPlace(keyed, claimed, from, now);
            if (refusal is RefusalReason reason)
            {
                Counters.DatagramsIgnored++;
                Refuse(nonce, reason, from);
                return;
            }

            JoinCopy? made;
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

            // The same address, shown by the cookie, under a new nonce: it started again. One that is in stays until the new one gets its number: if it had only
            // fallen silent, it may be heard again first, and goes on.
            joiners.RemoveAll(j => j.Peer == 0 && j.Link.Other == from);
            MakeRoom(from, made);
            UpdateLink link = LinkTo(from, cookies.SessionId(sessionId, joins++), 0, made.LogIndex, now);
            known = new Joiner(join, link, made, keyed, claimed, now + PatienceWithCopy(made));
            joiners.Add(known);
        }

        if (known.Copy is JoinCopy copy)
        {
            Span<byte> bytes = stackalloc byte[WireFormat.WelcomeBytes];
            WelcomeDatagram welcome = new(nonce, known.Link.SessionId, Options.Window.History, copy.Bytes.Length, copy.Hash, copy.LogIndex);
            Send(bytes.Slice(0, welcome.Encode(bytes)), known.Link);
        }
    }

    /// <summary>Why somebody can get no number now; null if it can.</summary>
    private RefusalReason? WhyNoPlace(byte keyed, PlayerPlaces.Place? claimed, PeerAddress from, SimTime now)
    {
        if (keyed > 0)
        {
            return null; // it has one
        }

        // Who shows that it is a player whom nobody else is has a number, but counts: else a machine could collect passes, and then come with all of them.
        PeerAddress address = from;
        byte own = claimed?.Number ?? 0;
        return joiners.Count(j => j.Peer > 0 && j.Peer != own && j.Link.Other != address && j.Link.Other.IsSameMachine(address)) >= Options.MaxJoinersPerAddress
                ? RefusalReason.TooManyFromOneAddress
            : own == 0 && places.Free(now, 0, address.Machine) == 0 && !joiners.Exists(j => j.Peer > 0 && j.Link.Other == address) ? RefusalReason.Full
            : null;
    }

    /// <summary>
    /// Lets go of the oldest of those that are coming in, of the machine with the most: while there are too many, or their copies take too much memory.
    /// </summary>
    /// <param name="from">Who comes.</param>
    /// <param name="made">What it is to fetch. Others who fetch the same copy take no more memory for it.</param>
    private void MakeRoom(PeerAddress from, JoinCopy made)
    {
        List<Joiner> coming = joiners.FindAll(j => j.Peer == 0); // the oldest first
        List<Joiner> ofOne = coming.FindAll(j => j.Link.Other.IsSameMachine(from));
        if (ofOne.Count >= door.ComingOfOne)
        {
            LeaveOut(ofOne[0]);
        }

        while (coming.Count >= door.Coming)
        {
            LeaveOut(OldestOf(coming));
        }

        while (coming.FindAll(j => j.Copy != made) is { Count: > 0 } others && made.Bytes.Length + BytesOf(others) > RoomForCopiesLike(made))
        {
            LeaveOut(OldestOf(others));
        }

        void LeaveOut(Joiner joiner)
        {
            joiners.Remove(joiner);
            coming.Remove(joiner);
        }

        Joiner OldestOf(List<Joiner> some) => some.GroupBy(j => j.Link.Other.Machine)
            .OrderByDescending(machine => machine.Count() + (machine.Key == from.Machine ? 1 : 0)).First().First();
    }

    /// <summary>Gives one that has its copy and its clock a number, and tells it; false if there is none, and it was told so.</summary>
    private bool TrySeat(Joiner joiner, SimTime now)
    {
        PlayerPlaces.Place? claimed = joiner.Claimed is PlayerPlaces.Place former && former.Pass == joiner.ClaimedPass ? former : null; // nobody else got it since
        PlayerPlaces.Place? place = joiner.Keyed > 0 ? places[joiner.Keyed] : claimed;
        LetGo(j => j.Peer > 0 && j.Peer != place?.Number && j.Link.Other == joiner.Link.Other, LeaveReason.TimedOut); // started again, or gone, and another got its port: it may still come back
        if (WhyNoPlace(joiner.Keyed, claimed, joiner.Link.Other, now) is RefusalReason reason)
        {
            Refuse(joiner.Nonce, reason, joiner.Link.Other);
            joiners.Remove(joiner);
            return false;
        }

        place ??= places[places.Free(now, joiner.Wanted, joiner.Link.Other.Machine)];

        if (joiners.Find(j => j.Peer == place.Number) is Joiner before)
        {
            SayGoodbye(before.Link, LeaveReason.Replaced); // its player came in from elsewhere
            LetGo(j => j == before, LeaveReason.Replaced);
        }

        joiner.Sit(place);
        if (claimed != place)
        {
            BeginAccount(place.Number);
        }

        place.Take(isSamePlayer: claimed == place, joiner.Link.Other.Machine);
        GiveSeat(joiner);
        JoinerCame?.Invoke(joiner.Link.Traffic);
        return true;
    }

    private void GiveSeat(Joiner joiner)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.SeatBytes];
        Send(bytes.Slice(0, new SeatDatagram(joiner.Link.SessionId, joiner.Peer, joiner.FirstSequence, places[joiner.Peer].Pass!.Value).Encode(bytes)), joiner.Link);
    }

    /// <summary>Somebody shows that it is at another address now.</summary>
    private void OnMove(in MoveDatagram move, PeerAddress from)
    {
        SimTime now = Clock.Now;
        if (JoinerOf(move.SessionId) is Joiner joiner && (joiner.Peer == move.Peer || move.Peer == 0) && cookies.IsGood(from, move.SessionId, move.Cookie, now))
        {
            joiner.Link.Other = from;
            joiner.Link.CountReceived(WireFormat.MoveBytes);
            joiner.Link.NoteHeard(now);
            joiner.Link.Hasten(now);
        }
        else
        {
            Counters.DatagramsIgnored++;
        }
    }

    private void Refuse(ulong nonce, RefusalReason reason, PeerAddress to)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.RefusalBytes];
        Send(bytes.Slice(0, new RefusalDatagram(nonce, reason).Encode(bytes)), to);
    }

    /// <summary>The number that a player's key gives; 0 if it is none.</summary>
    private byte NumberByKey(in JoinDatagram join)
    {
        foreach (KeyValuePair<byte, string> player in Options.PlayerKeys)
        {
            if (JoinCookies.IsProof(player.Value, join))
            {
                return player.Key;
            }
        }

        return 0;
    }

    private void OnFetch(in FetchDatagram fetch, PeerAddress from)
    {
        ulong session = fetch.SessionId;
        Joiner? joiner = JoinerOf(session);
        if (joiner is null || joiner.Link.Other != from || joiner.Copy is null || fetch.Number <= joiner.Fetches)
        {
            Counters.DatagramsIgnored++;
            if (joiner is not null && joiner.Link.Other != from)
            {
                Challenge(session, from); // pieces are many times as long as what asks for them: it must show first that it is there
            }

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
                if (joiner.PiecesGiven >= MostRepeats * ((copy.Length / ChunkDatagram.MaxData) + FetchDatagram.MaxChunks) || !paces.TrySpend(from, now))
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
    private JoinCopy? CopyFor(SimTime now)
    {
        ForgetCopies(now);
        if (newestCopy is null || !Serves(newestCopy, now))
        {
            // One instant for both: the log goes on from where the state ends, however the clock runs on meanwhile.
            SettleLog();
            Simulation? world = World?.Simulation;
            bool hasState = world is not null && settledTo > world.Start;
            if (hasState && (settledTo > world!.SimulatedTo || settledTo < world.HistoryEdge))
            {
                return null;
            }

            newestCopy = new JoinCopy(hasState ? WorldCopy.Encode(Scene!, world!.Snapshot(settledTo)) : sceneCopy, log.Settled, now);
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
        foreach (Joiner joiner in joiners)
        {
            joiner.Copy = joiner.IsReady ? null : joiner.Copy;
        }

        bool isFetched = joiners.Exists(j => j.Copy == newestCopy);
        newestCopy = newestCopy is not null && now - newestCopy.Made <= (isFetched ? Options.Timeout : CopyAge) ? newestCopy : null;
    }

    /// <summary>
    /// Whether a new joiner can be given this copy. A copy is shared for a second; and while there is no memory for another one, until it is as old as the time-out.
    /// So joiners are not dropped each time that another one comes, and no joiner gets a world older than that because others keep fetching it.
    /// </summary>
    private bool Serves(JoinCopy newest, SimTime now) =>
        now - newest.Made <= CopyAge || newest.Bytes.Length + BytesOf(joiners) > RoomForCopiesLike(newest);

    /// <summary>How much memory copies of that size may take, in bytes; see <see cref="DoorLimits.CopyBytes"/>.</summary>
    private long RoomForCopiesLike(JoinCopy copy) => Math.Max(door.CopyBytes, (long)copy.Bytes.Length * door.CopiesAtLeast);

    /// <summary>How many bytes the copies take that these joiners are fetching; a shared one counts once.</summary>
    private static long BytesOf(IEnumerable<Joiner> some) => some.Select(j => j.Copy).OfType<JoinCopy>().Distinct().Sum(copy => (long)copy.Bytes.Length);
}
