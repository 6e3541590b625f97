using System;
using System.Collections.Generic;
using System.Linq;
using System.Security.Cryptography;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>The clients' numbers in a session: what is known about each, and which are reserved for a player that is away.</summary>
/// <remarks>
/// A number is reserved for a player that fell silent, or said that it may come back, as long as the host's option says and no newcomer
/// needs it. One that a player gave up goes to a newcomer after all that nobody has had, since games keep scores by number; but a seat, a
/// number to which the scene grants something, is there to be taken again.
/// </remarks>
internal sealed class PlayerPlaces
{
    private readonly Place[] places = new Place[SessionOptions.MaxNumber + 1];
    private readonly HostOptions options;
    private readonly SimTime began;
    private readonly PeerSet seats;
    private uint visits;

    internal PlayerPlaces(HostOptions options, SimTime now, Scene? scene = null, ulong sessionId = 0)
    {
        Ids = new PlayerIds(sessionId);
        this.options = options;
        began = now;
        seats = SeatsOf(scene);
        for (byte number = 1; number < places.Length; number++)
        {
            places[number] = new Place(number, new RateLimit(options.MaxEventsPerSecond, options.MaxEventsPerSecond, now));
        }
    }

    internal Place this[byte number] => places[number];

    /// <summary>Says who somebody is, for rules.</summary>
    internal PlayerIds Ids { get; }

    /// <summary>Whether a place is reserved for a player that is away. One that was sent away is not waited for, whatever it keeps.</summary>
    internal bool IsKept(Place place, SimTime now) => place.IsKept(now, options.RejoinTime) && place.Former.Why != LeaveReason.Kicked;

    /// <summary>Until when a number is reserved, by the local clock, if its player is away.</summary>
    internal SimTime KeptUntil(byte number) => places[number].LeftAt is SimTime left ? left + options.RejoinTime : SimTime.MaxValue;

    /// <summary>
    /// Returns the place that a join claims, if it proves that its client was that player, and wants to be that again rather than a
    /// spectator, or the other way round; otherwise null. Without protection a pass travels in clear text, so it never opens a number that
    /// has a key.
    /// </summary>
    /// <param name="join">The join.</param>
    /// <param name="keyed">The player whose key it presents; 0 for none.</param>
    /// <param name="binding">What its handshake alone has; empty in a session without protection.</param>
    internal Place? Claimed(in JoinDatagram join, byte keyed, ReadOnlySpan<byte> binding = default) =>
        IsFor(join.Player, join.Role == (byte)PeerRole.Spectator) && (join.Player == keyed || !options.PlayerKeys.ContainsKey(join.Player))
            && places[join.Player].Pass is Token128 pass && JoinCookies.IsProof(pass, join, binding) ? places[join.Player] : null;

    /// <summary>Returns the place of the player that a backend knows by that identity; null if it has none.</summary>
    internal Place? OfPlayer(string playerId, Place? except = null) =>
        Array.Find(places, place => place != except && place?.Admission?.PlayerId == playerId);

    /// <summary>The same, if the place is a spectator's, or a player's, as is wanted.</summary>
    internal Place? OfPlayer(string playerId, bool isSpectator) => Array.Find(
        places, place => place?.Admission?.PlayerId == playerId && IsFor(place.Number, isSpectator));

    /// <summary>Whether a number is one for spectators, or one for players, as is wanted.</summary>
    internal static bool IsFor(byte number, bool isSpectator) => isSpectator
        ? number is > SessionOptions.MaxClients and <= SessionOptions.MaxNumber
        : number is > 0 and <= SessionOptions.MaxClients;

    /// <summary>A number for the next client that is another than all before.</summary>
    internal uint NextVisit() => ++visits;

    /// <summary>Whether the number that a token gives is another player's: one that is in, or the owner of its key.</summary>
    internal bool IsOfAnother(PlayerAdmission admission) =>
        options.PlayerKeys.ContainsKey(admission.Number)
        || (places[admission.Number] is { IsTaken: true } place && place.Admission?.PlayerId != admission.PlayerId);

