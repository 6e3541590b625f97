using System;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>Solves the normals of a <see cref="ContactProblem"/> on which sweeps have not converged, with friction as they left it.</summary>
/// <remarks>
/// <para>A sweep passes an impulse on from one body to the next, so a column of n bodies takes on the order of n² sweeps, and more where a
/// light body carries a heavy one. <see cref="NormalImpulses"/> solves few contacts exactly, and many from the impulses that the sweeps
/// reached, in a few times n steps, each of which costs as much as a sweep.</para>
/// <para>Not for a problem with a held body, because a hand's push is limited. Cost: that of the solver. Allocates only when there are more
/// bodies or contacts than ever before. Not thread-safe.</para>
/// </remarks>
internal sealed class NormalRefinement
{
    private readonly NormalImpulses normals = new();
    private ContactPoint[] points = Array.Empty<ContactPoint>();
    private double[] demands = Array.Empty<double>(); // by contact, as the next
    private double[] impulses = Array.Empty<double>();
    private double[] masses = Array.Empty<double>(); // by body, as the next
    private Vector3D[] changes = Array.Empty<Vector3D>();

    /// <summary>
    /// Whether so many sweeps, of <see cref="ContactStep.MaxSweeps"/> at most, have left a problem's normals to it: they have not settled,
    /// or look settled because impulses are too large to add up.
    /// </summary>
    internal static bool IsNeeded(ContactProblem problem, int sweeps, double tolerance) =>
        !problem.HasHand() && (sweeps == ContactStep.MaxSweeps || !ContactSolver.CanAddUp(problem, tolerance));

    /// <summary>Sets velocities, and the impulses along normals: each contact opens at least at its target, or pushes.</summary>
    /// <param name="problem">With the velocities before it, and the impulses that sweeps reached; no body is held.</param>
    /// <param name="tolerance">The closing speed, in m/s, that may be left at many contacts; few are solved exactly.</param>
    /// <returns>The number of steps it took: each costs about as much as a sweep.</returns>
    internal int Solve(ContactProblem problem, double tolerance)
    {
        Grow(problem);
        ContactSolver.ApplyFriction(problem);
        int steps = 0;
        bool isPushed = Ask(problem, pushes: true);
        if (!TrySolve(problem, tolerance, ref steps) && isPushed)
        {
            // Not all overlap can be pushed out, as of what is squeezed between two walls: that nothing closes can always be had.
            Ask(problem, pushes: false);
            TrySolve(problem, tolerance, ref steps);
        }

        for (int b = 0; b < problem.BodyCount; b++)
        {
            problem.Bodies[b].Velocity += changes[b];
        }

        for (int i = 0; i < problem.ContactCount; i++)
        {
            ref SolverContact c = ref problem.Contacts[i];
            c.Impulse = Math.Max(0, impulses[i]);
        }

        return steps;
    }

    private bool TrySolve(ContactProblem problem, double tolerance, ref int steps)
    {
        int count = problem.ContactCount;
        Span<ContactPoint> contacts = points.AsSpan(0, count);
        Span<double> inertias = masses.AsSpan(0, problem.BodyCount);
        Span<double> demand = demands.AsSpan(0, count);
        Span<double> impulse = impulses.AsSpan(0, count);
        Span<Vector3D> change = changes.AsSpan(0, problem.BodyCount);
        bool isMet = normals.TrySolve(contacts, inertias, demand, impulse, change, again: true, tolerance);
        steps += normals.Steps;
        return isMet;
    }

    /// <summary>Asks for what lacks of the targets, or of those alone that push nothing out; whether any pushes.</summary>
    private bool Ask(ContactProblem problem, bool pushes)
    {
        bool isPushed = false;
        for (int i = 0; i < problem.ContactCount; i++)
        {
            ref readonly SolverContact c = ref problem.Contacts[i];
            points[i] = new ContactPoint(c.First, c.Second, c.Surface, default) { Normal = c.Normal, Impulse = c.Impulse };
            demands[i] = (pushes ? c.Target : Math.Min(0, c.Target)) - ContactSolver.Opening(problem, c);
            isPushed |= c.Target > 0;
        }

        return isPushed;
    }

    private void Grow(ContactProblem problem)
    {
        if (points.Length < problem.ContactCount)
        {
            int size = problem.Contacts.Length;
            (points, demands, impulses) = (new ContactPoint[size], new double[size], new double[size]);
        }

        if (masses.Length < problem.BodyCount)
        {
            int size = problem.Bodies.Length;
            (masses, changes) = (new double[size], new Vector3D[size]);
        }

        for (int b = 0; b < problem.BodyCount; b++)
        {
            masses[b] = 1 / problem.Bodies[b].InverseMass;
        }
    }
}
