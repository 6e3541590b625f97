using System;
using System.Net;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using Xunit;

namespace LagSim.Tests.Sessions;

[Trait("Time", "real")]
public sealed class PeerThreadTests
{
    [Fact]
    public async Task Ask_WhileItRuns_IsAnswered()
    {
        using UdpPort port = new(new IPEndPoint(IPAddress.Loopback, 0));
        using PeerThread thread = Host(port);
        thread.Start();

        Assert.Equal(SessionState.Waiting, await thread.Ask(session => session.State).WaitAsync(Deadline, TestContext.Current.CancellationToken));
    }

    [Fact]
    public async Task Ask_NeverStarted_IsCancelledByDispose()
    {
        using UdpPort port = new(new IPEndPoint(IPAddress.Loopback, 0));
        PeerThread thread = Host(port);
        Task<int> question = thread.Ask(_ => 1);
        Assert.False(question.IsCompleted);

        thread.Dispose();

        await Assert.ThrowsAsync<TaskCanceledException>(() => question.WaitAsync(Deadline, TestContext.Current.CancellationToken));
    }

    [Fact]
    public void Ask_AfterDispose_Throws()
    {
        using UdpPort port = new(new IPEndPoint(IPAddress.Loopback, 0));
        PeerThread thread = Host(port);
        thread.Start();
        thread.Dispose();

        Assert.Throws<ObjectDisposedException>(() => { _ = thread.Ask(_ => 1); });
    }

    [Fact]
    public void Do_Warm_AllocatesNothingOnTheCallingThread()
    {
        using UdpPort port = new(new IPEndPoint(IPAddress.Loopback, 0));
        using PeerThread thread = Host(port); // not started: nobody empties the queue, so that a call costs the same each time
        PlayerAction push = PlayerAction.Impulse(BodyId.OfScene(0), new Vector3D(0, 1, 0));
        for (int n = 0; n < 2; n++)
        {
            _ = thread.Do(push);
            thread.Step();
        }

        Assert.Equal(0, Allocated(() =>
        {
            for (int n = 0; n < ActionRequests.Kept / 2; n++)
            {
                _ = thread.Do(push);
            }
        }));
        thread.Step();
        Assert.NotEqual(0, Allocated(() => _ = thread.Ask(_ => 1))); // the control: what allocates is seen
    }

    [Fact]
    public async Task Do_NeverAwaited_IsUsedAgainAndItsAnswerForgotten()
    {
        using UdpPort port = new(new IPEndPoint(IPAddress.Loopback, 0));
        using PeerThread thread = Host(port);
        PlayerAction push = PlayerAction.Impulse(BodyId.OfScene(0), new Vector3D(0, 1, 0));
        ValueTask<ExternalEvent> left = thread.Do(push), right = thread.Do(push);
        Task<ExternalEvent> awaited = right.AsTask();
        thread.Step();
        await Assert.ThrowsAsync<InvalidOperationException>(() => awaited.WaitAsync(Deadline, TestContext.Current.CancellationToken));
        for (int n = 0; n < ActionRequests.Kept; n++)
        {
            _ = thread.Do(push);
        }

        Assert.Throws<InvalidOperationException>(() => left.IsCompleted); // another's by now, and never taken for it
    }

    [Fact]
    public async Task Do_AwaitedWhileManyMoreAreAsked_KeepsItsAnswer()
    {
        using UdpPort port = new(new IPEndPoint(IPAddress.Loopback, 0));
        using PeerThread thread = Host(port);
        Task<ExternalEvent>[] answers = new Task<ExternalEvent>[3 * ActionRequests.Kept];
        for (int n = 0; n < answers.Length; n++)
        {
            answers[n] = thread.Do(PlayerAction.Impulse(BodyId.OfScene(0), new Vector3D(0, n, 0))).AsTask();
        }

        thread.Step();
        foreach (Task<ExternalEvent> answer in answers)
        {
            InvalidOperationException refused = await Assert.ThrowsAsync<InvalidOperationException>(
                () => answer.WaitAsync(Deadline, TestContext.Current.CancellationToken));
            Assert.Contains("Waiting", refused.Message, StringComparison.Ordinal); // the session's own: it does not run yet
        }
    }

    [Theory]
    [InlineData("0.0.0.0", 5000)]
    [InlineData("::", 5000)]
    [InlineData("::ffff:0.0.0.0", 5000)]
    [InlineData("255.255.255.255", 5000)]
    [InlineData("127.0.0.1", 0)]
    public void Join_WhatIsNoMachine_IsRefusedAtOnce(string address, int port)
    {
        ArgumentException refused = Assert.Throws<ArgumentException>(() => PeerThread.Join(new IPEndPoint(IPAddress.Parse(address), port)));
        Assert.Contains("is no host to join: it takes the address of one machine and a port from 1 to 65535.", refused.Message, StringComparison.Ordinal);
        Assert.Equal("host", refused.ParamName);
    }

