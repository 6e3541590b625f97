using System;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using LagSim.Trajectories;

namespace LagSim.Islands;

/// <summary>Opens the segments of a contact step that was solved: chords, or the law that a body follows alone.</summary>
internal sealed class StepSegments(
    Scene scene, BodyTable bodies, TimelineStore timelines, ContactGraph graph, ContactStep step, StepForces stepForces,
    MemberFactory members, TrajectoryFactory trajectories, IslandSleep sleep)
{
    private readonly StaticSurfaces surfaces = scene.Surfaces;
    private readonly Paths paths = new(timelines);
    private readonly PlaneSet planes = new();
    private bool[] holdsPair = Array.Empty<bool>(); // by body of the graph: whether another body holds it

    /// <summary>
    /// Opens the segments of the solved step: chords for bodies that something holds, and for the others the law that they follow alone.
    /// </summary>
    /// <param name="key">The step.</param>
    /// <param name="length">How long it is.</param>
    /// <param name="isLost">By body: whether no step follows the forces on it.</param>
    internal void OpenStep(in EventKey key, SimDuration length, Span<bool> isLost)
    {
        step.Problem.List();
        FindHoldingPairs();
        SimTime end = key.Time + length;
        SimTime centre = key.Time + SimDuration.FromTicks(length.Ticks / 2);
        double kept = step.Rules.LimitsEnergy ? double.NaN : 1; // of the pushes of bodies that leave; known once one does
        for (int i = 0; i < graph.BodyCount; i++)
        {
            int slot = graph.Slots[i];
            int before = timelines.Last(slot);
            if (paths.IsHeld(before))
            {
                trajectories.Hands.GoOn(slot, key);
                continue;
            }

            ref readonly SolverBody solved = ref step.Problem.Bodies[i];
            if (isLost[i])
            {
                trajectories.Loss.Lose(slot, key, graph.Positions[i], graph.Velocities[i], LossReason.TooStiff, graph.Spins[i]);
            }
            else if (!IsHeldTogether(i, out int planeCount))
            {
                kept = double.IsNaN(kept) ? PartOfPushes(i, isLost, length) : kept;
                Vector3D velocity = LeavingVelocity(i, before, isLost, out Vector3D push) + (push * kept);
                trajectories.Flights.Open(slot, key, graph.Positions[i], velocity, spin: graph.Spins[i]);
            }
            else if (planeCount > 0)
            {
                OpenAlone(i, key, solved);
            }
            else
            {
                SimTime still = sleep.IsStill(i, solved) && timelines.Segment(before).Law == MotionLaw.Constrained
                    ? timelines.Carried.StillSince(before) : key.Time;
                OpenMember(i, key, end, centre, still);
            }
        }
    }

    private void OpenMember(int body, in EventKey key, SimTime end, SimTime centre, SimTime still)
    {
        int slot = graph.Slots[body];
        ref readonly SolverBody solved = ref step.Problem.Bodies[body];
        if (members.TryOpenChord(slot, key, end, graph.Positions[body], solved.Velocity, solved.Spin))
        {
            int piece = timelines.Last(slot);
            timelines.BeginMember(piece, centre, still);
            CarryContacts(body, piece);
            timelines.EndMember(piece, bodies.Id(slot));
        }
    }

    /// <summary>The bodies that another body holds in the step.</summary>
    private void FindHoldingPairs()
    {
        if (holdsPair.Length < graph.BodyCount)
        {
            holdsPair = new bool[graph.BodyCount * 2];
        }

        for (int i = 0; i < graph.BodyCount; i++)
        {
            holdsPair[i] = false;
        }

        for (int i = 0; i < step.Problem.ContactCount; i++)
        {
            ref readonly SolverContact c = ref step.Problem.Contacts[i];
            if (c.Second != ContactPoint.Static && c.Holds)
            {
                holdsPair[c.First] = true;
                holdsPair[c.Second] = true;
            }
        }
    }

    /// <summary>
    /// Whether something pushes a body in the step. If that is static planes alone, which it touches and on which a closed form carries it,
    /// <paramref name="planes"/> is their number. Off them, or in them, a closed form would carry it for good: the step brings it there first.
    /// </summary>
    private bool IsHeldTogether(int body, out int planes)
    {
        planes = 0;
        bool isHeld = holdsPair[body];
        bool needsSteps = isHeld || !bodies.Spec(graph.Slots[body]).Forces.IsEmpty;
        bool rubs = false;
        foreach (int i in step.Problem.ListOf(body))
        {
            ref readonly SolverContact c = ref step.Problem.Contacts[i];
            if (c.Second == ContactPoint.Static && c.Holds)
            {
                isHeld = true;
                needsSteps |= !surfaces.IsPlane(c.Surface) || c.Impulse == 0 || (step.Rules.LeavesWhereItTouches && Math.Abs(c.Gap) > step.Scale.SweepGap);
                rubs |= c.Friction > 0;
                planes++;
            }
        }

        planes = needsSteps || (rubs && planes > 1) ? 0 : planes;
        return isHeld;
    }

    /// <summary>
    /// The part of their pushes with which bodies leave, from 0 to 1: as much as leaves them no more kinetic energy than they came with, or
    /// than the pull would give them in a step. A push that has held a body is far below that. One that a blow has given acts no longer.
    /// </summary>
    /// <param name="first">The first body that leaves.</param>
    /// <param name="isLost">By body: whether it is lost.</param>
    /// <param name="length">How long a step is.</param>
    private double PartOfPushes(int first, Span<bool> isLost, SimDuration length)
    {
        double room = 0;
        double along = 0;
        double square = 0;
        for (int i = first; i < graph.BodyCount; i++)
        {
            int before = timelines.Last(graph.Slots[i]);
            if (paths.IsHeld(before) || isLost[i] || IsHeldTogether(i, out _))
            {
                continue;
            }

            Vector3D velocity = LeavingVelocity(i, before, isLost, out Vector3D push);
            double fall = Math.Max(step.Scale.Pull, graph.Accelerations[i].Length) * length.ToSeconds();
            room += graph.Masses[i] * fall * fall;
            along += graph.Masses[i] * Vector3D.Dot(velocity, push);
            square += graph.Masses[i] * push.LengthSquared;
        }

        // square s² + 2 along s = room
        double root = Math.Sqrt((along * along) + (square * room));
        double part = along > 0 ? room / (along + root) : (root - along) / square;
        return part <= 1 ? part : 1; // not a number if nothing pushed
    }

    /// <summary>The velocity at the tick of a body that leaves, without its push.</summary>
    /// <param name="body">The body.</param>
    /// <param name="piece">Its last segment.</param>
    /// <param name="isLost">By body: whether it is lost.</param>
    /// <param name="half">What the contacts of the last step gave in its second half, because until now they have held it, in m/s.</param>
    private Vector3D LeavingVelocity(int body, int piece, Span<bool> isLost, out Vector3D half)
    {
        half = Vector3D.Zero;
        Vector3D velocity = graph.Velocities[body] + (step.Rules.KeepsMomentum ? step.Braked(body) : Vector3D.Zero);
        if (timelines.Segment(piece).Law != MotionLaw.Constrained)
        {
            return velocity;
        }

        Vector3D push = Vector3D.Zero;
        for (int at = timelines.Carried.First(piece); at != TimelineStore.None; at = timelines.Carried.Next(at))
        {
            ref readonly PersistentContact contact = ref timelines.Carried.At(at);
            bool acts = contact.Surface != PersistentContact.NoSurface || IsPushedBack(contact.Partner, isLost);
            push += acts || !step.Rules.KeepsMomentum ? contact.Push : Vector3D.Zero;
        }

        half = push * (0.5 / graph.Masses[body]);
        return velocity + stepForces.GainAtTick(body);
    }

    /// <summary>
    /// Whether a body that leaves may keep the push of another: the other is held, or leaves as well, with the same push the other way. One
    /// that stays gets nothing back, and the push would be momentum made of nothing.
    /// </summary>
    private bool IsPushedBack(BodyId partner, Span<bool> isLost)
    {
        int other = graph.IndexOf(bodies.SlotOf(partner));
        return other >= 0 && (double.IsPositiveInfinity(graph.Masses[other]) || (!isLost[other] && !IsHeldTogether(other, out _)));
    }

    /// <summary>
    /// Opens the closed form of a body that planes alone hold: with the mean of its velocities before the tick and after.
    /// </summary>
    private void OpenAlone(int body, in EventKey key, in SolverBody solved)
    {
        Vector3D velocity = (graph.Velocities[body] + solved.Velocity) * 0.5;
        Vector3D spin = (graph.Spins[body] + solved.Spin) * 0.5;
        planes.Clear();
        foreach (int i in step.Problem.ListOf(body))
        {
            ref readonly SolverContact c = ref step.Problem.Contacts[i];
            if (c.Second == ContactPoint.Static && c.Impulse > 0)
            {
                velocity -= c.Normal * Vector3D.Dot(c.Normal, velocity);
                planes.Add(c.Surface);
            }
        }

        trajectories.Open(graph.Slots[body], key, graph.Positions[body], velocity, 0, planes.Planes, spin);
    }

    private void CarryContacts(int body, int piece)
    {
        BodyId self = bodies.Id(graph.Slots[body]);
        foreach (int i in step.Problem.ListOf(body))
        {
            ref readonly SolverContact c = ref step.Problem.Contacts[i];
            bool isFirst = c.First == body;
            bool isPair = c.Second != ContactPoint.Static;
            Vector3D push = (c.Normal * c.Impulse) + c.FrictionImpulse;
            timelines.Carried.Add(piece, new PersistentContact(
                !isPair ? self : bodies.Id(graph.Slots[isFirst ? c.Second : c.First]),
                isPair ? PersistentContact.NoSurface : c.Surface,
                c.Holds,
                (isFirst ? push : -push).WithoutNegativeZero(),
                (isFirst ? c.Turn : -c.Turn).WithoutNegativeZero()));
        }
    }
}
