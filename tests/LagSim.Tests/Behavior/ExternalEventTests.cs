using System;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>What players do to a world, and what becomes of it when it comes late, twice, too late or for nobody.</summary>
public sealed class ExternalEventTests
{
    private static readonly BodyId Guest = new(1, 1, 0);

    private static Scene Space => new SceneBuilder("space").WithGravity(Floating).AddBody("ball", Ball(mass: 2), V(0), V(1)).Build();

    private static ExternalEvent SpawnAt(double seconds) => ExternalEvent.Spawn(At(seconds), 1, 1, Ball(), V(0, 5), V(0, 0, 1));

    [Fact]
    public void SubmitForwarded_ImpulseBeyondThePermittedSpeed_HasNoEffectAsInTime()
    {
        Simulation forwarded = Run(Drop(10, 0.8), 0.5), inTime = Run(Drop(10, 0.8), 0.5);
        ExternalEvent external = ExternalEvent.Impulse(At(0.4), 1, 1, First, V(0, 1e13));
        forwarded.SubmitForwarded(external, At(0.45));
        inTime.Submit(external);
        forwarded.AdvanceTo(At(0.5));
        inTime.AdvanceTo(At(0.5));
        Assert.Equal(inTime.StateHash(At(0.5)), forwarded.StateHash(At(0.5)));
        forwarded.SubmitForwarded(ExternalEvent.Impulse(At(0.4), 1, 2, First, V(0, 1)), At(0.46)); // the control
        forwarded.AdvanceTo(At(0.5));
        Assert.NotEqual(inTime.StateHash(At(0.5)), forwarded.StateHash(At(0.5)));
    }

    [Fact]
    public void TookEffect_OfEachEvent_TellsWhatHadNone()
    {
        ExternalEvent push = ExternalEvent.Impulse(At(1), 1, 1, First, V(0, 2)), shot = ExternalEvent.Impulse(At(1.5), 1, 2, First, V(0, 1e13));
        ExternalEvent gone = ExternalEvent.SetVelocity(At(1.5), 2, 1, Guest, V(1)), held = ExternalEvent.SetVelocity(At(2.5), 2, 2, First, V(1));
        ExternalEvent grab = ExternalEvent.Grab(At(2), 1, 3, First), keyframe = ExternalEvent.HoldKeyframe(At(2.25), 1, 5, First, V(1, 2), V(0));
        ExternalEvent drop = ExternalEvent.Release(At(3), 2, 3, First), removal = ExternalEvent.Remove(At(4), 1, 4, First);
        Simulation simulation = new(Space, KeepAll);
        Assert.Equal(SubmitResult.Queued, simulation.Submit(push));
        Assert.Equal(SubmitResult.Queued, simulation.Submit(shot));
        Assert.False(simulation.TookEffect(push)); // its time has not come
        foreach (ExternalEvent external in new[] { gone, held, grab, keyframe, drop, removal })
        {
            simulation.Submit(external);
        }

        simulation.AdvanceTo(At(5));
        Assert.Equal([true, false, false, false, true, true, false, true], new[] { push, shot, gone, held, grab, keyframe, drop, removal }.Select(e => simulation.TookEffect(e)));
        Assert.Equal(V(1, 1), Read(simulation, First, 1.6).Velocity); // what was too much has not been clamped

        // A later event can change the answer.
        simulation.Submit(ExternalEvent.Spawn(At(0.5), 1, 9, Ball(), V(0, 5), V(0)));
        simulation.AdvanceTo(At(5));
        Assert.False(simulation.TookEffect(gone)); // that is another body
        simulation.Submit(ExternalEvent.Spawn(At(0.5), 1, 1, Ball(), V(0, -5), V(0)));
        Assert.False(simulation.TookEffect(gone)); // not before it is simulated again
        simulation.AdvanceTo(At(5));
        Assert.True(simulation.TookEffect(gone));
        simulation.Retract(push);
        Assert.False(simulation.TookEffect(push));
    }

    [Fact]
    public void TookEffect_WhileAHealIsUnderWay_IsNotKnownAheadOfIt()
    {
        Simulation simulation = new(Space, KeepAll);
        ExternalEvent push = ExternalEvent.Impulse(At(1), 1, 1, First, V(0, 2));
        simulation.Submit(push);
        simulation.AdvanceTo(At(2));
        Assert.True(simulation.TookEffect(push)); // the control
        simulation.Submit(ExternalEvent.Spawn(At(0.5), 1, 9, Ball(), V(0, 5), V(0)));
        Assert.True(simulation.SimulatedTo < At(1));
        Assert.False(simulation.TookEffect(push));
        simulation.AdvanceTo(At(2));
        Assert.True(simulation.TookEffect(push));
    }

