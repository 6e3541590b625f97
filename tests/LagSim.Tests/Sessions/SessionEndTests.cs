using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>How a session begins and ends, for programs.</summary>
public sealed class SessionEndTests
{
    [Fact]
    public void Leave_OfClientAndHost_IsToldApart()
    {
        SessionGroup group = new(ScriptedActions.Box(), 3, LinkProfiles.PureDelay(5));
        List<string> told = Listen(group);
        group.Connect();
        Assert.All(group.Sessions, s => Assert.Equal(SessionEnd.None, s.EndedBy));
        group.Sessions[1].Leave();
        group.Run(0.5);
        Assert.Equal([SessionEnd.None, SessionEnd.Left, SessionEnd.None], group.Sessions.Select(s => s.EndedBy));
        group.Host.Leave();
        group.Host.Leave();
        group.Run(0.5);
        Assert.Equal([SessionEnd.Left, SessionEnd.Left, SessionEnd.HostEnded], group.Sessions.Select(s => s.EndedBy));
        Assert.Equal(["0 begun", "0 ended", "1 begun", "1 ended", "2 begun", "2 ended"], told.Order()); // each once
    }

    [Fact]
    public void Silence_OfTheHost_IsToldApartFromThatOfThePeer()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 3, LinkProfiles.PureDelay(5), options: _ => new HostOptions { RejoinTime = SimDuration.FromSeconds(20) }).Connect();
        group.Cut(0, 1);
        group.Cut(2, 0);
        group.Run(15);
        Assert.All(group.Sessions.Skip(1), s => Assert.Equal(SessionState.Rejoining, s.State)); // they ask to be let in again
        Assert.True(group.RunUntil(() => group.Sessions.Skip(1).All(s => s.State == SessionState.Ended), 40));
        Assert.EndsWith("This peer asked for 20 s to be let in again, in vain.", group.Sessions[1].EndReason, System.StringComparison.Ordinal);
        Assert.Equal([SessionEnd.None, SessionEnd.HostSilent, SessionEnd.Disconnected], group.Sessions.Select(s => s.EndedBy));
    }

    [Fact]
    public void Join_RefusedOrWithoutAnswer_IsToldApart()
    {
        SessionGroup group = new(
            ScriptedActions.Box(), 3, LinkProfiles.PureDelay(5), options: peer => new HostOptions { ConnectKey = peer == 1 ? "wrong" : "" }, expected: 2);
        List<string> told = Listen(group);
        group.Cut(0, 2);
        Assert.True(group.RunUntil(() => group.Sessions.Skip(1).All(s => s.State == SessionState.Ended), 40));
        Assert.Equal([SessionEnd.None, SessionEnd.Refused, SessionEnd.HostSilent], group.Sessions.Select(s => s.EndedBy));
        Assert.Equal(["1 ended", "2 ended"], told.Order());
    }

    [Fact]
    public void Silence_BeforeTheFirstStep_IsNotTheHosts()
    {
        VirtualClock clock = new(SimTime.FromSeconds(10));
        using Net.Carriers.IDatagramPort port = new VirtualNetwork(clock, 1).CreatePort(1);
        ClientSession client = new(null, port, clock, new ClientOptions(), Net.Carriers.PeerAddress.Virtual(0), 1);
        clock.Now += SimDuration.FromSeconds(11);
        client.Step();
        Assert.Equal(SessionState.Joining, client.State);
        clock.Now += SimDuration.FromSeconds(11); // it sleeps again
        client.Step();
        Assert.Equal(SessionState.Joining, client.State);
        for (int second = 0; second < 11; second++)
        {
            clock.Now += SimDuration.FromSeconds(1); // and now it listens
            client.Step();
        }

        Assert.Equal(SessionEnd.HostSilent, client.EndedBy);
    }

    [Fact]
    public void World_ThatCannotGoOn_IsAFailure()
    {
        // A program's own acceleration that has no number any more.
        LagSim.Scenes.Scene broken = new LagSim.Scenes.SceneBuilder("broken")
            .AddForce(LagSim.Scenes.Force.Supplied(new FunctionForce((t, _, _) => V(t > 0.5 ? double.NaN : 0))), out LagSim.Scenes.ForceSet own)
            .AddBody("dust", new LagSim.Scenes.BodySpec(0.1, 1, 1, forces: own), V(0, 1)).Build();
        SessionGroup group = new(broken, 1, LinkProfiles.PureDelay(5));
        Assert.True(group.RunUntil(() => group.Host.State == SessionState.Ended));
        Assert.Equal(SessionEnd.Failed, group.Host.EndedBy);
    }

    [Fact]
    public void LogStart_OfALateClient_IsWhatItsSnapshotHas()
    {
        SessionGroup group = new(ScriptedActions.Box(), 3, LinkProfiles.PureDelay(5), expected: 1);
        group.Cut(2, 0);
        Assert.True(group.RunUntil(() => group.Sessions.Take(2).All(s => s.State == SessionState.Running)));
        group.Do(0, PlayerAction.Teleport(First, V(0, 4)));
        group.Do(0, PlayerAction.Impulse(Second, V(1, 4)));
        group.Run(2);
        List<uint> told = [];
        group.Sessions[2].Logged += entry => told.Add(entry.Index);
        group.Restore(2, 0);
        Assert.True(group.RunUntil(() => group.Sessions[2].State == SessionState.Running));
        group.Do(1, PlayerAction.Remove(Third));
        Assert.True(group.Settle(3));
        Assert.Equal([0u, 0u, 2u], group.Sessions.Select(s => s.LogStart));
        Assert.Equal([3u], told);
        Assert.Equal([true, true, false], group.Sessions.Select(s => s.BegunFrom is null));
        Assert.Equal(group.Host.World!.Simulation.Start, group.Sessions[2].BegunFrom!.Start);
    }

    [Fact]
    public void Begin_WithoutEvents_TakesFewDatagrams()
    {
        // Until a client says that it has begun, the host tells it the start again and again; so it says so at once.
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5));
        Assert.True(group.RunUntil(() => group.Host.World is not null));
        long before = group.Host.Counters.DatagramsSent;
        group.Run(1.5);
        Assert.InRange(group.Host.Counters.DatagramsSent - before, 1, 4);
    }

    [Fact]
    public void Flush_OfTheHost_HasClientsCommitAtOnce()
    {
        SimTime[] committed = new SimTime[2];
        for (int n = 0; n < 2; n++)
        {
            SessionGroup group = new SessionGroup(
                ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5), options: _ => new HostOptions { KeepAlive = SimDuration.FromSeconds(3) }).Connect();
            group.Run(3.9);
            if (n == 1)
            {
                group.Host.Flush();
            }

            group.Run(0.05);
            committed[n] = group.Sessions[1].Committed!.Value.Time;
        }

        Assert.True(committed[1] > committed[0], $"{committed[1]} {committed[0]}");
    }

    private static List<string> Listen(SessionGroup group)
    {
        List<string> told = [];
        for (int peer = 0; peer < group.Sessions.Count; peer++)
        {
            int number = peer;
            group.Sessions[peer].Begun += () => told.Add($"{number} begun");
            group.Sessions[peer].Ended += () => told.Add($"{number} ended");
        }

        return told;
    }
}
