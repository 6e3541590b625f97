using System;
using System.Linq;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Strategies;
using LagSim.Net.Wire;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

public sealed class JoiningTests
{
    [Theory]
    [InlineData("loopback", 0.05)]
    [InlineData("delay-25ms", 0.05)]
    [InlineData("delay-500ms", 0.2)]
    [InlineData("awful", 100)]
    public void Join_ClocksAnHourApart_SetsItsClockBeforeItsFirstTick(string link, double boundMilliseconds)
    {
        SessionGroup group = new(ScriptedActions.Box(), 3, Profile(link), 3);
        bool hadWorld = false;
        group.BeforeStep = peer =>
        {
            Session session = group.Sessions[peer];
            Assert.True(session.World is null || session.SharedTime.IsSet, $"peer {peer} had a world before it had the time");
            if (peer != 0 && session.World is not null)
            {
                hadWorld = true;
                Assert.True(group.Client(peer).ClockSync.SampleCount >= 8);
            }
        };
        group.Connect().Run(0.1);
        Assert.True(hadWorld);
        foreach (Session session in group.Sessions)
        {
            Assert.Equal(group.Host.World!.Simulation.Start, session.World!.Simulation.Start);
            Near(group.Host.SharedTime.Now.ToSeconds(), session.SharedTime.Now.ToSeconds(), boundMilliseconds / 1000);
        }

        // Nothing of this would be so by the clocks as they came.
        Assert.True(group.Sessions.Skip(1).All(s => Math.Abs(s.SharedTime.Offset.ToSeconds()) > 1));
        Assert.Equal(new byte[] { 0, 1, 2 }, group.Sessions.Select(s => s.Peer).Order().ToArray());
    }

