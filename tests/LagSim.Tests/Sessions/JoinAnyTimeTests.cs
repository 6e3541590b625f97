using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>Who joins a running session has the world that it would have, had it been there from the start.</summary>
public sealed class JoinAnyTimeTests
{
    [Fact]
    public void Join_AtHundredMomentsOfRunningBilliards_IsTheSameEachTime()
    {
        SessionGroup group = new SessionGroup(BuiltInScenes.Billiards(), 2, LinkProfiles.PureDelay(20), 5).Connect();
        Random random = new(1);
        int moving = 0;
        long loggedBefore = 0;
        for (int i = 0; i < 100; i++)
        {
            for (int kicks = 0; kicks < 3; kicks++)
            {
                Kick(group, random);
                group.Run(random.NextDouble() * 0.3);
            }

            ClientSession client = group.Join(100 + i, (ulong)(1000 + i));
            Assert.True(group.RunUntil(() => client.State == SessionState.Running, 5), client.EndReason);
            Kick(group, random);
            group.Do(2, PlayerAction.SetVelocity(BodyId.OfScene(random.Next(16)), V(random.NextDouble() - 0.5, 0, random.NextDouble() - 0.5)));
            Kick(group, random);
            group.Run(0.5);
            loggedBefore = Math.Max(loggedBefore, client.World!.Simulation.HistoryEdge > group.Host.World!.Simulation.Start ? 1 : 0);
            string? difference = group.Difference();
            Assert.True(difference is null, $"join {i}: {difference}");
            Assert.Equal(0, client.Counters.EventsLost + client.Counters.StatesDiffered);
            moving += Enumerable.Range(0, 16).Count(n => Read(client.World.Simulation, BodyId.OfScene(n), client.World.Simulation.SimulatedTo).Velocity != Vector3D.Zero);
            client.Leave();
            group.Run(0.05);
            Assert.Equal(1, group.Host.ClientCount);
            group.DropLast();
        }

        Assert.Equal(1, loggedBefore); // it did not begin from the start
        Assert.True(moving > 500, $"{moving}"); // nor were all at rest
    }

    [Theory]
    [InlineData("awful", 1)]
    [InlineData("awful", 2)]
    [InlineData("wifi-busy", 3)]
    [InlineData("starlink", 4)]
    [InlineData("blackout", 5)]
    public void Join_AgainAndAgainOverABadLinkWhileAllSortsIsDone_IsTheSameEachTime(string link, int seed)
    {
        // Spawns, removals, bodies on Runge-Kutta, others who act during the join; three addresses in turn, of which some leave and some just vanish.
        const int joins = 9;
        Assert.True(LinkProfiles.TryGet(link, out LinkProfile? profile, out _));
        HostOptions Options() => new() { Window = new(SimDuration.FromSeconds(3)) };
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 3, profile, (ulong)seed, _ => Options()).Connect();
        ScriptedActions actions = new(seed, maxSpawns: 20);
        Random random = new(seed);
        HashSet<(byte Peer, uint Sequence)> judged = [];
        group.Host.Logged += entry => judged.Add((entry.Event.Peer, entry.Event.Sequence));
        List<ExternalEvent> done = [];
        int late = 0;
        for (int i = 0; i < joins; i++)
        {
            done.AddRange(actions.DoIn(group, 3));
            group.Run(random.NextDouble() * 2);
            ClientSession client = group.Join(100 + (i % 3), (ulong)(1000 + i + (100 * seed)), ClientOptions.From(Options()));
            for (int tries = 0; tries < 200 && client.State is not (SessionState.Running or SessionState.Ended); tries++)
            {
                if (tries % 3 == 0)
                {
                    done.Add(group.Do(random.Next(3), PlayerAction.SetVelocity(BodyId.OfScene(random.Next(4)), V(random.NextDouble() - 0.5, random.NextDouble() * 3))));
                }

                group.Run(0.1);
            }

            Assert.True(client.State == SessionState.Running, $"join {i}: {client.State} {client.EndReason}");
            late += client.BegunFrom is null ? 0 : 1;
            done.AddRange(actions.DoIn(group, 6));
            Assert.True(group.RunUntil(() => done.All(e => judged.Contains((e.Peer, e.Sequence))) && group.Sessions.All(s => s.LogLength == group.Host.LogLength), 30), $"join {i} does not settle");
            group.Run(0.5);
            string? difference = group.Difference();
            Assert.True(difference is null, $"join {i}: {difference}");
            Assert.All(group.Sessions, s => Assert.Equal(0, s.Counters.EventsLost + s.Counters.StatesDiffered + s.Counters.EventsForged));
            if (i % 2 == 0)
            {
                client.Leave();
            }

            group.Run(0.01 * random.Next(3));
            group.DropLast();
        }

