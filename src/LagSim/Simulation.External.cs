using System;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <content>External events: submitting, taking back, applying.</content>
public sealed partial class Simulation
{
    /// <summary>
    /// Adds an event at its own time. Should that be simulated already, what it can have touched is taken back from there on (<see
    /// cref="SimulationOptions.Healing"/> says what that is), <see cref="SimulatedTo"/> lies before it, and the next <see cref="AdvanceTo"/> simulates it again;
    /// <see cref="Healed"/> tells what that took.
    /// </summary>
    /// <returns>What became of it. <see cref="SubmitResult.TooOld"/> means that nothing changed.</returns>
    /// <remarks>
    /// That it is there does not mean that it has an effect: that depends on what it meets when its time comes, and <see cref="TookEffect"/> tells. Cost: O(1) in
    /// the bodies if it lies ahead; else, with the next advance, that of the events since its time of the bodies it can have touched, or of all with a full rollback.
    /// </remarks>
    /// <exception cref="SceneException">The event carries a value that may not enter the world; nothing changed.</exception>
    /// <exception cref="SimulationException">Simulating again led out of the permitted range.</exception>
    public SubmitResult Submit(in ExternalEvent external)
    {
        ThrowIfFaulted();
        ExternalEventCheck.Throw(external, Scene);
        twin?.Submit(external);
        return Followed(Insert(external, external.Key, forwarded: false));
    }

    /// <summary>
    /// Adds an event that takes effect at <paramref name="arrival"/>, after its own time, by advancing the body alone from the event's time to the arrival: its
    /// own motion and contacts with static geometry, as the thesis does. What lies before the arrival is not rewritten. What a hand does (grab, knot, release)
    /// is done at the arrival as it is.
    /// </summary>
    /// <returns>What became of it.</returns>
    /// <exception cref="ArgumentOutOfRangeException">The arrival is before the event's time.</exception>
    /// <exception cref="SceneException">The event carries a value that may not enter the world; nothing changed.</exception>
    /// <exception cref="SimulationException">Simulating again led out of the permitted range.</exception>
    public SubmitResult SubmitForwarded(in ExternalEvent external, SimTime arrival)
    {
        if (arrival < external.Time)
        {
            throw new ArgumentOutOfRangeException(nameof(arrival), arrival.ToShortString(), $"An event of {external.Time.ToShortString()} cannot arrive before"
                + " it happened.");
        }

        ThrowIfFaulted();
        ExternalEventCheck.Throw(external, Scene);
        twin?.SubmitForwarded(external, arrival);
        return external.Time < HistoryEdge ? SubmitResult.TooOld : Followed(Insert(external, external.At(arrival).Key, forwarded: true));
    }

    /// <summary>Takes an event back, as if it had never been; false if it is not there (any more).</summary>
    /// <exception cref="SimulationException">Simulating again led out of the permitted range.</exception>
    public bool Retract(in ExternalEvent external)
    {
        ThrowIfFaulted();
        int slot = bodies.SlotOf(external.Body);
        if (slot < 0)
        {
            return false;
        }

        twin?.Retract(external);
        log.DropBefore(slot, HistoryEdge); // what is older can no longer be changed
        int next = log.Due(slot);
        EventKey due = next == EventLog.None ? EventKey.Before(Start) : log.Key(next);
        if (!log.TryRemove(slot, external.Peer, external.Sequence, out EventKey key))
        {
            return false;
        }

        Reconsider(key.Time);
        if (key == due && log.Due(slot) == next) // else an earlier one is due again
        {
            log.SetDueFrom(slot, key);
        }

        if (key.Time <= KnownTo)
        {
            Rewrite(slot, key);
        }
        else if (key == due)
        {
            Predict(slot);
        }

        return Followed(true);
    }

    private T Followed<T>(T result)
    {
        FollowWithTwin();
        return result;
    }

