using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.Experiments.Hands;
using LagSim.Harness.Experiments.Hold;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Peers;

/// <summary>A hand that holds and throws a ball, played by sessions in virtual time.</summary>
public sealed class HoldTestTests
{
    [Theory]
    [InlineData("random", "delay-0ms", 2)]
    [InlineData("slow", "delay-100ms", 2)]
    [InlineData("random", "delay-500ms", 3)]
    [InlineData("random", "awful", 4)]
    public void Run_WithHealing_SettlesToTheBitAndIsSeenSoOnceNoEventIsOnItsWay(string motion, string link, int peers)
    {
        HoldOptions options = Options(motion, link) with { Peers = peers };
        HoldRun run = HoldTest.Run(options);
        Assert.True(run.Agrees);
        Assert.Equal((0, 0), Differing(run.Settled));
        Assert.All(run.Trace.SettledError, error => Assert.Equal(0, error));
        Assert.Equal(peers, run.StateHashes.Count);
        Assert.Single(run.StateHashes.Distinct());
        Assert.Equal(0, run.Seen.Before.ToStatistics().DifferingBits);
        Assert.Equal(0, run.Seen.After.ToStatistics().DifferingBits);
        Assert.True(run.Seen.After.ToStatistics().Samples > 500);
        Assert.True(run.Heals >= (peers - 1) * run.Keyframes);
        Assert.Equal(peers - 1, run.Views.Count);
        Assert.NotNull(run.Trace.Known);

        // The control: without compensation everything is done where it arrives, and stays wrong.
        HoldRun none = HoldTest.Run(options with { Strategy = "none" });
        Assert.False(none.Agrees);
        Assert.True(Differing(none.Settled).Bits > 100);
        Assert.Equal(0, none.Heals);
    }

    [Fact]
    public void Truth_WithOneKeyframeWithheld_IsAnotherWorld()
    {
        HoldRun run = HoldTest.Run(Options("random", "delay-100ms"));
        Assert.Equal((run.TruthStateHash, run.TruthEventHash), Hashes(run, run.Accepted));
        ExternalEvent[] keyframes = run.Accepted.Where(e => e.Kind == EventKind.HoldKeyframe).ToArray();
        Assert.Equal(run.Keyframes, keyframes.Length);
        foreach (ExternalEvent withheld in new[] { keyframes[1], keyframes[keyframes.Length / 2], keyframes[^1] })
        {
            Assert.NotEqual(run.TruthEventHash, Hashes(run, run.Accepted.Where(e => !e.Equals(withheld))).Events);
        }

        Assert.NotEqual(run.TruthStateHash, Hashes(run, run.Accepted.SkipLast(1)).State); // not thrown
        Assert.False((run with { TruthEventHash = run.TruthEventHash ^ 1 }).Agrees);
    }

    [Theory]
    [InlineData("slow")]
    [InlineData("random")]
    public void Views_OfAGeneratedMotion_AreAsGoodAsTheBestPredictorInHindsight(string motion)
    {
        double before = 0;
        foreach (double delay in new double[] { 0, 100, 300 })
        {
            HoldRun run = HoldTest.Run(Options(motion, $"delay-{delay}ms") with { HoldSeconds = 12 });
            HeldView host = run.Views.Single();
            Assert.Equal((0, 0), (host.Peer, host.Predicted.StalledSamples));
            Assert.Equal(2360, host.Predicted.Samples); // 11.8 s, the throw left out
            Assert.InRange(host.RatioToBest, 0.9, 1.15);
            Assert.True(host.Predicted.RmsMetres < host.Simulated.RmsMetres);
            Assert.InRange(host.Simulated.RmsMetres, before, 0.3); // later events, further off
            before = host.Simulated.RmsMetres;
            Assert.InRange(run.Own.RmsMetres, 1e-3, 0.02); // what keyframes leave out, whatever the delay
            if (delay == 100)
            {
                Assert.True(host.HoldLastMetres > 1.15 * host.BestInHindsightMetres); // the control: the bound excludes somebody
            }
        }
    }

