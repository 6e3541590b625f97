using System;
using LagSim.Events;
using LagSim.Harness.Links;
using LagSim.Net.Carriers;
using LagSim.Net.Wire;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>A joiner that keeps to no rule: it joins as it should, and then says what a test has it say.</summary>
internal sealed class RawJoiner
{
    private readonly SessionGroup group;
    private readonly IDatagramPort port;
    private readonly byte[] buffer = new byte[WireFormat.MaxBytes];
    private uint number;

    internal RawJoiner(SessionGroup group, int address = 50)
    {
        this.group = group;
        group.Network.Connect(address, 0, LinkProfiles.PureDelay(1));
        port = group.Network.CreatePort(address);
        byte[] bytes = new byte[WireFormat.JoinBytes];
        new JoinDatagram(0, 4711, group.Scene.Hash).Encode(bytes);
        Send(bytes);
        group.Run(0.01);
        Assert.True(port.TryReceive(buffer, out int length, out _));
        Assert.True(WelcomeDatagram.TryDecode(buffer.AsSpan(0, length), out WelcomeDatagram welcome, out _));
        Peer = welcome.Peer;
        SessionId = welcome.SessionId;
    }

    internal byte Peer { get; }

    internal ulong SessionId { get; }

    /// <summary>An update that claims to carry these events from that number on; sent and delivered.</summary>
    internal void Claim(uint firstIndex, params ExternalEvent[] events)
    {
        Send(Bytes(firstIndex, events));
        group.Run(0.01);
    }

    internal byte[] Bytes(uint firstIndex, params ExternalEvent[] events)
    {
        UpdateDatagram update = new() { SessionId = SessionId, Peer = Peer, Number = ++number, Sent = SimTime.FromSeconds(number), FirstIndex = firstIndex };
        foreach (ExternalEvent external in events)
        {
            Assert.True(update.TryAdd(Verdict.Pending, external));
        }

        byte[] bytes = new byte[update.EncodedLength];
        update.Encode(bytes);
        return bytes;
    }

    internal void Send(byte[] datagram) => port.Send(datagram, PeerAddress.Virtual(0));
}
