using System;
using System.IO;
using System.Net;
using System.Threading.Tasks;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Tests.Clocks;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>A refused action of which nobody would hear is said on standard error: once, and not if somebody awaits it or listens.</summary>
[Trait("Time", "real")]
public sealed class UnheardRefusalTests : IDisposable
{
    private const string Sentence = "Command was refused, and nothing listens to PeerThread.Refused or awaits the action: ";
    private static readonly PlayerAction Early = PlayerAction.Command(new GameCommand(1)); // the session waits for others
    private readonly TextWriter before = Console.Error;
    private readonly StringWriter said = new();
    private readonly ManualClock clock = new();
    private readonly UdpPort port = new(new IPEndPoint(IPAddress.Loopback, 0));
    private readonly PeerThread thread;

    public UnheardRefusalTests()
    {
        Console.SetError(TextWriter.Synchronized(said));
        HostSession session = new(BuiltInScenes.Pair(), port, clock, new HostOptions { ExpectedClients = 1 }, 1);
        thread = new PeerThread(session, port, "test");
    }

    public void Dispose()
    {
        thread.Dispose();
        port.Dispose();
        Console.SetError(before);
    }

    [Fact]
    public void Do_RefusedAndDiscarded_IsSaidOnceAfterASecond()
    {
        _ = thread.Do(Early);
        Assert.True(thread.Step() <= SimDuration.FromSeconds(1)); // so that it wakes for it
        Step(0.9);
        Assert.Equal(0, Said);
        Step(0.2);
        Assert.Equal(1, Said);
        Assert.Contains("Waiting", said.ToString(), StringComparison.Ordinal);
        _ = thread.Do(Early);
        Step(5);
        thread.Dispose();
        Assert.Equal(1, Said);
    }

    [Fact]
    public void Do_RefusedJustBeforeTheEnd_IsSaidByThen()
    {
        _ = thread.Do(Early);
        thread.Step();
        thread.Dispose();
        Assert.Equal(1, Said);
    }

    /// <summary>The controls: awaited before the answer or after, looked at, and listened to. The next that nobody hears of is said.</summary>
    [Fact]
    public async Task Do_RefusedAndHeardOf_IsNotSaid()
    {
        Task<ExternalEvent> awaited = thread.Do(Early).AsTask();
        Step(2);
        await Assert.ThrowsAsync<InvalidOperationException>(() => awaited);

        ValueTask<ExternalEvent> late = thread.Do(Early);
        thread.Step();
        await Assert.ThrowsAsync<InvalidOperationException>(async () => await late);
        Step(2);

        ValueTask<ExternalEvent> seen = thread.Do(Early);
        thread.Step();
        Assert.True(seen.IsFaulted);
        Step(2);

        static void Listen(PlayerAction action, Exception why)
        {
        }

        thread.Refused += Listen;
        _ = thread.Do(Early);
        Step(2);
        thread.Refused -= Listen;
        Assert.Equal(0, Said);

        _ = thread.Do(Early);
        Step(2);
        Assert.Equal(1, Said);
    }

    private int Said => said.ToString().Split(Sentence).Length - 1;

    private void Step(double seconds)
    {
        thread.Step();
        clock.Now += SimDuration.FromSeconds(seconds);
        thread.Step();
    }
}