    [Fact]
    public void Traffic_OfOneHand_IsBelowTheAimAndFollowsSurprise()
    {
        HoldRun slow = HoldTest.Run(Options("slow", "delay-100ms") with { HoldSeconds = 10 });
        HoldRun random = HoldTest.Run(Options("random", "delay-100ms") with { HoldSeconds = 10 });
        HoldRun coarse = HoldTest.Run(Options("random", "delay-100ms") with { HoldSeconds = 10, KeyframeDistanceMetres = 0.03 });
        Assert.InRange(slow.HolderBytesPerSecond, 1000, 4812); // 4.7 KiB, both ways
        Assert.InRange(random.HolderBytesPerSecond, 1000, 4812);
        Assert.InRange(coarse.HolderBytesPerSecond, 1000, 4812);
        Assert.True(random.HolderBytesPerSecond > coarse.HolderBytesPerSecond);
        Assert.True(random.KeyframesPerSecond > 1.5 * slow.KeyframesPerSecond);
        Assert.InRange(random.KeyframesPerSecond, 5, 20); // at most every 50 ms
    }

    [Fact]
    public void Release_ComesAtTheHandsVelocity_AndTheBallFlies()
    {
        HoldRun run = HoldTest.Run(Options("slow", "delay-100ms"));
        Assert.Equal([EventKind.Grab, EventKind.HoldKeyframe], run.Accepted.Take(2).Select(e => e.Kind));
        ExternalEvent release = run.Accepted[^1];
        Assert.Equal(EventKind.Release, release.Kind);
        Assert.InRange(release.Velocity.Length, 2.5, 4.5); // 1.875 times 0.71 m in 0.4 s, and the motion's own
        HoldTrace trace = run.Trace;
        int thrown = Array.FindIndex(trace.Seconds, second => second > trace.Release);
        Vector3D[] own = trace.Balls[HoldTest.Holder];
        double left = trace.Seconds[thrown] - trace.Release;
        Assert.Equal(release.Velocity.X, (own[thrown + 10].X - own[thrown].X) / 0.05, 1e-6); // it flies on as fast as the hand went
        Assert.InRange(left, 0, 0.005);
        Assert.True(own.Skip(thrown).Max(at => at.Y) > own[thrown].Y + 0.1);
        Assert.InRange((double)trace.Known! - trace.Release, 0.0999, 0.1001);
        Assert.InRange(trace.Release - trace.Grab, 3, 3.0001);
        Assert.All(Enumerable.Range(0, trace.Seconds.Length), n => Assert.Equal(trace.Seconds[n] >= trace.Grab && trace.Seconds[n] <= trace.Release, trace.Hand[n].IsFinite));
    }

    [Fact]
    public void Run_SameOptionsTwice_IsTheSame()
    {
        HoldOptions options = Options("random", "awful");
        HoldRun[] runs = [HoldTest.Run(options), HoldTest.Run(options), HoldTest.Run(options with { Seed = 2 })];
        Assert.Equal(runs[0].EventHashes, runs[1].EventHashes);
        Assert.Equal(runs[0].Views[0].Predicted, runs[1].Views[0].Predicted);
        Assert.Equal(runs[0].BytesSentPerSecond, runs[1].BytesSentPerSecond);
        Assert.NotEqual(runs[0].EventHashes[0], runs[2].EventHashes[0]);
    }

    [Fact]
    public void Run_WhatCannotBePlayed_IsRefusedByName()
    {
        HandMotion leap = Line("leap", n => new Vector3D(n == 100 ? 1 : 0, 0, 0)), dive = Line("dive", n => new Vector3D(0, -0.1 * n, 0));
        Refused<HandMotionException>(new HoldOptions(leap), "'leap'", "120 m/s", "100 m/s");
        Refused<HandMotionException>(new HoldOptions(dive), "'dive'", "24 m below", "20 m");
        Refused<ArgumentOutOfRangeException>(Options("slow", "delay-0ms") with { HoldSeconds = 50.5 }, "1 to 50 s", "50.5");
        Refused<ArgumentOutOfRangeException>(Options("slow", "delay-0ms") with { HoldSeconds = double.NaN }, "1 to 50 s", "NaN");
        Refused<ArgumentOutOfRangeException>(new HoldOptions(Line("still", _ => Vector3D.Zero)) { HoldSeconds = 2.1 }, "'still', 2 s", "2.1");
        HoldTest.Check(new HoldOptions(Line("still", _ => Vector3D.Zero)) { HoldSeconds = 2 });

        static HandMotion Line(string name, Func<int, Vector3D> at) => new(name, Enumerable.Range(0, 241).Select(at).ToArray());

        static void Refused<T>(HoldOptions options, params string[] words)
            where T : Exception
        {
            string said = Assert.Throws<T>(() => HoldTest.Check(options)).Message;
            Assert.All(words, word => Assert.Contains(word, said, StringComparison.Ordinal));
            Assert.Throws<T>(() => HoldTest.Run(options));
        }
    }

