using System;
using System.Globalization;
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

/// <summary>How much players can do on long and lossy ways: more than fits into one datagram is under way at a time, and states are committed meanwhile.</summary>
public sealed class ThroughputTests(ITestOutputHelper output)
{
    private const double Seconds = 10;

    private static readonly PlayerAction Push = PlayerAction.Impulse(First, V(0.001));

    [Theory]
    [InlineData("delay-50ms", 490, 1)]
    [InlineData("3g", 490, 2)]
    [InlineData("transatlantic", 490, 1)]
    [InlineData("satellite", 490, 5)]
    [InlineData("awful", 490, 5)]
    [InlineData("delay-1000ms", 490, 5)]
    public void Do_NearlyAsMuchAsTheHostTakes_NothingIsRefused(string profile, double rate, double history)
    {
        SessionGroup group = Group(profile, 2, history);
        Play(group, Push, rate, 1);
        group.Run(history + 5);
        Report(profile, group);
        Assert.Equal(Count(rate), group.Host.Counters.EventsAccepted);
        Assert.Equal(0, group.Host.Counters.EventsRefused);
        Assert.Equal(0, group.Client(1).UnconfirmedEvents);
        AssertAgreed(group);
    }

    [Fact]
    public void Check_OneDatagramOfEntriesInARoundTrip_TakesNextToNothing()
    {
        // As if each update began at the first entry that is not acknowledged, and had no other after it.
        SessionGroup group = Group("3g", 2, 2);
        UpdateDatagram read = new();
        uint acknowledged = 0;
        group.Network.Lose((from, to, datagram) =>
        {
            if (!read.TryDecode(datagram.Span, out _))
            {
                return false;
            }

            acknowledged = from == 0 ? read.EventsReceived : acknowledged;
            return to == 0 && read.Entries.Length > 0 && read.FirstIndex > acknowledged + 1;
        });
        Play(group, Push, 490, 1);
        group.Run(10);
        Report("one datagram", group);
        Assert.True(group.Host.LogLength < Count(490) / 3, $"{group.Host.LogLength} judged");
    }

    [Theory]
    [InlineData("3g", 20)]
    [InlineData("transatlantic", 60)]
    [InlineData("satellite", 15)]
    [InlineData("awful", 15)]
    public void Log_EightClientsActAllTheTime_ReachesEveryoneAndIsCommittedMeanwhile(string profile, double rate)
    {
        const double history = 3;
        SessionGroup group = Group(profile, 9, history);
        double kept = 0;
        int unconfirmed = 0, log = 0;
        SimTime begun = group.Clock.Now;
        Play(group, PlayerAction.Teleport(First, V(0, 4)), rate, 8, () =>
        {
            unconfirmed = Math.Max(unconfirmed, group.Sessions.Skip(1).Max(s => ((ClientSession)s).UnconfirmedEvents));
            log = Math.Max(log, group.Host.KeptLogEntries);
            if (group.Clock.Now - begun > SimDuration.FromSeconds(history))
            {
                kept = Math.Max(kept, group.Sessions.Max(s => (s.SharedTime.Now - s.World!.Simulation.HistoryEdge).ToSeconds()));
            }
        });
        Report($"{profile}: history kept for {kept:0.00} s, {unconfirmed} not judged, {log} of the log kept", group);
        Assert.InRange(kept, history, history + 3);
        Assert.InRange(unconfirmed, 1, rate * 3);
        Assert.InRange(log, 1, 8 * rate * (history + 3) * 2);
        Assert.All(group.Sessions, s => Assert.True(s.Counters.StatesAgreed > 3 || s is HostSession, $"{s.Counters.StatesAgreed} compared while all act"));
        group.Run(history + 5);
        Assert.Equal(Count(rate) * 8, group.Host.Counters.EventsAccepted);
        Assert.Equal(0, group.Host.Counters.EventsRefused);
        AssertAgreed(group);
    }

    [Fact]
    public void Commit_EntryOfTheLogMissing_GoesNoFurtherUntilItCame()
    {
        SessionGroup group = Group("delay-50ms", 3, 1);
        UpdateDatagram read = new();
        const uint missing = 1500;
        bool isLost = true;
        group.Network.Lose((from, to, datagram) => isLost && from == 0 && to == 2 && read.TryDecode(datagram.Span, out _)
            && read.FirstIndex <= missing && read.FirstIndex + read.Entries.Length > missing);
        Play(group, Push, 200, 2);
        group.Run(1); // a client that is ten seconds behind gets a fresh copy
        Assert.InRange(group.Sessions[2].LogLength, missing - 30, missing - 1); // those before it in its datagrams are lost with it
        Assert.True(group.Sessions[2].Committed!.Value.Time <= group.Log[missing].Event.Time);
        Assert.True(group.Sessions[1].Committed!.Value.Time > group.Log[missing].Event.Time + SimDuration.FromSeconds(5));
        isLost = false;
        group.Run(5);
        AssertAgreed(group);
    }

