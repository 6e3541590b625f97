using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Determinism;

/// <summary>A world that goes on from a snapshot is the world that was there from the start.</summary>
public sealed class SnapshotTests
{
    public static TheoryData<int> Blocks => [.. Enumerable.Range(0, 8)];

    [Theory]
    [MemberData(nameof(Blocks))]
    public void World_GoingOnFromASnapshot_IsTheSameToTheBit(int block)
    {
        int bodies = 0, inPersistentContact = 0, held = 0, stepping = 0, turning = 0;
        foreach (int seed in Enumerable.Range(20_000 + (block * 30), 30))
        {
            RandomWorld world = new(seed, hands: seed % 2 == 0, forced: seed % 3 == 0);
            Simulation expected = world.OnTime();
            foreach (SimTime time in Instants(expected, seed))
            {
                WorldSnapshot snapshot = expected.Snapshot(time);
                Simulation actual = GoOn(world, snapshot, seed);
                string? difference = RandomWorld.Difference(expected, actual);
                Assert.True(difference is null, $"seed {seed}, from {time}: {difference}");
                bodies += snapshot.Bodies.Count;
                inPersistentContact += snapshot.Bodies.Count(b => b.Contacts.Length > 0 || b.SupportCount > 0);
                held += snapshot.Bodies.Count(b => b.Law == MotionLaw.Held);
                stepping += snapshot.Bodies.Count(b => b.NextStep > SimDuration.Zero);
                turning += snapshot.Bodies.Count(b => b.Spin != Vector3D.Zero || b.SpinRate != Vector3D.Zero);
            }
        }

        Assert.True(bodies > 400 && inPersistentContact > 10 && held > 10 && stepping > 10 && turning > 10, $"{bodies} {inPersistentContact} {held} {stepping} {turning}"); // else nothing was shown
    }

    /// <summary>
    /// A contact that was struck in an instant waits before it is struck again, and a snapshot after it does not say how often it was.
    /// </summary>
    [Fact]
    public void Snapshot_TakenRightAfterALaterRoundOfImpacts_GoesOnTheSame()
    {
        int tried = 0;
        foreach (int seed in Enumerable.Range(30_000, 400))
        {
            RandomWorld world = new(seed, hands: seed % 2 == 0, forced: seed % 3 == 0);
            Simulation expected = world.OnTime();
            foreach (SimTime at in LaterRounds(expected).Take(20))
            {
                foreach (long ticks in new[] { 1, 2, ContactTime.SoonTicks, 4 * ContactTime.SoonTicks })
                {
                    Simulation actual = GoOn(world, expected.Snapshot(at + SimDuration.FromTicks(ticks)), seed);
                    string? difference = RandomWorld.Difference(expected, actual);
                    Assert.True(difference is null, $"seed {seed}, {ticks} ticks after {at}: {difference}");
                    tried++;
                }
            }
        }

        Assert.True(tried > 1_000, $"{tried}");
    }

    /// <summary>Who joins after one of an island was removed knows nothing of it, though the others carry its contact to their next tick: no hash may count that it is looked at.</summary>
    [Fact]
    public void Snapshot_TakenRightAfterAMemberWasRemoved_GoesOnToTheSameHashes()
    {
        Scene scene = new SceneBuilder("stack").AddPlane("floor", Vector3D.Up, 0.0).AddStaticSphere("dome", V(0), 1, 0)
            .AddBody("lower", Ball(e: 0), V(0, 1.5)).AddBody("upper", Ball(e: 0), V(0, 2.5)).Build();
        Simulation world = new(scene, KeepAll);
        world.Submit(ExternalEvent.Remove(At(0.2), 1, 1, Second));
        world.AdvanceTo(At(1));
        Assert.Equal(MotionLaw.Constrained, Read(world, First, 0.2).Motion);
        Simulation joined = new(scene, world.Snapshot(At(0.2) + SimDuration.OneTick), KeepAll);
        joined.AdvanceTo(At(1));
        Assert.Equal(world.StateHash(At(1)), joined.StateHash(At(1)));
        Assert.Equal(world.EventHash(At(1)), joined.EventHash(At(1)));
        Assert.All(world.Timeline(Second), entry => Assert.True(entry.Key.Time <= At(0.2)));
    }

