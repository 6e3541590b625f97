using System;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <content>The thesis's way with a late event: advance the one body it concerns.</content>
public sealed partial class Simulation
{
    /// <summary>
    /// Puts the body at the key's time on the very path it would be on, had the event come in time and were nothing there but static
    /// geometry. The path keeps its own epoch and step grid, so where it flew freely at the stamp and nothing else was touched it agrees with
    /// the other peers bit for bit. What carried it then is found again by contact, and a closed-form flight's next
    /// contact is looked for from the arrival on: both may differ in rounding.
    /// </summary>
    private void Adopt(int slot, in EventKey key, in ExternalEvent external)
    {
        Vector3D position = external.Position;
        Vector3D velocity = external.Velocity;
        Vector3D spin = external.Spin;
        if (external.Kind != EventKind.Spawn)
        {
            // Should its stamp have left the history, when a later rollback comes here again, the oldest state that is kept has to do.
            int then = timelines.At(slot, external.Time);
            then = then == TimelineStore.None ? timelines.First(slot) : then;
            double seconds = Math.Max(0, paths.SecondsInto(then, external.Time));
            if (!TryAfter(external, slot, then, seconds, out position, out velocity))
            {
                return;
            }

            spin = timelines.SpinOf(then).At(seconds);
        }

        // A world of its own with the same start, so that a force that depends on time sees the same time. It goes on to its end whatever is
        // cancelled, for the instant at hand is half done; and it takes any state, also one that may not come in by the door.
        Simulation alone = new(Scene.WithoutBodies(), new SimulationOptions(Start, SimDuration.MaxValue, maxSegments: timelines.Most));
        alone.AdvanceTo(SimTime.Max(alone.SimulatedTo, external.Time - SimDuration.OneTick));
        ExternalEvent spawn = ExternalEvent.Spawn(external.Time, 1, 1, bodies.Spec(slot), position, velocity, spin);
        alone.Insert(spawn, spawn.Key, forwarded: false);
        alone.AdvanceTo(SimTime.Max(alone.SimulatedTo, key.Time));
        int end = alone.timelines.Last(alone.bodies.SlotOf(new BodyId(1, 1, 0)));
        MotionSegment path = alone.timelines.Segment(end);
        timelines.Append(slot, bodies.Id(slot), key, path, alone.timelines.Dense(end), spin: alone.timelines.SpinOf(end));
    }
}
