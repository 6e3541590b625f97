using System.Collections.Generic;
using System.Linq;
using System.Security.Cryptography;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>The numbers of a session's players: what is known of each, and for whom one is kept that nobody has at the moment.</summary>
/// <remarks>A number is kept for a player that fell silent, as long as the host's option says and no newcomer needs it.</remarks>
internal sealed class PlayerPlaces
{
    private readonly Place[] places = new Place[SessionOptions.MaxClients + 1];
    private readonly HostOptions options;
    private readonly SimTime began;

    internal PlayerPlaces(HostOptions options, SimTime now)
    {
        this.options = options;
        began = now;
        for (byte number = 1; number < places.Length; number++)
        {
            places[number] = new Place(number, new RateLimit(options.MaxEventsPerSecond, options.MaxEventsPerSecond, now));
        }
    }

    internal Place this[byte number] => places[number];

    /// <summary>
    /// The place of the player that a join says, and shows, that its client was; null if it does not. A pass travels in clear, so it opens no number that has a key.
    /// </summary>
    /// <param name="join">The join.</param>
    /// <param name="keyed">The player whose key it shows; 0 for none.</param>
    internal Place? Claimed(in JoinDatagram join, byte keyed) =>
        join.Player is > 0 and <= SessionOptions.MaxClients && (join.Player == keyed || !options.PlayerKeys.ContainsKey(join.Player))
            && places[join.Player].Pass is Token128 pass && JoinCookies.IsProof(pass, join) ? places[join.Player] : null;

    /// <summary>
    /// The least number that nobody has and that is kept for nobody; if there is none, the one that has been kept the longest; 0 if all are taken. Never one of a
    /// player with a key.
    /// </summary>
    /// <param name="now">By the own clock.</param>
    /// <param name="wanted">
    /// The number that whoever is to get it says it had; 0 for none. A host that was ended and started again knows no pass that it gave before, so for as long
    /// as a number is kept it gives that one, if it is free: who comes back is who it was, though it shows nothing. Where that must be sure players have keys.
    /// </param>
    /// <param name="machine">
    /// Where the new player comes from. A machine whose players have, or have kept for them, as many numbers as one machine may have, gets one of those that
    /// are kept for it: coming again and again takes nobody else's.
    /// </param>
    internal byte Free(SimTime now, byte wanted, PeerAddress machine)
    {
        if (wanted is > 0 and <= SessionOptions.MaxClients && now - began <= options.RejoinTime && places[wanted] is { IsTaken: false, Pass: null }
            && !options.PlayerKeys.ContainsKey(wanted))
        {
            return wanted;
        }

        bool IsKept(Place place) => place.IsKept(now, options.RejoinTime);
        List<Place> free = places.Skip(1)
            .Where(place => !place.IsTaken && !options.PlayerKeys.ContainsKey(place.Number) && place.LastSequence != uint.MaxValue)
            .ToList();
        List<Place> keptHere = free.FindAll(place => place.Machine == machine && IsKept(place));
        bool hasEnough = places.Skip(1).Count(place => place.Machine == machine && (place.IsTaken || IsKept(place))) >= options.MaxClientsPerAddress;
        List<Place> choice = hasEnough && keptHere.Count > 0 ? keptHere : free;
        Place? chosen = choice.Find(place => !IsKept(place)) ?? choice.OrderBy(place => place.LeftAt).FirstOrDefault();
        return chosen?.Number ?? 0;
    }

    /// <summary>Why the one that had that link was disconnected, if that was not long ago; else that there is none.</summary>
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

        /// <summary>How many events of this number are validated a second: to come again starts none anew.</summary>
        internal RateLimit Events { get; }

        /// <summary>Of the last event that bears this number.</summary>
        internal uint LastSequence { get; set; }

        /// <summary>Whether somebody has it now.</summary>
        internal bool IsTaken { get; private set; }

        /// <summary>When its player fell silent; null if nobody had it, or whoever had it left.</summary>
        internal SimTime? LeftAt { get; private set; }

        /// <summary>The secret of its player; null if it has none.</summary>
        internal Token128? Pass { get; private set; }

        /// <summary>Where its player is, or was; null if nobody had it.</summary>
        internal PeerAddress? Machine { get; private set; }

        /// <summary>Whether it is kept for a player that fell silent.</summary>
        internal bool IsKept(SimTime now, SimDuration time) => !IsTaken && Pass is not null && LeftAt is SimTime left && now - left <= time;

        /// <summary>Gives it to the player who has its pass, or to a new one, who gets another.</summary>
        internal void Take(bool isSamePlayer, PeerAddress machine)
        {
            IsTaken = true;
            Machine = machine;
            LeftAt = null;
            if (!isSamePlayer || Pass is null)
            {
                byte[] secret = new byte[Token128.Bytes];
                RandomNumberGenerator.Fill(secret); // no run depends on it: a pass is right or wrong whatever its bits
                Pass = new Token128(secret);
            }
        }

        /// <summary>The session id of the link of whoever had it last, and why that one was disconnected.</summary>
        internal (ulong Session, LeaveReason Why) Former { get; private set; }

        /// <summary>Its player is gone: kept for it, or free.</summary>
        internal void Leave(bool isKept, ulong session, LeaveReason why, SimTime now)
        {
            Former = (session, why);
            IsTaken = false;
            LeftAt = isKept ? now : null;
            Pass = isKept ? Pass : null;
        }
    }
}