    private SubmitResult Insert(in ExternalEvent external, in EventKey key, bool forwarded)
    {
        if (key.Time < HistoryEdge)
        {
            return SubmitResult.TooOld;
        }

        int slot = bodies.SlotOf(external.Body);
        if (slot < 0)
        {
            slot = AddBody(external.Body);
            EventKey birth = EventKey.Before(Start);
            timelines.Append(slot, external.Body, birth, MotionSegment.Nothing(Start), default);
            FitIndex();
        }

        log.DropBefore(slot, HistoryEdge);
        if (!log.TryAdd(slot, external, key, forwarded))
        {
            return SubmitResult.Duplicate;
        }

        Reconsider(key.Time);

        if (key.Time <= KnownTo)
        {
            Rewrite(slot, key);
            return SubmitResult.RolledBack;
        }

        int next = log.Due(slot);
        if (next == EventLog.None || EventKey.Compare(key, log.Key(next)) < 0)
        {
            log.SetDueFrom(slot, key);
            Predict(slot);
        }

        return SubmitResult.Queued;
    }

    private void HandleExternal(int slot, in EventKey key)
    {
        int entry = log.TakeDue(slot);
        ref readonly ExternalEvent external = ref log.Event(entry);
        bool isThere = timelines.Segment(timelines.Last(slot)).IsPresent;
        if (external.Kind == EventKind.Spawn)
        {
            if (!isThere)
            {
                bodies.SetSpec(slot, trajectories.Flights.Chosen(external.Spec));
                collapseRule.HasLosses |= external.Spec.Restitution < 1;
                flights.SetRadius(slot, external.Spec.Radius);
                if (log.IsForwarded(entry))
                {
                    Adopt(slot, key, external);
                }
                else
                {
                    trajectories.Flights.Open(slot, key, external.Position, external.Velocity, spin: external.Spin.WithoutNegativeZero());
                }
            }

            return;
        }

        if (!isThere)
        {
            return; // nothing to act on, now; later news may still put the body there and this is simulated again
        }

        if (external.Kind == EventKind.Remove)
        {
            timelines.Append(slot, bodies.Id(slot), key, MotionSegment.Nothing(key.Time), default);
        }
        else if (external.Kind is EventKind.Grab or EventKind.HoldKnot or EventKind.Release)
        {
            collapseRule.HasLosses |= external.Kind == EventKind.Grab; // a hand gives and takes
            trajectories.Hands.Act(slot, key, external);
        }
        else if (paths.IsHeld(timelines.Last(slot)))
        {
            return; // what is in a hand goes where the hand goes
        }
        else if (log.IsForwarded(entry))
        {
            Adopt(slot, key, external);
        }
        else
        {
            int last = timelines.Last(slot);
            double seconds = paths.SecondsInto(last, key.Time);
            SupportSet supports = timelines.Segment(last).Supports;
            bool isPermitted = TryAfter(external, slot, last, seconds, out Vector3D position, out Vector3D velocity);
            Span<int> carriers = stackalloc int[SupportSet.Most];
            int count = external.Kind == EventKind.Teleport ? 0 : supports.Count;
            for (int k = 0; k < count; k++)
            {
                carriers[k] = supports[k];
            }

            if (isPermitted && paths.IsMember(last) && external.Kind != EventKind.Teleport)
            {
                members.GoOn(slot, key, position, velocity, timelines.SpinOf(last).At(seconds), hasChanged: true);
                timelines.EndMember(timelines.Last(slot), bodies.Id(slot));
            }
            else if (isPermitted)
            {
                trajectories.Open(slot, key, position, velocity, 0, carriers.Slice(0, count), timelines.SpinOf(last).At(seconds));
            }
        }
    }

    /// <summary>
    /// The state right after an event that comes so many seconds into a segment. False if it would be faster than may be given: the door cannot
    /// know the velocity that an impulse meets, so such an event has no effect, on every peer alike.
    /// </summary>
    private bool TryAfter(in ExternalEvent external, int slot, int segment, double seconds, out Vector3D position, out Vector3D velocity)
    {
        ref readonly MotionSegment before = ref timelines.Segment(segment);
        DenseOutput dense = timelines.Dense(segment);
        position = external.Kind == EventKind.Teleport ? external.Position : before.PositionAt(seconds, dense);
        velocity = external.Kind switch
        {
            EventKind.Teleport or EventKind.SetVelocity => external.Velocity,
            EventKind.Impulse => before.VelocityAt(seconds, dense) + (external.Velocity / bodies.Spec(slot).Mass),
            _ => throw new InvalidOperationException($"{external.Kind} has no effect of its own on a state."),
        };
        return velocity.Length <= Limits.MaxGivenSpeed(Scene.SmallestRadius);
    }
}
