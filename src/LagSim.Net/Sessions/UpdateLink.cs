using System;
using LagSim.Net.Carriers;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>One end of the exchange of updates with one other peer: numbers, clock echoes, and when the next one is due.</summary>
internal sealed class UpdateLink
{
    private readonly UpdateDatagram outgoing = new();
    private readonly byte[] buffer = new byte[IDatagramPort.MaxDatagramBytes];
    private uint lastSent;
    private uint lastReceived;
    private SimTime echoSent = SimTime.MinValue;
    private SimTime echoReceived = SimTime.MinValue;
    private SimDuration unheard;

    internal UpdateLink(ulong sessionId, byte self, PeerAddress other, SimTime now)
    {
        SessionId = sessionId;
        Self = self;
        Other = other;
        Heard = now;
        Due = now;
    }

    internal ulong SessionId { get; }

    internal byte Self { get; }

    internal PeerAddress Other { get; }

    /// <summary>When the last update came, by the own clock.</summary>
    internal SimTime Heard { get; private set; }

    /// <summary>When the next update is due, by the own clock.</summary>
    internal SimTime Due { get; private set; }

    /// <summary>The longer of two silences: for how long nothing came, and for how long the other said, when it last wrote, that nothing came there.</summary>
    internal SimDuration Silence(SimTime now) => now - Heard > unheard ? now - Heard : unheard;

    /// <summary>Notes an update that came; false for one that was overtaken or came twice, whose clock readings are then of no use.</summary>
    internal bool Note(UpdateDatagram update, SimTime now)
    {
        Heard = now;
        if (update.Number <= lastReceived)
        {
            return false;
        }

        lastReceived = update.Number;
        echoSent = update.Sent;
        echoReceived = now;
        unheard = update.EchoReceived == SimTime.MinValue ? SimDuration.Zero : update.Sent - update.EchoReceived; // both by its own clock
        return true;
    }

    /// <summary>Has the next update sent no later than this.</summary>
    internal void Hasten(SimTime by) => Due = SimTime.Min(Due, by);

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
        return buffer.AsSpan(0, outgoing.Encode(buffer));
    }
}