    [Fact]
    public void Check_OneBitOfASnapshotPerturbed_IsSeenToFail()
    {
        int tried = 0, seen = 0;
        foreach (int seed in Enumerable.Range(21_000, 60))
        {
            RandomWorld world = new(seed);
            Simulation expected = world.OnTime();
            WorldSnapshot whole = expected.Snapshot(At(0.3));
            BodySnapshot[] bodies = whole.Bodies.ToArray();
            int which = Array.FindIndex(bodies, b => b.Law == MotionLaw.Ballistic);
            if (which >= 0 && !world.Events.Any(e => e.Body == bodies[which].Id))
            {
                BodySnapshot was = bodies[which];
                bodies[which] = With(was, velocity: was.Velocity + V(0, 0, was.Velocity.Z == 0 ? double.Epsilon : Math.BitIncrement(was.Velocity.Z) - was.Velocity.Z));
                tried++;
                Simulation actual = GoOn(world, new WorldSnapshot(whole.Start, whole.Time, whole.EventHash, bodies), seed);
                seen += actual.StateHash(whole.Time) != expected.StateHash(whole.Time) || RandomWorld.Difference(expected, actual) is not null ? 1 : 0;
            }
        }

        Assert.True(tried > 10, $"{tried}");
        Assert.Equal(tried, seen);
    }

    [Fact]
    public void Submit_EarlierThanTheSnapshot_IsTooOld()
    {
        Simulation world = Run(Drop(4, 0.8), 1);
        Simulation joined = new(world.Scene, world.Snapshot(At(0.5)), KeepAll);
        Assert.Equal(SubmitResult.TooOld, joined.Submit(ExternalEvent.Remove(At(0.5) - SimDuration.OneTick, 1, 1, First)));
        Assert.NotEqual(SubmitResult.TooOld, joined.Submit(ExternalEvent.Remove(At(0.5), 1, 1, First)));
    }

    [Fact]
    public void Snapshot_OutsideTheWindow_IsRefused()
    {
        Simulation world = Run(Drop(4, 0.8), 1);
        Assert.Throws<ArgumentOutOfRangeException>(() => world.Snapshot(At(0)));
        Assert.Throws<ArgumentOutOfRangeException>(() => world.Snapshot(At(1) + SimDuration.OneTick));
        world.DropHistoryBefore(At(0.5));
        Assert.Throws<ArgumentOutOfRangeException>(() => world.Snapshot(At(0.5) - SimDuration.OneTick));
        Assert.Single(world.Snapshot(At(0.5)).Bodies);
    }

    public static TheoryData<string, Func<BodySnapshot, BodySnapshot>> Impossible => new()
    {
        { "radius", b => With(b, spec: Ball(1e-12)) },
        { "promises none below", b => With(b, spec: Ball(0.1)) },
        { "mass", b => With(b, spec: Ball(mass: double.NaN)) },
        { "names force 0", b => With(b, spec: Ball(flight: MotionLaw.RungeKutta4, force: 1)) },
        { "position", b => With(b, position: V(double.NaN)) },
        { "velocity", b => With(b, velocity: V(1e300)) },
        { "acceleration", b => With(b, acceleration: V(0, double.NegativeInfinity)) },
        { "must be Sliding", b => With(b, law: MotionLaw.Absent) },
        { "must be Sliding", b => With(b, law: (MotionLaw)77) },
        { "must be Sliding", b => With(b, law: MotionLaw.RungeKutta4) },
        { "is carried", b => With(b, law: MotionLaw.Sliding) },
        { "The step of", b => With(b, law: MotionLaw.Constrained) },
        { "is carried", b => With(b, supports: [0]) },
        { "Plane 1", b => With(b, law: MotionLaw.Resting, supports: [1]) },
        { "Plane -1", b => With(b, law: MotionLaw.Resting, supports: [-1]) },
        { "Plane 0", b => With(b, law: MotionLaw.Resting, supports: [0, 0]) },
        { "opened by", b => With(b, opened: new EventKey(At(2), 0, EventKind.Impact, First, First, 0, 0)) },
        { "opened by", b => With(b, opened: new EventKey(At(-1), 0, EventKind.Impact, First, First, 0, 0)) },
        { "opened by", b => With(b, opened: new EventKey(At(0.1), 0, EventKind.Remove, First, First, 0, 0)) },
        { "counts from", b => With(b, epoch: At(0.9)) },
        { "counts from", b => With(b, epoch: SimTime.MinValue) },
        { "counts from", b => With(b, end: At(0.4)) },
    };