    [Fact]
    public void TookEffect_OfAForwardedEvent_IsOfItsArrival()
    {
        Simulation simulation = Run(Space, 1);
        ExternalEvent push = ExternalEvent.Impulse(At(0.5), 1, 1, First, V(0, 2));
        simulation.SubmitForwarded(push, At(1.5));
        Assert.False(simulation.TookEffect(push));
        simulation.AdvanceTo(At(2));
        Assert.True(simulation.TookEffect(push));
    }

    [Fact]
    public void Spawn_AtItsTime_IsThereFromThatTickOn()
    {
        Simulation simulation = new(Space, KeepAll);
        Assert.Equal(SubmitResult.Queued, simulation.Submit(SpawnAt(1)));
        simulation.AdvanceTo(At(3));
        Assert.False(simulation.TryRead(Guest, At(1) - SimDuration.OneTick, out _));
        Assert.True(simulation.TryRead(Guest, At(1), out BodyState born));
        Assert.Equal(V(0, 5), born.Position);
        Assert.Equal(V(0, 5, 2), Read(simulation, Guest, 3).Position);
    }

    [Fact]
    public void Remove_AtItsTime_TakesTheBodyOutOfEverything()
    {
        Simulation simulation = new(Space, KeepAll);
        simulation.Submit(ExternalEvent.Spawn(At(0.5), 1, 1, Ball(), V(3), V(0)));
        simulation.Submit(ExternalEvent.Remove(At(1), 2, 1, Guest));
        simulation.AdvanceTo(At(5));
        Assert.True(simulation.TryRead(Guest, At(1) - SimDuration.OneTick, out _));
        Assert.False(simulation.TryRead(Guest, At(1), out BodyState gone));
        Assert.Equal(MotionLaw.Absent, gone.Motion);
        Assert.Empty(Impacts(simulation, First)); // it flew through where the guest was
        Assert.NotEmpty(Impacts(With(Space, 5, ExternalEvent.Spawn(At(0.5), 1, 1, Ball(), V(3), V(0))), First));
    }

    [Fact]
    public void TeleportSetVelocityImpulse_Each_DoesWhatItSays()
    {
        Simulation simulation = With(
            Space, 6,
            ExternalEvent.Teleport(At(1), 1, 1, First, V(10, 20, 30)),
            ExternalEvent.SetVelocity(At(2), 1, 2, First, V(0, 3)),
            ExternalEvent.Impulse(At(4), 1, 3, First, V(0, 0, 8)));
        Assert.Equal(V(10, 20, 30), Read(simulation, First, 2).Position); // a teleport leaves it without velocity
        Assert.Equal(V(10, 26, 30), Read(simulation, First, 4).Position);
        Assert.Equal(V(0, 3, 4), Read(simulation, First, 4).Velocity); // 8 N s on 2 kg
        Assert.Equal(V(10, 32, 38), Read(simulation, First, 6).Position);
    }

    [Fact]
    public void SpawnAndTeleport_AtTheSameTick_BothCount()
    {
        Simulation simulation = With(Space, 2, ExternalEvent.Teleport(At(1), 0, 7, Guest, V(0, 9)), SpawnAt(1));
        Assert.Equal(V(0, 9), Read(simulation, Guest, 1).Position);
    }

    [Fact]
    public void Actions_ToABodyThatIsNotThere_DoNothingUntilItsSpawnArrives()
    {
        ExternalEvent action = ExternalEvent.SetVelocity(At(1), 2, 1, Guest, V(0, 0, -4));
        Simulation simulation = With(Space, 2, action);
        Simulation untouched = Run(Space, 2);
        Assert.Equal(untouched.StateHash(At(2)), simulation.StateHash(At(2)));
        Assert.Equal(untouched.EventHash(At(2)), simulation.EventHash(At(2)));

        Assert.Equal(SubmitResult.RolledBack, simulation.Submit(SpawnAt(0.5)));
        simulation.AdvanceTo(At(2));
        Assert.Equal(V(0, 5, 0.5 - 4), Read(simulation, Guest, 2).Position);
        Simulation onTime = With(Space, 2, SpawnAt(0.5), action);
        Assert.Equal(onTime.StateHash(At(2)), simulation.StateHash(At(2)));
        Assert.Equal(onTime.EventHash(At(2)), simulation.EventHash(At(2)));
    }

