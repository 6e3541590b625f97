using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Determinism;

/// <summary>Random heaps that are kicked, shot at, robbed and gone through while their next steps are taken ahead: news in time or late, and copies, change no bit.</summary>
public sealed class StepsAheadPropertyTests
{
    private const double Length = 0.6;
    private const double CopiedAt = 0.45;

    /// <summary>The bodies of each heap; eight contacts at least, so that its steps are taken ahead.</summary>
    private static readonly int[] Heaps = [9, 7, 6];

    private static readonly Action<WaitCallback, object> AtOnce = (run, job) => run(job);

    /// <summary>Each with its world as one thread makes it.</summary>
    private static readonly Lazy<(Scene Scene, ExternalEvent[] Events, Simulation Plain)>[] Drawn = [.. Enumerable.Range(0, 4).Select(seed => new Lazy<(Scene, ExternalEvent[], Simulation)>(() =>
    {
        (Scene scene, ExternalEvent[] events) = Draw(seed);
        return (scene, events, Play(scene, events, Options(Way.OneThread), null));
    }))];

    /// <summary>How a world is run that must come to the same.</summary>
    public enum Way
    {
        /// <summary>All steps are taken ahead, the moment that they can be.</summary>
        AtOnce,

        /// <summary>Some are, on the pool's threads, as it happens.</summary>
        Pool,

        /// <summary>One thread, for news that comes late.</summary>
        OneThread,
    }

    public static TheoryData<int, Way, bool> Ways
    {
        get
        {
            TheoryData<int, Way, bool> ways = [];
            foreach (int seed in new[] { 1, 2, 3 })
            {
                ways.Add(seed, Way.AtOnce, false);
                ways.Add(seed, Way.AtOnce, true);
                ways.Add(seed, seed == 1 ? Way.OneThread : Way.Pool, true);
            }

            return ways;
        }
    }

    [Theory]
    [MemberData(nameof(Ways))]
    public void News_InTimeOrLateWhileStepsAreAhead_ChangesNoBitOfOneThread(int seed, Way way, bool isLate)
    {
        (Scene scene, ExternalEvent[] events, Simulation plain) = Drawn[seed].Value;
        Simulation other = Play(scene, events, Options(way), isLate ? new Random(seed) : null);
        AssertSame(plain, other);
        Assert.True(!isLate || other.Rollbacks > 3, $"{other.Rollbacks} heals");
        Assert.True(way != Way.AtOnce || other.StepsUsedAhead > 50, $"{other.StepsUsedAhead} steps ahead");
    }

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    public void Copy_TakenAndLoadedWhileStepsAreAhead_GoesOnAsOneThreadDoes(int seed)
    {
        (Scene scene, ExternalEvent[] events, Simulation plain) = Drawn[seed].Value;
        Simulation ahead = new(scene, Options(Way.AtOnce));
        foreach (ExternalEvent external in events)
        {
            ahead.Submit(external);
        }

        // Half a step after the instant that is copied, so that steps beyond it have been taken.
        ahead.AdvanceTo(At(CopiedAt + 0.001));
        Assert.True(ahead.StepsUsedAhead > 50);
        WorldSnapshot copy = ahead.Snapshot(At(CopiedAt)), right = plain.Snapshot(At(CopiedAt));
        Assert.Equal((right.Start, right.Time, right.EventHash), (copy.Start, copy.Time, copy.EventHash));
        Assert.Equal(right.Bodies, copy.Bodies);
        Assert.NotEqual(right.Bodies, plain.Snapshot(At(CopiedAt + 0.002)).Bodies);

        Simulation loaded = new(scene, copy, Options(Way.AtOnce));
        foreach (ExternalEvent external in events.Where(e => e.Time > At(CopiedAt)))
        {
            loaded.Submit(external);
        }

        loaded.AdvanceTo(At(Length));
        Assert.True(loaded.StepsUsedAhead > 20, $"{loaded.StepsUsedAhead}");
        ahead.AdvanceTo(At(Length));
        foreach (double time in Times().Where(t => t > CopiedAt))
        {
            Assert.Equal((plain.StateHash(At(time)), plain.EventHash(At(time))), (loaded.StateHash(At(time)), loaded.EventHash(At(time))));
        }

        AssertSame(plain, ahead);
    }

    [Theory]
    [InlineData(1)]
    [InlineData(3)]
    public void StepTakenAhead_UsedThoughItsIslandWasTouched_IsSeen(int seed)
    {
        // The control: the same worlds with a fault differ.
        (Scene scene, ExternalEvent[] events, Simulation plain) = Drawn[seed].Value;
        Simulation wrong = Play(scene, events, Options(Way.AtOnce), null, hasFault: true);
        Assert.NotEqual(plain.StateHash(At(Length)), wrong.StateHash(At(Length)));
    }

    private static SimulationOptions Options(Way way) => way switch
    {
        Way.AtOnce => new(default, SimDuration.MaxValue, threads: 3) { OtherThread = AtOnce },
        Way.Pool => new(default, SimDuration.MaxValue, threads: 3),
        _ => new(default, SimDuration.MaxValue, threads: 1),
    };

    private static IEnumerable<double> Times() => Enumerable.Range(1, 28).Select(n => Length * n / 28);

