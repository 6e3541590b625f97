using System;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>Solves a <see cref="ContactProblem"/> whose masses are too unlike for <see cref="ContactSolver"/>: the normals exactly, friction in turns with them.</summary>
/// <remarks>
/// Where a light body carries a heavy one, a sweep hands on as much as the light one weighs, and as many sweeps are needed as the ratio of
/// their masses. So beyond the ratio for which <see cref="ContactStep.MostSweeps"/> are enough, <see cref="LastingContactSolver"/> is
/// asked, which works on velocities and not on impulses. Cost: the cube of the contacts up to a hundred.
/// </remarks>
internal sealed class UnlikeMassSolver
{
    /// <summary>
    /// Masses that differ by no more than this factor are like enough for sweeps. What is off falls by e in as many sweeps as the factor, so in as many as there may be at
    /// most it falls to e^-8, a three thousandth.
    /// </summary>
    internal const double LikeMasses = ContactStep.MostSweeps / 8;

    private readonly LastingContactSolver solver = new();
    private ContactPoint[] points = Array.Empty<ContactPoint>();
    private Rub[] rubs = Array.Empty<Rub>();
    private double[] masses = Array.Empty<double>();
    private double[] radii = Array.Empty<double>();
    private Vector3D[] velocities = Array.Empty<Vector3D>();
    private Vector3D[] spins = Array.Empty<Vector3D>();

    /// <summary>Whether it is the one to ask: masses differ by more than that factor, and none is in a hand.</summary>
    internal static bool Suits(ContactProblem problem)
    {
        double least = double.PositiveInfinity;
        double most = 0;
        for (int b = 0; b < problem.BodyCount; b++)
        {
            least = Math.Min(least, problem.Bodies[b].InverseMass);
            most = Math.Max(most, problem.Bodies[b].InverseMass);
        }

        return least > 0 && most > LikeMasses * least;
    }

    /// <summary>Changes the bodies' velocities, which are those without contacts, and sets the impulses.</summary>
    internal void Solve(ContactProblem problem)
    {
        Fill(problem);
        solver.Solve(
            points.AsSpan(0, problem.ContactCount), rubs.AsSpan(0, problem.ContactCount), masses.AsSpan(0, problem.BodyCount), radii.AsSpan(0, problem.BodyCount),
            velocities.AsSpan(0, problem.BodyCount), spins.AsSpan(0, problem.BodyCount), LastingContactSolver.Start.Anew, LastingContactSolver.UsualTurns);
        for (int b = 0; b < problem.BodyCount; b++)
        {
            problem.Bodies[b].Velocity = velocities[b];
            problem.Bodies[b].Spin = spins[b];
        }

        for (int i = 0; i < problem.ContactCount; i++)
        {
            ref SolverContact c = ref problem.Contacts[i];
            c.Impulse = points[i].Impulse;
            c.Rub = rubs[i].Push;
            c.Turn = rubs[i].Turn;
        }
    }

    private void Fill(ContactProblem problem)
    {
        if (points.Length < problem.ContactCount)
        {
            points = new ContactPoint[problem.Contacts.Length];
            rubs = new Rub[problem.Contacts.Length];
        }

        if (masses.Length < problem.BodyCount)
        {
            int size = problem.Bodies.Length;
            (masses, radii, velocities, spins) = (new double[size], new double[size], new Vector3D[size], new Vector3D[size]);
        }

        for (int b = 0; b < problem.BodyCount; b++)
        {
            ref readonly SolverBody body = ref problem.Bodies[b];
            (masses[b], radii[b], velocities[b], spins[b]) = (1 / body.InverseMass, body.Radius, body.Velocity, body.Spin);
        }

        for (int i = 0; i < problem.ContactCount; i++)
        {
            ref readonly SolverContact c = ref problem.Contacts[i];
            points[i] = new ContactPoint(c.First, c.Second, c.Surface, default) { Normal = c.Normal, Target = c.Target };
            rubs[i] = new Rub { Friction = c.Friction, Lever = c.Lever };
        }
    }
}
