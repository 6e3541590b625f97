using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Tests.Determinism;
using LagSim.Tests.Faults;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sensors;

/// <summary>The log of crossings is a fold, too: that of a healed world is that of a world that had every event in time.</summary>
public sealed class CrossingHealingTests
{
    private const int Worlds = 120;

    [Theory]
    [InlineData(HealingMode.CausalCone, false)]
    [InlineData(HealingMode.CausalCone, true)]
    [InlineData(HealingMode.FullRollback, false)]
    [InlineData(HealingMode.FullRollback, true)]
    [InlineData(HealingMode.SyncTest, false)]
    public void Crossings_OfAHealedWorld_AreThoseOfOneThatHadEverythingInTime(HealingMode mode, bool inPieces)
    {
        int crossings = 0;
        int reconverged = 0;
        for (int seed = 0; seed < Worlds; seed++)
        {
            RandomWorld world = World(seed);
            Simulation expected = world.OnTime();
            Simulation healed = world.Shuffled(
                seed, mode: mode, inPieces: inPieces, bruteForceLimit: seed % 4 == 1 ? 0 : 64,
                prepare: simulation => simulation.Healed += report => reconverged += report.ReconvergedAt is null ? 0 : 1);
            Assert.True(Difference(expected, healed) is null, $"seed {seed}: {Difference(expected, healed)}");
            crossings += All(expected).Count;
        }

        Assert.True(crossings > 20 * Worlds, $"{crossings} crossings");
        Assert.True(mode == HealingMode.FullRollback || reconverged > Worlds / 8, $"{reconverged} heals ended early");
    }

    [Theory]
    [InlineData((int)HealingFault.LeavesCrossings)]
    [InlineData((int)HealingFault.PutsNoCrossingsBack)]
    [InlineData((int)HealingFault.LeavesCarried)]
    public void Crossings_HealedWrongly_AreSeenToDiffer(int fault)
    {
        Assert.Contains(Enumerable.Range(0, Worlds), seed =>
        {
            RandomWorld world = World(seed);
            FaultyEngineParts parts = new() { Healing = (HealingFault)fault };
            try
            {
                return Difference(world.OnTime(), world.Shuffled(seed, parts: parts)) is not null;
            }
            catch (SimulationException)
            {
                return true; // a crossing that was not put back is found again where nothing can happen any more
            }
        });
    }

    /// <summary>Sensors change no path: the same world without them has the same segments.</summary>
    [Fact]
    public void Paths_WithSensors_AreThoseWithoutToTheBit()
    {
        for (int seed = 0; seed < Worlds; seed++)
        {
            RandomWorld world = World(seed);
            Simulation with = world.OnTime();
            Simulation without = world.OnTime(scene: Without(world));
            foreach (BodyId body in Bodies(with))
            {
                Assert.Equal(without.Timeline(body), with.Timeline(body));
            }

            Assert.Empty(All(without));
        }
    }

    /// <summary>At any instant a body is inside where its centre is, by the sensor's own measure, unless it is on the boundary.</summary>
    [Fact]
    public void Sides_AtSampledInstants_AreWhereBodiesAre()
    {
        int inside = 0;
        int seen = 0;
        for (int seed = 0; seed < Worlds; seed++)
        {
            Simulation world = World(seed).OnTime();
            for (int i = 0; i <= 50; i++)
            {
                SimTime time = At(RandomWorld.End * i / 50);
                foreach (BodyId body in Bodies(world))
                {
                    bool isThere = world.TryRead(body, time, out BodyState state);
                    for (int sensor = 0; sensor < world.Scene.Sensors.Count; sensor++)
                    {
                        Sensor region = world.Scene.Sensors[sensor];
                        BodyState carrier = default;
                        bool isSeen = isThere && region.Filter.CollidesWith(state.Filter) && body != region.Carrier
                            && (region.Carrier is not BodyId carried || world.TryRead(carried, time, out carrier));
                        double gap = region.Gap(state.Position - carrier.Position, world.SpecOf(body).Radius);
                        if (!isSeen || Math.Abs(gap) > 1e-7)
                        {
                            Assert.True((isSeen && gap < 0) == world.IsInside(body, sensor, time), $"seed {seed}: body {body}, sensor {sensor} at {time}: {gap}");
                            inside += isSeen && gap < 0 ? 1 : 0;
                            seen++;
                        }
                    }
                }
            }
        }

        Assert.InRange(inside, seen / 10, seen - (seen / 10));
    }

