using System;
using System.Linq;
using System.Net;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Testing;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Rules;

/// <summary>Threads that rules never let go: they are given up, nobody waits for them, and all else goes on. With real threads and sockets.</summary>
[Trait("Time", "real")]
public sealed class LostThreadTests
{
    private const int Hang = 2;

    // Only a hang reaches this; a pass never waits for it.
    private static readonly TimeSpan Deadline = TimeSpan.FromSeconds(30);

    [Fact]
    public void SimulationHost_WhoseRulesWait_IsGivenUpAndAnotherGoesOn()
    {
        using ManualResetEventSlim inside = new(), release = new();
        Thread? lost = null;
        bool isBack = false, hasGoneOn = false;
        GivenRules rules = new()
        {
            Command = (w, _, _) =>
            {
                lost = Thread.CurrentThread;
                inside.Set();
                release.Wait();
                Volatile.Write(ref isBack, true);
                w.Random();
                Volatile.Write(ref hasGoneOn, true);
            },
        };
        using SimulationHost other = new(Floor(rules), new StopwatchClock(), ruleTimeout: RuleWatchdog.MaxLimit);
        SimulationHost host = new(Floor(rules), new StopwatchClock(), ruleTimeout: RuleWatchdog.MaxLimit);
        other.Start();
        host.Start();
        host.Do(PlayerAction.Command(new GameCommand(Hang)));
        Assert.True(inside.Wait(Deadline, TestContext.Current.CancellationToken));

        // It is given up at the last look of the limit, and its thread some looks later, not before.
        Look(host, RuleWatchdog.LooksToGiveUp + RuleWatchdog.LooksToAbandon);
        _ = host.RenderSnapshot;
        Look(host, 1);
        InvalidOperationException told = Assert.Throws<InvalidOperationException>(() => host.RenderSnapshot);
        string sentence = Assert.IsType<SimulationException>(told.InnerException).Message;
        Assert.StartsWith("The rules 'given 1' failed at ", sentence, StringComparison.Ordinal);
        Assert.EndsWith(
            ": it has not returned within 600s, and was given up. Its thread could not be ended, and is left to itself until the process ends.", sentence,
            StringComparison.Ordinal);
        Assert.Throws<InvalidOperationException>(() => host.Do(PlayerAction.Command(new GameCommand(1))));
        host.Dispose(); // would wait for ever
        Assert.True(lost!.IsAlive && lost.IsBackground); // so the process can end
        Assert.True(Within(() => other.RenderSnapshot.TryRead(First, other.Now, out _)));

        // What comes back sleeps, and does nothing any more.
        release.Set();
        Assert.True(Within(() => Volatile.Read(ref isBack) && lost.ThreadState.HasFlag(ThreadState.WaitSleepJoin)));
        Assert.False(Volatile.Read(ref hasGoneOn));
    }

    [Fact]
    public void SimulationHost_WhoseRulesAskTheWorldForEver_EndsItsThread()
    {
        using ManualResetEventSlim inside = new();
        Thread? thread = null;
        GivenRules rules = new()
        {
            Command = (w, _, _) =>
            {
                thread = Thread.CurrentThread;
                inside.Set();
                while (w.Random() < ulong.MaxValue)
                {
                }
            },
        };
        using SimulationHost host = new(Floor(rules), new StopwatchClock(), ruleTimeout: RuleWatchdog.MaxLimit);
        host.Start();
        host.Do(PlayerAction.Command(new GameCommand(Hang)));
        Assert.True(inside.Wait(Deadline, TestContext.Current.CancellationToken));
        Look(host, RuleWatchdog.LooksToGiveUp);
        Assert.False(thread!.Join(0)); // the control: it has not ended by itself
        Look(host, 1);
        Assert.True(thread.Join(Deadline));
        InvalidOperationException told = Assert.Throws<InvalidOperationException>(() => host.RenderSnapshot);
        Assert.EndsWith(": it has not returned within 600s, and was given up.", told.InnerException!.Message, StringComparison.Ordinal);
    }

