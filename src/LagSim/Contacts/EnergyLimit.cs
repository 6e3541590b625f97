using System;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>Goes from one solution of a contact step, which makes no energy, as far towards another as a bound of energy allows.</summary>
/// <remarks>
/// The way between two solutions is straight. Every point of it keeps to the law of contact as both ends do: openings and what they must be
/// at least are linear, and the impulses that friction allows form a cone. Energy along it is a parabola, so how far it may go is known in
/// closed form. Cost: bodies and contacts. Allocates only when there are more of them than ever before. Not thread-safe.
/// </remarks>
internal sealed class EnergyLimit
{
    private SolverBody[] bodies = Array.Empty<SolverBody>();
    private SolverContact[] contacts = Array.Empty<SolverContact>();
    private double work; // of hands

    /// <summary>Remembers the solution that a problem has, to go towards it later.</summary>
    internal void Remember(ContactProblem problem)
    {
        if (bodies.Length < problem.BodyCount)
        {
            bodies = new SolverBody[problem.Bodies.Length];
        }

        if (contacts.Length < problem.ContactCount)
        {
            contacts = new SolverContact[problem.Contacts.Length];
        }

        Array.Copy(problem.Bodies, bodies, problem.BodyCount);
        Array.Copy(problem.Contacts, contacts, problem.ContactCount);
        work = problem.HandWork();
    }

    /// <summary>
    /// Goes from the solution that the problem has now towards the remembered one, until its kinetic energy, without the work of hands, is as
    /// large as it may be, in J.
    /// </summary>
    internal void GoTowards(ContactProblem problem, double most)
    {
        double part = Part(problem, most);
        for (int b = 0; b < problem.BodyCount; b++)
        {
            ref SolverBody body = ref problem.Bodies[b];
            if (part > 0)
            {
                body.Velocity += (bodies[b].Velocity - body.Velocity) * part;
                body.Spin += (bodies[b].Spin - body.Spin) * part;
            }
        }

        for (int i = 0; i < problem.ContactCount; i++)
        {
            ref SolverContact c = ref problem.Contacts[i];
            if (part > 0)
            {
                c.Impulse += (contacts[i].Impulse - c.Impulse) * part;
                c.FrictionImpulse += (contacts[i].FrictionImpulse - c.FrictionImpulse) * part;
                c.Turn += (contacts[i].Turn - c.Turn) * part;
            }

            (c.Friction, c.Lever) = (contacts[i].Friction, contacts[i].Lever);
        }
    }

    /// <summary>How far it may go, from 0 to 1: the root of energy + 2 s along + s² square = most.</summary>
    private double Part(ContactProblem problem, double most)
    {
        double energy = 0;
        double along = 0;
        double square = 0;
        for (int b = 0; b < problem.BodyCount; b++)
        {
            ref readonly SolverBody body = ref problem.Bodies[b];
            if (body.InverseMass > 0)
            {
                double half = 0.5 / body.InverseMass;
                double turning = ContactProblem.SphereInertia * body.Radius * body.Radius;
                Vector3D way = bodies[b].Velocity - body.Velocity;
                Vector3D turn = bodies[b].Spin - body.Spin;
                energy += half * (body.Velocity.LengthSquared + (turning * body.Spin.LengthSquared));
                along += half * (Vector3D.Dot(body.Velocity, way) + (turning * Vector3D.Dot(body.Spin, turn)));
                square += half * (way.LengthSquared + (turning * turn.LengthSquared));
            }
        }

        double done = problem.HandWork();
        along -= 0.5 * (work - done);
        double room = most - (energy - done);
        if (!(room > 0))
        {
            return along < 0 ? Math.Min(1, -along / square) : 0; // the least energy on the way
        }

        double root = Math.Sqrt((along * along) + (square * room));
        double part = along > 0 ? room / (along + root) : (root - along) / square;
        return part > 1 || square == 0 ? 1 : part >= 0 ? part : 0; // the same two solutions; or the remembered one is beyond all numbers
    }
}