    [Theory]
    [MemberData(nameof(Impossible))]
    public void Simulation_SnapshotThatIsOfNoWorldOfTheScene_IsRefusedByName(string word, Func<BodySnapshot, BodySnapshot> change)
    {
        Simulation world = Run(new SceneBuilder("one").AddPlane("floor", Vector3D.Up, V(0)).AddBody("ball", Ball(), V(0, 3)).Build(), 1);
        WorldSnapshot good = world.Snapshot(At(0.5));
        Assert.Equal(world.StateHash(At(0.5)), new Simulation(world.Scene, good).StateHash(At(0.5))); // the control, without the change
        WorldSnapshot bad = new(good.Start, good.Time, good.EventHash, [change(good.Bodies[0])]);
        Assert.Contains(word, Assert.Throws<SceneException>(() => new Simulation(world.Scene, bad)).Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Simulation_SnapshotOfASceneWithMoreBodies_IsRefused()
    {
        Simulation four = Run(Bodies(4), 1);
        WorldSnapshot snapshot = four.Snapshot(At(0.5));
        Assert.Contains("has body 0.0.2", Assert.Throws<SceneException>(() => new Simulation(Bodies(2), snapshot)).Message, StringComparison.Ordinal);
        Assert.Equal(four.StateHash(At(0.5)), new Simulation(Bodies(4), snapshot).StateHash(At(0.5))); // the control

        static Scene Bodies(int count)
        {
            SceneBuilder builder = new("some");
            for (int n = 0; n < count; n++)
            {
                builder.AddBody($"{n}", Ball(), V(2 * n));
            }

            return builder.Build();
        }
    }

    [Fact]
    public void Simulation_ContactThatNoImpactHasSolved_IsRefusedByName()
    {
        Simulation world = Run(new SceneBuilder("two").AddPlane("floor", Vector3D.Up, V(0)).AddBody("low", Ball(0.5, 1, 0), V(0, 0.5)).AddBody("high", Ball(0.5, 1, 0), V(0, 1.6)).Build(), 1);
        WorldSnapshot good = world.Snapshot(At(0.6));
        Assert.Equal(EventKind.StepEnd, good.Bodies[0].Opened.Kind);
        Assert.Equal(world.StateHash(At(0.6)), new Simulation(world.Scene, With(solved: false)).StateHash(At(0.6))); // the control
        string message = Assert.Throws<SceneException>(() => new Simulation(world.Scene, With(solved: true))).Message;
        Assert.Contains("A contact of body 0.0.0", message, StringComparison.Ordinal);
        Assert.Contains("opened by StepEnd", message, StringComparison.Ordinal);

        WorldSnapshot With(bool solved)
        {
            BodySnapshot b = good.Bodies[0];
            BodySnapshot changed = new(b.Id, b.Spec, b.Opened, b.Law, b.Epoch, b.End, b.Position, b.Velocity, b.Acceleration, spin: b.Spin, spinRate: b.SpinRate,
                centre: b.Centre, stillSince: b.StillSince,
                contacts: [.. b.Contacts.ToArray().Select(c => new PersistentContact(c.Partner, c.Surface, c.Holds, c.Push, c.Turn, solved && c.Surface >= 0))]);
            return new WorldSnapshot(good.Start, good.Time, good.EventHash, [changed, good.Bodies[1]]);
        }
    }

    [Fact]
    public void Simulation_SnapshotOutOfOrderOrTime_IsRefusedByName()
    {
        Simulation world = Run(Drop(4, 0.8), 1);
        WorldSnapshot good = world.Snapshot(At(0.5));
        BodySnapshot one = good.Bodies[0];
        Refused("must ascend", good.Start, good.Time, one, one);
        Refused("began at", good.Time, good.Start, one);
        Refused("began at", good.Start, SimTime.MaxValue, one);
        Refused("began at", SimTime.MinValue, good.Time, one);

        void Refused(string word, SimTime start, SimTime time, params BodySnapshot[] bodies) => Assert.Contains(
            word, Assert.Throws<SceneException>(() => new Simulation(world.Scene, new WorldSnapshot(start, time, 0, bodies))).Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Bodies_GoneForGood_AreForgotten()
    {
        // Fifty thousand that come and go, and as many of which only somebody speaks: what is kept follows the window.
        Simulation world = new(Drop(4, 0.8), new SimulationOptions(default, SimDuration.FromSeconds(0.1)));
        int most = 0;
        for (uint n = 1; n <= 50_000; n++)
        {
            SimTime now = At(n * 0.001);
            world.Submit(ExternalEvent.Spawn(now, 1, n, Ball(), V(10 + (2 * (n % 20)), 50)));
            world.Submit(ExternalEvent.Remove(now + SimDuration.FromSeconds(0.01), 2, n, new BodyId(1, n, 0)));
            world.Submit(ExternalEvent.Impulse(now, 3, n, new BodyId(7, n, 0), V(1)));
            world.AdvanceTo(now);
            most = Math.Max(most, world.BodyCount);
        }

        Assert.InRange(most, 200, 1_000);
        Assert.True(world.TryRead(First, world.SimulatedTo, out _));
    }

    private static IEnumerable<SimTime> LaterRounds(Simulation world) => Bodies(world).SelectMany(world.Timeline)
        .Where(e => e.Key.Kind == EventKind.Impact && e.Key.Round > 0 && e.Key.Time > At(0.01) && e.Key.Time < At(RandomWorld.End - 0.01))
        .Select(e => e.Key.Time).Distinct();

    private static IEnumerable<SimTime> Instants(Simulation world, int seed)
    {
        // Somewhere, and at the very tick of an event and those beside it.
        Random random = new(seed);
        yield return At(0.05 + (random.NextDouble() * 1.15));
        SimTime[] busy = Bodies(world).SelectMany(world.Timeline).Select(e => e.Key.Time).Where(t => t > At(0.01) && t < At(RandomWorld.End)).ToArray();
        if (busy.Length > 0)
        {
            SimTime at = busy[random.Next(busy.Length)];
            yield return at;
            yield return at + SimDuration.OneTick;
        }
    }

    private static Simulation GoOn(RandomWorld world, WorldSnapshot snapshot, int seed)
    {
        Simulation simulation = new(world.Scene, snapshot, KeepAll);
        Random random = new(seed);
        foreach (ExternalEvent external in world.Events.Where(e => e.Time >= snapshot.Time).OrderBy(_ => random.Next()))
        {
            SimTime heard = SimTime.Min(At(RandomWorld.End), external.Time + SimDuration.FromSeconds(random.NextDouble() * 0.2));
            simulation.AdvanceTo(SimTime.Max(simulation.SimulatedTo, heard));
            Assert.NotEqual(SubmitResult.TooOld, simulation.Submit(external));
        }

        simulation.AdvanceTo(SimTime.Max(simulation.SimulatedTo, At(RandomWorld.End)));
        return simulation;
    }

    private static BodySnapshot With(
        in BodySnapshot b, BodySpec? spec = null, EventKey? opened = null, MotionLaw? law = null, SimTime? epoch = null, SimTime? end = null,
        Vector3D? position = null, Vector3D? velocity = null, Vector3D? acceleration = null, int[]? supports = null) => new(
        b.Id, spec ?? b.Spec, opened ?? b.Opened, law ?? b.Law, epoch ?? b.Epoch, end ?? b.End, position ?? b.Position, velocity ?? b.Velocity,
        acceleration ?? b.Acceleration, supports, b.Cubic, b.Quartic, b.Quintic, b.Hold, b.NextStep, b.Spin, b.SpinRate, b.Centre, b.StillSince, b.Contacts);
}
