using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>Players whom the host sends away, whom it shuts out, and what it removes of theirs.</summary>
public sealed class SentAwayTests
{
    private static readonly BodySpec Ball = new(0.25, 1, 0.5);

    [Theory]
    [InlineData(false)]
    [InlineData(true)] // the goodbyes are lost: it is told in answer to what it says next
    public void Kick_APlayer_EndsItsSessionWithASentenceAndNobodyElses(bool isLost)
    {
        SessionGroup group = Three();
        if (isLost)
        {
            group.Cut(0, 1);
        }

        byte player = group.Client(1).Peer;
        Assert.True(group.Host.Kick(player));
        group.Run(0.2);
        if (isLost)
        {
            group.Restore(0, 1);
            group.Run(6);
        }

        Assert.Equal((SessionState.Ended, SessionEnd.Kicked), (group.Sessions[1].State, group.Sessions[1].EndedBy));
        Assert.Equal("The host sent this player away.", group.Sessions[1].EndReason);
        Assert.Equal(1, group.Host.ClientCount);
        Assert.False(group.Host.Kick(player));
        group.Do(2, PlayerAction.SetVelocity(BodyId.OfScene(0), new Vector3D(1, 0, 0)));
        group.Settle(1);
        group.Run(3);
        Assert.Equal((SessionState.Running, 0, true), (group.Sessions[2].State, group.Sessions[2].Counters.StatesDiffered, group.Sessions[2].Counters.StatesAgreed > 0));
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Kick_OrBan_ItComesAgain_OnlyIfNotBanned(bool isBanned)
    {
        SessionGroup group = Three();
        byte player = group.Client(1).Peer;
        PeerAddress? machine = isBanned ? group.Host.Ban(player) : group.Host.Kick(player) ? null : throw new InvalidOperationException();
        group.Run(0.2);
        ClientSession again = Again(group, 77);
        Assert.Equal(isBanned ? (SessionState.Ended, SessionEnd.Refused) : (SessionState.Running, SessionEnd.None), (again.State, again.EndedBy));
        if (isBanned)
        {
            Assert.Equal("The host refused: it has shut out this player, or this address.", again.EndReason);
            Assert.True(group.Host.Unban(machine!.Value));
            Assert.False(group.Host.Unban(machine.Value));
            Assert.Equal(SessionState.Running, Again(group, 78).State);
        }
    }

    /// <summary>Another link of the same player, which its key proves, is fetching its copy: after a ban it gets no number, after a kick it does.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Kick_OrBan_APlayerThatIsComingAgainAlready_OnlyIfNotBanned(bool isBanned)
    {
        ClientOptions own = new() { ConnectKey = "mine" };
        SessionGroup group = new SessionGroup(
            ScriptedActions.Box(), 2, LinkProfiles.PureDelay(20), options: peer => peer > 0 ? own : new HostOptions { PlayerKeys = new Dictionary<byte, string> { [3] = "mine" } }).Connect();
        ClientSession again = group.Join(7, 77, own);
        Assert.True(group.RunUntil(() => group.Host.ComingCount == 1, 3));
        Assert.True(isBanned ? group.Host.Ban(3) is not null : group.Host.Kick(3));
        group.Run(3);
        Assert.Equal(SessionEnd.Kicked, group.Client(1).EndedBy);
        Assert.Equal(isBanned ? (SessionState.Ended, SessionEnd.Refused, 0) : (SessionState.Running, SessionEnd.None, 1), (again.State, again.EndedBy, group.Host.ClientCount));
    }

    /// <summary>Who shows the pass of a player that was sent away is a new player; who was only silent gets its own again.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Kick_APlayer_VoidsItsPass(bool isKicked)
    {
        SessionGroup group = new(ScriptedActions.Box(), 3, LinkProfiles.PureDelay(20));
        List<PlayerPass> passes = [];
        group.Client(1).PassGiven += passes.Add;
        group.Connect();
        if (isKicked)
        {
            group.Host.Kick(group.Client(1).Peer);
            group.Run(0.2);
        }

        ClientSession again = Again(group, 79, new ClientOptions { Pass = passes[^1] }, passes.Add);
        Assert.Equal(SessionState.Running, again.State);
        Assert.Equal((2, isKicked), (passes.Count, passes[0] != passes[1]));
    }

    [Fact]
    public void RemoveBodiesOf_APlayerWhoIsGone_RemovesWhatItSpawnedAndNothingElseForAll()
    {
        SessionGroup group = Three();
        for (int n = 0; n < 5; n++)
        {
            group.Do(1, PlayerAction.Spawn(Ball, new Vector3D((0.7 * n) - 1.4, 3, 0.5), default));
        }

        BodyId other = group.Do(2, PlayerAction.Spawn(Ball, new Vector3D(0, 4, -0.5), default)).Body;
        group.Settle(6);
        byte player = group.Client(1).Peer;
        group.Host.Kick(player);
        group.Run(0.5);
        Assert.Equal(5, group.Host.RemoveBodiesOf(player));
        group.Settle(11);
        Assert.Equal(0, group.Host.RemoveBodiesOf(player));
        foreach (int peer in new[] { 0, 2 })
        {
            Simulation world = group.Sessions[peer].World!.Simulation;
            BodyId[] there = [.. Enumerable.Range(0, world.BodyCount).Select(world.BodyAt).Where(body => world.TryRead(body, world.SimulatedTo, out _))];
            Assert.DoesNotContain(there, body => body.Peer == player);
            Assert.Contains(other, there);
        }

        Assert.Null(group.Difference());
    }

    [Fact]
    public void Kick_NoPlayersNumber_IsRefusedWithTheRange()
    {
        SessionGroup group = Three();
        foreach (Action call in new Action[] { () => group.Host.Kick(0), () => group.Host.Ban(SessionOptions.MaxNumber + 1), () => group.Host.RemoveBodiesOf(255) })
        {
            Assert.Matches($"1 to ({SessionOptions.MaxClients}|{SessionOptions.MaxNumber})", Assert.Throws<ArgumentOutOfRangeException>(call).Message);
        }

        Assert.False(group.Host.Kick(SessionOptions.MaxClients));
        Assert.Null(group.Host.Ban(SessionOptions.MaxClients));
    }

    /// <summary>From the address of the one that was sent away.</summary>
    private static ClientSession Again(SessionGroup group, ulong nonce, ClientOptions? options = null, Action<PlayerPass>? onPass = null)
    {
        ClientSession session = new(null, group.Ports[1], new SkewedClock(group.Clock, 0, default), options ?? new ClientOptions(), PeerAddress.Virtual(0), nonce);
        session.PassGiven += pass => onPass?.Invoke(pass);
        group.Steps.Replace(1, session, group.Ports[1]);
        group.Run(3);
        return group.Client(1);
    }

    private static SessionGroup Three()
    {
        SessionGroup group = new(ScriptedActions.Box(), 3, LinkProfiles.PureDelay(20));
        group.Connect();
        return group;
    }
}
