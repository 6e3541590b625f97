using System;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>Numbers the updates of a link, and writes into each whose it is and what it answers.</summary>
internal sealed class UpdateComposer
{
    private readonly byte[] buffer;

    /// <param name="update">What updates are composed in, one after the other; all links of a session share it.</param>
    /// <param name="buffer">Where their bytes go; likewise.</param>
    internal UpdateComposer(UpdateDatagram update, byte[] buffer)
    {
        Update = update;
        this.buffer = buffer;
    }

    /// <summary>The update that is being composed.</summary>
    internal UpdateDatagram Update { get; }

    /// <summary>Its number.</summary>
    internal uint Number { get; private set; }

    /// <summary>Begins the next update.</summary>
    internal UpdateDatagram Next(ulong sessionId, byte self, LinkHearing hearing, SimTime now)
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

    /// <summary>Its bytes, until the next one of any link is begun.</summary>
    internal ReadOnlySpan<byte> Encode() => buffer.AsSpan(0, Update.Encode(buffer));
}
