using System;
using LagSim.Net.Carriers;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>One end of the exchange of updates with one other peer: numbers, clock echoes, and when the next one is due.</summary>
internal sealed class UpdateLink
{
    /// <summary>Who writes more often is not answered more often than this.</summary>
    private static readonly SimDuration LeastDistance = SimDuration.FromMilliseconds(1);

    private readonly UpdateDatagram outgoing = new();
    private readonly byte[] buffer = new byte[IDatagramPort.MaxDatagramBytes];
    private uint lastSent;
    private uint lastReceived;
    private SimTime echoSent = SimTime.MinValue;
    private SimTime echoReceived = SimTime.MinValue;
    private SimDuration unheard;
    private SimTime earliest = SimTime.MinValue; // of the next update
    private long datagramsSent;
    private long bytesSent;
    private long datagramsReceived;
    private long bytesReceived;
    private SimDuration roundTrip;

    internal UpdateLink(ulong sessionId, byte self, byte peer, PeerAddress other, SimTime now)
    {
        SessionId = sessionId;
        Self = self;
        Peer = peer;
        Other = other;
        Heard = now;
        Due = now;
    }

    internal ulong SessionId { get; }

    internal byte Self { get; }

    internal byte Peer { get; }

    internal PeerAddress Other { get; }

    internal LinkTraffic Traffic => new(Peer, Other, datagramsSent, bytesSent, datagramsReceived, bytesReceived, roundTrip);

    /// <summary>When the last update came, by the own clock.</summary>
    internal SimTime Heard { get; private set; }

    /// <summary>When the next update is due, by the own clock.</summary>
    internal SimTime Due { get; private set; }

    /// <summary>The longer of two silences: for how long nothing came, and for how long the other said, when it last wrote, that nothing came there.</summary>
    internal SimDuration Silence(SimTime now) => now - Heard > unheard ? now - Heard : unheard;

    /// <summary>Notes an update that came; false for one that was overtaken or came twice, in which there is nothing that a later one has not.</summary>
    internal bool Note(UpdateDatagram update, SimTime now)
    {
        if (update.Number <= lastReceived)
        {
            return false; // perhaps somebody plays it again: it does not even show that the other is there
        }

        Heard = now;
        if (update.EchoSent != SimTime.MinValue)
        {
            SimDuration exchange = now - update.EchoSent;
            SimDuration held = update.Sent - update.EchoReceived;
            roundTrip = held >= SimDuration.Zero && held <= exchange ? exchange - held : roundTrip; // else it is made up
        }

        lastReceived = update.Number;
        echoSent = update.Sent;
        echoReceived = now;
        unheard = update.EchoReceived == SimTime.MinValue ? SimDuration.Zero : update.Sent - update.EchoReceived; // both by its own clock
        return true;
    }

    /// <summary>Notes something else that only the other can have sent, and only now.</summary>
    internal void NoteHeard(SimTime now) => Heard = now;

    /// <summary>Has the next update sent no later than this, but for the least distance of two.</summary>
    internal void Hasten(SimTime by) => Due = SimTime.Min(Due, SimTime.Max(by, earliest));

    internal void CountReceived(int bytes)
    {
        datagramsReceived++;
        bytesReceived += bytes;
    }

    internal void CountSent(int bytes)
    {
        datagramsSent++;
        bytesSent += bytes;
    }

    /// <summary>An update with everything that this type knows filled in; the rest is the caller's. Send it with <see cref="Seal"/>.</summary>
    internal UpdateDatagram Compose(SimTime now)
    {
        outgoing.Clear();
        outgoing.SessionId = SessionId;
        outgoing.Peer = Self;
        outgoing.Number = ++lastSent;
        outgoing.Sent = now;
        outgoing.EchoSent = echoSent;
        outgoing.EchoReceived = echoReceived;
        return outgoing;
    }

    /// <summary>The bytes of the composed update; sets when the next is due.</summary>
    internal ReadOnlySpan<byte> Seal(SimTime nextDue)
    {
        Due = nextDue;
        earliest = outgoing.Sent + LeastDistance;
        return buffer.AsSpan(0, outgoing.Encode(buffer));
    }
}
