using System;
using System.Runtime.CompilerServices;
using System.Threading;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Scenes;
using LagSim.Tests.Clocks;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Hosting;

/// <summary>The dedicated thread: it waits, it wakes, it stops, and its faults reach the caller.</summary>
[Trait("Time", "real")]
public sealed class WorldThreadTests
{
    // Only a hang reaches this; a pass never waits for it.
    private static readonly TimeSpan Deadline = TimeSpan.FromSeconds(20);

    [Fact]
    public void Wake_ThreadThatWaitsForEver_DoesOneMoreStep()
    {
        using SemaphoreSlim stepped = new(0);
        using WorldThread thread = new("test", () =>
        {
            stepped.Release();
            return SimDuration.MaxValue;
        });
        thread.Start();
        for (int i = 0; i < 100; i++)
        {
            Assert.True(stepped.Wait(Deadline, TestContext.Current.CancellationToken));
            thread.Wake();
        }

        Assert.True(stepped.Wait(Deadline, TestContext.Current.CancellationToken));
        Assert.InRange(thread.Steps, 99, 101);
    }

    [Fact]
    public void Steps_ReadInATightLoopOnAnotherThread_IsSeenToGrow()
    {
        using ManualResetEventSlim reads = new();
        using WorldThread thread = new("test", () =>
        {
            reads.Wait();
            return SimDuration.MaxValue;
        });
        thread.Start();
        Assert.True(GrowsBefore(thread, 30_000_000_000, reads));
    }

    [Fact]
    public void Step_SpanThatRanOut_IsFollowedByTheNext()
    {
        using CountdownEvent steps = new(5);
        using WorldThread thread = new("test", () =>
        {
            if (!steps.IsSet)
            {
                steps.Signal();
            }

            return SimDuration.FromMilliseconds(0.2);
        });
        thread.Start();
        Assert.True(steps.Wait(Deadline, TestContext.Current.CancellationToken));
    }

    [Fact]
    public void Fault_InAStep_ReachesTheCallerAndEndsTheThread()
    {
        using SemaphoreSlim stepped = new(0);
        InvalidTimeZoneException thrown = new("on purpose");
        using WorldThread thread = new("faulty", () =>
        {
            stepped.Release();
            throw thrown;
        });
        thread.ThrowIfFaulted();
        thread.Start();
        Assert.True(stepped.Wait(Deadline, TestContext.Current.CancellationToken));
        Assert.True(SpinWait.SpinUntil(() => thread.Fault is not null, Deadline));
        InvalidOperationException failure = Assert.Throws<InvalidOperationException>(thread.ThrowIfFaulted);
        Assert.Same(thrown, failure.InnerException);
        Assert.Contains("faulty", failure.Message, StringComparison.Ordinal);
        thread.Wake(); // harmless
    }

    [Fact]
    public void Dispose_WhereverTheThreadIs_IsPrompt()
    {
        PromptlyDisposed(start: false, SimDuration.MaxValue);
        PromptlyDisposed(start: true, SimDuration.MaxValue);
        PromptlyDisposed(start: true, SimDuration.FromSeconds(3600));
        PromptlyDisposed(start: true, SimDuration.Zero);
    }

    [Fact]
    public void Dispose_FromItsOwnThread_DoesNotDeadlock()
    {
        using SemaphoreSlim ended = new(0);
        WorldThread? thread = null;
        thread = new WorldThread("suicide", () =>
        {
            thread!.Dispose();
            ended.Release();
            return SimDuration.MaxValue;
        });
        thread.Start();
        Assert.True(ended.Wait(Deadline, TestContext.Current.CancellationToken));
        thread.Dispose();
    }

    [Fact]
    public void Dispose_ByTwoThreads_ReturnsToEachOnlyOnceTheStepHasEnded()
    {
        using ManualResetEventSlim inStep = new();
        using ManualResetEventSlim goOn = new();
        bool hasEnded = false;
        WorldThread thread = new("busy", () =>
        {
            inStep.Set();
            goOn.Wait(Deadline);
            Volatile.Write(ref hasEnded, true);
            return SimDuration.MaxValue;
        });
        thread.Start();
        Assert.True(inStep.Wait(Deadline, TestContext.Current.CancellationToken));
        bool[] ended = new bool[2];
        Thread[] disposers = [new(() => Dispose(0)), new(() => Dispose(1))];
        Array.ForEach(disposers, disposer => disposer.Start());
        Assert.True(SpinWait.SpinUntil(() => Array.TrueForAll(disposers, WaitsOrHasReturned), Deadline));
        goOn.Set();
        Assert.All(disposers, disposer => Assert.True(disposer.Join(Deadline)));
        Assert.Equal([true, true], ended);

        void Dispose(int n)
        {
            thread.Dispose();
            ended[n] = Volatile.Read(ref hasEnded);
        }

        static bool WaitsOrHasReturned(Thread disposer) => (disposer.ThreadState & (ThreadState.WaitSleepJoin | ThreadState.Stopped)) != 0;
    }

