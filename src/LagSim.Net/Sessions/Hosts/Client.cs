using LagSim.Net.Sessions.Links;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>A client of the host: one that is joining and has no number yet, or one that is in.</summary>
internal sealed class Client
{
    internal Client(JoinClaim claim, UpdateLink link, JoinSnapshot snapshot, byte[] welcome)
    {
        Claim = claim;
        Link = link;
        Snapshot = snapshot;
        Welcome = welcome;
        DesyncQueries = new DesyncQueries(link.Heard);
    }

    /// <summary>Its number; 0 until it is in.</summary>
    internal byte Peer => Link.Peer;

    /// <summary>The identity it was welcomed with.</summary>
    internal JoinClaim Claim { get; }

    internal UpdateLink Link { get; }

    /// <summary>The answer to its join, which is sent again whenever the join is.</summary>
    internal byte[] Welcome { get; }

    /// <summary>How it follows the log, since it got its number or was heard again after a silence.</summary>
    internal CatchingUp CatchingUp { get; private set; } = new();

    /// <summary>The snapshot it downloads; null once it has it.</summary>
    internal JoinSnapshot? Snapshot { get; set; }

    /// <summary>The last chunk request that was answered.</summary>
    internal uint LastRequest { get; set; }

    /// <summary>The last sequence number of the former holders of its number.</summary>
    internal uint FirstSequence { get; private set; }

    /// <summary>Its desync queries.</summary>
    internal DesyncQueries DesyncQueries { get; }

    /// <summary>How many bytes of its snapshot were sent to it, repetitions included.</summary>
    internal long CopyBytesGiven { get; set; }

    /// <summary>Whether it has scene, state, clock and number, and so needs the log.</summary>
    internal bool IsReady => Peer > 0;

    /// <summary>Whether it knows when the session starts.</summary>
    internal bool HasBegun { get; set; }

    /// <summary>Whether an update from it has arrived. Until then it is sent none.</summary>
    internal bool HasWritten { get; set; }

    /// <summary>The number of log entries that it has.</summary>
    internal uint Acknowledged => Link.Outgoing.Acknowledged;

    /// <summary>The number of its validated events, including those of former holders of its number.</summary>
    internal uint EventsReceived => Incoming.Received;

    /// <summary>The events received from it.</summary>
    internal ReceiveWindow Incoming { get; private set; } = new(0);

    /// <summary>When its events are stamped.</summary>
    internal ClientStamps Stamps { get; } = new();

    /// <summary>The committed states that it was told of.</summary>
    internal StateTellings States { get; } = new();

    /// <summary>How far it has the roster.</summary>
    internal RosterDelivery Roster { get; } = new();

    /// <summary>Gives it a number.</summary>
    internal void Sit(PlayerPlaces.Place place)
    {
        Link.Peer = place.Number;
        FirstSequence = place.LastSequence;
        Incoming = new ReceiveWindow(FirstSequence);
        CatchingUp = new CatchingUp();
    }

    /// <summary>Records that it was silent, or not listened to, for a long time until now.</summary>
    internal void NoteSilence() => CatchingUp = new CatchingUp();
}
