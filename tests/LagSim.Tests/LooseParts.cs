using System;
using LagSim.Collisions;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests;

/// <summary>Parts of the engine, and what they work on, made by hand: for tests of one part without a world.</summary>
internal static class LooseParts
{
    /// <summary>What happens to <see cref="Second"/> at two seconds, after the two have met.</summary>
    internal static readonly ExternalEvent Later = ExternalEvent.SetVelocity(At(2), 1, 1, Second, V(0, 1));

    /// <summary>The key of something that happens to one body of the scene alone.</summary>
    internal static EventKey Key(double seconds, EventKind kind, int body = 0, uint round = 0) =>
        new(At(seconds), round, kind, BodyId.OfScene(body), BodyId.OfScene(body), 0, 0);

    /// <summary>A flight that goes on for ever.</summary>
    internal static MotionSegment Flight(double from, Vector3D position, Vector3D velocity, Vector3D acceleration = default) =>
        new(MotionLaw.Ballistic, At(from), SimTime.MaxValue, position, velocity, acceleration);

    /// <summary>Adds a body on one segment; its slot is its number in the scene.</summary>
    internal static void AddBody(BodyTable bodies, TimelineStore timelines, BodySpec spec, EventKey opened, MotionSegment segment)
    {
        int slot = bodies.Add(BodyId.OfScene(bodies.Count), spec);
        timelines.AddSlot(slot);
        timelines.Append(slot, bodies.Id(slot), opened, segment, default);
    }

    /// <summary>
    /// Adds two bodies that fly at each other, are struck at one second, and of which the second is pushed at two. One impact strikes both
    /// of them, or else each hits something of its own.
    /// </summary>
    internal static void AddTwoStruck(BodyTable bodies, TimelineStore timelines, bool byOneImpact = true)
    {
        AddBody(bodies, timelines, Ball(), Key(0, EventKind.Start), Flight(0, V(0), V(1)));
        AddBody(bodies, timelines, Ball(), Key(0, EventKind.Start, 1), Flight(0, V(3), V(-1)));
        EventKey shared = new(At(1), 0, EventKind.Impact, First, Second, 0, 0);
        timelines.Append(0, First, byOneImpact ? shared : Key(1, EventKind.Impact), Flight(1, V(1), V(-1)), default);
        timelines.Append(1, Second, byOneImpact ? shared : Key(1, EventKind.Impact, 1), Flight(1, V(2), V(1)), default);
        if (byOneImpact)
        {
            Span<int> both = [0, 1];
            timelines.Join(both);
        }

        timelines.Append(1, Second, Later.Key, Flight(2, V(3), V(0, 1)), default);
    }

    /// <summary>A predictor of the contacts of these paths in a scene with these surfaces.</summary>
    internal static CollisionPredictor Predictor(Scene scene, BodyTable bodies, TimelineStore timelines)
    {
        ContactScale scale = new(scene.ContactTolerance, scene.Gravity, default);
        MemberContacts members = new(timelines, bodies, scene.Surfaces, scale);
        StrikeCounts strikes = new(timelines, bodies, scene.Surfaces, scene.Box);
        return new CollisionPredictor(scene, default, bodies, timelines, members, strikes, scale, new EventWork(), hasIslands: true);
    }
}
