using System;
using System.Net;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>A state can be awaited: no thread waits for it, and it fails with a sentence where it cannot come.</summary>
[Trait("Time", "real")]
public sealed class WhenStateTests
{
    private static TimeSpan Deadline => TimeSpan.FromSeconds(20);

    [Fact]
    public async Task WhenRunning_OfHostAndClient_CompletesOnceTheyRunAndNotOnTheirThreads()
    {
        using PeerThread host = PeerThread.Host(BuiltInScenes.Pair(), bind: IPAddress.Loopback);
        using PeerThread client = PeerThread.Join(host.LocalAddress.ToEndPoint());
        foreach (PeerThread peer in new[] { host, client })
        {
            Task<string> after = peer.WhenRunning(Deadline, TestContext.Current.CancellationToken).ContinueWith(
                _ => Thread.CurrentThread.Name ?? "", TestContext.Current.CancellationToken, TaskContinuationOptions.ExecuteSynchronously, TaskScheduler.Default);
            Assert.DoesNotContain("LagSim", await after, StringComparison.Ordinal);
            Assert.Equal(SessionState.Running, peer.State);
            Assert.Null(peer.Session.WhyNotRunning);
            Assert.True(peer.WhenRunning(TimeSpan.Zero, TestContext.Current.CancellationToken).IsCompletedSuccessfully); // as it is
        }

        Task over = client.WhenState(SessionState.Ended, Deadline, TestContext.Current.CancellationToken);
        host.Dispose();
        await over;
        InvalidOperationException never = await Assert.ThrowsAsync<InvalidOperationException>(
            () => client.WhenRunning(Deadline, TestContext.Current.CancellationToken));
        Assert.EndsWith(" ended the session.", never.Message, StringComparison.Ordinal);
    }

    [Fact]
    public async Task WhenRunning_WithoutAHost_FailsWithWhatItWaitsForAndThenWithTheEnd()
    {
        using UdpPort silent = new(new IPEndPoint(IPAddress.Loopback, 0));
        ClientOptions options = new() { Timeout = SimDuration.FromSeconds(2), KeepAlive = SimDuration.FromSeconds(0.4), RejoinTime = SimDuration.Zero, Warmup = false };
        using PeerThread client = PeerThread.Join(silent.LocalAddress.ToEndPoint(), options);
        string expected = $"No answer from the host at {silent.LocalAddress} ";
        Assert.True(SpinWait.SpinUntil(() => client.Session.WhyNotRunning!.StartsWith(expected, StringComparison.Ordinal), Deadline));
        Assert.False(client.WaitUntilRunning(TimeSpan.FromMilliseconds(10)));
        TimeoutException early = await Assert.ThrowsAsync<TimeoutException>(
            () => client.WhenRunning(TimeSpan.FromMilliseconds(10), TestContext.Current.CancellationToken));
        Assert.Equal($"{expected}yet.", early.Message); // however long it began to ask after the wait did
        Assert.StartsWith(expected, early.Message, StringComparison.Ordinal);
        InvalidOperationException end = await Assert.ThrowsAsync<InvalidOperationException>(
            () => client.WhenRunning(Deadline, TestContext.Current.CancellationToken));
        Assert.Equal($"{expected}within 2 s.", end.Message);
        Assert.Equal(end.Message, client.Session.EndReason);
        Assert.False(client.WaitUntilRunning(Deadline)); // at once
    }

    [Fact]
    public async Task WhenRunning_CancelledOrStopped_Ends()
    {
        using IDatagramPort port = new VirtualNetwork(new VirtualClock(), 1).CreatePort(0);
        HostSession session = new(BuiltInScenes.Pair(), port, new VirtualClock(), new HostOptions { Warmup = false }, 7);
        PeerThread thread = new(session, port, "test");
        using CancellationTokenSource cancellation = new();
        Task cancelled = thread.WhenRunning(Timeout.InfiniteTimeSpan, cancellation.Token);
        Task stopped = thread.WhenRunning(Timeout.InfiniteTimeSpan, TestContext.Current.CancellationToken);
        TimeoutException early = await Assert.ThrowsAsync<TimeoutException>(() => thread.WhenRunning(TimeSpan.Zero, TestContext.Current.CancellationToken));
        Assert.StartsWith("The session has not begun: its thread was not started", early.Message, StringComparison.Ordinal);
        await cancellation.CancelAsync();
        await Assert.ThrowsAnyAsync<OperationCanceledException>(() => cancelled.WaitAsync(Deadline, TestContext.Current.CancellationToken));
        Assert.False(stopped.IsCompleted);
        thread.Dispose(); // it does not own its port, and so does not leave
        Assert.Contains(
            "was stopped",
            (await Assert.ThrowsAsync<InvalidOperationException>(() => stopped.WaitAsync(Deadline, TestContext.Current.CancellationToken))).Message,
            StringComparison.Ordinal);
        Assert.False(thread.WaitUntilRunning(Timeout.InfiniteTimeSpan));
        Assert.Throws<ArgumentOutOfRangeException>(() => { _ = thread.WhenRunning(TimeSpan.FromDays(30), TestContext.Current.CancellationToken); });
        Assert.Throws<ArgumentOutOfRangeException>(() => { _ = thread.WhenRunning(TimeSpan.FromSeconds(-1), TestContext.Current.CancellationToken); });
    }

    /// <summary>One that waits for a state that it has already left and gets again: rejoining is not the end of it.</summary>
    [Fact]
    public void WaitUntilRunning_WhileItRejoins_WaitsUntilItIsBack()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5)).Connect();
        ClientSession session = group.Client(1);
        StateWaiters waiters = new(session.Parts.Status);
        group.Steps.Freeze(0);
        Assert.True(group.RunUntil(() => session.State == SessionState.Rejoining));
        Task back = waiters.When(SessionState.Running, Timeout.InfiniteTimeSpan, CancellationToken.None);
        waiters.Wait(SessionState.Running, TimeSpan.Zero);
        Assert.False(back.IsCompleted);
        group.Steps.Thaw(0);
        Assert.True(group.RunUntil(() => session.State == SessionState.Running));
        Assert.True(back.IsCompletedSuccessfully);
    }
}
