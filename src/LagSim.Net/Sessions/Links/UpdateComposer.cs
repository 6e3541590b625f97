using System;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>Numbers a link's updates, and stamps each with its sender and what it acknowledges.</summary>
internal sealed class UpdateComposer
{
    private readonly byte[] buffer;

    /// <param name="update">The update to compose in, one at a time; shared by all links of a session.</param>
    /// <param name="buffer">The buffer to encode into; shared likewise.</param>
    internal UpdateComposer(UpdateDatagram update, byte[] buffer)
    {
        Update = update;
        this.buffer = buffer;
    }

    /// <summary>The update being composed.</summary>
    internal UpdateDatagram Update { get; }

    /// <summary>Its number.</summary>
    internal uint Number { get; private set; }

    /// <summary>Begins the next update.</summary>
    internal UpdateDatagram Next(ulong sessionId, byte self, LinkReceipts hearing, SimTime now)
    {
        Update.Clear();
        Update.SessionId = sessionId;
        Update.Peer = self;
        Update.Number = ++Number;
        Update.Sent = now;
        Update.EchoNumber = hearing.Newest;
        Update.EchoBits = hearing.BitsBeforeNewest;
        Update.EchoReceived = hearing.NewestCame;
        return Update;
    }

    /// <summary>Its bytes, valid until the next update of any link is begun.</summary>
    internal ReadOnlySpan<byte> Encode() => buffer.AsSpan(0, Update.Encode(buffer));
}
