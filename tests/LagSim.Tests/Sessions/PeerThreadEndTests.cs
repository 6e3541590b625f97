using System;
using System.Collections.Concurrent;
using System.Linq;
using System.Net;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>However the thread of a session ends, it ends once, says goodbye, and leaves no caller waiting. Over real sockets.</summary>
[Trait("Time", "real")]
public sealed class PeerThreadEndTests
{
    private static readonly PlayerAction Push = PlayerAction.Impulse(BodyId.OfScene(0), new Vector3D(0, 1, 0));

    private static TimeSpan Deadline => TimeSpan.FromSeconds(20);

    /// <summary>In a handler, as a game's own end would: all is tidied up, once, after the step.</summary>
    [Fact]
    public async Task Dispose_InAHandler_LeavesAndClosesThePortAfterTheStep()
    {
        OwnedPort port = new();
        PeerThread? host = null;
        int ended = 0;
        bool wasClosedInside = true;
        host = PeerThread.Host(BuiltInScenes.Pair(), port, new HostOptions { Unprotected = true }, setUp: session =>
        {
            session.Ended += () => ended++;
            session.Logged += _ =>
            {
                host!.Dispose();
                host.Dispose();
                wasClosedInside = port.IsDisposed;
            };
        });
        Assert.True(host.WaitUntilRunning(Deadline));
        await host.Do(Push);
        host.Dispose(); // waits for its end

        Assert.Equal((false, true, 1), (wasClosedInside, port.IsDisposed, ended));
        Assert.Equal(1, port.Disposals);
        Assert.Equal(SessionEnd.Left, host.Session.EndedBy);
        Assert.Throws<ObjectDisposedException>(() => { _ = host.Do(Push); });
    }

    [Fact]
    public void Dispose_ByTwoThreadsAtOnce_ReturnsToBothOnceItIsDone()
    {
        for (int round = 0; round < 20; round++)
        {
            OwnedPort port = new();
            PeerThread host = PeerThread.Host(BuiltInScenes.Pair(), port, new HostOptions { Unprotected = true });
            bool[] isDone = new bool[2];
            Parallel.For(0, 2, n =>
            {
                host.Dispose();
                isDone[n] = host.Session.State == SessionState.Ended;
            });
            Assert.Equal([true, true], isDone);
            Assert.Equal(1, port.Disposals);
        }
    }

    [Fact]
    public void Start_OfASecondOnOneSession_IsRefusedAndLeavesTheFirstAlone()
    {
        using UdpPort port = new(new IPEndPoint(IPAddress.Loopback, 0));
        HostSession session = new(BuiltInScenes.Pair(), port, new StopwatchClock(), new HostOptions(), 7);
        using PeerThread first = new(session, port, "first");
        first.Start();
        Assert.True(first.WaitUntilRunning(Deadline));
        PeerThread second = new(session, port, "second");
        Assert.Contains("on another", Assert.Throws<InvalidOperationException>(second.Start).Message, StringComparison.Ordinal);
        second.Dispose();

        Assert.Throws<InvalidOperationException>(() => session.Links); // the first still has it

        first.Dispose();
        using PeerThread third = new(session, port, "third"); // the control: once it is free another may
        third.Start();
    }

    [Fact]
    public void Fault_OnceItIsDecided_IsToldAndNotTakenForAnEnd()
    {
        OwnedPort port = new() { Breaks = true };
        using PeerThread host = PeerThread.Host(BuiltInScenes.Pair(), port, new HostOptions { Unprotected = true });
        for (int look = 0; look < 2; look++)
        {
            InvalidOperationException told = Assert.Throws<InvalidOperationException>(() => { host.WaitUntilRunning(Deadline); });
            Assert.IsType<FormatException>(told.InnerException);
            Assert.IsType<FormatException>(Assert.Throws<InvalidOperationException>(() => { _ = host.Do(Push); }).InnerException);
        }
    }

    [Fact]
    public async Task Fault_WhileAnswersAreOutstanding_CompletesThemWithIt()
    {
        OwnedPort port = new();
        using PeerThread host = PeerThread.Host(BuiltInScenes.Pair(), port, new HostOptions { Unprotected = true });
        Assert.True(host.WaitUntilRunning(Deadline));
        Task<int>? second = null;
        Task<int> first = host.Ask(_ =>
        {
            second = host.Ask(_ => 2); // for the next step, which does not come
            port.Breaks = true;
            return 1;
        });
        Assert.Equal(1, await first);
        await Assert.ThrowsAsync<FormatException>(() => second!.WaitAsync(Deadline, TestContext.Current.CancellationToken));
    }

    /// <summary>The token of the options, and then the thread's own end, as its documentation says.</summary>
    [Fact]
    public void Cancellation_ThenDispose_SaysGoodbyeAndClosesThePort()
    {
        using CancellationTokenSource cancellation = new();
        OwnedPort port = new();
        int ended = 0;
        PeerThread host = PeerThread.Host(
            BuiltInScenes.Pair(),
            port,
            new HostOptions { Cancellation = cancellation.Token, Unprotected = true },
            session => session.Ended += () => ended++);
        Assert.True(host.WaitUntilRunning(Deadline));
        cancellation.Cancel();
        Assert.True(SpinWait.SpinUntil(() => Record.Exception(() => host.State) is not null, Deadline));
        Assert.Equal((0, false), (ended, port.IsDisposed)); // nothing is said by itself

        host.Dispose();
        host.Dispose();

        Assert.Equal((1, 1, SessionEnd.Left), (ended, port.Disposals, host.Session.EndedBy));
    }

