using System;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>Actions for a future instant, and what a spawn belongs to, over links.</summary>
public sealed class SchedulingTests
{
    private static readonly Scene Scene = new SceneBuilder("scheduling").AddPlane("floor", Vector3D.Up, -50.0)
        .AddBody("a", Ball(), V(0)).AddBody("b", Ball(), V(9, -49.4)).Build(); // one that bounces all the time

    private readonly SessionGroup group = new SessionGroup(Scene, 3, LinkProfiles.PureDelay(20)).Connect();

    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    public void Do_ForAFutureInstant_HappensThenOnEveryPeerAndNobodyHeals(int peer)
    {
        Session me = group.Sessions[peer];
        SimTime at = me.SharedTime.Now + me.MaxAhead;
        ExternalEvent done = me.Do(PlayerAction.SetVelocity(First, V(1)), at);
        group.Steps.Wake(peer);
        Assert.Equal(at, done.Time);
        Assert.True(group.Settle(1));
        Assert.Equal(1, group.Host.Counters.EventsAccepted);
        Assert.True(group.Host.SharedTime.Now < at); // it was judged, and told, before its time
        group.Run(2);
        Assert.All(group.Sessions, s => Assert.True(s.World!.Simulation.TookEffect(done)));
        Assert.All(group.Sessions, s => Assert.Equal(0, s.Counters.Heals));
        Assert.Null(group.Difference());
    }

    [Fact]
    public void Do_TooFarAheadOrInThePast_IsRefusedWithASentenceAndSendsNothing()
    {
        Session me = group.Sessions[1];
        SimTime now = me.SharedTime.Now;
        Assert.Equal(SimDuration.FromMilliseconds(500), me.MaxAhead);
        foreach (SimTime at in new[] { now + me.MaxAhead + SimDuration.FromMilliseconds(1), now - SimDuration.OneTick, SimTime.MinValue, SimTime.MaxValue })
        {
            ArgumentOutOfRangeException no = Assert.Throws<ArgumentOutOfRangeException>(() => me.Do(PlayerAction.SetVelocity(First, V(1)), at));
            Assert.Contains("An action can be done from now", no.Message, StringComparison.Ordinal);
        }

        group.Run(1);
        Assert.Empty(group.Log);
    }

    /// <summary>The control of the limit: a host says no to what a client claims for later than that.</summary>
    [Fact]
    public void Claim_BeyondTheHistory_IsTooEarlyForTheHost()
    {
        RawClient liar = new(group);
        SimTime now = group.Host.SharedTime.Now;
        liar.Claim(
            1, ExternalEvent.SetVelocity(now + SimDuration.FromSeconds(0.9), liar.Peer, 1, First, V(1)),
            ExternalEvent.SetVelocity(now + SimDuration.FromSeconds(1.5), liar.Peer, 2, First, V(1)));
        group.Run(0.1);
        Assert.Equal([Verdict.Accepted, Verdict.TooEarly], group.Log.Values.Select(e => e.Verdict));
    }

    [Fact]
    public void Do_ToABodyThatBelongsToOthers_ThrowsHereAndIsRefusedByTheHost()
    {
        byte owner = group.Sessions[1].Peer;
        ExternalEvent spawn = group.Do(1, PlayerAction.Spawn(Ball(), V(0, 8), players: PeerSet.Of(owner)));
        Assert.True(group.Settle(1));
        group.Run(0.5);
        SceneException no = Assert.Throws<SceneException>(() => group.Do(2, PlayerAction.SetVelocity(spawn.Body, V(1))));
        Assert.Equal($"Peer {group.Sessions[2].Peer} may not touch the spawned body {spawn.Body}; those who may: {owner}.", no.Message);
        group.Do(1, PlayerAction.SetVelocity(spawn.Body, V(1)));
        Assert.True(group.Settle(2));
        RawClient liar = new(group);
        liar.Claim(1, ExternalEvent.SetVelocity(group.Host.SharedTime.Now, liar.Peer, 1, spawn.Body, V(0, 5)));
        group.Run(0.2);
        Assert.Equal(Verdict.NoRight, group.Log[3].Verdict);
        Assert.Null(group.Difference());
    }
}