    [Theory]
    [InlineData(-1)]
    [InlineData(65_536)]
    public void Host_PortOutOfRange_IsRefusedWithTheRange(int port)
    {
        ArgumentOutOfRangeException refused = Assert.Throws<ArgumentOutOfRangeException>(() => PeerThread.Host(BuiltInScenes.Pair(), port));
        Assert.Equal(("udpPort", port), (refused.ParamName, refused.ActualValue));
        Assert.Contains("a number from 1 to 65535, or 0", refused.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Start_AgainOrAfterDispose_IsAnErrorThatSaysSo()
    {
        using UdpPort port = new(new IPEndPoint(IPAddress.Loopback, 0));
        PeerThread thread = Host(port);
        thread.Start();
        Assert.Contains("has been started already", Assert.Throws<InvalidOperationException>(thread.Start).Message, StringComparison.Ordinal);
        Assert.Throws<ArgumentNullException>(() => { _ = thread.Ask<int>(null!); });
        thread.Dispose();
        Assert.Throws<ObjectDisposedException>(thread.Start);
    }

    [Fact]
    public void Step_ThatThrows_TellsTheOthersAtOnceAndThenTheProgram()
    {
        BreakingPort carrier = new(new UdpPort(new IPEndPoint(IPAddress.Loopback, 0)));
        using PeerThread host = PeerThread.Host(BuiltInScenes.Pair(), carrier, new HostOptions { Unprotected = true });
        using PeerThread client = PeerThread.Join(new IPEndPoint(IPAddress.Loopback, host.LocalAddress.ToEndPoint().Port));
        Assert.True(client.WaitUntilRunning(Deadline), client.Session.EndReason);
        using ManualResetEventSlim ended = new();
        client.Session.Ended += ended.Set;
        carrier.Breaks = true;
        _ = client.Do(PlayerAction.Impulse(BodyId.OfScene(0), new Vector3D(0, 1, 0)));

        Assert.True(ended.Wait(Deadline, TestContext.Current.CancellationToken)); // long before the time-out, whose sentence is another
        Assert.EndsWith(" failed, and the session is over. An exception ended its session.", client.Session.EndReason, StringComparison.Ordinal);
        Assert.Equal(SessionEnd.HostFailed, client.Session.EndedBy);
        Exception? told = null;
        Assert.True(SpinWait.SpinUntil(() => (told = Record.Exception(host.Latest)) is not null, Deadline)); // the others are told first
        Assert.IsType<FormatException>(Assert.IsType<InvalidOperationException>(told).InnerException);
    }

    [Fact]
    public void EndReason_OnceTheStateReadsEndedOnAnotherThread_IsThere()
    {
        using IDatagramPort port = new VirtualNetwork(new VirtualClock(), 1).CreatePort(0);
        Session[] sessions = new Session[2000];
        for (int i = 0; i < sessions.Length; i++)
        {
            sessions[i] = new HostSession(BuiltInScenes.Pair(), port, new VirtualClock(), new HostOptions(), 7);
        }

        int missing = 0;
        using ManualResetEventSlim watched = new();
        Thread reader = new(() =>
        {
            watched.Set();
            foreach (Session session in sessions)
            {
                while (session.State != SessionState.Ended)
                {
                    Thread.SpinWait(1);
                }

                missing += session.EndReason is null ? 1 : 0;
            }
        });
        reader.Start();
        watched.Wait(TestContext.Current.CancellationToken);
        foreach (Session session in sessions)
        {
            session.Leave();
        }

        reader.Join();
        Assert.Equal(0, missing);
    }

    private static long Allocated(Action work)
    {
        long before = GC.GetAllocatedBytesForCurrentThread();
        work();
        return GC.GetAllocatedBytesForCurrentThread() - before;
    }

    /// <summary>A carrier that throws when it is asked for a datagram, once it is told to.</summary>
    private sealed class BreakingPort(IDatagramPort inner) : IDatagramPort
    {
        private volatile bool breaks;

        public event Action? Arrived
        {
            add => inner.Arrived += value;
            remove => inner.Arrived -= value;
        }

        public bool Breaks
        {
            set => breaks = value;
        }

        public PeerAddress LocalAddress => inner.LocalAddress;

        public void Send(ReadOnlySpan<byte> datagram, PeerAddress to) => inner.Send(datagram, to);

        public bool TryReceive(Span<byte> buffer, out int length, out PeerAddress from) =>
            breaks ? throw new FormatException("a carrier that breaks its promise") : inner.TryReceive(buffer, out length, out from);

        public void Dispose() => inner.Dispose();
    }

    private static TimeSpan Deadline => TimeSpan.FromSeconds(20);

    private static PeerThread Host(UdpPort port) =>
        new(new HostSession(BuiltInScenes.Pair(), port, new StopwatchClock(), new HostOptions(), 7), port, "test");
}