    [Fact]
    public void Do_MoreThanMayWaitForTheVerdict_ThrowsUntilItCame()
    {
        // Without a budget: so many events at once are more than a player may cost by default.
        SessionGroup group = new SessionGroup(
            Floating(), 2, LinkProfiles.PureDelay(5), 1, _ => new HostOptions { Window = new(SimDuration.FromSeconds(5)), MaxEventsPerSecond = 100_000, PlayerBudget = null }).Connect();
        for (int i = 0; i < ClientSession.MaxUnconfirmedEvents; i++)
        {
            group.Sessions[1].Do(Push);
        }

        InvalidOperationException refused = Assert.Throws<InvalidOperationException>(() => group.Do(1, Push));
        Assert.Equal("Nothing more can be done yet: 16384 events of this peer wait for the host's verdict, and that is the most that may.", refused.Message);
        Assert.Equal(SessionState.Running, group.Sessions[1].State);
        Assert.True(group.Settle(ClientSession.MaxUnconfirmedEvents, 4));
        Assert.Equal(ClientSession.MaxUnconfirmedEvents + 1u, group.Do(1, Push).Sequence);
        Assert.True(group.Settle(ClientSession.MaxUnconfirmedEvents + 1, 1));
        Assert.Equal(0, group.Host.Counters.EventsRefused);
    }

    [Fact]
    public void Updates_ToAClientThatAcknowledgesNothing_BecomeFew()
    {
        SessionGroup group = Group("delay-5ms", 2, 1);
        RawClient deaf = new(group);
        deaf.Claim(1);
        byte[] ready = deaf.Bytes(1);
        ready[WireFormat.EmptyUpdateBytes - 6] = 2; // the flag
        deaf.Send(ready);
        for (int i = 0; i < 3000; i++)
        {
            group.Do(0, Push);
        }

        group.Run(0.5);
        deaf.Received();
        double seconds = 8;
        for (int i = 0; i < seconds * 10; i++)
        {
            deaf.Claim(1);
            group.Run(0.09);
        }

        // Once a resend interval a datagram, all of the window a few times, and the answers to what it writes.
        int few = (int)(seconds / 0.03) + (8 * 3000 / 20) + (int)(seconds * 10);
        Assert.InRange(deaf.Received().Count(d => d.Type == DatagramType.Update), 100, few);
    }

    private static SessionGroup Group(string profile, int peers, double history)
    {
        Assert.True(LinkProfiles.TryGet(profile, out LinkProfile? link, out _));
        return new SessionGroup(Floating(), peers, link, 1, _ => new HostOptions { Window = new(SimDuration.FromSeconds(history)) }).Connect();
    }

    private static int Count(double rate) => (int)(Seconds * rate);

    private static void Play(SessionGroup group, PlayerAction action, double rate, int clients, Action? look = null)
    {
        for (int i = 0; i < Count(rate); i++)
        {
            for (int peer = 1; peer <= clients; peer++)
            {
                group.Do(peer, action);
            }

            group.Run(1 / rate);
            look?.Invoke();
        }
    }

    private static void AssertAgreed(SessionGroup group) => Assert.All(group.Sessions.Skip(1), s =>
    {
        Assert.Equal((group.Host.LogLength, 0L), (s.LogLength, s.Counters.EventsLost + s.Counters.EventsForged + s.Counters.StatesDiffered));
        Assert.True(s.Counters.StatesAgreed > 6, $"{s.Counters.StatesAgreed} compared");
    });

    private static Scene Floating() => new SceneBuilder("floating").WithGravity(V(0)).AddBody("one", Ball(0.3), V(0, 4)).Build();

    private void Report(string what, SessionGroup group) => output.WriteLine(string.Create(
        CultureInfo.InvariantCulture,
        $"{what}: accepted {group.Host.Counters.EventsAccepted}, refused {group.Host.Counters.EventsRefused}, at the host {Latest(group.Host):0.00} s late, at joiners {group.Sessions.Skip(1).Max(Latest):0.00} s; up {group.Client(1).Links[0].BytesSent} B, down {group.Client(1).Links[0].BytesReceived} B"));

    private static double Latest(Session session) => session.Counters.Lateness.Count == 0 ? 0 : session.Counters.Lateness.Max().ToSeconds();
}