    /// <summary>By its own timer, on the shortest limit: a client hangs, the host and another client go on and agree.</summary>
    [Fact]
    public async Task PeerThread_WhoseRulesWait_EndsItsSessionAndTheOthersAgree()
    {
        using ManualResetEventSlim release = new();
        GivenRules rules = new()
        {
            Hears = (_, _, surface) => surface == 0,
            Contact = (w, _) => w.State<GivenState>().Count++,
            Command = (w, _, command) =>
            {
                w.State<GivenState>().Count += 100;
                if (command.Number == Hang && Thread.CurrentThread.Name == "lost")
                {
                    release.Wait();
                }
            },
        };
        Scene scene = Floor(rules);
        using PeerThread host = PeerThread.Host(scene, options: new HostOptions { ExpectedClients = 2 }, bind: IPAddress.Loopback);
        ClientOptions options = new() { Rules = [rules], Timeout = SimDuration.FromSeconds(60) };
        using PeerThread other = PeerThread.Join(host.LocalAddress.ToEndPoint(), options);
        UdpPort port = new(new IPEndPoint(IPAddress.Loopback, 0));
        ClientSession session = new(null, port, new StopwatchClock(), options with { RuleTimeout = RuleWatchdog.MinLimit }, host.LocalAddress, Session.DrawNumber());
        int ended = 0;
        session.Ended += () => ended++;
        PeerThread lost = new(session, port, "lost", ownsPort: true, SessionWarmup.Before);
        lost.Start();
        Assert.True(host.WaitUntilRunning(Deadline) && other.WaitUntilRunning(Deadline) && lost.WaitUntilRunning(Deadline));
        byte number = session.Peer;

        await host.Do(PlayerAction.Command(new GameCommand(1)));
        Assert.Equal(SessionState.Running, lost.State); // the control: another command ends nothing
        await host.Do(PlayerAction.Command(new GameCommand(Hang)));
        Task<int>? question = null;
        Assert.True(Within(() =>
        {
            question ??= lost.State == SessionState.Running ? lost.Ask(_ => 1) : null;
            return lost.State == SessionState.Ended && Volatile.Read(ref ended) > 0; // told right after
        }));
        Assert.Equal((SessionEnd.Failed, 1), (session.EndedBy, ended));
        Assert.Matches(
            "^The world cannot be simulated any further. The rules 'given 1' failed at .* in OnCommand for command .* of peer .*: it has not returned within 0.1s, and"
                + " was given up. Its thread could not be ended, and is left to itself until the process ends.$",
            session.EndReason);
        Assert.False(lost.WaitUntilRunning(Deadline));
        foreach (Action ask in new Action[] { () => _ = lost.Do(PlayerAction.Command(new GameCommand(1))), () => _ = lost.Ask(_ => 1) })
        {
            // What is asked while the session is just ending still gets an answer, which is the failure; what is asked later is refused at once.
            Assert.True(Within(() => Record.Exception(ask) is InvalidOperationException no
                && no.Message.StartsWith("The session's thread is not there any more: The rules 'given 1'", StringComparison.Ordinal)));
        }

        await Assert.ThrowsAnyAsync<Exception>(() => Answered(question!));
        lost.Dispose(); // would wait for ever

        // It said goodbye, so nobody waits for the timeout; the others go on, and what they commit is the same.
        Assert.True(Within(() => host.Session.Roster.All(member => member.Number != number)));
        await host.Do(PlayerAction.Command(new GameCommand(Hang)));
        SimTime from = host.Session.SharedTime.Now;
        CommittedState mine = default, theirs = default;
        Assert.True(Within(() =>
        {
            (mine, theirs) = (host.Session.Committed ?? default, other.Session.Committed ?? default);
            return mine.Time > from && mine.Time == theirs.Time;
        }));
        Assert.Equal(mine, theirs);
        Assert.InRange(await host.Ask(s => s.World!.Simulation.TryReadRules(s.World.Simulation.SimulatedTo, out GivenState state) ? state.Count : 0), 300, 399);
        Assert.Equal((SessionState.Running, SessionState.Running), (host.State, other.State));
        release.Set();
    }

    /// <summary>The action whose own call never returns is answered, too: with what ended the session.</summary>
    [Fact]
    public async Task Do_WhoseOwnCallNeverReturns_IsAnsweredWithTheFailure()
    {
        using ManualResetEventSlim release = new();
        GivenRules rules = new()
        {
            Command = (_, _, command) =>
            {
                if (command.Number == Hang)
                {
                    release.Wait();
                }
            },
        };
        HostOptions options = new() { ExpectedClients = 0, RuleTimeout = RuleWatchdog.MinLimit };
        PeerThread host = PeerThread.Host(Floor(rules), options: options, bind: IPAddress.Loopback);
        Assert.True(host.WaitUntilRunning(Deadline));
        await host.Do(PlayerAction.Command(new GameCommand(1)));
        Task<ExternalEvent> hung = host.Do(PlayerAction.Command(new GameCommand(Hang))).AsTask();
        Assert.Same(hung, await Task.WhenAny(hung, Task.Delay(Deadline, TestContext.Current.CancellationToken)));
        Assert.True(Within(() => host.State == SessionState.Ended));
        Assert.StartsWith("The rules 'given 1' failed at ", hung.Exception!.InnerException!.Message, StringComparison.Ordinal);

        host.Dispose();
        release.Set();
    }

    /// <summary>A test under lag whose world is given up says which call it was, not that a world cannot be compared.</summary>
    [Fact]
    public void SessionTest_WhoseRulesAskTheWorldForEver_SaysWhichCall()
    {
        GivenRules rules = new()
        {
            Command = (w, _, _) =>
            {
                while (true)
                {
                    w.Random();
                }
            },
        };
        SessionTest test = new SessionTest(Floor(rules)).WithOptions(_ => new ClientOptions { RuleTimeout = RuleWatchdog.MinLimit }).WithClients(1, "lan")
            .At(1, player: 1, PlayerAction.Command(new GameCommand(Hang)));
        SessionTestException failure = Assert.Throws<SessionTestException>(() => test.Run(4, TestContext.Current.CancellationToken));
        Assert.Matches("in OnCommand for command .*: it has not returned within 0.1s, and was given up", failure.Message);
    }

    // A question that was answered before the call has its answer; none is left without an end.
    private static async Task<int> Answered(Task<int> question)
    {
        int answer = await question.WaitAsync(Deadline, TestContext.Current.CancellationToken);
        throw new InvalidOperationException($"answered with {answer}");
    }

    private static void Look(SimulationHost host, int times)
    {
        for (int n = 0; n < times; n++)
        {
            host.Watchdog.Look();
        }
    }

    private static bool Within(Func<bool> isSo) => SpinWait.SpinUntil(isSo, Deadline);

    private static Scene Floor(GameRules rules) => new SceneBuilder("floor").AddPlane("floor", Vector3D.Up, V(0), 0.9).AddBody("ball", Ball(e: 0.9), V(0, 2)).WithRules(rules).Build();
}
