using LagSim.BroadPhase;
using LagSim.Collisions;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Rollback;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using static LagSim.Tests.LooseParts;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Rollback;

/// <summary>
/// Two bodies, and the parts that a rewinder needs. Both are struck at one second, the second is pushed at two, and all is simulated to
/// three.
/// </summary>
internal sealed class RewoundWorld
{
    internal RewoundWorld(bool byOneImpact, HealingMode mode = HealingMode.CausalCone)
    {
        Scene scene = new SceneBuilder("empty").WithGravity(Floating).WithSmallestRadius(0.5).Build();
        FreeFlights flights = new(scene.Gravity, scene.RestitutionThreshold, scene.Box);
        Timelines = new TimelineStore(default, newest: flights);
        for (int slot = 0; slot < 2; slot++)
        {
            flights.AddSlot(slot, 0.5);
            Log.AddSlot(slot);
            Scheduler.AddSlot(slot);
            Rollback.AddSlot(slot);
        }

        AddTwoStruck(Bodies, Timelines, byOneImpact);
        Log.TryAdd(1, Later, Later.Key, forwarded: false);
        SegmentLookup view = new(Timelines, Rollback);
        CollisionPredictor collisions = Predictor(scene, Bodies, Timelines);
        CollisionSearch search = new(Bodies, Timelines, flights, scene.Surfaces, collisions, view, new StepMarks(), new EventWork());
        AdaptiveBroadPhase broadPhase = new(scene, Bodies, Timelines, bruteForceLimit: 2);
        broadPhase.Begin();
        EventPredictor predictor = new(Bodies, Timelines, Log, Scheduler, Rollback, flights, broadPhase, search, view);
        predictor.Predict(0); // so that the broad phase knows them
        predictor.Predict(1);
        Reconvergence = new Reconvergence(Bodies, Timelines, Log, Scheduler, Progress, Rollback, broadPhase, predictor, new CutPaths());
        Rewinder = new Rewinder(Bodies, Timelines, Log, Scheduler, Progress, Rollback, Reconvergence, predictor, mode);
        Progress.SimulatedTo = At(3);
    }

    internal BodyTable Bodies { get; } = new(2);

    internal TimelineStore Timelines { get; }

    internal EventLog Log { get; } = new();

    internal EventScheduler Scheduler { get; } = new(2);

    internal RollbackState Rollback { get; } = new();

    internal Progress Progress { get; } = new(default, SimDuration.MaxValue, default);

    internal Reconvergence Reconvergence { get; }

    internal Rewinder Rewinder { get; }

    /// <summary>The number of segments that a body has.</summary>
    internal int Count(int slot)
    {
        int count = 0;
        for (int at = Timelines.First(slot); at != TimelineStore.None; at = Timelines.Next(at))
        {
            count++;
        }

        return count;
    }
}