    [Fact]
    public void Host_ActionDone_IsInTheRenderSnapshotsThatFollow()
    {
        ManualClock clock = new() { Now = At(100) };
        using SimulationHost host = new(Drop(0, 0.5), clock);
        host.Start();
        Assert.True(SpinWait.SpinUntil(() => host.RenderSnapshot.Covers(clock.Now), Deadline));
        Assert.True(host.RenderSnapshot.TryRead(First, At(100), out BodyState before));
        Assert.Equal(MotionLaw.Resting, before.Motion);

        ExternalEvent pushed = host.Do(PlayerAction.Impulse(First, V(0, 3)));
        Assert.Equal((At(100), 1u), (pushed.Time, pushed.Sequence));
        Assert.True(SpinWait.SpinUntil(() => host.RenderSnapshot.TryRead(First, At(100), out BodyState s) && s.Velocity == V(0, 3), Deadline));
        ExternalEvent spawned = host.Do(PlayerAction.Spawn(Ball(), V(0, 9)));
        Assert.True(SpinWait.SpinUntil(() => host.RenderSnapshot.TryRead(spawned.Body, At(100), out _), Deadline));
    }

    [Fact]
    public void Host_InvalidAction_IsRefusedWithoutUsingUpItsNumber()
    {
        using SimulationHost host = new(Drop(0, 0.5), new ManualClock());
        Assert.Throws<SceneException>(() => host.Do(PlayerAction.Teleport(First, V(double.NaN))));
        Assert.Throws<InvalidOperationException>(() => host.Do(default));
        Assert.Equal(1u, host.Do(PlayerAction.Remove(First)).Sequence);
    }

    [Fact]
    public void Host_ActionAfterDispose_ThrowsInsteadOfBeingForgotten()
    {
        SimulationHost host = new(Drop(0, 0.5), new ManualClock());
        host.Start();
        host.Do(PlayerAction.Impulse(First, V(0, 3)));
        host.Dispose();
        Assert.Throws<ObjectDisposedException>(() => host.Do(PlayerAction.Impulse(First, V(0, 3))));
    }

    [Fact]
    public void Host_WorldAtRest_DoesNoSteps()
    {
        ManualClock clock = new();
        using SimulationHost host = new(Drop(0, 0.5), clock);
        host.Start();
        Assert.True(SpinWait.SpinUntil(() => host.RenderSnapshot.Number > 0, Deadline));
        clock.Now = At(1000);
        Assert.True(host.RenderSnapshot.TryRead(First, clock.Now, out _)); // what it published covers all of the future
        Assert.InRange(host.Steps, 0, 1);
    }

    [Fact]
    public void Host_SimulationThatFaults_TellsTheCaller()
    {
        Scene scene = new SceneBuilder("nan").AddForce(Force.Supplied(new FunctionForce((t, _, _) => V(t > 0.01 ? double.NaN : 0))))
            .AddBody("x", Ball(flight: MotionLaw.RungeKutta4, force: 1), V(0)).Build();
        using SimulationHost host = new(scene, new ManualClock());
        host.Start();
        InvalidOperationException? failure = null;
        Assert.True(SpinWait.SpinUntil(() =>
        {
            try
            {
                _ = host.RenderSnapshot;
                return false;
            }
            catch (InvalidOperationException e)
            {
                failure = e;
                return true;
            }
        }, Deadline));
        Assert.IsType<SimulationException>(failure!.InnerException);
        Assert.Throws<InvalidOperationException>(() => host.Do(PlayerAction.Remove(First)));
    }

    /// <summary>Nothing in the loop but the reading, so that a compiler may move that out of it where it is an ordinary one.</summary>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private static bool GrowsBefore(WorldThread thread, long timeout, ManualResetEventSlim reads)
    {
        reads.Set();
        while (thread.Steps == 0)
        {
            if (--timeout == 0)
            {
                return false;
            }
        }

        return true;
    }

    private static void PromptlyDisposed(bool start, SimDuration wait)
    {
        using SemaphoreSlim stepped = new(0);
        WorldThread thread = new("test", () =>
        {
            stepped.Release();
            return wait;
        });
        if (start)
        {
            thread.Start();
            Assert.True(stepped.Wait(Deadline, TestContext.Current.CancellationToken));
        }

        Thread disposer = new(thread.Dispose);
        disposer.Start();
        Assert.True(disposer.Join(Deadline));
        long steps = thread.Steps;
        thread.Dispose();
        Assert.Equal(steps, thread.Steps);
    }
}
