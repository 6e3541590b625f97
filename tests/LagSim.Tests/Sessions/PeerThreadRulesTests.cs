using System;
using System.Collections.Concurrent;
using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using System.Net;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Sessions.Core;
using LagSim.Scenes;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>
/// What a <see cref="PeerThread"/> promises beside running a session: its carrier, its handlers, its thread, and what is refused.
/// </summary>
[Trait("Time", "real")]
public sealed class PeerThreadRulesTests
{
    private static readonly PlayerAction Push = PlayerAction.Impulse(BodyId.OfScene(0), new Vector3D(0, 1, 0));

    private static readonly PlayerAction TooFast = PlayerAction.SetVelocity(BodyId.OfScene(0), new Vector3D(1e6, 0, 0));

    private static TimeSpan Deadline => TimeSpan.FromSeconds(20);

    [Fact]
    public void HostAndJoin_OverCarriers_RunAndDisposeThem()
    {
        OwnedPort hosts = new(), clients = new();
        using (PeerThread host = PeerThread.Host(BuiltInScenes.Pair(), hosts, new HostOptions { Unprotected = true }))
        using (PeerThread client = PeerThread.Join(clients, host.LocalAddress))
        {
            Assert.True(client.WaitUntilRunning(Deadline), client.Session.EndReason);
            Assert.Equal((false, false), (hosts.IsDisposed, clients.IsDisposed)); // the control
        }

        Assert.Equal((true, true), (hosts.IsDisposed, clients.IsDisposed));
    }

    [Fact]
    public async Task RefusedAndHandlerFailed_WithoutAnybodyWhoListens_AreTraced()
    {
        using StringWriter text = new();
        using TextWriterTraceListener listener = new(TextWriter.Synchronized(text));
        Trace.Listeners.Add(listener);
        try
        {
            using PeerThread host = PeerThread.Host(
                BuiltInScenes.Pair(), bind: IPAddress.Loopback, setUp: session => session.Logged += _ => throw new FormatException("broken 4711"));
            Assert.True(host.WaitUntilRunning(Deadline));
            _ = host.Do(TooFast);
            await host.Do(Push);
            host.Refused += (_, _) => { }; // the control: who listens has it instead
            await Assert.ThrowsAsync<SceneException>(() => host.Do(TooFast).AsTask());
        }
        finally
        {
            Trace.Listeners.Remove(listener);
        }

        string traced = text.ToString();
        Assert.Equal(2, traced.Split("SetVelocity was refused").Length);
        Assert.Contains("broken 4711", traced, StringComparison.Ordinal);
    }

    [Fact]
    public void HostAndJoin_OptionsOutOfRange_DisposeTheCarrier()
    {
        OwnedPort hosts = new(), clients = new();
        Assert.Throws<ArgumentOutOfRangeException>(() => PeerThread.Host(BuiltInScenes.Pair(), hosts, new HostOptions { MaxSegments = 0, Unprotected = true }));
        Assert.Throws<ArgumentOutOfRangeException>(
            () => PeerThread.Join(clients, hosts.LocalAddress, new ClientOptions { MaxSegments = 0 }));
        Assert.Equal((true, true), (hosts.IsDisposed, clients.IsDisposed));
    }

    [Fact]
    public async Task SetUp_SubscribesBeforeAnythingIsTold()
    {
        int begun = 0;
        int here = Environment.CurrentManagedThreadId; // what follows an await may be on another
        int? thread = null;
        using PeerThread host = PeerThread.Host(BuiltInScenes.Pair(), bind: IPAddress.Loopback, setUp: session =>
        {
            thread = Environment.CurrentManagedThreadId;
            session.Begun += () => begun++;
        });
        using PeerThread client = PeerThread.Join(
            host.LocalAddress.ToEndPoint(), setUp: session => session.PassGiven += _ => Interlocked.Increment(ref begun));
        Assert.True(client.WaitUntilRunning(Deadline), client.Session.EndReason);
        Assert.Equal(2, await host.Ask(_ => Volatile.Read(ref begun)));
        Assert.Equal(here, thread);

        int late = 0;
        client.Session.Begun += () => late++; // the control: who comes later has missed it
        Assert.Equal(0, await client.Ask(_ => late));
    }

