using System;
using LagSim.Contacts;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Islands;

/// <summary>What forces give the bodies of a contact step: to each from the middle of its last step to the middle of this one.</summary>
/// <remarks>
/// <para>Leapfrog: the velocity of a step is that of its middle. Where the next is as long, forces act at the mean of both velocities for a
/// whole step. Where the last was cut short before its middle, what they gave for later is taken back first. Where the next is shorter,
/// what they owe until as long before the tick as its middle is after it is given first, at the velocity of the last step: the new one
/// may be so fast that forces would follow it only in the shorter step.</para>
/// <para>Changes velocities of the graph, and the bodies of the step's problem. Deterministic. Cost: each force of each body once a step,
/// and once more each time that <see cref="Iterate"/> goes round.</para>
/// </remarks>
internal sealed class StepForces(BodyTable bodies, TimelineStore timelines, in Forces forces, ContactGraph graph, ContactStep step)
{
    /// <summary>
    /// The largest number of times that a force is evaluated again for the velocity that it leaves: each time the error halves, or shrinks
    /// far more.
    /// </summary>
    private const int MaxIterations = 64;

    private readonly Forces forces = forces;
    private Acting[] actions = Array.Empty<Acting>(); // by body of the graph
    private SimTime tick;
    private SimTime middle;

    /// <summary>Begins a step at a tick with the bodies of the graph, where it has evaluated them.</summary>
    internal void Begin(SimTime tick)
    {
        this.tick = tick;
        if (actions.Length < graph.BodyCount)
        {
            actions = new Acting[graph.BodyCount * 2];
        }

        for (int i = 0; i < graph.BodyCount; i++)
        {
            int piece = timelines.Last(graph.Slots[i]);
            ref SimTime until = ref actions[i].Until;
            until = timelines.Segment(piece).Law == MotionLaw.Constrained ? timelines.Carried.CentreOf(piece) : tick;
            if (tick < until && step.Rules.TakesBackForces)
            {
                // forces that follow from the velocity would act backwards on the one that this step gives: a drag would drive
                graph.Velocities[i] -= At(i, graph.Velocities[i], graph.Spins[i]) * until.SecondsSince(tick);
                until = tick;
            }
        }
    }

    /// <summary>What forces give a body until the middle of a step of such a length, by the velocity that it has so far.</summary>
    internal Vector3D GainInStep(int body, SimDuration length)
    {
        middle = tick + SimDuration.FromTicks(length.Ticks / 2);
        ref Acting action = ref actions[body];
        bool mayOwe = HasForces(body) && step.Rules.GivesWhatForcesOwe; // gravity is the same at any velocity
        action.AtMeanFrom = mayOwe ? SimTime.Max(tick - (middle - tick), action.Until) : action.Until;
        graph.Accelerations[body] = At(body, graph.Velocities[body], graph.Spins[body]);
        action.Owed = graph.Accelerations[body] * action.AtMeanFrom.SecondsSince(action.Until);
        return action.Owed + (graph.Accelerations[body] * middle.SecondsSince(action.AtMeanFrom));
    }

    /// <summary>What forces give a body until the tick, once the step is solved.</summary>
    internal Vector3D GainAtTick(int body) =>
        actions[body].Owed + (graph.Accelerations[body] * tick.SecondsSince(actions[body].AtMeanFrom));

    /// <summary>
    /// Has forces act at the mean of the velocities before the tick and after it, contacts included: the implicit midpoint rule, under
    /// which a magnetic force makes and takes no speed, and a damper none but what it should. At the velocity that the body came with, a
    /// force across it would drive away what lies still.
    /// </summary>
    internal void Iterate(double tolerance, Span<bool> isLost)
    {
        double last = double.PositiveInfinity;
        double change = 0;
        for (int n = 0; n < MaxIterations && HasForces() && change < last; n++)
        {
            last = n == 0 ? double.PositiveInfinity : change;
            change = 0;
            for (int i = 0; i < graph.BodyCount; i++)
            {
                if (!HasForces(i) || isLost[i] || double.IsPositiveInfinity(graph.Masses[i]))
                {
                    continue;
                }

                double since = middle.SecondsSince(actions[i].AtMeanFrom);
                Vector3D mean = (graph.Velocities[i] + step.Problem.Bodies[i].Velocity) * 0.5;
                Vector3D spin = (graph.Spins[i] + step.Problem.Bodies[i].Spin) * 0.5;
                Vector3D acceleration = At(i, mean, spin);
                change = Math.Max(change, (acceleration - graph.Accelerations[i]).Length * since);
                graph.Accelerations[i] = acceleration;
                step.Regain(i, graph.Velocities[i] + actions[i].Owed + (acceleration * since), graph.Spins[i]);
            }

            if (change == 0)
            {
                return;
            }

            step.SolveAgain(tolerance);
        }
    }

    /// <summary>Whether a program's own force acts on a body, of which nobody knows when it will change.</summary>
    internal bool MayChange(int body) => forces.HasSupplied(bodies.Spec(graph.Slots[body]));

    private Vector3D At(int body, in Vector3D velocity, in Vector3D spin)
    {
        int slot = graph.Slots[body];
        return forces.On(bodies.Id(slot)).At(bodies.Spec(slot), tick, 0, graph.Positions[body], velocity, spin);
    }

    private bool HasForces(int body) => !bodies.Spec(graph.Slots[body]).Forces.IsEmpty;

    private bool HasForces()
    {
        bool has = false;
        for (int i = 0; i < graph.BodyCount && !has; i++)
        {
            has = HasForces(i);
        }

        return has;
    }

    /// <summary>How forces act on a body in a step.</summary>
    private struct Acting
    {
        /// <summary>Until when they have acted already: the velocity with which it comes contains that.</summary>
        internal SimTime Until;

        /// <summary>From when on they act at the mean of the velocities before and after the tick.</summary>
        internal SimTime AtMeanFrom;

        /// <summary>What they give it between the two, at the velocity with which it comes, in m/s.</summary>
        internal Vector3D Owed;
    }
}
