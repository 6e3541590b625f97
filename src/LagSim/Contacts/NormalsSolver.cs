using System;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>Settles the normals of a <see cref="ContactProblem"/> that sweeps have not settled, with friction as they left it.</summary>
/// <remarks>
/// <para>A sweep hands an impulse on from one body to the next, so a column of n bodies takes in the order of n² of them, and more where a
/// light body carries a heavy one. Few contacts are solved exactly instead (<see cref="ActiveSet"/>). Many are by
/// <see cref="ProjectedGradients"/>, which begin with the impulses that the sweeps got to and take a few times n steps, each of which
/// costs what a sweep does.</para>
/// <para>Not with a body in a hand, whose push is limited. Cost: that of the solver. Allocates only when there are more bodies or contacts
/// than ever before. Not thread-safe.</para>
/// </remarks>
internal sealed class NormalsSolver
{
    private readonly ProjectedGradients gradients = new();
    private readonly ActiveSet few = new();
    private ContactPoint[] points = Array.Empty<ContactPoint>();
    private double[] demands = Array.Empty<double>(); // by contact, as the next
    private double[] impulses = Array.Empty<double>();
    private double[] masses = Array.Empty<double>(); // by body, as the next
    private Vector3D[] changes = Array.Empty<Vector3D>();

    /// <summary>Sets velocities, and the impulses along normals: each contact opens at least at its target, or pushes.</summary>
    /// <param name="problem">With the velocities before it, and the impulses that sweeps got to; nobody is in a hand.</param>
    /// <param name="tolerance">What may be left to close, in m/s.</param>
    /// <returns>How many steps that took: each costs about as much as a sweep.</returns>
    internal int Solve(ContactProblem problem, double tolerance)
    {
        int count = problem.ContactCount;
        int bodies = problem.BodyCount;
        Fill(problem);
        Span<ContactPoint> contacts = points.AsSpan(0, count);
        Span<double> inertias = masses.AsSpan(0, bodies);
        Span<double> demand = demands.AsSpan(0, count);
        Span<double> impulse = impulses.AsSpan(0, count);
        Span<Vector3D> change = changes.AsSpan(0, bodies);
        int steps = count;
        if (ImpactSolver.AreMany(count, inertias))
        {
            gradients.TrySolve(contacts, inertias, demand, impulse, change, again: true, tolerance);
            steps = gradients.Steps;
        }
        else
        {
            few.TrySolve(contacts, inertias, demand, impulse, change);
        }

        for (int b = 0; b < bodies; b++)
        {
            problem.Bodies[b].Velocity += changes[b];
        }

        for (int i = 0; i < count; i++)
        {
            problem.Contacts[i].Impulse = Math.Max(0, impulses[i]);
        }

        return steps;
    }

    /// <summary>Adds friction, and asks for what lacks after it.</summary>
    private void Fill(ContactProblem problem)
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

        for (int i = 0; i < problem.ContactCount; i++)
        {
            ref readonly SolverContact c = ref problem.Contacts[i];
            points[i] = new ContactPoint(c.First, c.Second, c.Surface, default) { Normal = c.Normal, Impulse = c.Impulse };
        }

        ContactSolver.ApplyFriction(problem);
        for (int i = 0; i < problem.ContactCount; i++)
        {
            ref readonly SolverContact c = ref problem.Contacts[i];
            demands[i] = c.Target - ContactSolver.Opening(problem, c);
        }
    }
}
