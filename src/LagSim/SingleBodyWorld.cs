using LagSim.Events;
using LagSim.Handlers;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <summary>A world of a scene's static geometry and forces, in which a body is alone; made again for each body.</summary>
/// <remarks>
/// It begins when the scene does, so that a force that depends on time sees the same time. It runs to its end whatever is cancelled,
/// because the current instant is half done. Where the body is put was decided in the world of all, and is taken as it is.
/// </remarks>
internal sealed class SingleBodyWorld(Scene scene, SimTime start, int maxSegments) : ISingleBodyWorld
{
    /// <inheritdoc/>
    public (MotionSegment Segment, DenseOutput Dense, Spin Spin) Follow(in ExternalEvent spawn, SimTime time)
    {
        SimulationOptions options = new SimulationOptions(start, SimDuration.MaxValue, maxSegments).WithParts(GivenPlaces.Parts);
        Engine engine = new(scene.WithoutBodies(), options, start, start, 1);
        engine.Begin();
        Advance(engine, SimTime.Max(start, spawn.Time - SimDuration.OneTick));
        engine.Intake.Insert(spawn, spawn.Key, isForwarded: false);
        Advance(engine, SimTime.Max(engine.Progress.SimulatedTo, time));
        TimelineStore timelines = engine.Timelines;
        int end = timelines.Last(engine.Bodies.SlotOf(spawn.Body));
        return (timelines.Segment(end), timelines.Dense(end), timelines.SpinOf(end));
    }

    private static void Advance(Engine engine, SimTime time)
    {
        long events = long.MaxValue;
        engine.Loop.TryAdvanceTo(time, ref events);
        engine.Loop.ThrowIfBlockedAt(time);
    }

    /// <summary>Every place is as it was given.</summary>
    private sealed class GivenPlaces(Scene scene, BodyTable bodies, TimelineStore timelines, SegmentLookup view)
        : FreePlaces(scene, bodies, timelines, view)
    {
        internal static readonly EngineParts Parts = new WithThem();

        internal override bool TryFind(int slot, in EventKey key, in ExternalEvent external, CollisionFilter filter, out Vector3D position)
        {
            position = external.Position;
            return true;
        }

        private sealed class WithThem : EngineParts
        {
            internal override FreePlaces FreePlaces(Scene scene, BodyTable bodies, TimelineStore timelines, SegmentLookup view) =>
                new GivenPlaces(scene, bodies, timelines, view);
        }
    }
}
