using System;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using LagSim.Trajectories;

namespace LagSim.Islands;

/// <summary>Opens the paths of members of islands: chords to the next tick, and rest.</summary>
internal sealed class MemberFactory(BodyTable bodies, TimelineStore timelines, in Forces forces, ContactScale scale, TrajectoryFactory trajectories)
{
    /// <summary>The longest step, in parts of a force's own time.</summary>
    private const double MaxRateTimesStep = 1.0 / 16;

    private readonly Forces forces = forces;

    /// <summary>
    /// Opens the next segment of a member from a state: a chord to the end of the step under way, or of one that begins if it slept.
    /// </summary>
    internal void GoOn(int slot, in EventKey key, in Vector3D position, in Vector3D velocity, in Vector3D spin, bool hasChanged)
    {
        int before = timelines.Last(slot);
        MotionSegment path = timelines.Segment(before);
        bool slept = path.Law == MotionLaw.Resting;
        SimTime centre = slept ? key.Time : timelines.Carried.CentreOf(before);
        SimTime still = slept || hasChanged ? key.Time : timelines.Carried.StillSince(before);
        if (slept && !hasChanged)
        {
            centre = timelines.Carried.CentreOf(before);
            still = timelines.Carried.StillSince(before);
            timelines.Append(slot, bodies.Id(slot), key, MotionSegment.AtRest(key.Time, path.Position), default, spin: timelines.SpinOf(before));
        }
        else
        {
            OpenChord(slot, key, slept ? NextTick(slot, key.Time, StepWanted(slot, key.Time, position, velocity, spin)) : path.End, position, velocity, spin);
        }

        int piece = timelines.Last(slot);
        timelines.BeginMember(piece, centre, still);
        for (int at = timelines.Carried.First(before); at != TimelineStore.None; at = timelines.Carried.Next(at))
        {
            PersistentContact contact = timelines.Carried.At(at);
            timelines.Carried.Add(piece, contact);
        }
    }

    internal void OpenChord(int slot, in EventKey key, SimTime end, in Vector3D position, in Vector3D velocity, in Vector3D spin)
    {
        Vector3D x = position.WithoutNegativeZero();
        Vector3D v = velocity.WithoutNegativeZero();
        trajectories.Check(slot, key.Time, x, v);
        timelines.Append(slot, bodies.Id(slot), key, new MotionSegment(MotionLaw.Constrained, key.Time, end, x, v, Vector3D.Zero), default, spin: new Spin(spin));
    }

    /// <summary>
    /// When the first step of a new member begins: at this instant if it is a tick, unless a step has released the body at it.
    /// </summary>
    internal SimTime NextTick(int slot, SimTime time, double wanted)
    {
        ref readonly EventKey opened = ref timelines.Key(timelines.Last(slot));
        bool hadIt = opened.Kind == EventKind.StepEnd && opened.Time == time;
        return scale.TickFrom(hadIt ? time + SimDuration.OneTick : time, wanted);
    }

    /// <summary>
    /// The longest step, in seconds, that follows the forces on a body, and in which it does not fall by more than the tolerance where they
    /// are stronger than gravity; infinite where there are none.
    /// </summary>
    internal double StepWanted(int slot, SimTime time, in Vector3D position, in Vector3D velocity, in Vector3D spin)
    {
        ref readonly BodySpec spec = ref bodies.Spec(slot);
        double rate = spec.Forces.IsEmpty ? 0 : forces.FixedStepRateAt(spec, position, velocity, spin);
        if (!(rate * SimDuration.FromTicks(ContactScale.ShortestTicks).ToSeconds() <= 1)) // what is not a number is too stiff
        {
            throw trajectories.Failures.OfContactStep(slot, time, position, velocity, spin, double.IsNaN(rate) ? double.PositiveInfinity : rate);
        }

        double fall = scale.FallAt(PullOn(slot, time, position, velocity, spin));
        return rate > 0 ? Math.Min(fall, MaxRateTimesStep / rate) : fall;
    }

    /// <summary>
    /// How hard forces, gravity included, pull a body, in m/s²; 0 for a body under gravity alone, because the scale includes that.
    /// </summary>
    internal double PullOn(int slot, SimTime time, in Vector3D position, in Vector3D velocity, in Vector3D spin)
    {
        ref readonly BodySpec spec = ref bodies.Spec(slot);
        return spec.Forces.IsEmpty ? 0 : forces.On(bodies.Id(slot)).At(spec, time, 0, position, velocity, spin).Length;
    }
}
