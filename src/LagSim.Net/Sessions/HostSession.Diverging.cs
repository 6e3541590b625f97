using System;
using System.Collections.Generic;
using LagSim.Net.Carriers;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <content>A joiner whose committed state is another asks for the events of the time in which that came about.</content>
public sealed partial class HostSession
{
    /// <summary>
    /// Raised on the session's thread for each joiner, once, that says its committed state at that time is not this host's. Handlers must not throw.
    /// </summary>
    public event Action<byte, SimTime>? JoinerDiverged;

    private void OnDoubt(in DoubtDatagram doubt, PeerAddress from)
    {
        Joiner? joiner = JoinerOf(doubt.SessionId);
        SimTime now = Clock.Now;
        bool isItsTurn = joiner is not null && joiner.Link.Other == from && joiner.Peer == doubt.Peer && doubt.Number > joiner.Doubted;
        if (!isItsTurn || World is null || doubt.UpTo >= Watermark || !joiner!.Doubts.TrySpend(now))
        {
            Counters.DatagramsIgnored++; // what is not committed may still change
            return;
        }

        bool isFirst = joiner.Doubted == 0;
        joiner.Doubted = doubt.Number;
        joiner.Link.CountReceived(WireFormat.DoubtBytes);
        Answer(joiner, doubt);
        if (isFirst)
        {
            JoinerDiverged?.Invoke(joiner.Peer, doubt.UpTo);
        }
    }

    private void Answer(Joiner joiner, in DoubtDatagram doubt)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.MaxBytes];
        bool isWhole = Recent.IsWholeAfter(doubt.After);
        List<LogEntry> events = Recent.Between(doubt.After, doubt.UpTo);
        if (!isWhole || events.Count == 0)
        {
            Send(bytes.Slice(0, new EvidenceDatagram(doubt.SessionId, isWhole).Encode(bytes)), joiner.Link);
            return;
        }

        for (long n = doubt.First; n < events.Count && n < (long)doubt.First + DoubtDatagram.MaxEvents; n++)
        {
            LogEntry entry = events[(int)n];
            Send(bytes.Slice(0, new EvidenceDatagram(doubt.SessionId, (uint)events.Count, (uint)n, entry.Index, entry.Event).Encode(bytes)), joiner.Link);
        }
    }
}
