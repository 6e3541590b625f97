using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Trajectories;

/// <summary>Opens the paths of held bodies: a hand grabs one, sends keyframes, and releases it.</summary>
/// <remarks>
/// While it is held a body's path is the hand's: nothing it meets changes it, and it pushes others as if its mass were infinite. Static
/// geometry does not stop a hand, and two held bodies pass through each other. Where it is at t depends on the grab and the keyframes up to
/// t alone.
/// </remarks>
internal sealed class HandFactory(Scene scene, BodyTable bodies, TimelineStore timelines, BodyLoss loss, FlightFactory flights)
{
    private readonly Paths paths = new(timelines);
    private readonly Clearance clearance = new(scene);

    private bool IsHolding(int slot, byte peer)
    {
        int last = timelines.Last(slot);
        return paths.IsHeld(last) && timelines.HoldOf(last).Peer == peer;
    }

    /// <summary>
    /// Does what a hand does to a body that is there. To grab what is held has no effect, nor has a keyframe or a release of a hand that
    /// does not hold it, nor what would move it faster than may be given. An event that comes late may change that.
    /// </summary>
    internal void Act(int slot, in EventKey key, in ExternalEvent external)
    {
        int last = timelines.Last(slot);
        double seconds = paths.SecondsInto(last, key.Time);
        DenseOutput dense = timelines.Dense(last);
        Vector3D position = timelines.Segment(last).PositionAt(seconds, dense);
        Vector3D velocity = timelines.Segment(last).VelocityAt(seconds, dense);
        if (external.Kind == EventKind.Grab && !paths.IsHeld(last))
        {
            // Until the first keyframe the hand is taken to be at rest where it took the body.
            Converge(slot, key, position, velocity, position, Vector3D.Zero, new Hold(external.Peer, external.Position, key.Time, external.MaxForce, external.MaxPower));
        }
        else if (external.Kind == EventKind.HoldKeyframe && IsHolding(slot, external.Peer))
        {
            Hold hold = timelines.HoldOf(last);
            Converge(slot, key, position, velocity, external.Position - hold.Offset, external.Velocity, hold.WithKeyframe(key.Time));
        }
        else if (external.Kind == EventKind.Release && IsHolding(slot, external.Peer))
        {
            LetGo(slot, key, last, position, external.Velocity);
        }
    }

    /// <summary>
    /// Converges on the path that a keyframe extrapolates. A body that is on it already, as far as the scene resolves, follows it. So a
    /// keyframe of a hand that keeps still moves nothing.
    /// </summary>
    private void Converge(
        int slot, in EventKey key, in Vector3D position, in Vector3D velocity, in Vector3D target, in Vector3D targetVelocity, in Hold hold)
    {
        if ((position - target).Length < scene.RestitutionThreshold
            && (velocity - targetVelocity).Length * HandPath.Stops.ToSeconds() < scene.RestitutionThreshold)
        {
            Follow(slot, key, position, velocity, hold);
            return;
        }

        MotionSegment path = HandPath.Converge(key.Time, position, velocity, target, targetVelocity, out DenseOutput dense);
        if (HandPath.SpeedBound(path, dense) <= Limits.MaxGivenSpeed(scene.SmallestRadius))
        {
            timelines.Append(slot, bodies.Id(slot), key, path, dense, hold);
        }
    }

    /// <summary>On the foretold path: brakes, or keeps still.</summary>
    private void Follow(int slot, in EventKey key, in Vector3D position, in Vector3D velocity, in Hold hold)
    {
        // Slower than this it would not get as far as the scene resolves: what rounding leaves of a convergence on a hand that keeps still.
        bool isStill = velocity.Length * HandPath.Stops.ToSeconds() < scene.RestitutionThreshold;
        MotionSegment path = isStill || key.Time >= hold.KeyframeTime + HandPath.Stops
            ? HandPath.Still(key.Time, hold.KeyframeTime, position)
            : HandPath.Brake(key.Time, hold.KeyframeTime, position, velocity);
        if (loss.TryAllow(slot, key, position, velocity))
        {
            timelines.Append(slot, bodies.Id(slot), key, path, default, hold);
        }
    }

    /// <summary>
    /// A segment of a held path ends: the next begins where it ends, or the hand, without a keyframe for so long, has released the body.
    /// </summary>
    internal void OpenNext(int slot, in EventKey key)
    {
        int last = timelines.Last(slot);
        Hold hold = timelines.HoldOf(last);
        double seconds = paths.SecondsInto(last, key.Time);
        DenseOutput dense = timelines.Dense(last);
        Vector3D position = timelines.Segment(last).PositionAt(seconds, dense);
        if (key.Time >= hold.KeyframeTime + HandPath.Lasts)
        {
            LetGo(slot, key, last, position, Vector3D.Zero);
        }
        else
        {
            Follow(slot, key, position, timelines.Segment(last).VelocityAt(seconds, dense), hold.Busy(hold.BusyAt(key.Time)));
        }
    }

    /// <summary>
    /// A held body continues after an impact as before it: the same path, to the bit, in a new segment, so that cutting it cuts what it
    /// struck.
    /// </summary>
    /// <param name="slot">The held body.</param>
    /// <param name="key">The impact, or what else opens the segment.</param>
    /// <param name="given">The impulse that the hand has given in it, in N s.</param>
    /// <param name="speed">How fast the hand was, in m/s.</param>
    internal void GoOn(int slot, in EventKey key, double given = 0, double speed = 0)
    {
        int last = timelines.Last(slot);
        MotionSegment path = timelines.Segment(last);
        Hold hold = timelines.HoldOf(last);
        SimTime busy = HandStrength.BusyAfter(hold, key.Time, given, HandStrength.ForceAt(hold, bodies.Spec(slot).Mass, speed));
        timelines.Append(slot, bodies.Id(slot), key, path, timelines.Dense(last), hold.Busy(busy));
    }

    /// <summary>A body is released outside of what stops it; where that leaves it no room, it is lost.</summary>
    private void LetGo(int slot, in EventKey key, int last, in Vector3D position, in Vector3D velocity)
    {
        if (clearance.TryPutOut(position, bodies.Spec(slot).Radius, timelines.Extras.Filter(last), out Vector3D outside))
        {
            flights.Open(slot, key, outside, velocity);
        }
        else
        {
            loss.Lose(slot, key, position, velocity, LossReason.NoRoom);
        }
    }
}
