using System;
using System.Threading;
using LagSim.Contacts;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Determinism;

/// <summary>Steps of islands that other threads take ahead change no bit, whether they come in time, late or never; and one that is not what it was taken for is not used.</summary>
public sealed class StepsAheadTests
{
    private static readonly Action<WaitCallback, object> AtOnce = (run, job) => run(job);

    private static readonly Action<WaitCallback, object> Never = (_, _) => { };

    private static readonly Lazy<(ulong Hash, long Used)> OneThread = new(() => Run(new SimulationOptions(threads: 1)));

    [Theory]
    [InlineData(2)]
    [InlineData(7)]
    public void Heaps_OnSeveralThreads_HaveTheHashOfOne(int threads)
    {
        Assert.Equal(0, OneThread.Value.Used);
        Assert.Equal(OneThread.Value.Hash, Run(new SimulationOptions(threads: threads)).Hash);
    }

    [Fact]
    public void Heaps_WhoseStepsAreAllTakenAheadOrNone_HaveTheHashOfOneThread()
    {
        Assert.Equal(OneThread.Value, Run(new SimulationOptions(threads: 3) { OtherThread = Never }));
        (ulong ahead, long inTime) = Run(new SimulationOptions(threads: 3) { OtherThread = AtOnce });
        Assert.Equal(OneThread.Value.Hash, ahead);
        Assert.True(inTime > 50, $"only {inTime} steps were used that had been taken ahead");
    }

    [Fact]
    public void TryUse_OfTheSameStep_GivesIt_AndOfAnotherDoesNot()
    {
        Scene scene = new SceneBuilder("dome").AddStaticSphere("dome", V(0), 1, 0).Build();
        SimTime due = At(1);
        Assert.True(Uses(scene, due, due, 0));
        Assert.False(Uses(scene, due, due + SimDuration.OneTick, 0));
        Assert.False(Uses(scene, due, due, Math.BitIncrement(0.1) - 0.1)); // a bit of a speed
    }

    private static bool Uses(Scene scene, SimTime taken, SimTime due, double faster)
    {
        StepsAhead steps = new(1, () => new IslandStep(scene, new Forces(scene, At(0))), AtOnce);
        Assert.True(steps.TryRent(At(0), out StepsAhead.Job rented));
        IslandStep there = rented.Step;
        Fill(there, 0.1);
        steps.Begin(rented, taken, 0);
        IslandStep step = new(scene, new Forces(scene, At(0)));
        Fill(step, 0.1 + faster);
        bool uses = steps.TryUse(ref step, due);
        Assert.Equal(uses, ReferenceEquals(step, there));
        return uses;
    }

    private static void Fill(IslandStep step, double speed)
    {
        step.Clear();
        step.AddBody(First, new BodySpec(0.5, 1, 0), V(0, 1.5), V(speed), V(0));
        step.AddContact(0, ContactPoint.Static, 0, 0, 0);
    }

    /// <summary>Two heaps in a groove, far from each other.</summary>
    private static (ulong Hash, long Used) Run(SimulationOptions options)
    {
        double half = Math.Sqrt(0.5);
        SceneBuilder builder = new SceneBuilder("heaps").AddPlane("left", V(half, half), 0.0, 0.2, 1).AddPlane("right", V(-half, half), 0.0, 0.2, 1);
        for (int n = 0; n < 24; n++)
        {
            double left = 0.53 + (1.05 * (n % 3)) + (0.003 * n), right = 0.53 + (1.05 * (n / 3 % 2)), along = (1.05 * (n / 6 % 2)) + (n < 12 ? 0 : 40);
            builder.AddBody($"ball {n}", new BodySpec(0.5, 1, 0.2, friction: 0.3), V((left - right) * half, (left + right) * half, along));
        }

        Simulation world = new(builder.Build(), options);
        world.AdvanceTo(At(2));
        return (world.EventHash(At(2)), world.StepsUsedAhead);
    }
}