    [Fact]
    public async Task Dispose_OfACarrierThatThrows_IsReportedAndEndsAllTheSame()
    {
        OwnedPort port = new() { BreaksAtTheEnd = true };
        ConcurrentQueue<Exception> failures = new();
        PeerThread host = PeerThread.Host(BuiltInScenes.Pair(), port, new HostOptions { Unprotected = true }, setUp: session => session.HandlerFailed += failures.Enqueue);
        Assert.True(host.WaitUntilRunning(Deadline));
        Task<int> asked = host.Ask(_ => 1);
        host.Dispose();

        Assert.Equal(2, failures.Count(failure => failure is FormatException)); // of the event, and of the end
        Assert.Equal(SessionEnd.Left, host.Session.EndedBy);
        await Record.ExceptionAsync(() => asked.WaitAsync(Deadline, TestContext.Current.CancellationToken));
        Assert.True(asked.IsCompleted);
        Assert.Throws<ObjectDisposedException>(() => { _ = host.Do(Push); });
    }

    /// <summary>
    /// A game that tries a refused action again at once would never leave the step, if new requests did not wait for the next.
    /// </summary>
    [Fact]
    public async Task Refused_WhoseHandlerTriesAgainEachTime_HoldsUpNoStepAndNoEnd()
    {
        int refusals = 0;
        PlayerAction ofNobody = PlayerAction.Impulse(BodyId.OfScene(99), default);
        PeerThread host = PeerThread.Host(BuiltInScenes.Pair(), bind: IPAddress.Loopback);
        host.Refused += (action, _) =>
        {
            Interlocked.Increment(ref refusals);
            Again(action);
        };
        Assert.True(host.WaitUntilRunning(Deadline));
        _ = host.Do(ofNobody);
        long before = host.Steps;
        Assert.True(SpinWait.SpinUntil(() => host.Steps > before + 10, Deadline));
        Assert.True(Volatile.Read(ref refusals) > 1); // the control: it was tried again
        await Task.Run(host.Dispose, TestContext.Current.CancellationToken).WaitAsync(Deadline, TestContext.Current.CancellationToken);

        void Again(PlayerAction action) => _ = host.Do(action);
    }

    [Fact]
    public void HandlerFailed_OfWhatBreaksAtTheVeryStart_IsHeardBySetUp()
    {
        using ManualResetEventSlim heard = new();
        using PeerThread host = PeerThread.Host(BuiltInScenes.Pair(), bind: IPAddress.Loopback, setUp: session =>
        {
            session.HandlerFailed += _ => heard.Set();
            session.Begun += () => throw new FormatException("at the start");
        });
        Assert.True(heard.Wait(Deadline, TestContext.Current.CancellationToken));
        Assert.True(host.WaitUntilRunning(Deadline)); // and it ended nothing
    }

    [Fact]
    public void SetUp_ThatThrows_EndsTheSessionAndDisposesTheCarrier()
    {
        OwnedPort port = new();
        HostSession? made = null;
        Assert.Throws<FormatException>(() => PeerThread.Host(BuiltInScenes.Pair(), port, new HostOptions { Unprotected = true }, setUp: session =>
        {
            made = session;
            throw new FormatException("a set-up that breaks");
        }));
        Assert.Equal((1, SessionState.Ended), (port.Disposals, made!.State));
    }

    /// <summary>A game's context refuses to take the rest of a method when the game shuts down. The action has happened all the same.</summary>
    [Fact]
    public void Answer_WhoseContextRefusesIt_IsReportedAndIsNoRefusal()
    {
        ConcurrentQueue<Exception> failures = new();
        using PeerThread host = PeerThread.Host(
            BuiltInScenes.Pair(), bind: IPAddress.Loopback, setUp: session => session.HandlerFailed += failures.Enqueue);
        int refused = 0;
        host.Refused += (_, _) => refused++;
        Assert.True(host.WaitUntilRunning(Deadline));
        using ManualResetEventSlim isAwaited = new();
        _ = host.Ask(_ => isAwaited.Wait(Deadline)); // an answer that is there already needs no context
        SynchronizationContext? before = SynchronizationContext.Current;
        try
        {
            SynchronizationContext.SetSynchronizationContext(new ClosedContext());
            _ = Await(host.Do(Push));
        }
        finally
        {
            SynchronizationContext.SetSynchronizationContext(before);
            isAwaited.Set();
        }

        Assert.True(SpinWait.SpinUntil(() => !failures.IsEmpty, Deadline));
        Assert.IsType<InvalidOperationException>(Assert.Single(failures));
        Assert.Equal(SessionState.Running, host.State);
        Assert.Equal(0, refused);
    }

    private static async Task Await(ValueTask<ExternalEvent> answer) => await answer;

    private sealed class ClosedContext : SynchronizationContext
    {
        public override void Post(SendOrPostCallback d, object? state) => throw new InvalidOperationException("The game has shut down.");
    }
}
