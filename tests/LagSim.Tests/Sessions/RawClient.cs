using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>A client that keeps to no rule: it joins as it should, and then says what a test has it say.</summary>
internal sealed class RawClient
{
    private readonly SessionGroup group;
    private readonly IDatagramPort port;
    private readonly byte[] buffer = new byte[WireFormat.MaxBytes];
    private readonly byte role;
    private Token128 cookie;
    private uint number;

    internal RawClient(SessionGroup group, int address = 50, bool sits = true, byte role = 1)
    {
        this.group = group;
        this.role = role;
        group.Network.Connect(address, 0, LinkProfiles.PureDelay(1));
        port = group.Network.CreatePort(address);
        if (sits)
        {
            Join(4711);
        }
        else
        {
            AskFor(4711);
        }
    }

    internal byte Peer { get; private set; }

    internal ulong SessionId { get; private set; }

    /// <summary>How long the copy is that it could fetch.</summary>
    internal int CopyLength { get; private set; }

    /// <summary>The last sequence number of those who had its number before.</summary>
    internal uint LastSequence { get; private set; }

    /// <summary>Asks to be let in, under a nonce, and is, with a number.</summary>
    internal void Join(ulong nonce)
    {
        AskFor(nonce);
        Sit();
    }

    /// <summary>Asks to be let in, under a nonce, and is welcome.</summary>
    internal void AskFor(ulong nonce)
    {
        Assert.Equal(DatagramType.Welcome, Ask(nonce));
        Assert.True(WelcomeDatagram.TryDecode(buffer.AsSpan(0, WireFormat.WelcomeBytes), out WelcomeDatagram welcome, out _));
        Assert.Equal(nonce, welcome.Nonce);
        SessionId = welcome.SessionId;
        CopyLength = welcome.CopyLength;
        number = 0; // of this link's updates
    }

    /// <summary>Says that it is ready, and gets its number.</summary>
    internal void Sit()
    {
        Peer = 0;
        UpdateDatagram update = new() { SessionId = SessionId, Number = ++number, Sent = SimTime.FromSeconds(number), Ready = true };
        byte[] bytes = new byte[update.EncodedLength];
        update.Encode(bytes);
        Send(bytes);
        group.Run(0.01);
        SeatDatagram seat = default;
        while (port.TryReceive(buffer, out int length, out _) && !SeatDatagram.TryDecode(buffer.AsSpan(0, length), out seat, out _))
        {
        }

        Assert.NotEqual(0, seat.Peer);
        Peer = seat.Peer;
        LastSequence = seat.LastSequence;
    }

    /// <summary>Asks to be let in and tells what the answer was; null for none.</summary>
    internal DatagramType? Ask(ulong nonce)
    {
        Received();
        byte[] bytes = new byte[WireFormat.JoinBytes];
        new JoinDatagram(nonce, Cookie(nonce), Prove(nonce), group.Scene.HashButSeed, (uint)Simulation.FoldVersion, role: role).Encode(bytes);
        Send(bytes);
        group.Run(0.01);
        while (port.TryReceive(buffer, out _, out _))
        {
            if ((DatagramType)buffer[3] is not (DatagramType.Update or DatagramType.Leave or DatagramType.Roster)) // of a former link
            {
                return (DatagramType)buffer[3];
            }
        }

        return null;
    }

    /// <summary>Asks to connect, and takes the cookie that comes.</summary>
    internal Token128 Cookie(ulong nonce)
    {
        byte[] bytes = new byte[WireFormat.ConnectRequestBytes];
        new ConnectRequestDatagram(nonce).Encode(bytes);
        Send(bytes);
        group.Run(0.01);
        ChallengeDatagram challenge = default;
        bool came = false;
        while (!came && port.TryReceive(buffer, out int length, out _))
        {
            came = ChallengeDatagram.TryDecode(buffer.AsSpan(0, length), out challenge, out _);
        }

        Assert.True(came);
        cookie = challenge.Cookie;
        return cookie;
    }

    internal Token128 Prove(ulong nonce, string key = "") => JoinCookies.Prove(key, nonce, cookie);

    /// <summary>The type and length of each datagram that came since the last look.</summary>
    internal List<(DatagramType Type, int Length)> Received()
    {
        List<(DatagramType, int)> all = [];
        while (port.TryReceive(buffer, out int length, out _))
        {
            all.Add(((DatagramType)buffer[3], length));
        }

        return all;
    }

    /// <summary>Says goodbye.</summary>
    internal void Leave()
    {
        byte[] bytes = new byte[WireFormat.LeaveBytes];
        new LeaveDatagram(SessionId, Peer, LeaveReason.Left).Encode(bytes);
        Send(bytes);
        group.Run(0.01);
    }

    /// <summary>An update that claims to carry these events from that number on; sent and delivered.</summary>
    internal void Claim(uint firstIndex, params ExternalEvent[] events)
    {
        Send(Bytes(firstIndex, events));
        group.Run(0.01);
    }

    internal byte[] Bytes(uint firstIndex, params ExternalEvent[] events)
    {
        UpdateDatagram update = new() { SessionId = SessionId, Peer = Peer, Number = ++number, Sent = SimTime.FromSeconds(number), FirstIndex = firstIndex, Ready = true };
        foreach (ExternalEvent external in events)
        {
            Assert.True(update.TryAdd(Verdict.Pending, external));
        }

        byte[] bytes = new byte[update.EncodedLength];
        update.Encode(bytes);
        return bytes;
    }

    /// <summary>An update without events that promises to stamp nothing earlier from that number on; sent and delivered.</summary>
    internal void Promise(uint firstIndex, SimTime earliest)
    {
        UpdateDatagram update = new()
        {
            SessionId = SessionId,
            Peer = Peer,
            Number = ++number,
            Sent = SimTime.FromSeconds(number),
            FirstIndex = firstIndex,
            Ready = true,
            Watermark = earliest,
        };
        byte[] bytes = new byte[update.EncodedLength];
        update.Encode(bytes);
        Send(bytes);
        group.Run(0.01);
    }

    internal void Send(byte[] datagram) => port.Send(datagram, PeerAddress.Virtual(0));
}
