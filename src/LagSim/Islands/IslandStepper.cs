using System;
using LagSim.Collisions;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Rollback;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Islands;

/// <summary>Contact steps: bodies in persistent contact are islands, which move by steps of a common clock, or rest together.</summary>
/// <remarks>
/// A step opens the segments of all of an island with one key. Within it an impact or a player opens new ones only for the bodies that it
/// reaches. All others continue along their chords to the next tick, which finds the island's members by the contacts that its segments
/// carry.
/// </remarks>
internal sealed class IslandStepper(
    BodyTable bodies, TimelineStore timelines, ContactGraph graph, ContactStep step, StepForces stepForces, Partners partners,
    RewindRequests rewinds, MemberFactory members, StepSegments segments, IslandSleep sleep, IslandStatics statics, StepMarks marks,
    EventWork work)
{
    private bool[] isLost = Array.Empty<bool>(); // by body of the graph: no step follows the forces on it

    private Paths Paths => new(timelines);

    /// <summary>How many contact steps were taken.</summary>
    internal long StepsTaken { get; private set; }

    /// <summary>
    /// Takes the step of an island whose tick has come; false if a body that takes part is ahead and has to be rewound first.
    /// </summary>
    internal bool TryStep(int slot, in EventKey key, out EventKey canonical)
    {
        canonical = default;
        partners.NearMisses.Clear();
        CollectIsland(slot, key);
        if (!rewinds.AreNone)
        {
            return false;
        }

        canonical = StepKey();
        graph.Evaluate(canonical.Time, 0);
        SimTime time = canonical.Time;
        stepForces.Begin(time);
        SimDuration length = FillStep(canonical.Time, StepWanted(canonical.Time));
        double tolerance = StepTolerance(out bool mayRest);
        if (mayRest && sleep.MayFallAsleep(canonical.Time) && statics.Holds(canonical.Time, length.ToSeconds()))
        {
            sleep.FallAsleep(canonical);
        }
        else
        {
            SolveStep(length, tolerance);
            for (double wanted = StepWantedAfter(time); step.Scale.StepFrom(canonical.Time, wanted) < length; wanted = Math.Min(wanted, StepWantedAfter(time)))
            {
                length = FillStep(canonical.Time, wanted); // a force got strong within it
                SolveStep(length, tolerance);
            }

            step.FindHolding(length.ToSeconds());
            segments.OpenStep(canonical, length, isLost);
            MarkStep();
        }

        StepsTaken++;
        return true;
    }

    /// <summary>Marks the bodies of the step that strike no other body of it, so that the predictions that follow skip them.</summary>
    private void MarkStep()
    {
        for (int i = 0; i < graph.BodyCount; i++)
        {
            if (!step.MayMeet(i) && timelines.Segment(timelines.Last(graph.Slots[i])).Law == MotionLaw.Constrained)
            {
                marks.Add(graph.Slots[i], bodies.Room);
            }
        }
    }

    /// <summary>
    /// Collects the solver bodies: all that hold together with a body, through others as well, and which of them are held, by the segments
    /// that they are on at the key.
    /// </summary>
    private void CollectIsland(int slot, in EventKey key)
    {
        graph.Clear();
        graph.AddBody(slot);
        for (int i = 0; i < graph.BodyCount; i++)
        {
            int piece = timelines.Last(graph.Slots[i]);
            if (!Paths.IsMember(piece))
            {
                continue; // held
            }

            for (int at = timelines.Carried.First(piece); at != TimelineStore.None; at = timelines.Carried.Next(at))
            {
                ref readonly PersistentContact contact = ref timelines.Carried.At(at);
                if (contact.Holds && contact.Surface == PersistentContact.NoSurface && graph.IndexOf(bodies.SlotOf(contact.Partner)) < 0
                    && partners.TryFind(bodies.Id(graph.Slots[i]), contact.Partner, key, out int partner))
                {
                    graph.AddBody(partner);
                }
            }
        }

        graph.Sort();
    }

    /// <summary>The step's key, the same whichever member was popped: the least of its members' keys, without sleepers.</summary>
    private EventKey StepKey()
    {
        EventKey least = default;
        bool any = false;
        for (int i = 0; i < graph.BodyCount; i++)
        {
            int piece = timelines.Last(graph.Slots[i]);
            if (timelines.Segment(piece).Law == MotionLaw.Constrained)
            {
                SimTime end = timelines.Segment(piece).End;
                BodyId id = bodies.Id(graph.Slots[i]);
                EventKey own = new(end, Paths.RoundAfter(piece, end), EventKind.StepEnd, id, id, 0, 0);
                least = any && EventKey.Compare(least, own) <= 0 ? least : own;
                any = true;
            }
        }

        return least;
    }

    /// <summary>
    /// The longest step of these bodies, in seconds, by where they come from. A body whose forces no step follows takes part without them
    /// once more, and is lost.
    /// </summary>
    private double StepWanted(SimTime time)
    {
        if (isLost.Length < graph.BodyCount)
        {
            isLost = new bool[graph.BodyCount * 2];
        }

        double wanted = double.PositiveInfinity;
        for (int i = 0; i < graph.BodyCount; i++)
        {
            double its = double.IsPositiveInfinity(graph.Masses[i]) ? double.PositiveInfinity
                : members.StepWanted(graph.Slots[i], time, graph.Positions[i], graph.Velocities[i], graph.Spins[i]);
            isLost[i] = its == 0;
            wanted = isLost[i] ? wanted : Math.Min(wanted, its);
        }

        return wanted;
    }

    /// <summary>The same by where the step that was solved leads them.</summary>
    private double StepWantedAfter(SimTime time)
    {
        double wanted = double.PositiveInfinity;
        for (int i = 0; i < graph.BodyCount; i++)
        {
            ref readonly SolverBody solved = ref step.Problem.Bodies[i];
            wanted = isLost[i] || double.IsPositiveInfinity(graph.Masses[i]) ? wanted
                : Math.Min(wanted, members.StepWanted(graph.Slots[i], time, graph.Positions[i], solved.Velocity, solved.Spin));
        }

        return wanted;
    }

    /// <summary>Has the step's bodies and contacts ready.</summary>
    /// <returns>How long it is.</returns>
    private SimDuration FillStep(SimTime tick, double wanted)
    {
        SimDuration length = step.Scale.StepFrom(tick, wanted);
        double seconds = length.ToSeconds();
        step.Clear();
        for (int i = 0; i < graph.BodyCount; i++)
        {
            int slot = graph.Slots[i];
            int piece = timelines.Last(slot);
            ref readonly BodySpec spec = ref bodies.Spec(slot);
            bool isHeld = Paths.IsHeld(piece);
            Vector3D velocity = graph.Velocities[i];
            Vector3D gain = Vector3D.Zero;
            if (isHeld)
            {
                velocity = (Paths.PositionAt(piece, tick + length) - graph.Positions[i]) / seconds;
            }
            else if (isLost[i])
            {
                graph.Accelerations[i] = Vector3D.Zero;
            }
            else
            {
                gain = stepForces.GainInStep(i, length);
            }

            step.AddBody(
                spec, graph.Positions[i], velocity, gain, graph.Spins[i], isHeld, spec.Forces.IsEmpty || isHeld ? 0 : graph.Accelerations[i].Length,
                timelines.Extras.Filter(piece));
            if (isHeld)
            {
                step.Problem.HandRoom(i) = step.Rules.BoundsHands
                    ? seconds * HandStrength.ForceAt(timelines.HoldOf(piece), spec.Mass, velocity.Length) : double.PositiveInfinity;
            }
        }

        step.FindContacts(seconds);
        Warm();
        step.DropImpacts(seconds);
        return length;
    }

    private void SolveStep(SimDuration length, double tolerance)
    {
        step.Solve(length.ToSeconds(), tolerance);
        stepForces.Iterate(tolerance, isLost);
        step.LimitEnergy(length.ToSeconds(), tolerance);
        work.CountSweeps(step.Sweeps, step.Problem.ContactCount);
    }

    /// <summary>Has the contacts begin with the impulses that they had in the last step.</summary>
    private void Warm()
    {
        for (int i = 0; i < step.Problem.ContactCount; i++)
        {
            ref SolverContact c = ref step.Problem.Contacts[i];
            int piece = timelines.Last(graph.Slots[c.First]);
            if (!Paths.IsMember(piece))
            {
                continue;
            }

            int at = c.Second == ContactPoint.Static ? timelines.Carried.With(piece, c.Surface) : timelines.Carried.With(piece, bodies.Id(graph.Slots[c.Second]));
            if (at != TimelineStore.None)
            {
                ref readonly PersistentContact known = ref timelines.Carried.At(at);
                c.Impulse = Math.Max(0, Vector3D.Dot(known.Push, c.Normal));
                c.FrictionImpulse = c.Friction > 0 ? known.Push - (c.Normal * Vector3D.Dot(known.Push, c.Normal)) : Vector3D.Zero;
                c.Turn = c.Lever > 0 ? known.Turn : Vector3D.Zero;
                c.Held = known.Holds;
            }
        }
    }

    /// <summary>How well the step is solved: the finer, the less the island moves.</summary>
    private double StepTolerance(out bool mayRest)
    {
        double fastest = 0;
        mayRest = true;
        for (int i = 0; i < graph.BodyCount; i++)
        {
            bool isHeld = double.IsPositiveInfinity(graph.Masses[i]);
            fastest = Math.Max(fastest, graph.Velocities[i].Length);
            mayRest &= !isHeld && !stepForces.MayChange(i);
        }

        return Math.Min(step.Scale.SweepSpeed, Math.Max(0.05 * fastest, step.Scale.FinestSweepSpeed));
    }
}