    [Fact]
    public async Task Handler_ThatThrows_IsToldAndEndsNothing()
    {
        using UdpPort port = new(new IPEndPoint(IPAddress.Loopback, 0));
        HostSession session = new(BuiltInScenes.Pair(), port, new StopwatchClock(), new HostOptions(), 7);
        int heard = 0;
        session.Logged += _ => throw new FormatException("a handler that breaks its promise");
        session.Logged += _ => heard++;
        using PeerThread host = new(session, port, "test");
        ConcurrentQueue<Exception> told = new();
        host.Session.HandlerFailed += told.Enqueue;
        host.Session.HandlerFailed += _ => throw new FormatException("and another");
        host.Start();
        Assert.True(host.WaitUntilRunning(Deadline));

        await host.Do(Push);
        await host.Do(Push);

        Assert.Equal(2, await host.Ask(_ => heard));
        Assert.Equal(2, told.Count);
        Assert.All(told, failure => Assert.IsType<FormatException>(failure));
        Assert.Equal(SessionState.Running, host.State);
    }

    /// <summary>The control: without such a thread it goes through.</summary>
    [Fact]
    public void Handler_ThatThrowsInAPolledSession_GoesThrough()
    {
        using UdpPort port = new(new IPEndPoint(IPAddress.Loopback, 0));
        HostSession session = new(BuiltInScenes.Pair(), port, new StopwatchClock(), new HostOptions(), 7);
        session.Ended += () => throw new FormatException("a handler that breaks its promise");
        Assert.Throws<FormatException>(session.Leave);
    }

    [Fact]
    public void Handlers_TakenAway_AreNotCalled()
    {
        using UdpPort port = new(new IPEndPoint(IPAddress.Loopback, 0));
        HostSession session = new(BuiltInScenes.Pair(), port, new StopwatchClock(), new HostOptions(), 7);
        int calls = 0;
        void Count() => calls++;
        session.Ended += Count;
        session.Ended += Count;
        session.Ended += null;
        session.Ended -= Count;
        session.Ended -= () => { }; // of nobody
        session.Leave();
        Assert.Equal(1, calls);
    }

    [Fact]
    public void Handlers_Called_AllocateNothing()
    {
        HandlerList<Action<int>> handlers = new(new SessionOwner());
        int sum = 0;
        handlers.Add(n => sum += n);
        handlers.Add(n => sum -= n);
        void Raise() => handlers.Raise(1, static (handler, told) => handler(told));
        Raise();

        Assert.Equal(0, Allocated(Raise));
        Assert.NotEqual(0, Allocated(() => handlers.Add(_ => { }))); // the control
        Assert.Equal(0, sum);
    }

    public static TheoryData<string> OfTheHost => new(HostCalls.Keys);

    public static TheoryData<string> OfTheClient => new(ClientCalls.Keys);

    [Theory]
    [MemberData(nameof(OfTheHost))]
    public async Task MemberOfAHost_OnAnotherThread_ThrowsWhileThePeerThreadRuns(string member)
    {
        using UdpPort port = new(new IPEndPoint(IPAddress.Loopback, 0));
        HostSession session = new(BuiltInScenes.Pair(), port, new StopwatchClock(), new HostOptions(), 7);
        _ = session.Links; // polled so far: anybody may
        PeerThread host = new(session, port, "test");
        _ = session.Links; // not started
        host.Start();
        Assert.True(host.WaitUntilRunning(Deadline));

        InvalidOperationException foreign = Assert.Throws<InvalidOperationException>(() => HostCalls[member](session));
        Assert.Contains($"'{member}' is for the session's own thread", foreign.Message, StringComparison.Ordinal);
        Assert.True(await host.Ask(_ => // the control: on its own thread it does not
        {
            HostCalls[member](session);
            return true;
        }));

        host.Dispose();
        _ = session.Links; // nobody runs it any more
    }

    [Theory]
    [MemberData(nameof(OfTheClient))]
    public async Task MemberOfAClient_OnAnotherThread_ThrowsWhileThePeerThreadRuns(string member)
    {
        using PeerThread host = PeerThread.Host(BuiltInScenes.Pair(), bind: IPAddress.Loopback);
        using PeerThread client = PeerThread.Join(host.LocalAddress.ToEndPoint());
        Assert.True(client.WaitUntilRunning(Deadline), client.Session.EndReason);
        ClientSession session = (ClientSession)client.Session;

        Assert.Contains(
            $"'{member}'", Assert.Throws<InvalidOperationException>(() => ClientCalls[member](session)).Message, StringComparison.Ordinal);
        Assert.True(await client.Ask(_ =>
        {
            ClientCalls[member](session);
            return true;
        }));
    }