    [Fact]
    public void HandCourse_OfAnyMotion_IsInOnePieceAndClearOfTheFloor()
    {
        HandCourse course = new(HandMotions.Generate("random", 3), 10);
        Assert.Equal(new Vector3D(0, 0.1, 0), course.At(0));
        Assert.Equal(course.At(0), course.At(-1));
        Assert.Equal(11, course.Release);
        const double step = 1e-3;
        for (double time = 0; time < course.Release; time += step)
        {
            Assert.InRange((course.At(time + step) - course.At(time)).Length, 0, 8 * step);
            Assert.True(time < HandCourse.LiftSeconds || course.At(time).Y > 0.55);
        }

        // The throw is at its fastest when the hand opens.
        Vector3D thrown = course.VelocityAt(course.Release) - Plain().VelocityAt(course.Release);
        Assert.InRange(thrown.X, 2.2, 2.35); // 1.875 times 0.5 m in 0.4 s, over the last 120th
        Assert.Equal(thrown.X, thrown.Y, 1e-9);

        HandCourse Plain() => new(HandMotions.Generate("random", 3), 20); // not thrown by then
    }

    [Fact]
    public void HandView_OfASmoothMotion_IsNearItThoughKeyframesAreLateAndSeldom()
    {
        HandView view = new();
        Assert.False(view.TryDraw(TestWorlds.At(1), out _));
        HandSender sender = new(BodyId.OfScene(0));
        Queue<HandUpdate> lateEvents = new();
        for (double time = 1; time < 6; time += 1 / 120.0)
        {
            if (sender.TrySample(TestWorlds.At(time), Hand(time), Velocity(time), out PlayerAction keyframe))
            {
                lateEvents.Enqueue(new HandUpdate(TestWorlds.At(time + 0.1), keyframe.Stamp(TestWorlds.At(time), 1, 1)));
            }
        }

        Assert.InRange(lateEvents.Count, 15, 50); // seldom
        ErrorAccumulator errors = new(), last = new();
        for (double time = 1; time < 6; time += 0.005)
        {
            while (lateEvents.TryPeek(out HandUpdate next) && next.Heard <= TestWorlds.At(time))
            {
                view.Hear(lateEvents.Dequeue());
            }

            bool isDrawn = view.TryDraw(TestWorlds.At(time), out Vector3D drawn);
            Assert.Equal(time > 1.0999, isDrawn);
            if (time > 3)
            {
                errors.Add((drawn - Hand(time)).Length, true);
                last.Add((view.DrawnBy(0, TestWorlds.At(time)) - Hand(time)).Length, true);
            }
        }

        Assert.InRange(errors.ToStatistics().RmsMetres, 1e-6, 0.03);
        Assert.True(last.ToStatistics().RmsMetres > 2 * errors.ToStatistics().RmsMetres); // the control

        static Vector3D Hand(double time) => new(0.3 * Math.Sin(3 * time), 1, 0.1 * time);

        static Vector3D Velocity(double time) => new(0.9 * Math.Cos(3 * time), 0, 0.1);
    }

    private static HoldOptions Options(string motion, string link)
    {
        Assert.True(LinkProfiles.TryGet(link, out LinkProfile? found, out _));
        return new HoldOptions(HandMotions.Generate(motion, 1)) { HoldSeconds = 2, Link = found!, DelayMilliseconds = null };
    }

    private static (long Bits, long Stalled) Differing(PhaseErrors errors)
    {
        ErrorStatistics[] phases = [errors.Before.ToStatistics(), errors.During.ToStatistics(), errors.After.ToStatistics()];
        return (phases.Sum(e => e.DifferingBits), phases.Sum(e => e.StalledSamples));
    }

    private static (ulong State, ulong Events) Hashes(HoldRun run, IEnumerable<ExternalEvent> events)
    {
        SimTime start = run.Accepted[0].Time - SimDuration.FromSeconds(run.Trace.Grab);
        Simulation simulation = new(HoldOptions.BuildScene(), new SimulationOptions(start, SimDuration.MaxValue));
        foreach (ExternalEvent external in events)
        {
            simulation.Submit(external);
        }

        SimTime end = start + SimDuration.FromSeconds(run.Trace.Seconds[^1]);
        simulation.AdvanceTo(end);
        return (simulation.StateHash(end), simulation.EventHash(end));
    }
}