    [Fact]
    public void Retract_OfAnAppliedEvent_IsAsIfItHadNeverBeen()
    {
        ExternalEvent action = ExternalEvent.SetVelocity(At(1), 2, 1, First, V(0, 1));
        Simulation simulation = With(Space, 2, action);
        Assert.NotEqual(Run(Space, 2).StateHash(At(2)), simulation.StateHash(At(2)));
        Assert.True(simulation.Retract(action));
        Assert.False(simulation.Retract(action));
        Assert.Equal(Run(Space, 2).StateHash(At(2)), simulation.StateHash(At(2)));
        Assert.Equal(Run(Space, 2).EventHash(At(2)), simulation.EventHash(At(2)));
    }

    [Fact]
    public void Retract_OfAQueuedEvent_LeavesTheOthersQueued()
    {
        ExternalEvent first = ExternalEvent.SetVelocity(At(1), 2, 1, First, V(0, 1)), second = ExternalEvent.SetVelocity(At(1.5), 2, 2, First, V(0, 2));
        Simulation simulation = new(Space, KeepAll);
        simulation.Submit(first);
        simulation.Submit(second);
        Assert.True(simulation.Retract(first));
        simulation.AdvanceTo(At(2));
        Assert.Equal(0, simulation.Rollbacks);
        Assert.Equal(V(1.5, 1), Read(simulation, First, 2).Position);
    }

    [Fact]
    public void Retract_OfASpawnOthersWereHitBy_TakesTheHitsBackToo()
    {
        ExternalEvent spawn = ExternalEvent.Spawn(At(0.5), 1, 1, Ball(), V(3), V(0));
        Simulation simulation = With(Space, 5, spawn);
        Assert.NotEmpty(Impacts(simulation, First));
        Assert.True(simulation.Retract(spawn));
        Assert.Equal(Run(Space, 5).EventHash(At(5)), simulation.EventHash(At(5)));
    }

    [Fact]
    public void Retract_OfAnUnknownEvent_IsFalse()
    {
        Simulation simulation = Run(Space, 1);
        Assert.False(simulation.Retract(ExternalEvent.Remove(At(0.5), 1, 1, First)));
        Assert.False(simulation.Retract(ExternalEvent.Remove(At(0.5), 1, 1, Guest)));
    }

    [Fact]
    public void SubmitAndRetract_BeforeTheHistory_ChangeNothing()
    {
        ExternalEvent old = ExternalEvent.SetVelocity(At(0.5), 1, 1, First, V(0, 1));
        Simulation simulation = new(Space, new SimulationOptions(default, SimDuration.FromSeconds(1)));
        simulation.Submit(old);
        for (int i = 1; i <= 100; i++)
        {
            simulation.Submit(ExternalEvent.SetVelocity(At(0.05 * i), 2, (uint)i, First, V(0, 1 + (i % 2))));
            simulation.AdvanceTo(At(0.05 * i));
        }

        Assert.Equal(At(5) - SimDuration.FromSeconds(1), simulation.HistoryEdge);
        ulong before = simulation.StateHash(At(5));
        Assert.Equal(SubmitResult.TooOld, simulation.Submit(ExternalEvent.Remove(simulation.HistoryEdge - SimDuration.OneTick, 3, 1, First)));
        Assert.False(simulation.Retract(old));
        Assert.Equal(before, simulation.StateHash(At(5)));
        Assert.Equal(0, simulation.Rollbacks);
        Assert.Equal(SubmitResult.RolledBack, simulation.Submit(ExternalEvent.Remove(simulation.HistoryEdge, 3, 1, First)));
        Assert.Throws<ArgumentOutOfRangeException>(() => simulation.StateHash(simulation.HistoryEdge - SimDuration.OneTick));
        simulation.AdvanceTo(At(5));
        simulation.DropHistoryBefore(At(4.5));
        Assert.Equal(SubmitResult.TooOld, simulation.Submit(ExternalEvent.Remove(At(4.4), 3, 2, First)));
    }

    [Fact]
    public void Submit_TheSameEventAgain_IsADuplicateQueuedOrApplied()
    {
        ExternalEvent action = ExternalEvent.Impulse(At(1), 2, 1, First, V(0, 2));
        Simulation simulation = new(Space, KeepAll);
        Assert.Equal(SubmitResult.Queued, simulation.Submit(action));
        Assert.Equal(SubmitResult.Duplicate, simulation.Submit(action));
        simulation.AdvanceTo(At(2));
        Assert.Equal(SubmitResult.Duplicate, simulation.Submit(action));
        Assert.Equal(V(1, 1), Read(simulation, First, 2).Velocity);
        Assert.Equal(0, simulation.Rollbacks);

        // The control: another sequence number is another action.
        Assert.Equal(SubmitResult.RolledBack, simulation.Submit(ExternalEvent.Impulse(At(1), 2, 2, First, V(0, 2))));
        simulation.AdvanceTo(At(2));
        Assert.Equal(V(1, 2), Read(simulation, First, 2).Velocity);
    }

