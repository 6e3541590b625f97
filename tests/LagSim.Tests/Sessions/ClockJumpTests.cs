using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Testing.Links;
using LagSim.Testing.Running;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>A machine that slept, or whose clock was set: its player is told, and not left to do what all others refuse.</summary>
public sealed class ClockJumpTests
{
    [Theory]
    [InlineData(0.5, false)]
    [InlineData(5, true)]
    [InlineData(60, true)]
    [InlineData(-5, true)]
    public void Clock_ThatJumps_HasTheWorldReplacedIfByMoreThanTheHistory(double seconds, bool isReplaced)
    {
        VirtualClock clock = new(SimTime.FromSeconds(10));
        VirtualNetwork network = new(clock, 1, LinkProfiles.Lan);
        VirtualSteps steps = new(network);
        IDatagramPort hostPort = network.CreatePort(0), port = network.CreatePort(1);
        HostSession host = new(ScriptedActions.Box(), hostPort, clock, new HostOptions(), 1);
        JumpingClock own = new(clock);
        ClientSession client = new(null, port, own, new ClientOptions(), PeerAddress.Virtual(0), 4);
        steps.Add(host, hostPort);
        steps.Add(client, port);
        steps.RunFor(SimDuration.FromSeconds(5));
        Assert.Equal(SessionState.Running, client.State);

        List<string> renewed = [];
        client.Renewed += renewed.Add;
        own.Jump += SimDuration.FromSeconds(seconds);
        steps.RunFor(SimDuration.FromSeconds(30));
        Assert.Equal((SessionState.Running, 1), (client.State, client.Peer));
        if (isReplaced)
        {
            Assert.Matches(
                $"^This machine's clock and the host's are {Math.Abs(seconds)}[0-9.]* s further apart than before: ",
                Assert.Single(renewed).Replace("4.99", "5", StringComparison.Ordinal).Replace("59.99", "60", StringComparison.Ordinal));
        }
        else
        {
            Assert.Empty(renewed);
        }

        ExternalEvent external = client.Do(PlayerAction.Impulse(First, V(0, 1)));
        steps.RunFor(SimDuration.FromSeconds(5));
        Assert.Equal((1L, 0L, 0L), (host.Counters.EventsAccepted, host.Counters.EventsRefused, client.Counters.StatesDiffered));
        Assert.Equal(client.Peer, external.Peer);
    }

    private sealed class JumpingClock(IClock inner) : IClock
    {
        internal SimDuration Jump { get; set; }

        public SimTime Now => inner.Now + Jump;
    }
}