    [Fact]
    public async Task LatestAndWaitUntilRunning_OnTheSessionsOwnThread_ThrowAndElsewhereDoNot()
    {
        using PeerThread host = PeerThread.Host(BuiltInScenes.Pair(), bind: IPAddress.Loopback);
        Assert.True(host.WaitUntilRunning(Deadline)); // the control
        _ = host.Latest();

        foreach (Action call in new Action[] { () => host.Latest(), () => host.WaitUntilRunning(Deadline) })
        {
            InvalidOperationException own = await Assert.ThrowsAsync<InvalidOperationException>(() => host.Ask(_ =>
            {
                call();
                return true;
            }));
            Assert.Contains("may not be called on the session's own thread", own.Message, StringComparison.Ordinal);
        }
    }

    [Fact]
    public async Task Refused_IsToldOfWhatNobodyAwaits_AndNotOfWhatIsDone()
    {
        using PeerThread host = PeerThread.Host(BuiltInScenes.Pair(), bind: IPAddress.Loopback);
        ConcurrentQueue<(PlayerAction Action, Exception Why)> refused = new();
        host.Refused += (action, why) => refused.Enqueue((action, why));
        Assert.True(host.WaitUntilRunning(Deadline));

        await host.Do(Push); // the control
        Assert.Empty(refused);
        _ = host.Do(TooFast);
        await host.Do(Push); // after it

        (PlayerAction action, Exception why) = Assert.Single(refused);
        Assert.Equal(EventKind.SetVelocity, action.Kind);
        Assert.IsType<SceneException>(why);
    }

    [Fact]
    public async Task Refused_IsToldBeforeTheAnswer_AndAHandlerThatThrowsEndsNothing()
    {
        using PeerThread host = PeerThread.Host(BuiltInScenes.Pair(), bind: IPAddress.Loopback);
        int told = 0;
        host.Session.HandlerFailed += _ => told++;
        host.Refused += (_, _) => throw new FormatException("a handler that breaks its promise");
        Assert.True(host.WaitUntilRunning(Deadline));

        await Assert.ThrowsAsync<SceneException>(() => host.Do(TooFast).AsTask());

        Assert.Equal(1, told);
        await host.Do(Push);
    }

    private static long Allocated(Action work)
    {
        work();
        long before = GC.GetAllocatedBytesForCurrentThread();
        work();
        return GC.GetAllocatedBytesForCurrentThread() - before;
    }

    private static Dictionary<string, Action<HostSession>> HostCalls { get; } = new(Shared<HostSession>())
    {
        [nameof(HostSession.Kick)] = session => session.Kick(1),
        [nameof(HostSession.Ban)] = session => session.Ban(1),
        [nameof(HostSession.Unban)] = session => session.Unban(PeerAddress.Virtual(1)),
        [nameof(HostSession.RemoveBodiesOf)] = session => session.RemoveBodiesOf(1),
        [nameof(HostSession.Flush)] = session => session.Flush(),
        [nameof(HostSession.Costs)] = session => _ = session.Costs,
        [nameof(HostSession.ClientCount)] = session => _ = session.ClientCount,
    };

    private static Dictionary<string, Action<ClientSession>> ClientCalls { get; } = new(Shared<ClientSession>())
    {
        [nameof(ClientSession.UnconfirmedEvents)] = session => _ = session.UnconfirmedEvents,
    };

    private static Dictionary<string, Action<TSession>> Shared<TSession>()
        where TSession : Session => new()
        {
            [nameof(Session.Do)] = session => session.Do(Push),
            [nameof(Session.Step)] = session => session.Step(),
            [nameof(Session.Leave)] = session => session.Leave(),
            [nameof(Session.Links)] = session => _ = session.Links,
            [nameof(Session.LogStart)] = session => _ = session.LogStart,
            [nameof(Session.LogLength)] = session => _ = session.LogLength,
            [nameof(Session.BegunFrom)] = session => _ = session.BegunFrom,
        };
}
