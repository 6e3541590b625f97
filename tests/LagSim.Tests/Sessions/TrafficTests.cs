using System.Collections.Generic;
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

/// <summary>What a session sends, to whom, and what it keeps.</summary>
public sealed class TrafficTests
{
    [Fact]
    public void Copy_OfCounters_StaysAsItIsWhileTheSessionGoesOn()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(50), 4).Connect();
        int done = 0;
        SessionCounters[] copies = new SessionCounters[40];
        string[] then = new string[copies.Length];
        for (int n = 0; n < copies.Length; n++)
        {
            done += new ScriptedActions(n, maxSpawns: 0).DoIn(group, 2).Count;
            group.Run(0.1);
            copies[n] = group.Host.Counters.Copy();
            then[n] = Everything(group.Host.Counters);
        }

        Assert.True(group.Settle(done));
        group.Run(3);
        Assert.Equal(then, copies.Select(Everything));
        Assert.Equal(copies.Length, then.Distinct().Count()); // they differ from one another, so they would have changed
        Assert.True(group.Host.Counters.Lateness.Count > 20, $"{group.Host.Counters.Lateness.Count}");

        // By the names of the properties, so that none that is added later is left out of a copy.
        static string Everything(SessionCounters counters) => string.Join(" ", typeof(SessionCounters).GetProperties().Select(p =>
            p.GetValue(counters) is IReadOnlyList<SimDuration> spans ? string.Join(",", spans.Select(span => span.Ticks)) : $"{p.Name} {p.GetValue(counters)}"));
    }

    [Fact]
    public void Idle_HostWithEightClients_SendsLessThanFiftyBytesASecondOnALink()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 9, LinkProfiles.Lan, 1).Connect();
        group.Run(20); // the balls come to rest, the clocks are set
        LinkTraffic[] before = All();
        group.Run(100);
        LinkTraffic[] after = All();
        Assert.Equal(16, after.Length);
        for (int i = 0; i < after.Length; i++)
        {
            Assert.Equal(before[i].Address, after[i].Address);
            Assert.InRange((after[i].BytesSent - before[i].BytesSent) / 100.0, 1, 50);
            Assert.InRange((after[i].BytesReceived - before[i].BytesReceived) / 100.0, 1, 50);
        }

        LinkTraffic[] All() => group.Sessions.SelectMany(s => s.Links).ToArray();
    }

    [Fact]
    public void Links_CountWhatWentOverThem()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 3, LinkProfiles.PureDelay(30), 1).Connect();
        new ScriptedActions(1).DoIn(group, 20);
        group.Settle(20);
        LinkTraffic toHost = Assert.Single(group.Sessions[1].Links);
        LinkTraffic fromHost = group.Host.Links.Single(l => l.Peer == group.Sessions[1].Peer);
        Assert.Equal(0, toHost.Peer);
        Assert.InRange(fromHost.BytesReceived, toHost.BytesSent * 0.98, toHost.BytesSent); // what was under way, and the first words
        Assert.InRange(toHost.BytesReceived, fromHost.BytesSent * 0.9, fromHost.BytesSent);
        Near(0.06, toHost.RoundTrip.ToSeconds(), 0.001);
        Near(0.06, fromHost.RoundTrip.ToSeconds(), 0.001);
    }

    [Fact]
    public void Do_MoreThanTheHostTakes_IsTakenLaterAndAllOfIt()
    {
        SessionGroup group = new SessionGroup(
            ScriptedActions.Box(), 3, LinkProfiles.PureDelay(5), 1,
            _ => new HostOptions { MaxEventsPerSecond = 50, Window = new(SimDuration.FromSeconds(5)) }).Connect();
        for (int i = 0; i < 200; i++)
        {
            group.Do(1, PlayerAction.Impulse(First, V(0.01, 0.05)));
            group.Run(0.001);
        }

        group.Run(1);
        Assert.InRange(group.Host.Counters.EventsAccepted, 95, 130); // fifty at once and fifty a second
        Assert.True(group.Host.Counters.EventsDeferred > 0);
        Assert.True(group.Settle(200));
        Assert.Equal(0, group.Host.Counters.EventsRefused);
        Assert.Null(group.Difference());
    }

    [Fact]
    public void Client_ThatAcknowledgesNothing_IsToldToGoAndTheLogIsForgotten()
    {
        SessionGroup group = new SessionGroup(
            Floating(), 2, LinkProfiles.PureDelay(1), 1, _ => new HostOptions { Window = new(SimDuration.FromSeconds(0.1)), MaxEventsPerSecond = 100_000 }).Connect();
        RawClient deaf = new(group);
        for (int i = 0; i < 70_000; i++)
        {
            group.Do(0, PlayerAction.SetVelocity(First, V(0.001 * (i % 7))));
            if (i % 50 == 0)
            {
                deaf.Claim(1);
            }
        }

        group.Run(1);
        Assert.Equal(1, group.Host.ClientCount);
        Assert.Equal(DatagramType.Leave, deaf.Received().Last(d => d.Type == DatagramType.Leave).Type);
        Assert.True(group.RunUntil(() => group.Sessions[1].LogLength == 70_000, 60));
        group.Run(1);
        Assert.InRange(group.Host.KeptLogEntries, 0, 1000);
        Assert.Equal(SessionState.Running, group.Sessions[1].State);
    }

    private static Scene Floating() => new SceneBuilder("floating").WithGravity(V(0)).AddBody("one", Ball(0.3), V(0, 4)).Build();
}
