using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Testing.Links;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>A path that loses long packets without a word lets a player in and carries its session, in short ones.</summary>
public sealed class SmallMtuTests
{
    [Theory]
    [InlineData(576, 0, false)]
    [InlineData(576, 0, true)]
    [InlineData(576, 10, false)]
    [InlineData(576, 10, true)]
    [InlineData(900, 0, false)]
    [InlineData(900, 10, true)]
    [InlineData(1200, 0, false)]
    [InlineData(1200, 0, true)]
    [InlineData(1200, 10, false)]
    public void Join_OverAPathThatDropsLongPackets_GetsInWithinFiveSeconds(int mtu, int lossPercent, bool isProtected)
    {
        SessionGroup group = Group(isProtected, lossPercent);
        List<int> lengths = LengthsOnceIn(group, 7);
        group.Network.LoseAbove(mtu);
        ClientSession client = group.Join(7, 99, Options(isProtected));
        Assert.True(group.RunUntil(() => client.State == SessionState.Running, 5), client.WhyNotRunning + client.EndReason);

        // The session goes on in short ones, however much there is to tell.
        lengths.Clear();
        for (int n = 0; n < 40; n++)
        {
            group.Do(0, PlayerAction.Impulse(First, V(0.01, 0)));
            group.Do(1, PlayerAction.Impulse(First, V(0, 0.01)));
        }

        Assert.True(group.Settle(80, 5), $"{client.LogLength} of {group.Host.LogLength}, {group.Host.Counters.EventsAccepted} {client.State}");
        Assert.InRange(lengths.Max(), 300, 548);
    }

    [Fact]
    public void Join_OverAPathThatDropsLongPackets_SaysSo()
    {
        SessionGroup group = Group(isProtected: false, lossPercent: 0);
        group.Network.LoseAbove(576);
        ClientSession client = group.Join(7, 99);
        HashSet<string> said = [];
        Assert.True(group.RunUntil(
            () =>
            {
                said.Add(client.WhyNotRunning ?? "");
                return client.State == SessionState.Running;
            },
            5));
        Assert.Contains(said, s => s.EndsWith(" Datagrams of more than 548 bytes do not arrive here, so it comes in short ones.", StringComparison.Ordinal));
    }

    [Fact]
    public void Join_WhoseRequestsAskForLongChunksAlone_DoesNotGetInAndSaysWhy()
    {
        SessionGroup group = Group(isProtected: false, lossPercent: 0, (address, port) => address == 7 ? new LongChunksPort(port) : port);
        group.Network.LoseAbove(576);
        ClientSession client = group.Join(7, 99);
        Assert.False(group.RunUntil(() => client.State == SessionState.Running, 5));
        Assert.EndsWith("The host's other datagrams arrive, but none of the copy does, whether long or short.", client.WhyNotRunning, StringComparison.Ordinal);
    }

    [Fact]
    public void Join_OverANormalPath_AsksForNothingShorter()
    {
        SessionGroup group = Group(isProtected: false, lossPercent: 0);
        int requests = 0;
        group.Network.Lose((_, _, datagram) =>
        {
            if (datagram.Span[3] == (byte)DatagramType.SnapshotRequest)
            {
                requests++;
                Assert.True(SnapshotRequestDatagram.TryDecode(datagram.Span, out SnapshotRequestDatagram request, out _));
                Assert.Equal((0, 1161), (request.Shorter, request.ChunkBytes));
                Assert.Equal(29, datagram.Length);
            }

            return false;
        });
        ClientSession client = group.Join(7, 99);
        Assert.True(group.RunUntil(() => client.State == SessionState.Running, 5));
        Assert.True(requests > 0);
    }