        Assert.True(late > joins / 2, $"{late} went on from a copy of the state");
        Assert.All(group.Sessions.Skip(1), s => Assert.True(s.Counters.StatesAgreed > 10, $"{s.Counters.StatesAgreed}"));
        Assert.Superset(new HashSet<EventKind> { EventKind.Spawn, EventKind.Remove, EventKind.Teleport, EventKind.Impulse }, done.Select(e => e.Kind).ToHashSet());
        Assert.Contains(group.Accepted, e => e.Kind == EventKind.Spawn && e.Spec.Flight == MotionLaw.RungeKutta4);
    }

    [Theory]
    [InlineData("loopback")]
    [InlineData("awful")]
    [InlineData("delay-1000ms")]
    public void Join_BigRunningWorldWhateverTheLink_DownloadsItWhole(string link)
    {
        // 400 bodies are some 80 KB: seventy pieces, more than a window.
        Assert.True(LinkProfiles.TryGet(link, out LinkProfile? profile, out _));
        SessionGroup group = new SessionGroup(
            BuiltInScenes.Crowd(400), 2, profile, 3, _ => new HostOptions { Window = new(SimDuration.FromSeconds(5)) }).Connect();
        group.Run(6);
        ClientSession client = group.Join(100, 77);
        Assert.True(group.RunUntil(() => client.State == SessionState.Running), client.EndReason);
        group.Do(1, PlayerAction.SetVelocity(First, V(3, 1)));
        group.Do(2, PlayerAction.SetVelocity(Second, V(-3, 1)));
        Assert.True(group.Settle(2));
        group.Run(0.2);
        Assert.True(client.World!.Simulation.HistoryEdge > group.Host.World!.Simulation.Start);
        Simulation host = group.Host.World.Simulation, late = client.World.Simulation;
        SimTime time = SimTime.Min(host.SimulatedTo, late.SimulatedTo);
        Assert.Equal(host.StateHash(time), late.StateHash(time));
        Assert.Equal(host.EventHash(time), late.EventHash(time));
    }

    [Fact]
    public void Join_CopyWithAByteChangedOnItsWay_EndsWithASentence()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5), 3).Connect();
        group.Run(3);
        ClientSession client = group.Join(100, 77);
        List<byte[]> chunks = [];
        bool isLosing = true;
        group.Network.Lose((from, to, datagram) =>
        {
            bool isChunk = isLosing && from == 0 && to == 100 && datagram.Span[3] == (byte)DatagramType.SnapshotChunk;
            if (isChunk)
            {
                chunks.Add(datagram.ToArray());
            }

            return isChunk;
        });
        group.Run(0.1);
        byte[] changed = chunks[0];
        changed[300] ^= 1;
        isLosing = false;
        group.Ports[0].Send(changed, PeerAddress.Virtual(100));
        group.Run(0.1);
        Assert.Equal(SessionState.Ended, client.State);
        Assert.Contains("its hash is another one than was announced", client.EndReason, StringComparison.Ordinal);
    }

    [Fact]
    public void Client_FellSilentAndEndedAndCameBackAsANewOne_HasTheSameWorld()
    {
        SessionGroup group = new SessionGroup(
            ScriptedActions.Box(), 2, LinkProfiles.PureDelay(10), 3,
            peer => new HostOptions
            {
                Timeout = SimDuration.FromSeconds(2),
                KeepAlive = SimDuration.FromSeconds(0.5),
                RejoinTime = SimDuration.FromSeconds(peer == 0 ? 60 : 0),
                MaxClientsPerAddress = 1, // so it gets the number that its machine had
            }).Connect();
        new ScriptedActions(1).DoIn(group, 5);
        group.Cut(0, 1);
        group.Cut(1, 0);
        group.Run(3);
        Assert.Equal(SessionState.Ended, group.Sessions[1].State);
        Assert.Equal(0, group.Host.ClientCount);
        group.Do(0, PlayerAction.SetVelocity(Second, V(1, 4)));
        uint before = group.Log.Values.Where(e => e.Event.Peer == 1).Max(e => e.Sequence);
        group.Restore(0, 1);
        group.Restore(1, 0);
        group.DropLast();
        ClientSession again = group.Join(1, 4242);
        Assert.True(group.RunUntil(() => again.State == SessionState.Running), again.EndReason);
        ExternalEvent external = group.Do(1, PlayerAction.SetVelocity(First, V(-1, 4)));
        Assert.Equal((1, before + 1), (external.Peer, external.Sequence));
        group.Run(1);
        Assert.Equal(group.Host.LogLength, again.LogLength);
        Assert.Null(group.Difference());
    }

    private static void Kick(SessionGroup group, Random random) => group.Do(
        random.Next(2), PlayerAction.SetVelocity(BodyId.OfScene(random.Next(16)), V((random.NextDouble() - 0.5) * 4, 0, (random.NextDouble() - 0.5) * 4)));
}
