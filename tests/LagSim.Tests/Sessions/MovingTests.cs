using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Wire;
using LagSim.Testing.Links;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>A player whose address changes stays who it is; nobody else takes its link by saying that it moved.</summary>
public sealed class MovingTests
{
    [Theory]
    [InlineData(1)]
    [InlineData(10)]
    public void Address_ThatChanges_IsFollowedOnceItIsShownAndNothingIsLost(int times)
    {
        (SessionGroup group, NatPort nat) = Two();
        List<string> told = [];
        group.Client(1).Interrupted += told.Add;
        int done = 0;
        for (int n = 1; n <= times; n++)
        {
            nat.Place(1, n % 3, 2000 + n);
            group.Do(1, PlayerAction.Impulse(First, V(0.1, 1)));
            group.Do(0, PlayerAction.Impulse(Second, V(-0.1, 1)));
            done += 2;
            group.Run(0.4);
            Assert.Equal(NatPort.Address(n % 3, 2000 + n), group.Host.Links[0].Address);
        }

        Assert.True(group.Settle(done, 2));
        group.Run(3);
        Assert.Empty(told);
        Assert.Equal((done, 1), (group.Host.Counters.EventsAccepted, group.Host.ClientCount));
        Assert.Null(group.Difference());
        Assert.All(group.Sessions, s => Assert.Equal((0L, 0L), (s.Counters.EventsLost, s.Counters.StatesDiffered)));
    }

    /// <summary>Somebody who knows the session, as whoever listens does, but is not where the client is.</summary>
    [Fact]
    public void Move_WithoutTheCookieOfThatAddress_IsIgnored()
    {
        (SessionGroup group, NatPort nat) = Two();
        ulong session = 0;
        Token128 its = default;
        group.Network.Lose((from, to, datagram) =>
        {
            session = from == 1 && datagram.Span[3] == (byte)DatagramType.Update ? BitConverter.ToUInt64(datagram.Span[4..12]) : session;
            if (to == 1 && MoveChallengeDatagram.TryDecode(datagram.Span, out MoveChallengeDatagram challenge, out _))
            {
                its = challenge.Cookie;
            }

            return false;
        });
        nat.Place(1, 1, 2001);
        group.Run(3);
        Assert.True(session != 0 && its != default);
        PeerAddress there = NatPort.Address(1, 2001);
        Assert.Equal(there, group.Host.Links[0].Address);
        nat.Place(9, 9, 9000);
        IDatagramPort thief = group.Network.CreatePort(9);
        Random random = new(1);
        long ignored = group.Host.Counters.DatagramsIgnored;
        for (int n = 0; n < 100; n++)
        {
            byte[] bytes = new byte[WireFormat.MoveBytes];
            Token128 cookie = n % 2 == 0 ? its : new Token128((ulong)random.NextInt64(), (ulong)random.NextInt64());
            new MoveDatagram(session, (byte)(n % 3), cookie).Encode(bytes); // heard on the way, or made up
            thief.Send(bytes, PeerAddress.Virtual(0));
        }

        group.Run(1);
        Assert.Equal(ignored + 100, group.Host.Counters.DatagramsIgnored);
        Assert.Equal(there, group.Host.Links[0].Address);
        group.Do(1, PlayerAction.Impulse(First, V(0, 1)));
        Assert.True(group.Settle(1, 1));
    }

    [Fact]
    public void Update_FromAnotherAddress_IsAnsweredWithAChallengeAndNothingOfItIsTaken()
    {
        (SessionGroup group, NatPort nat) = Two();
        byte[]? copied = null;
        group.Network.Lose((from, _, datagram) =>
        {
            bool isIt = from == 1 && copied is null && datagram.Span[3] == (byte)DatagramType.Update;
            copied = isIt ? datagram.ToArray() : copied;
            return isIt; // the host gets it from somebody else first
        });
        group.Do(1, PlayerAction.Impulse(First, V(0, 1)));
        group.Run(0.001);
        Assert.NotNull(copied);
        nat.Place(9, 9, 9000);
        IDatagramPort thief = group.Network.CreatePort(9);
        thief.Send(copied, PeerAddress.Virtual(0));
        group.Run(0.001);
        Assert.Equal(0, group.Host.Counters.EventsAccepted);
        byte[] buffer = new byte[WireFormat.MaxBytes];
        Assert.True(thief.TryReceive(buffer, out int length, out _));
        Assert.True(MoveChallengeDatagram.TryDecode(buffer.AsSpan(0, length), out _, out _));
        Assert.False(thief.TryReceive(buffer, out _, out _));
        Assert.True(group.Settle(1, 1));
        Assert.Equal(NatPort.Address(1, 2000), group.Host.Links.Single().Address);
    }

    private static (SessionGroup Group, NatPort Nat) Two()
    {
        NatPort? nat = null;
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.Loopback, wrap: (node, port) => node == 0 ? nat = new NatPort(port) : port);
        nat!.Place(1, 1, 2000);
        group.Connect().Run(0.5);
        return (group, nat);
    }
}
