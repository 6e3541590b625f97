using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Strategies;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

public sealed class SessionWarmupTests
{
    public static TheoryData<string, bool> Warmups => new(LateEventStrategies.Names.SelectMany(name => new[] { (name, true), (name, false) }));

    [Theory]
    [MemberData(nameof(Warmups))]
    public void Run_ByEveryStrategy_TakesEveryKindBothWaysAndLateAndRefused(string strategy, bool few)
    {
        SessionWarmup warmup = SessionWarmup.Run(LateEventStrategies.OfName(strategy), SessionWarmup.EveryKind, few);

        Assert.Equal(PlayersKinds, warmup.HeardByHost);
        Assert.Equal(PlayersKinds.Append(EventKind.Player).Order(), warmup.HeardByClient);
        Assert.NotEqual(0, warmup.HostCounters.EventsRefused); // a refusal by the host, after which the sender retracts
        Assert.Equal(warmup.HostCounters.EventsRefused, warmup.ClientCounters.EventsRefused);
        Assert.Equal((0, 0), (warmup.HostCounters.DatagramsMalformed, warmup.ClientCounters.DatagramsMalformed));
        Assert.NotEqual(0, warmup.ClientCounters.StatesAgreed + warmup.ClientCounters.StatesDiffered);
        ILateEventStrategy late = LateEventStrategies.Create(strategy);
        Assert.Equal(late.RewritesPast, warmup.HostCounters.Heals > 0);
        Assert.Equal(late.RewritesPast, warmup.ClientCounters.Heals > 0);
        Assert.True(!late.PromisesAgreement || warmup.ClientCounters.StatesDiffered == 0);
    }

    [Fact]
    public void Run_WithoutAKind_IsSeenNotToCoverIt()
    {
        foreach (EventKind missing in PlayersKinds)
        {
            SessionWarmup warmup = SessionWarmup.Run(LateEventStrategy.Healing, [.. SessionWarmup.EveryKind.Where(k => k != missing)], few: true);
            Assert.Equal(PlayersKinds.Where(k => k != missing), warmup.HeardByHost);
            Assert.Equal(PlayersKinds.Where(k => k != missing).Append(EventKind.Player).Order(), warmup.HeardByClient);
        }
    }

    [Theory]
    [InlineData(true, LateEventStrategy.FullRollback)]
    [InlineData(false)]
    public async Task Step_OfAThread_WarmsUpOnceBeforeAnythingIsAnswered_UnlessItIsSwitchedOff(bool isOn, params LateEventStrategy[] expected)
    {
        using IDatagramPort port = new VirtualNetwork(new VirtualClock(), 1).CreatePort(0);
        HostOptions options = new() { Warmup = isOn, Strategy = LateEventStrategy.FullRollback };
        List<LateEventStrategy> warmed = [];
        HostSession session = new(BuiltInScenes.Pair(), port, new VirtualClock(), options, 7);
        using PeerThread thread = new(session, port, "test", ownsPort: false, (started, _) => warmed.AddRange(started.WarmsUpFor is LateEventStrategy one ? [one] : []));
        Task<int> asked = thread.Ask(_ => warmed.Count);

        thread.Step();
        thread.Step();

        Assert.Equal(expected, warmed);
        Assert.Equal(expected.Length, await asked);
        Assert.True(new HostOptions().Warmup);
    }

    /// <summary>A process that is asked to end while it warms up has no time to lose: it is killed two seconds later.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public async Task Thread_SkippedOrDisposedWhileItWarmsUp_WaitsNoLongerAndAnswers(bool isSkipped)
    {
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5));
        using ManualResetEventSlim begun = new();
        TaskCompletionSource never = new(TaskCreationOptions.RunContinuationsAsynchronously);
        bool hasEnded = false;
        using PeerThread thread = new(group.Client(1), group.Ports[1], "test", ownsPort: false, (session, isOver) =>
        {
            Assert.False(isOver()); // the control: nobody has asked for an end yet
            begun.Set();
            SessionWarmup.Before(session, isOver, _ => never.Task);
            hasEnded = true;
        });
        thread.Start();
        Assert.True(begun.Wait(TimeSpan.FromSeconds(30), TestContext.Current.CancellationToken));
        Task<bool> asked = thread.Ask(_ => true);
        if (isSkipped)
        {
            thread.SkipWarmup();
            Assert.True(await asked);
        }

        thread.Dispose();
        Assert.True(hasEnded);
        Assert.True(asked.IsCompleted);
    }

    /// <summary>A warm-up that is not over keeps a host from nothing: a client that asks meanwhile is let in. A client waits for its own.</summary>
    [Fact]
    public async Task Before_OfAHost_DoesNotWait_AndOfAClientDoes()
    {
        TaskCompletionSource over = new(TaskCreationOptions.RunContinuationsAsynchronously);
        List<LateEventStrategy> begun = [];
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5));
        SessionWarmup.Before(group.Host, () => false, Begin);
        group.Connect();
        Task client = Task.Run(() => SessionWarmup.Before(group.Client(1), () => false, Begin), TestContext.Current.CancellationToken);
        Assert.NotSame(client, await Task.WhenAny(client, Task.Delay(50, TestContext.Current.CancellationToken)));
        over.SetResult();
        await client;
        Assert.Equal([LateEventStrategy.Healing, LateEventStrategy.Healing], begun);

        Task Begin(LateEventStrategy strategy)
        {
            begun.Add(strategy);
            return over.Task;
        }
    }

    [Fact]
    public void Run_InTheMiddleOfASession_ChangesNoBitOfItAndNoDatagram()
    {
        string[] alone = Play(warmups: false, actions: 40);

        Assert.Equal(alone, Play(warmups: true, actions: 40));
        Assert.NotEqual(alone, Play(warmups: false, actions: 41));
    }

    private static IReadOnlyList<EventKind> PlayersKinds { get; } =
        [.. Enum.GetValues<EventKind>().Where(k => k is >= EventKind.Spawn and < EventKind.Timer and not EventKind.Player)]; // the host alone says who plays, and only to rules that listen

    private static string[] Play(bool warmups, int actions)
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 3, LinkProfiles.Transatlantic).Connect();
        int steps = 0;
        group.BeforeStep = _ =>
        {
            if (warmups && steps++ % 100 == 0)
            {
                SessionWarmup.Run(LateEventStrategy.Healing, SessionWarmup.EveryKind, few: steps % 200 == 1);
            }
        };
        new ScriptedActions(1) { HasHands = true }.DoIn(group, actions);
        Assert.True(group.Settle(actions));
        SimTime end = group.Sessions.Min(s => s.World!.Simulation.SimulatedTo);
        return
        [
            .. group.Sessions.Select(s => $"{s.World!.Simulation.StateHash(end):x} {s.World.Simulation.EventHash(end):x} at {end}, {s.Counters.Heals} heals,"
                + $" {s.Counters.DatagramsSent} sent, {s.Links.Sum(l => l.BytesSent)} bytes"),
        ];
    }
}
