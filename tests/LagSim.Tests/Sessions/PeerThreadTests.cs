using System;
using System.Net;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Harness.Links;
using LagSim.Harness.Scenes;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using Xunit;

namespace LagSim.Tests.Sessions;

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
    public void EndReason_OnceTheStateReadsEndedOnAnotherThread_IsThere()
    {
        using IDatagramPort port = new VirtualNetwork(new VirtualClock(), 1).CreatePort(0);
        Session[] sessions = new Session[2000];
        for (int i = 0; i < sessions.Length; i++)
        {
            sessions[i] = new HostSession(BuiltInScenes.Pair(), port, new VirtualClock(), new SessionOptions(), 7);
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

    private static TimeSpan Deadline => TimeSpan.FromSeconds(20);

    private static PeerThread Host(UdpPort port) =>
        new(new HostSession(BuiltInScenes.Pair(), port, new StopwatchClock(), new SessionOptions(), 7), port, "test");
}