    /// <summary>
    /// Returns a number that is neither taken nor reserved, otherwise the one reserved longest; 0 if all are taken. Of the former it is the
    /// lowest that is a seat or that nobody has had, then the one given up first. Never a number that has a key.
    /// </summary>
    /// <param name="now">The time by the local clock.</param>
    /// <param name="wanted">
    /// The number that the client says it had; 0 for none. A restarted host knows none of the passes it gave before, so for as long as
    /// numbers are reserved it grants that number without proof, if it is free. Where that is not safe enough, players have keys.
    /// </param>
    /// <param name="machine">
    /// The new player's machine. Once a machine's players hold, or had until shortly, as many numbers as one machine may have, it gets one of
    /// those it had, so that joining again and again takes no numbers from others.
    /// </param>
    /// <param name="isSpectator">Whether it is to be a spectator's number.</param>
    internal byte Free(SimTime now, byte wanted, PeerAddress machine, bool isSpectator = false)
    {
        if (IsFor(wanted, isSpectator) && now - began <= options.RejoinTime && places[wanted] is { IsTaken: false, LeftAt: null }
            && !options.PlayerKeys.ContainsKey(wanted))
        {
            return wanted;
        }

        bool IsKept(Place place) => place.IsKept(now, options.RejoinTime);
        bool HasLeft(Place place) => place.HasLeft(now, options.RejoinTime);
        List<Place> all = places.Skip(1).Where(place => IsFor(place.Number, isSpectator)).ToList();
        all = isSpectator ? all.Take(options.SpectatorPlaces).ToList() : all;
        List<Place> free = all
            .Where(place => !place.IsTaken && !options.PlayerKeys.ContainsKey(place.Number) && place.LastSequence != uint.MaxValue)
            .ToList();
        List<Place> hadHere = free.FindAll(place => place.Machine == machine && HasLeft(place));
        bool hasEnough = all.Count(place => place.Machine == machine && (place.IsTaken || HasLeft(place))) >= options.MaxClientsPerAddress;
        List<Place> choice = hasEnough && hadHere.Count > 0 ? hadHere : free;
        return choice.OrderBy(IsKept).ThenBy(place => IsKept(place) || !seats.Contains(place.Number) ? place.LeftAt ?? SimTime.MinValue : SimTime.MinValue)
            .FirstOrDefault()?.Number ?? 0;
    }

    /// <summary>The numbers to which a scene grants what it does not grant to everyone.</summary>
    private static PeerSet SeatsOf(Scene? scene)
    {
        uint mask = 0;
        foreach (PeerSet granted in scene?.Bodies.Select(body => body.Players).Append(scene.Spawners) ?? [])
        {
            mask |= granted == PeerSet.Everyone ? 0 : granted.Mask;
        }

        return PeerSet.FromMask(mask);
    }

    /// <summary>
    /// Gives a number the rate of events of one that the same machine had before, if less is left of that: else one that leaves and joins
    /// again would have a whole one with each number.
    /// </summary>
    internal void CarryRate(Place to, PeerAddress machine, SimTime now)
    {
        if (places.Skip(1).Where(place => !place.IsTaken && place.Machine == machine).OrderBy(place => place.Events.Left(now)).FirstOrDefault()
            is Place former && former.Events.Left(now) < to.Events.Left(now))
        {
            (to.Events, former.Events) = (former.Events, to.Events);
        }
    }

    /// <summary>
    /// Why the client with that link was disconnected, if that was recent; otherwise <see cref="LeaveReason.NotJoined"/>.
    /// </summary>
    internal LeaveReason WhyGone(ulong session)
    {
        for (byte number = 1; number < places.Length; number++)
        {
            if (places[number].Former is (ulong former, LeaveReason why) && former == session && why != 0)
            {
                return why;
            }
        }

        return LeaveReason.NotJoined;
    }

