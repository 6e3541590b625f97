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
internal class MemberFactory(BodyTable bodies, TimelineStore timelines, in Forces forces, ContactScale scale, TrajectoryFactory trajectories)
{
    /// <summary>The longest step, in parts of a force's own time.</summary>
    private const double MaxRateTimesStep = 1.0 / 16;

    private readonly Forces forces = forces;

    /// <summary>
    /// Opens the next segment of a member from a state: a chord to the end of the step under way, or of one that begins if it slept, or if
    /// what has changed it is faster than the step under way follows. False if it is lost instead.
    /// </summary>
    internal bool TryGoOn(int slot, in EventKey key, in Vector3D position, in Vector3D velocity, in Vector3D spin, bool hasChanged)
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
            SimTime end = path.End;
            double wanted = slept || hasChanged ? StepWanted(slot, key.Time, position, velocity, spin) : double.PositiveInfinity;
            if (slept)
            {
                end = NextTick(slot, key.Time, wanted);
            }
            else if (!IsFollowed(wanted, 2 * Math.Abs(path.End.SecondsSince(centre))))
            {
                centre = key.Time; // the change begins a step of its own, since forces would act for too long in the one under way
                end = SimTime.Min(end, scale.TickFrom(key.Time + SimDuration.OneTick, wanted));
            }

            if (!TryOpenChord(slot, key, end, position, velocity, spin))
            {
                return false;
            }
        }

        int piece = timelines.Last(slot);
        timelines.BeginMember(piece, centre, still);
        for (int at = timelines.Carried.First(before); at != TimelineStore.None; at = timelines.Carried.Next(at))
        {
            PersistentContact contact = timelines.Carried.At(at).GoingOn; // a copy, since the list may move
            timelines.Carried.Add(piece, contact);
        }

        return true;
    }

    /// <summary>Whether the step under way follows a change within it.</summary>
    /// <param name="wanted">The longest step that follows the changed state, in seconds.</param>
    /// <param name="step">The step under way, in seconds.</param>
    private protected virtual bool IsFollowed(double wanted, double step) => wanted >= step;

    /// <summary>Opens a chord; false if the body is lost instead.</summary>
    internal bool TryOpenChord(int slot, in EventKey key, SimTime end, in Vector3D position, in Vector3D velocity, in Vector3D spin)
    {
        Vector3D x = position.WithoutNegativeZero();
        Vector3D v = velocity.WithoutNegativeZero();
        bool isAllowed = trajectories.Loss.TryAllow(slot, key, x, v);
        if (isAllowed)
        {
            MotionSegment chord = new(MotionLaw.Constrained, key.Time, end, x, v, Vector3D.Zero);
            timelines.Append(slot, bodies.Id(slot), key, chord, default, spin: new Spin(spin));
        }

        return isAllowed;
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
    /// are stronger than gravity; infinite where there are none, zero where no step follows them.
    /// </summary>
    internal double StepWanted(int slot, SimTime time, in Vector3D position, in Vector3D velocity, in Vector3D spin)
    {
        ref readonly BodySpec spec = ref bodies.Spec(slot);
        if (spec.Forces.IsEmpty)
        {
            return double.PositiveInfinity;
        }

        double fall = scale.FallAt(PullOn(slot, time, position, velocity, spin));
        double rate = forces.FixedStepRateAt(spec, position, velocity, spin);
        if (forces.HasSupplied(spec))
        {
            rate = Math.Max(rate, forces.On(bodies.Id(slot)).EstimatedRate(spec, time, position, velocity, spin, scale.Step.ToSeconds()));
        }

        double wanted = rate > 0 ? Math.Min(fall, MaxRateTimesStep / rate) : fall;
        if (ContactScale.IsFollowed(rate))
        {
            return Math.Max(wanted, ContactScale.ShortestLasting);
        }

        bool isOfSpeed = ContactScale.IsFollowed(forces.FixedStepRateAt(spec, position, Vector3D.Zero, spin));
        return isOfSpeed && ContactScale.IsFollowedFor(rate) ? wanted : 0;
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