    [Fact]
    public void SharedTime_OfARunningClient_NeverStepsNorGoesBack()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.Awful, 7).Connect();
        SimTime before = group.Sessions[1].SharedTime.Now, beforeTrue = group.Clock.Now;
        group.BeforeStep = _ =>
        {
            SimTime now = group.Sessions[1].SharedTime.Now;
            double passed = (group.Clock.Now - beforeTrue).ToSeconds();
            Assert.InRange((now - before).ToSeconds(), passed * 0.949, (passed * 1.051) + 1e-9);
            (before, beforeTrue) = (now, group.Clock.Now);
        };
        group.Run(20);
        Assert.Equal(SessionState.Running, group.Sessions[1].State);
    }

    [Fact]
    public void Join_WrongKey_EndsWithASentence()
    {
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.Lan, options: peer => new HostOptions { ConnectKey = $"key {peer}" });
        Assert.True(group.RunUntil(() => group.Sessions[1].State == SessionState.Ended, 5));
        Assert.Equal("The host refused: the key is wrong.", group.Sessions[1].EndReason);
        Assert.Equal(0, group.Host.ClientCount);
        Assert.Equal(SessionState.Waiting, group.Host.State);
    }

    [Fact]
    public void Join_AnotherScene_EndsWithASentence()
    {
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.Lan, scenes: peer => ScriptedActions.Box(peer == 0 ? 0.8 : 0.81));
        Assert.True(group.RunUntil(() => group.Sessions[1].State == SessionState.Ended, 5));
        Assert.Equal("The host refused: it has another scene now. A session keeps its scene; start a new one to join that.", group.Sessions[1].EndReason);
    }

    [Fact]
    public void Join_SessionFull_EndsWithASentenceAndTheOthersGoOn()
    {
        SessionGroup group = new(ScriptedActions.Box(), SessionOptions.MaxClients + 2, LinkProfiles.Lan, expected: SessionOptions.MaxClients);
        Assert.True(group.RunUntil(() => group.Sessions.Count(s => s.State == SessionState.Running) == SessionOptions.MaxClients + 1 && group.Sessions.Any(s => s.State == SessionState.Ended), 5));
        Assert.Equal("The host refused: the session is full.", group.Sessions.Single(s => s.State == SessionState.Ended).EndReason);
        Assert.Equal(SessionOptions.MaxClients, group.Host.ClientCount);
    }

    [Fact]
    public void Join_HostOfAnotherVersion_EndsWithASentence()
    {
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5));
        group.Cut(1, 0);
        group.Run(0.1);
        byte[] bytes = new byte[WireFormat.RefusalBytes];
        new RefusalDatagram(1 + 1, RefusalReason.VersionDiffers).Encode(bytes); // the group's nonces are seed + peer
        bytes[2] = 77; // as a host of version 77 sends it
        group.Ports[0].Send(bytes, PeerAddress.Virtual(1));
        group.Run(0.1);
        Assert.Equal($"The host refused: it speaks version 77 of the protocol, this peer {Session.WireVersion}.", group.Sessions[1].EndReason);
    }

    [Fact]
    public void Join_RefusalOfAnotherNonce_IsIgnoredAndCounted()
    {
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5));
        byte[] bytes = new byte[WireFormat.RefusalBytes];
        new RefusalDatagram(99, RefusalReason.Full).Encode(bytes);
        group.Ports[0].Send(bytes, PeerAddress.Virtual(1));
        group.Connect();
        Assert.Equal(1, group.Sessions[1].Counters.DatagramsIgnored);
    }

    [Fact]
    public void Join_NobodyThere_EndsAfterTheTimeoutWithASentence()
    {
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.Lan, options: _ => new HostOptions { Timeout = SimDuration.FromSeconds(1.5), KeepAlive = SimDuration.FromSeconds(0.5) });
        group.Cut(1, 0);
        group.Run(1.4);
        Assert.Equal(SessionState.Joining, group.Sessions[1].State);
        group.Run(0.2);
        Assert.Equal(SessionState.Ended, group.Sessions[1].State);
        Assert.Equal("No answer from the host within 1.5 s.", group.Sessions[1].EndReason);
    }

    [Fact]
    public void Join_WrongKeyFromTheAddressOfAClient_DoesNotThrowThatOneOut()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.Lan).Connect();
        byte[] bytes = new byte[WireFormat.JoinBytes];
        new JoinDatagram(777, default, JoinCookies.Prove("wrong", 777, default), group.Scene.Hash, (uint)Simulation.FoldVersion).Encode(bytes);
        group.Ports[1].Send(bytes, PeerAddress.Virtual(0));
        group.Run(0.2);
        Assert.Equal(1, group.Host.ClientCount);
        group.Do(1, Events.PlayerAction.Teleport(First, V(0, 4)));
        Assert.True(group.Settle(1, 5));
    }

    [Fact]
    public void Host_ExpectsTwoClientsAndHasOne_DoesNotStart()
    {
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.Lan, expected: 2);
        group.Run(5);
        Assert.Equal([SessionState.Waiting, SessionState.Waiting], group.Sessions.Select(s => s.State));
        Assert.Throws<InvalidOperationException>(() => group.Do(1, Events.PlayerAction.Teleport(First, V(0, 4))));
    }

    [Theory]
    [InlineData(0.01, "Timeout")]
    [InlineData(1000, "Timeout")]
    [InlineData(1, "KeepAlive", 0.5)]
    public void Session_OptionOutOfRange_IsRefusedByName(double timeout, string named, double? keepAlive = null)
    {
        using IDatagramPort port = new VirtualNetwork(new VirtualClock(), 1).CreatePort(0);
        HostOptions options = new() { Timeout = SimDuration.FromSeconds(timeout) };
        options = keepAlive is double given ? options with { KeepAlive = SimDuration.FromSeconds(given) } : options;
        ArgumentOutOfRangeException refused = Assert.Throws<ArgumentOutOfRangeException>(
            () => new HostSession(ScriptedActions.Box(), port, new VirtualClock(), options, 1));
        Assert.Equal(named, refused.ParamName);
        Assert.Contains("must lie between", refused.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Session_UnknownStrategy_IsRefusedWithTheNamesThereAre()
    {
        using IDatagramPort port = new VirtualNetwork(new VirtualClock(), 1).CreatePort(0);
        ArgumentOutOfRangeException refused = Assert.Throws<ArgumentOutOfRangeException>(
            () => new HostSession(ScriptedActions.Box(), port, new VirtualClock(), new HostOptions { Strategy = (LateEventStrategy)9 }, 1));
        Assert.Equal((LateEventStrategy)9, refused.ActualValue);
        Assert.Contains(
            "there are Healing, FullRollback, Interpolation, LatencyForward, ApplyOnArrival", refused.Message, StringComparison.Ordinal);
        ArgumentException unnamed = Assert.Throws<ArgumentException>(() => LateEventStrategies.OfName("guess"));
        Assert.Contains("'guess'; there are none, latency-forward, interpolation, full-rollback, healing", unnamed.Message, StringComparison.Ordinal);
        Assert.Equal(Enum.GetValues<LateEventStrategy>(), LateEventStrategies.Names.Select(LateEventStrategies.OfName).Order());
    }

    private static LinkProfile Profile(string name) => LinkProfiles.TryGet(name, out LinkProfile? known, out _) ? known : throw new ArgumentException(name);
}