    /// <summary>One player's number.</summary>
    internal sealed class Place
    {
        internal Place(byte number, RateLimit events)
        {
            Number = number;
            Events = events;
        }

        internal byte Number { get; }

        /// <summary>
        /// The rate at which events of this number are validated. It belongs to the number, so that joining again does not reset it; see
        /// <see cref="CarryRate"/>.
        /// </summary>
        internal RateLimit Events { get; set; }

        /// <summary>The sequence number of the last event of this number.</summary>
        internal uint LastSequence { get; set; }

        /// <summary>The watermark when its client got it: the client stamps nothing before.</summary>
        internal SimTime Earliest { get; set; } = SimTime.MinValue;

        /// <summary>Whether a client has it now.</summary>
        internal bool IsTaken { get; private set; }

        /// <summary>When its last player left or fell silent; null if it has a player, or never had one.</summary>
        internal SimTime? LeftAt { get; private set; }

        /// <summary>What a backend says of its player; null without a connect token.</summary>
        internal PlayerAdmission? Admission { get; private set; }

        /// <summary>The secret of its player; null if it has none.</summary>
        internal Token128? Pass { get; private set; }

        /// <summary>Distinguishes those who have the number one after the other; the same player that comes back keeps it.</summary>
        internal uint Visit { get; private set; }

        /// <summary>Who has it, or had it last, for rules; 0 if no player had it.</summary>
        internal ulong Identity { get; private set; }

        /// <summary>Where its player is, or was; null if no player had it.</summary>
        internal PeerAddress? Machine { get; private set; }

        /// <summary>Whether it is reserved for a player that fell silent or may come back.</summary>
        internal bool IsKept(SimTime now, SimDuration time) => Pass is not null && HasLeft(now, time);

        /// <summary>Whether its last player has gone, and not longer ago than that.</summary>
        internal bool HasLeft(SimTime now, SimDuration time) => !IsTaken && LeftAt is SimTime left && now - left <= time;

        /// <summary>Gives the number to the player that has its pass, or to a new player, which gets a new pass.</summary>
        /// <param name="isSamePlayer">Whether it is the player that had it, and keeps its pass.</param>
        /// <param name="machine">Where the player is.</param>
        /// <param name="admission">What its connect token says of it; null without one.</param>
        /// <param name="visit">What tells it from those before, if it is another.</param>
        /// <param name="identity">Who it is, if it is another.</param>
        internal void Take(bool isSamePlayer, PeerAddress machine, PlayerAdmission? admission = null, uint visit = 0, ulong identity = 0)
        {
            Identity = isSamePlayer ? Identity : identity;
            Visit = isSamePlayer || (admission is not null && admission.PlayerId == Admission?.PlayerId) ? Visit : visit;
            IsTaken = true;
            Admission = admission;
            Machine = machine;
            LeftAt = null;
            if (!isSamePlayer || Pass is null)
            {
                byte[] secret = new byte[Token128.Bytes];
                RandomNumberGenerator.Fill(secret); // does not affect determinism: a pass is right or wrong whatever its bits
                Pass = new Token128(secret);
            }
        }

        /// <summary>The session id of the last holder's link, and why that holder was disconnected.</summary>
        internal (ulong Session, LeaveReason Why) Former { get; private set; }

        /// <summary>Gives up what was reserved for a player that has another place now.</summary>
        internal void Release()
        {
            Pass = null;
            Admission = null;
        }

        /// <summary>Keeps the pass of the player that was sent away, and what its token says, until another gets the number.</summary>
        internal void Keep(Token128? pass, PlayerAdmission? admission) => (Pass, Admission) = (pass, admission);

        /// <summary>Called when its player is gone: the number is reserved or free from then on.</summary>
        internal void Leave(bool isKept, ulong session, LeaveReason why, SimTime now)
        {
            Former = (session, why);
            IsTaken = false;
            LeftAt = now;
            Pass = isKept ? Pass : null;
            Admission = isKept ? Admission : null;
        }
    }
}
