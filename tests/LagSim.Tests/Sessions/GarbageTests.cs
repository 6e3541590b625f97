using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Testing.Links;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>Whatever comes in, nothing throws, and it is counted.</summary>
public sealed class GarbageTests
{
    private const int Count = 3000;
    private const int Stranger = 60;

    private readonly List<byte[]> seen = [];
    private readonly SessionGroup group = new(ScriptedActions.Box(), 3, LinkProfiles.PureDelay(5), 9);

    public GarbageTests() => group.Network.Lose((_, _, datagram) =>
    {
        seen.Add(datagram.ToArray());
        return false;
    });

    [Theory]
    [InlineData(Stranger, 0)]
    [InlineData(Stranger, 1)]
    [InlineData(1, 0)] // a client to the host
    [InlineData(0, 1)] // the host to a client
    public void Receive_RandomBytes_AreAllCountedAndTheSessionGoesOn(int from, int to)
    {
        group.Connect();
        Random random = new(from + (10 * to));
        Session target = group.Sessions[to];
        long before = target.Counters.DatagramsMalformed + target.Counters.DatagramsIgnored;
        IDatagramPort port = Port(from);
        for (int i = 0; i < Count; i++)
        {
            byte[] bytes = new byte[random.Next(1, WireFormat.MaxBytes + 1)];
            random.NextBytes(bytes);
            if (i % 2 == 0)
            {
                Head(bytes, (byte)random.Next(0, 11)); // half of them say they are ours
            }

            port.Send(bytes, PeerAddress.Virtual(to));
            Pause(i);
        }

        group.Run(0.2);
        Assert.Equal(before + Count, target.Counters.DatagramsMalformed + target.Counters.DatagramsIgnored);
        AssertGoesOn();
    }

    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    public void Receive_TrueDatagramsOfASessionFromAStranger_AreNoneOfItsBusiness(int to)
    {
        Record();
        long before = group.Sessions[to].Counters.DatagramsIgnored;
        byte[][] others = seen.Where(bytes => bytes[3] != (byte)DatagramType.ConnectRequest).ToArray(); // a connect request is answered, whoever it is
        foreach (byte[] bytes in others)
        {
            Port(Stranger).Send(bytes, PeerAddress.Virtual(to));
        }

        group.Run(0.2);
        Assert.True(others.Length > 100);
        Assert.Equal(before + others.Length, group.Sessions[to].Counters.DatagramsIgnored);
        AssertGoesOn();
    }

    [Fact]
    public void Receive_EveryDatagramOfTheSessionAgain_ChangesNothing()
    {
        // From and to whom they were, hours of a slow network later: all are old, none is new.
        List<(int From, int To, byte[] Bytes)> all = [];
        group.Network.Lose((from, to, datagram) =>
        {
            all.Add((from, to, datagram.ToArray()));
            return false;
        });
        Record();
        string before = Hashes();
        foreach ((int from, int to, byte[] bytes) in all.ToArray())
        {
            group.Ports[from].Send(bytes, PeerAddress.Virtual(to));
        }

        group.Run(1);
        Assert.Equal(before, Hashes());
        AssertGoesOn();

        string Hashes() => string.Join(" ", group.Sessions.Select(s => s.Counters.EventsAccepted));
    }

    [Theory]
    [InlineData(1, 0)]
    [InlineData(0, 1)]
    public void Receive_TrueDatagramsWithBrokenBytes_NeverThrow(int from, int to)
    {
        // From a peer's own address a broken datagram may still be a valid one; without encryption that cannot be told. It must not throw.
        Record();
        Random random = new(5);
        long before = group.Sessions[to].Counters.DatagramsMalformed;
        byte[][] samples = seen.ToArray();
        group.IsTapped = false;
        for (int i = 0; i < Count; i++)
        {
            byte[] bytes = (byte[])samples[random.Next(samples.Length)].Clone();
            if (bytes[3] is (byte)DatagramType.Leave)
            {
                continue; // that ends the session, rightly
            }

            for (int flips = random.Next(1, 5); flips > 0; flips--)
            {
                bytes[random.Next(4, bytes.Length)] ^= (byte)(1 << random.Next(8));
            }

            group.Ports[from].Send(random.Next(8) == 0 ? bytes[..random.Next(1, bytes.Length)] : bytes, PeerAddress.Virtual(to));
            Pause(i);
        }

        group.Run(0.2);
        Assert.True(group.Sessions[to].Counters.DatagramsMalformed > before + (Count / 20));
    }

    [Fact]
    public void Receive_RandomBytesWhileJoining_AreSurvived()
    {
        Random random = new(8);
        IDatagramPort stranger = Port(Stranger);
        for (int i = 0; i < Count; i++)
        {
            byte[] bytes = new byte[random.Next(1, 100)];
            random.NextBytes(bytes);
            Head(bytes, (byte)random.Next(1, 10));
            (i % 3 == 0 ? group.Ports[0] : stranger).Send(bytes, PeerAddress.Virtual(i % 3));
            Pause(i, 0.0005);
        }

        group.Connect();
        AssertGoesOn();
    }

    private static void Head(byte[] bytes, byte type)
    {
        byte[] head = [0x53, 0x4C, WireFormat.Version, type];
        head.AsSpan(0, Math.Min(4, bytes.Length)).CopyTo(bytes);
    }

    private IDatagramPort Port(int number)
    {
        if (number != Stranger)
        {
            return group.Ports[number];
        }

        port ??= group.Network.CreatePort(Stranger);
        return port;
    }

    private IDatagramPort? port;

    private void Record()
    {
        group.Connect();
        new ScriptedActions(3).DoIn(group, 30);
        Assert.True(group.Settle(30));
    }

    private void Pause(int i, double seconds = 0.01)
    {
        if (i % 50 == 49)
        {
            group.Run(seconds);
        }
    }

    private void AssertGoesOn()
    {
        long before = group.Host.Counters.EventsAccepted;
        group.Do(0, PlayerAction.Impulse(Second, V(1, 3)));
        group.Do(1, PlayerAction.Impulse(Third, V(-1, 3)));
        group.Do(2, PlayerAction.SetVelocity(First, V(0, 3)));
        group.Run(1);
        Assert.All(group.Sessions, s => Assert.Equal((SessionState.Running, before + 3, 0L), (s.State, s.Counters.EventsAccepted, s.Counters.EventsRefused)));
        Assert.True(group.Difference() is null, group.Difference());
    }
}
