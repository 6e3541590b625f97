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

    /// <summary>A round trip that is said to be longer is none: what the other says of its own times is not checked.</summary>
    private static readonly SimDuration MostRoundTrip = SimDuration.FromSeconds(10);

    private readonly UpdateDatagram outgoing = new();
    private readonly byte[] buffer = new byte[IDatagramPort.MaxDatagramBytes];
    private readonly SeenNumbers seen = new();
    private uint lastSent;
    private SimTime echoSent = SimTime.MinValue;
    private SimTime echoReceived = SimTime.MinValue;
    private SimDuration unheard;
    private SimTime earliest = SimTime.MinValue; // of the next update
    private long datagramsSent;
    private long bytesSent;
    private long datagramsReceived;
    private long bytesReceived;
    private SimDuration roundTrip;
    private SimDuration meanRoundTrip;
    private SimDuration meanDeviation;

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

    /// <summary>
    /// After how long an answer can be taken for lost: the mean round trip and four times its mean deviation, as TCP has it. Zero before it
    /// <see cref="IsMeasured"/>.
    /// </summary>
    internal SimDuration Patience => meanRoundTrip + (meanDeviation * 4);

    /// <summary>Whether a round trip has been measured yet.</summary>
    internal bool IsMeasured { get; private set; }

    /// <summary>Notes an update that came.</summary>
    /// <param name="update">The update.</param>
    /// <param name="now">When it came, by the own clock.</param>
    /// <param name="isNewest">False for one that was overtaken: of it only entries, watermark and acknowledgement are news.</param>
    /// <returns>False for one that came before, or is so old that it may have.</returns>
    internal bool Note(UpdateDatagram update, SimTime now, out bool isNewest)
    {
        isNewest = update.Number > seen.Newest;
        if (!seen.Add(update.Number))
        {
            return false; // perhaps somebody plays it again: it does not even show that the other is there
        }

        if (!isNewest)
        {
            return true;
        }

        Heard = now;
        if (update.EchoSent != SimTime.MinValue)
        {
            SimDuration exchange = now - update.EchoSent;
            SimDuration held = update.Sent - update.EchoReceived;
            if (held >= SimDuration.Zero && held <= exchange) // else it is made up
            {
                roundTrip = exchange - held;
                Average(roundTrip);
            }
        }

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
        earliest = outgoing.Sent + LeastDistance;
        Due = SimTime.Max(nextDue, earliest);
        return buffer.AsSpan(0, outgoing.Encode(buffer));
    }

    private void Average(SimDuration sample)
    {
        if (sample > MostRoundTrip)
        {
            return;
        }

        if (!IsMeasured)
        {
            IsMeasured = true;
            meanRoundTrip = sample;
            meanDeviation = sample / 2;
            return;
        }

        SimDuration off = sample - meanRoundTrip;
        meanRoundTrip += off / 8;
        meanDeviation += ((off < SimDuration.Zero ? -off : off) - meanDeviation) / 4;
    }
}