    [Fact]
    public void Crossings_OfAWorldThatGoesOnFromASnapshot_AreTheSame()
    {
        int after = 0;
        int onSegments = 0;
        for (int seed = 0; seed < Worlds; seed++)
        {
            RandomWorld world = World(seed);
            Simulation whole = world.OnTime();
            foreach (SimTime time in All(whole).Select(c => c.Time).Where((t, i) => t > At(0.01) && i % 7 == 0).SelectMany(t => new[] { t, t + SimDuration.OneTick }))
            {
                onSegments += whole.Snapshot(time).Bodies.Sum(body => body.Crossings.Length);
                Simulation rest = world.GoOnFrom(whole, time);
                Assert.Equal(All(whole).Where(c => c.Time >= time), All(rest));
                Assert.Null(RandomWorld.Difference(whole, rest));
                after += All(rest).Count;
            }
        }

        Assert.True(after > Worlds && onSegments > Worlds, $"{after} crossings after snapshots, {onSegments} in them");
    }

    /// <summary>The control: without what a body has crossed on its segment, the rest of it would be crossed again.</summary>
    [Fact]
    public void Crossings_SearchedFromTheOpening_AreSeenToDiffer()
    {
        Scene scene = new SceneBuilder("line").WithGravity(Vector3D.Zero).AddBody("ball", Ball(0.5), V(-3), V(1)).AddSensorSphere("ring", V(0), 1).Build();
        Assert.Equal([At(2), At(4)], All(Run(scene, 6)).Select(c => c.Time));
        Simulation wrong = new(scene, KeepAll.WithParts(new FaultyEngineParts { SearchesFromOpening = true }));
        wrong.WaitsForLateEvents = true;
        wrong.Engine.Meter.Observer = new StopsAfter(100); // it would cross again and again in one instant
        long events = 100;
        wrong.TryAdvanceTo(At(6), ref events);
        Assert.NotEqual([At(2), At(4)], All(wrong).Select(c => c.Time));
    }

    [Fact]
    public void Log_OfALongRun_IsBoundedByTheWindow()
    {
        Scene scene = new SceneBuilder("bounce").AddPlane("floor", Vector3D.Up, V(0)).AddBody("ball", Ball(0.5), V(0, 1.5)).AddSensorPlane("low", Vector3D.Up, 1.0).Build();
        Simulation world = new(scene, new SimulationOptions(history: SimDuration.FromSeconds(0.5)));
        world.AdvanceTo(At(10));
        Assert.InRange(All(world).Count, 1, 4);
        long before = GC.GetAllocatedBytesForCurrentThread();
        world.AdvanceTo(At(200));
        Assert.InRange(GC.GetAllocatedBytesForCurrentThread() - before, 0, 2_000);
        Assert.True(world.IsInside(First, 0, world.SimulatedTo) == Read(world, First, world.SimulatedTo).Position.Y < 1);
    }

    /// <summary>Lets so many events happen, and no more.</summary>
    private sealed class StopsAfter(int most) : IWorkObserver
    {
        private int count;

        public WorkVerdict OnWork(in EventKey key, Span<int> bodies, double amount, bool isAgain, BodyTable table) => OnCall(key, bodies, amount, isAgain, table);

        public WorkVerdict OnCall(in EventKey key, Span<int> bodies, double amount, bool isAgain, BodyTable table) => ++count < most ? WorkVerdict.GoOn : WorkVerdict.StopNow;
    }

    private static RandomWorld World(int seed) => new(seed, hands: seed % 5 == 0, forced: seed % 3 == 0, filters: seed % 4 == 0, sensors: true);

    private static Scene Without(RandomWorld world)
    {
        Scene scene = world.Scene;
        return new Scene(
            scene.Name, scene.Gravity, scene.RestitutionThreshold, scene.ContactTolerance, scene.PlaneArray, scene.SphereArray, scene.BodyArray, scene.ForceArray,
            scene.SmallestRadius, scene.Spawners, scene.Box, [], scene.Rules, scene.Seed);
    }

    private static IReadOnlyList<Crossing> All(Simulation world) => world.Crossings(SimTime.MinValue, SimTime.MaxValue);

    private static string? Difference(Simulation expected, Simulation actual)
    {
        IReadOnlyList<Crossing> a = All(expected);
        IReadOnlyList<Crossing> b = All(actual);
        for (int n = 0; n < Math.Max(a.Count, b.Count); n++)
        {
            if (n >= a.Count || n >= b.Count || a[n] != b[n])
            {
                return $"expected {(n < a.Count ? a[n].ToString() : "no more")}, was {(n < b.Count ? b[n].ToString() : "no more")}";
            }
        }

        return RandomWorld.Difference(expected, actual);
    }
}