    private static void AssertSame(Simulation expected, Simulation actual)
    {
        foreach (double time in Times())
        {
            Assert.Equal((time, expected.StateHash(At(time)), expected.EventHash(At(time))), (time, actual.StateHash(At(time)), actual.EventHash(At(time))));
        }
    }

    /// <summary>All news known from the start, or, with luck given, each up to 100 ms late and in the order in which it comes.</summary>
    private static Simulation Play(Scene scene, ExternalEvent[] events, SimulationOptions options, Random? luck, bool hasFault = false)
    {
        Simulation world = new(scene, options) { UsesStepsOfTouched = hasFault };
        foreach ((double at, ExternalEvent external) in events.Select(e => (At: luck is null ? -1 : e.Time.ToSeconds() + (0.1 * luck.NextDouble()), e)).OrderBy(e => e.At))
        {
            if (luck is not null)
            {
                world.AdvanceTo(SimTime.Max(world.SimulatedTo, At(Math.Min(at, Length))));
            }

            world.Submit(external);
        }

        world.AdvanceTo(At(Length));
        return world;
    }

    /// <summary>Three unequal heaps in a groove, far from each other, and what players do to them; some of it at the very tick at which a step ends.</summary>
    private static (Scene Scene, ExternalEvent[] Events) Draw(int seed)
    {
        Random random = new(seed);
        double half = Math.Sqrt(0.5);
        double[] frictions = seed % 2 == 0 ? [0, 0.2, 0.6] : [0.3, 0.6, 1];
        double[] masses = seed % 3 == 0 ? [0.02, 1, 10] : [0.5, 1, 3];
        SceneBuilder builder = new SceneBuilder("heaps").WithSmallestRadius(0.3)
            .AddPlane("left", V(half, half), 0.0, 0, 1).AddPlane("right", V(-half, half), 0.0, 0, 1);
        List<int> heapOf = [];
        for (int heap = 0; heap < Heaps.Length; heap++)
        {
            for (int n = 0; n < Heaps[heap]; n++)
            {
                double left = 0.52 + (1.01 * (n % 3)), right = 0.52 + (1.01 * (n / 3 % 2)), along = (1.01 * (n / 6)) + (40 * heap);
                double friction = frictions[random.Next(3)];
                builder.AddBody(
                    $"ball {heapOf.Count}",
                    new BodySpec(0.5 - (0.04 * random.NextDouble()), masses[random.Next(3)], 0, friction: friction, rollingResistance: friction > 0 ? 0.05 * random.Next(2) : 0),
                    V((left - right) * half, (left + right) * half, along), V(0, -1));
                heapOf.Add(heap);
            }
        }

        Scene scene = builder.Build();
        List<ExternalEvent> events = [];
        uint sequence = 0;
        byte Peer() => (byte)random.Next(1, 5);
        Vector3D Velocity(double most) => V((2 * random.NextDouble()) - 1, (2 * random.NextDouble()) - 1, (2 * random.NextDouble()) - 1) * most;
        double When() => 0.3 + (0.25 * random.NextDouble());
        for (int n = 0; n < 4; n++)
        {
            events.Add(ExternalEvent.SetVelocity(At(When()), Peer(), ++sequence, BodyId.OfScene(random.Next(heapOf.Count)), Velocity(2)));
        }

        events.Add(ExternalEvent.Remove(At(When()), Peer(), ++sequence, BodyId.OfScene(random.Next(heapOf.Count))));
        events.Add(ExternalEvent.Spawn(At(When()), Peer(), ++sequence, new BodySpec(0.3, 1, 0.2, friction: 0.5), V(0, 3, 0.5 + (40 * random.Next(3))), V(0, -6)));

        // A hand takes one and lifts it through the rest.
        double grab = When();
        BodyId held = BodyId.OfScene(Heaps[0] + 3 + random.Next(3));
        events.Add(ExternalEvent.Grab(At(grab), 5, ++sequence, held));
        for (int knot = 1; knot < 5; knot++)
        {
            events.Add(ExternalEvent.HoldKnot(At(grab + (0.02 * knot)), 5, ++sequence, held, V(0.05 * knot, 1.8 + (0.3 * knot), 40.5), V(0, 2)));
        }

        events.Add(ExternalEvent.Release(At(grab + 0.11), 5, ++sequence, held, Velocity(1)));

        // Where a step ends, before anything else has happened: what was taken ahead for that tick is of other states.
        double first = events.Min(e => e.Time.ToSeconds());
        Simulation untouched = new(scene, Options(Way.OneThread));
        untouched.AdvanceTo(At(first));
        foreach (int heap in new[] { 0, 2 })
        {
            BodyId body = BodyId.OfScene(heap == 0 ? 1 : heapOf.Count - 2);
            TimelineEntry[] ends = [.. untouched.Timeline(body).Where(e => e.Key.Kind == EventKind.StepEnd && e.State.Motion == MotionLaw.Constrained)];
            Assert.NotEmpty(ends);
            events.Add(ExternalEvent.SetVelocity(ends[^1].Key.Time, Peer(), ++sequence, body, ends[^1].State.Velocity + Velocity(1e-3)));
        }

        return (scene, [.. events]);
    }
}
