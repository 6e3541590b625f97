using System;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>Gets a protected link fresh keys, again and again: offers an exchange when it is due, and takes the host's answer.</summary>
internal sealed class KeyRenewal(HostConnection connection, DatagramSender sender, SessionCounters counters)
{
    /// <summary>Whether the link's keys are so old that it is to be given up.</summary>
    internal bool IsOverdue(SimTime now) => connection.Link?.Seal?.Keys.AreTooOld(now) == true;

    /// <summary>This machine slept, and nothing could be exchanged.</summary>
    internal void NoteSuspend(SimTime now) => connection.Link?.Seal?.Keys.NoteSuspend(now);

    internal void Tend(SimTime now)
    {
        if (connection.Link is not { Seal: LinkSeal seal } link)
        {
            return;
        }

        seal.Keys.Tend(now);
        if (seal.Keys.TryOffer(link.SessionId, now, out KeyExchangeDatagram offer))
        {
            Span<byte> bytes = stackalloc byte[WireFormat.KeyExchangeBytes];
            sender.Send(bytes.Slice(0, offer.Encode(DatagramType.KeyExchange, bytes)), link);
        }
    }

    /// <summary>Handles the host's answer. From then on this end seals with the fresh keys.</summary>
    internal void OnReply(in KeyExchangeDatagram reply)
    {
        if (connection.Link is { Seal: LinkSeal seal } link && reply.SessionId == link.SessionId && seal.Keys.TryFinish(reply))
        {
            link.CountReceived(WireFormat.KeyExchangeBytes);
        }
        else
        {
            counters.DatagramsIgnored++;
        }
    }
}
