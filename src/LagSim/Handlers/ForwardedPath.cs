using System;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Handlers;

/// <summary>The thesis's way with a late event (latency-forward): advance the one body it concerns.</summary>
internal sealed class ForwardedPath(Scene scene, BodyTable bodies, TimelineStore timelines, ISingleBodyWorld world)
{
    private readonly Paths paths = new(timelines);

    /// <summary>
    /// Puts the body at the key's time on the path it would be on if the event had come in time and there were nothing but static geometry.
    /// The path keeps its own epoch and step grid, so where it flew freely at the stamp and nothing else was touched it agrees with the
    /// other peers bit for bit. The surface that carried it is found again by contact, and a closed-form flight's next contact is searched
    /// for from the arrival on. Both may differ in rounding.
    /// </summary>
    /// <param name="slot">The body.</param>
    /// <param name="key">When it is applied.</param>
    /// <param name="external">The event.</param>
    /// <param name="place">Where a spawn or a teleport puts the body.</param>
    internal void Follow(int slot, in EventKey key, in ExternalEvent external, in Vector3D place)
    {
        Vector3D position = place;
        Vector3D velocity = external.Velocity;
        Vector3D spin = external.Spin;
        if (external.Kind != EventKind.Spawn)
        {
            // Should its stamp have left the history, when a later rollback comes here again, the oldest state that is kept has to do.
            int then = timelines.At(slot, external.Time);
            then = then == TimelineStore.None ? timelines.First(slot) : then;
            double seconds = Math.Max(0, paths.SecondsInto(then, external.Time));
            if (!ActionEffects.TryApply(external, place, timelines.Segment(then), timelines.Dense(then), seconds, bodies.Spec(slot).Mass, scene, out position, out velocity))
            {
                return;
            }

            spin = timelines.SpinOf(then).At(seconds);
        }

        BodySpec spec = external.Kind == EventKind.Spawn ? bodies.Spec(slot) : bodies.Spec(slot).With(timelines.Extras.Filter(timelines.Last(slot)));
        (MotionSegment path, DenseOutput dense, Spin turning) =
            world.Follow(ExternalEvent.Spawn(external.Time, 1, 1, spec, position, velocity, spin), key.Time);
        timelines.Append(slot, bodies.Id(slot), key, path, dense, spin: turning);
    }
}
