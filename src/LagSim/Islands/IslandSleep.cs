using LagSim.Contacts;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Islands;

/// <summary>Falling asleep: when an island may, and the segments of its rest. <see cref="SleepWaker"/> wakes it.</summary>
internal sealed class IslandSleep(BodyTable bodies, TimelineStore timelines, ContactGraph graph, ContactStep step)
{
    /// <summary>Whether no body of the island has been faster than the still speed for as long as it takes to fall asleep.</summary>
    internal bool MayFallAsleep(SimTime tick)
    {
        bool rests = true;
        for (int i = 0; i < graph.BodyCount && rests; i++)
        {
            int piece = timelines.Last(graph.Slots[i]);
            rests = tick - timelines.Carried.StillSince(piece) >= ContactScale.StillFor;
        }

        return rests;
    }

    /// <summary>
    /// Whether a body is so slow that in the time before a sleep it does not move by the tolerance; nor its surface, against what it rubs
    /// on, or what rolling resistance is to have it turn with.
    /// </summary>
    internal bool IsStill(int body, in SolverBody solved)
    {
        double speed = step.Scale.StillSpeed;
        bool isStill = solved.Velocity.Length <= speed;
        foreach (int i in step.Problem.ListOf(body))
        {
            ref readonly SolverContact c = ref step.Problem.Contacts[i];
            Vector3D turning = c.Second == ContactPoint.Static
                ? solved.Spin
                : step.Problem.Bodies[c.First].Spin - step.Problem.Bodies[c.Second].Spin;
            isStill &= c.Lever == 0 || turning.Length * solved.Radius <= speed;
            // At its bound friction slips; what is just below it has been moved there by the last sweeps.
            bool slips = c.Impulse > 0 && c.FrictionImpulse.Length >= 0.999 * c.Friction * c.Impulse;
            isStill &= c.Friction == 0 || !slips || ContactSolver.Slip(step.Problem, c).Length <= speed;
        }

        return isStill;
    }

    /// <summary>
    /// Puts the island to sleep: all its bodies rest, and forget their impulses, so that islands that came to rest in other ways are equal.
    /// </summary>
    internal void FallAsleep(in EventKey key)
    {
        step.Problem.List();
        for (int i = 0; i < graph.BodyCount; i++)
        {
            int slot = graph.Slots[i];
            int before = timelines.Last(slot);
            MotionSegment rest = MotionSegment.AtRest(key.Time, graph.Positions[i].WithoutNegativeZero());
            timelines.Append(slot, bodies.Id(slot), key, rest, default, spin: new Spin(SpinAtRest(i)));
            int piece = timelines.Last(slot);
            timelines.BeginMember(piece, key.Time, timelines.Carried.StillSince(before));
            for (int at = timelines.Carried.First(before); at != TimelineStore.None; at = timelines.Carried.Next(at))
            {
                PersistentContact contact = timelines.Carried.At(at);
                if (contact.Holds)
                {
                    timelines.Carried.Add(piece, new PersistentContact(contact.Partner, contact.Surface, holds: true));
                }
            }

            timelines.EndMember(piece, bodies.Id(slot));
        }
    }

    /// <summary>
    /// The spin of a body once its centre rests: as before, except what moves its surface slower than rest allows. Turning about the normal
    /// of a contact and rolling there are separated, so that a body that continues to turn on the spot does not continue to roll.
    /// </summary>
    private Vector3D SpinAtRest(int body)
    {
        Vector3D spin = graph.Spins[body];
        double least = step.Scale.StillSpeed / graph.Radii[body];
        foreach (int i in step.Problem.ListOf(body))
        {
            ref readonly SolverContact c = ref step.Problem.Contacts[i];
            Vector3D onTheSpot = c.Normal * Vector3D.Dot(c.Normal, spin);
            spin = c.Held && c.Friction > 0 && (spin - onTheSpot).Length <= least ? onTheSpot : spin;
        }

        return spin.Length > least ? spin : Vector3D.Zero;
    }
}
