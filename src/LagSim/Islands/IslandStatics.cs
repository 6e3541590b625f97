using LagSim.Contacts;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Islands;

/// <summary>
/// Statics: whether an island that is put to rest where it is stays there, or is only slow, as what has just begun to slide is.
/// </summary>
/// <remarks>
/// A step from rest is solved, with the contacts closed, and with what forces give in it and what would stop each body within the time of
/// waiting. Where impulses within their cones balance that, no body moves after it: nothing sets the island going, and what still moves is
/// braked. What is no faster than sweeps may leave it is at rest. A pure function of the island at a tick. Cost: one more solution for each step in which an island is
/// slow enough to sleep; the impulses that it finds serve the step that follows if there is one.
/// </remarks>
internal class IslandStatics(BodyTable bodies, in Forces forces, ContactGraph graph, ContactStep step)
{
    /// <summary>The sweeps of its solution leave this part of what may be left.</summary>
    private const double SweepPart = 0.05;

    private readonly Forces forces = forces;

    /// <summary>
    /// Whether an island stays at rest, whose step has its bodies and contacts ready: nothing in it is deep in anything, and its contacts
    /// balance its forces and stop it. If not, the step is as it was, but for better impulses to begin with.
    /// </summary>
    /// <param name="tick">When it would fall asleep.</param>
    /// <param name="seconds">The length of the step.</param>
    internal virtual bool Holds(SimTime tick, double seconds)
    {
        if (step.IsDeep())
        {
            return false;
        }

        for (int i = 0; i < graph.BodyCount; i++)
        {
            int slot = graph.Slots[i];
            Vector3D pull = forces.On(bodies.Id(slot)).At(bodies.Spec(slot), tick, 0, graph.Positions[i], Vector3D.Zero, Vector3D.Zero);
            Vector3D momentum = graph.Velocities[i].Length <= step.Scale.FinestSweepSpeed ? default : graph.Velocities[i];
            step.PutToRest(i, (pull + (momentum * (1 / ContactScale.StillFor.ToSeconds()))) * seconds);
        }

        step.SolveAtRest(seconds, SweepPart * step.Scale.LeastPull * seconds);

        // What sweeps have not settled is no better known than a step of an island that hardly moves has it.
        double most = step.HasSettled ? step.Scale.LeastPull * seconds : step.Scale.FinestSweepSpeed;
        bool holds = true;
        for (int i = 0; i < graph.BodyCount && holds; i++)
        {
            ref readonly SolverBody solved = ref step.Problem.Bodies[i];
            holds = solved.Velocity.Length <= most && solved.Spin.Length * solved.Radius <= most; // not so of what is not a number
        }

        if (!holds)
        {
            step.TakeFromRest();
        }

        return holds;
    }
}
