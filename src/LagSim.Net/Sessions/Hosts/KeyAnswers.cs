using System;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Answers clients that exchange their link's keys for fresh ones.</summary>
internal sealed class KeyAnswers(ClientRoster roster, DatagramSender sender, SessionCounters counters, IClock clock)
{
    internal void OnOffer(in KeyExchangeDatagram offer, PeerAddress from)
    {
        if (roster.Of(offer.SessionId)?.Link is not { Seal: LinkSeal seal } link || link.Other != from
            || !seal.Keys.TryAnswer(offer, clock.Now, out KeyExchangeDatagram reply))
        {
            counters.DatagramsIgnored++;
            return;
        }

        link.CountReceived(WireFormat.KeyExchangeBytes);
        Span<byte> bytes = stackalloc byte[WireFormat.KeyExchangeBytes];
        sender.Send(bytes.Slice(0, reply.Encode(DatagramType.KeyExchangeReply, bytes)), link);
    }
}
