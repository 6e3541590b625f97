using System;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Trajectories;

/// <summary>Opens the next segment of a body that is no member of an island: which law it follows from a state on.</summary>
/// <remarks>Contacts on the way are predicted elsewhere.</remarks>
internal sealed class TrajectoryFactory
{
    private readonly Scene scene;
    private readonly Forces forces;
    private readonly BodyTable bodies;
    private readonly TimelineStore timelines;
    private readonly Paths paths;
    private readonly StateLimits limits;
    private readonly SupportFactory supports;

    internal TrajectoryFactory(Scene scene, in Forces forces, BodyTable bodies, TimelineStore timelines)
    {
        this.scene = scene;
        this.forces = forces;
        this.bodies = bodies;
        this.timelines = timelines;
        paths = new Paths(timelines);
        limits = new StateLimits(scene);
        Loss = new BodyLoss(bodies, timelines, limits);
        Failures = new ForceFailures(scene, bodies, timelines);
        Flights = new FlightFactory(scene, forces, bodies, timelines, limits, Loss, Failures);
        Friction = new SlipFactory(scene, bodies, timelines, limits);
        supports = new SupportFactory(scene, bodies, timelines, limits, Loss, Friction);
        Hands = new HandFactory(scene, bodies, timelines, Loss, Flights);
    }

    /// <summary>Takes bodies out of the world that cannot be followed.</summary>
    internal BodyLoss Loss { get; }

    /// <summary>The messages for what ends a world.</summary>
    internal ForceFailures Failures { get; }

    /// <summary>Opens flights.</summary>
    internal FlightFactory Flights { get; }

    /// <summary>Opens motion on a plane with friction.</summary>
    internal SlipFactory Friction { get; }

    /// <summary>Opens paths of held bodies.</summary>
    internal HandFactory Hands { get; }

    /// <summary>
    /// Opens the body's next segment from a state that holds <paramref name="carry"/> seconds before the key's tick (under a tick, either
    /// way): at rest on or sliding along those of the touched planes that carry it, else in free flight.
    /// </summary>
    internal void Open(
        int slot, in EventKey key, in Vector3D position, in Vector3D velocity, double carry, Span<int> touchedPlanes, in Vector3D spin)
    {
        if (touchedPlanes.Length > 0 && supports.TryOpen(slot, key, position, velocity, carry, touchedPlanes, spin))
        {
            return;
        }

        Vector3D x = position;
        Vector3D v = velocity;
        if (carry != 0)
        {
            Vector3D a = forces.On(bodies.Id(slot)).At(bodies.Spec(slot), key.Time, -carry, position, velocity, spin);
            x += (v + (a * (0.5 * carry))) * carry;
            v += a * carry;
        }

        Flights.Open(slot, key, x, v, spin);
    }

    /// <summary>Opens what comes after a segment that has ended by itself.</summary>
    internal void OpenNext(int slot, in EventKey key)
    {
        int last = timelines.Last(slot);
        MotionSegment segment = timelines.Segment(last);
        if (segment.Law == MotionLaw.Held)
        {
            Hands.OpenNext(slot, key);
        }
        else if (segment.IsDense)
        {
            double h = segment.End.SecondsSince(segment.Epoch);
            DenseOutput dense = timelines.Dense(last);
            Flights.Open(slot, key, segment.PositionAt(h, dense), segment.VelocityAt(h, dense), spin: timelines.SpinOf(last).At(h));
        }
        else if (segment.Law == MotionLaw.Ballistic && scene.Box.Exists)
        {
            Flights.Open(slot, key, paths.PositionAt(last, key.Time), segment.Velocity, spin: timelines.SpinOf(last).AtEpoch);
        }
        else if (segment.Supports.Count == 1 && Friction.On(slot, segment.Supports[0]) > 0 && !IsAtEndOfRange(segment))
        {
            // It has stopped slipping, or rolling, or turned a little.
            double seconds = segment.End.SecondsSince(segment.Epoch);
            Span<int> carrier = stackalloc int[] { segment.Supports[0] };
            Open(
                slot, key, segment.PositionAt(seconds, default), segment.VelocityAt(seconds, default), 0, carrier,
                timelines.SpinOf(last).At(seconds));
        }
        else if (segment.Acceleration != Vector3D.Zero)
        {
            double seconds = segment.End.SecondsSince(segment.Epoch); // it falls without end
            Loss.Lose(slot, key, segment.PositionAt(seconds, default), segment.VelocityAt(seconds, default), LossReason.TooFast);
        }
        else
        {
            // The limit of a bounce sequence: what was carried along on the supports has come to rest on them.
            timelines.Append(slot, bodies.Id(slot), key, MotionSegment.AtRest(key.Time, segment.Position, segment.Supports), default, spin: timelines.SpinOf(last));
        }
    }

    /// <summary>Whether a segment ended because its body would become too fast.</summary>
    private bool IsAtEndOfRange(in MotionSegment segment) =>
        segment.Acceleration != Vector3D.Zero && segment.End == limits.EndOfRange(segment.Epoch, segment.Velocity, segment.Acceleration);
}
