using System;
using System.Linq;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>Who is disturbed on its way in, by a changed address or by others who come in, gets in all the same.</summary>
public sealed class ComingInAgainTests
{
    private const int Node = 5;

    /// <summary>A cookie is good for one address. Who has one and is seen at another from then on cannot know why nobody answers.</summary>
    [Theory]
    [InlineData((byte)DatagramType.Challenge)]
    [InlineData((byte)DatagramType.Welcome)]
    [InlineData((byte)DatagramType.SnapshotChunk)]
    [InlineData((byte)DatagramType.Seat)]
    public void Join_AddressThatChangesOnTheWayIn_GetsInWithinASecondMore(byte after)
    {
        (SessionGroup group, NatPort nat) = Host();
        nat.Place(Node, 1, 1000);
        bool hasMoved = false;
        group.Network.Lose((from, to, datagram) =>
        {
            // It moves as the answer leaves for where it was: that one still arrives, or not.
            if (!hasMoved && to == Node && datagram.Span[3] == after)
            {
                hasMoved = true;
                nat.Place(Node, 1, 2000);
                return (DatagramType)after is DatagramType.Welcome or DatagramType.Seat;
            }

            return false;
        });
        ClientSession client = group.Join(Node, 99);
        Assert.True(group.RunUntil(() => client.State == SessionState.Running, 1.5), $"{client.State} {client.EndReason}");
        Assert.True(hasMoved);
        Assert.Equal(NatPort.Address(1, 2000), group.Host.Links.Single().Address);
    }

    [Fact]
    public void Join_PushedOutByOthersOfItsMachine_AsksAgain()
    {
        // It is slow to fetch, and behind one NAT with somebody who comes in again and again for a while.
        (SessionGroup group, NatPort nat) = Host(BuiltInScenes.Crowd(400));
        nat.Place(Node, 1, 1000);
        group.Network.Connect(Node, 0, LinkProfiles.PureDelay(200));
        Intruder[] others = Enumerable.Range(0, 16).Select(n => Neighbour(group, nat, n)).ToArray();
        ClientSession client = group.Join(Node, 99);
        Assert.True(group.RunUntil(() => client.State == SessionState.Synchronising, 2));
        for (int n = 0; n < 10; n++)
        {
            Array.ForEach(others, one => one.ConnectRequest());
            group.Run(0.1);
            Assert.NotEqual(SessionState.Ended, client.State);
        }

        Assert.Equal(16, group.Host.ComingCount); // it is not among them, or has just come back
        Assert.True(group.RunUntil(() => client.State == SessionState.Running, 5), $"{client.State} {client.EndReason}");
        Assert.Equal(0, client.Counters.Renewals);
    }

    [Fact]
    public void Join_PushedOutForGood_EndsWithASentence()
    {
        (SessionGroup group, NatPort nat) = Host(BuiltInScenes.Crowd(400));
        nat.Place(Node, 1, 1000);
        group.Network.Connect(Node, 0, LinkProfiles.PureDelay(200));
        Intruder[] others = Enumerable.Range(0, 16).Select(n => Neighbour(group, nat, n)).ToArray();
        ClientSession client = group.Join(
            Node, 99, new ClientOptions { RejoinTime = SimDuration.Zero, Timeout = SimDuration.FromSeconds(3) });
        SimTime began = group.Clock.Now;
        while (client.State != SessionState.Ended && group.Clock.Now - began < SimDuration.FromSeconds(20))
        {
            Array.ForEach(others, one => one.ConnectRequest());
            group.Run(0.1);
        }

        Assert.Equal((SessionState.Ended, SessionEnd.Disconnected), (client.State, client.EndedBy));
        Assert.Equal("The host does not have this peer among its clients, or no longer.", client.EndReason);
    }

    private static Intruder Neighbour(SessionGroup group, NatPort nat, int n)
    {
        nat.Place(100 + n, 1, 3000 + n);
        return new Intruder(group, 100 + n);
    }

    private static (SessionGroup Group, NatPort Nat) Host(LagSim.Scenes.Scene? scene = null)
    {
        NatPort? nat = null;
        SessionGroup group = new(
            scene ?? ScriptedActions.Box(), 1, LinkProfiles.PureDelay(20), wrap: (node, port) => node == 0 ? nat = new NatPort(port) : port);
        group.Connect();
        return (group, nat!);
    }
}