    [Fact]
    public void Session_WhosePathDropsLongPacketsFromNowOn_GoesOnInShortOnes()
    {
        SessionGroup group = Group(isProtected: false, lossPercent: 0);
        ClientSession client = group.Join(7, 99);
        Assert.True(group.RunUntil(() => client.State == SessionState.Running, 5));
        group.Network.LoseAbove(576);
        List<int> lengths = LengthsOnceIn(group, 7);
        for (int round = 0; round < 10; round++)
        {
            for (int n = 0; n < 60; n++)
            {
                group.Do(0, PlayerAction.Impulse(First, V(0.001, 0)));
            }

            group.Run(0.2);
        }

        // Without an eye on lengths, what the window makes of the losses: 94 long ones in 4 s, and a log that is 160 events late after 2 s.
        Assert.InRange(lengths.Count(length => length > 548), 8, 40);
        Assert.Equal(group.Host.LogLength, client.LogLength);
    }

    [Fact]
    public void PathSize_OfLongUpdatesLostInARow_IsShortAndOfOneThatCameInBetweenIsNot()
    {
        PathSize path = new();
        uint number = 0;
        for (int n = 0; n < 100; n++)
        {
            path.NoteLost(++number, 577 - 1); // as long as any path carries
            path.NoteLost(++number, 1228);
            path.NoteArrived(++number, 100);
            path.NoteArrived(++number, n % 7 == 6 ? 577 : 576);
            Assert.Equal(1200, path.Bytes);
        }

        // A burst: what arrived after it is told first.
        number += 40;
        path.NoteArrived(number, 1228);
        for (uint lost = number - 20; lost < number; lost++)
        {
            path.NoteLost(lost, 1228);
        }

        Assert.Equal(1200, path.Bytes);
        for (int n = 0; n < 8; n++)
        {
            path.NoteLost(++number, 577);
            path.NoteArrived(++number, 576);
        }

        Assert.Equal((548, 525, 386), (path.Bytes, path.PlainBytes, path.UpdateRoom));
    }

    [Fact]
    public void Session_OverALinkThatLosesOneInTen_KeepsItsLongDatagrams()
    {
        SessionGroup group = Group(isProtected: false, lossPercent: 10);
        List<int> lengths = LengthsOnceIn(group, 7);
        ClientSession client = group.Join(7, 99);
        Assert.True(group.RunUntil(() => client.State == SessionState.Running, 5));
        for (int round = 0; round < 20; round++)
        {
            lengths.Clear();
            for (int n = 0; n < 40; n++)
            {
                group.Do(0, PlayerAction.Impulse(First, V(0.001, 0)));
            }

            group.Run(0.2);
        }

        Assert.True(lengths.Max() > 548, $"{lengths.Max()}");
    }

    private static List<int> LengthsOnceIn(SessionGroup group, int address)
    {
        List<int> lengths = [];
        group.Network.Lose((from, to, datagram) =>
        {
            if (from == address || to == address)
            {
                lengths.Add(datagram.Length);
            }

            return false;
        });
        return lengths;
    }

    private static SessionGroup Group(bool isProtected, int lossPercent, Func<int, IDatagramPort, IDatagramPort>? wrap = null)
    {
        LinkProfile link = new("lossy", new LinkLeg(30, lossPercent: lossPercent), new LinkLeg(30, lossPercent: lossPercent));
        return new SessionGroup(
            BuiltInScenes.Crowd(100), 1, link, wrap: wrap, expected: 0,
            options: _ => new HostOptions { Protection = isProtected ? new SecureHost(HostIdentity.Draw()) : null }).Connect();
    }

    private static ClientOptions Options(bool isProtected) => new() { Protection = isProtected ? SecureClient.TrustOnFirstUse() : null };

    /// <summary>A port whose requests ask for long chunks, as all did once.</summary>
    private sealed class LongChunksPort(IDatagramPort port) : IDatagramPort
    {
        public event Action? Arrived
        {
            add => port.Arrived += value;
            remove => port.Arrived -= value;
        }

        public PeerAddress LocalAddress => port.LocalAddress;

        public void Send(ReadOnlySpan<byte> datagram, PeerAddress to)
        {
            byte[] sent = datagram.ToArray();
            if (sent[3] == (byte)DatagramType.SnapshotRequest)
            {
                sent[12] = 0;
            }

            port.Send(sent, to);
        }

        public bool TryReceive(Span<byte> buffer, out int length, out PeerAddress from) => port.TryReceive(buffer, out length, out from);

        public void Dispose() => port.Dispose();
    }
}