    [Fact]
    public void Impulse_ThatWouldExceedTheFastestSpeed_HasNoEffect()
    {
        Simulation simulation = With(Space, 2, ExternalEvent.Impulse(At(1), 1, 1, First, V(1e300)));
        Assert.Equal(Run(Space, 2).StateHash(At(2)), simulation.StateHash(At(2)));
    }

    [Fact]
    public void Forwarded_LateSpawn_IsWhereItWouldBeHadItComeInTime()
    {
        Scene scene = new SceneBuilder("empty").AddPlane("floor", Vector3D.Up, Vector3D.Zero).WithSmallestRadius(0.5).Build();
        ExternalEvent spawn = ExternalEvent.Spawn(At(0.3), 1, 1, new BodySpec(0.5, 1, 0.8), new Vector3D(0, 5, 0), new Vector3D(3, 0, 0));
        Simulation onTime = new(scene, KeepAll);
        onTime.Submit(spawn);
        onTime.AdvanceTo(At(2));
        Simulation late = new(scene, KeepAll);
        late.AdvanceTo(At(0.4));
        late.SubmitForwarded(spawn, At(0.4));
        late.AdvanceTo(At(2));

        // Not to the bit: its contacts are looked for from the arrival on, so a root may differ by rounding.
        onTime.TryRead(spawn.Body, At(2), out BodyState expected);
        late.TryRead(spawn.Body, At(2), out BodyState actual);
        Assert.True((expected.Position - actual.Position).Length < 1e-11, $"{expected.Position} and {actual.Position}");
    }

    [Fact]
    public void Forwarded_LateTeleport_AgreesWithItsOwnPathFromTheArrivalOn()
    {
        Scene scene = Drop(1, 0.8, MotionLaw.RungeKutta4);
        ExternalEvent teleport = ExternalEvent.Teleport(At(0.3), 1, 1, First, V(0, 4));
        Simulation onTime = With(scene, 3, teleport);
        Simulation late = Run(scene, 0.35);
        late.SubmitForwarded(teleport, At(0.325));
        late.AdvanceTo(At(3));
        Assert.NotEqual(onTime.StateHash(At(0.31)), late.StateHash(At(0.31))); // what was before the arrival stays
        SameBits(Read(onTime, First, 0.33), Read(late, First, 0.33));
        SameBits(Read(onTime, First, 3), Read(late, First, 3));
        Assert.Throws<ArgumentOutOfRangeException>(() => late.SubmitForwarded(teleport, At(0.29)));
    }

    [Fact]
    public void TwoSpawns_InEitherOrderOfArrival_GiveTheSameBits()
    {
        // Other slots, other order of discovery, one and the same impact of three at once.
        ExternalEvent left = ExternalEvent.Spawn(At(0.1), 1, 1, Ball(mass: 1.7), V(-0.2, 5, 0.5), V(0, -7));
        ExternalEvent right = ExternalEvent.Spawn(At(0.1), 2, 1, Ball(mass: 0.3), V(0.4, 5, 0.5), V(0, -7));
        Scene scene = new SceneBuilder("floor").WithSmallestRadius(0.1).AddPlane("floor", Vector3D.Up, V(0), 0.9).AddStaticSphere("dome", V(0), 1, 0.7).AddBody("ball", Ball(), V(0, 2.5, -0.4)).Build();
        ExternalEvent[] spawns = [left, ExternalEvent.Spawn(At(0.1), 3, 1, Ball(0.1), V(0.1, 8), V(0, -1)), right];
        Simulation a = With(scene, 2, spawns), b = With(scene, 2, spawns.Reverse().ToArray());
        Assert.True(a.EventsProcessed > 6);
        Assert.Equal(a.StateHash(At(2)), b.StateHash(At(2)));
        Assert.Equal(a.EventHash(At(2)), b.EventHash(At(2)));
        SameTimelines(a, b);
    }

    private static Simulation With(Scene scene, double seconds, params ExternalEvent[] events)
    {
        Simulation simulation = new(scene, KeepAll);
        foreach (ExternalEvent external in events)
        {
            simulation.Submit(external);
        }

        simulation.AdvanceTo(At(seconds));
        return simulation;
    }
}
