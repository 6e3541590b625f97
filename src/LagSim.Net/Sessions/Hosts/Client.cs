using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>One that is coming in, and has no number yet, or is in.</summary>
internal sealed class Client
{
    // By the number of the update: the committed states it tells.
    private readonly (uint Number, SimTime UpTo)[] tellings = new (uint, SimTime)[32];

    internal Client(JoinClaim claim, UpdateLink link, JoinCopy copy)
    {
        Claim = claim;
        Link = link;
        Copy = copy;
        DesyncQueries = new RateLimit(2, RecentEvents.Most / DesyncQueryDatagram.MaxEvents, link.Heard);
    }

    /// <summary>Its number; 0 until it is in.</summary>
    internal byte Peer => Link.Peer;

    /// <summary>As whom it was welcomed.</summary>
    internal JoinClaim Claim { get; }

    internal UpdateLink Link { get; }

    /// <summary>How it follows the log, since it got its number, or was heard again after a silence.</summary>
    internal CatchingUp CatchingUp { get; private set; } = new();

    /// <summary>What it fetches; null once it has it.</summary>
    internal JoinCopy? Copy { get; set; }

    /// <summary>The last request for pieces of it that was answered.</summary>
    internal uint Fetches { get; set; }

    /// <summary>The last sequence number of those who had its number before.</summary>
    internal uint FirstSequence { get; private set; }

    /// <summary>
    /// How many of its questions about a difference are answered: two a second, and as many at once as a whole answer takes.
    /// </summary>
    internal RateLimit DesyncQueries { get; }

    /// <summary>The last such question that was answered.</summary>
    internal uint Doubted { get; set; }

    /// <summary>How many it got.</summary>
    internal long PiecesGiven { get; set; }

    /// <summary>Whether it has scene, state, clock and number, and so wants the log.</summary>
    internal bool IsReady => Peer > 0;

    /// <summary>Whether it knows when the session starts.</summary>
    internal bool HasBegun { get; set; }

    /// <summary>Whether an update of it came. Until then it gets none.</summary>
    internal bool HasWritten { get; set; }

    /// <summary>How many entries of the log it has.</summary>
    internal uint Acknowledged => Link.Outgoing.Acknowledged;

    /// <summary>How many of its events are validated, those of former holders of its number included.</summary>
    internal uint EventsReceived => Incoming.Received;

    /// <summary>What it did.</summary>
    internal ReceiveWindow Incoming { get; private set; } = new(0);

    /// <summary>The newest committed state of which it is known to have the hash, or that came before its own.</summary>
    internal SimTime Told { get; private set; } = SimTime.MinValue;

    /// <summary>Notes up to which committed state an update tells.</summary>
    internal void NoteTold(uint number, SimTime upTo) => tellings[number % (uint)tellings.Length] = (number, upTo);

    /// <summary>Notes that an update came.</summary>
    internal void NoteEcho(uint number)
    {
        (uint Number, SimTime UpTo) telling = tellings[number % (uint)tellings.Length];
        Told = number > 0 && telling.Number == number ? SimTime.Max(Told, telling.UpTo) : Told;
    }

    /// <summary>Gives it a number.</summary>
    internal void Sit(PlayerPlaces.Place place)
    {
        Link.Peer = place.Number;
        FirstSequence = place.LastSequence;
        Incoming = new ReceiveWindow(FirstSequence);
        CatchingUp = new CatchingUp();
    }

    /// <summary>Notes that it was silent, or not listened to, for long until now.</summary>
    internal void NoteSilence() => CatchingUp = new CatchingUp();
}
