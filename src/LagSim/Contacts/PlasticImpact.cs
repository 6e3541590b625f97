using System;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>
/// Perfectly plastic impacts: bodies that close on each other go on with one velocity, that of their centre of mass, of a hand among them,
/// or none where something static is.
/// </summary>
/// <remarks>
/// Momentum is kept, apart from what is static or held, and energy only lost. Each impact joins two groups of bodies, so there are fewer
/// impacts than bodies, and in the end nothing closes but what two hands press, or a hand and a surface. Deterministic: contacts come in
/// the order of the problem. Cost: contacts times impacts.
/// </remarks>
internal sealed class PlasticImpact
{
    private Group[] groups = Array.Empty<Group>();
    private int[] groupOf = Array.Empty<int>(); // by body; the last is what is static

    /// <summary>Joins what closes.</summary>
    /// <param name="problem">The contacts, and the velocities of the bodies, which it changes.</param>
    /// <param name="speed">In m/s: what closes no faster is left.</param>
    internal void Apply(ContactProblem problem, double speed)
    {
        Begin(problem);
        bool joins = true;
        while (joins)
        {
            joins = false;
            for (int i = 0; i < problem.ContactCount; i++)
            {
                ref readonly SolverContact c = ref problem.Contacts[i];
                int first = groupOf[c.First];
                int second = groupOf[c.Second == ContactPoint.Static ? problem.BodyCount : c.Second];
                if (Vector3D.Dot(c.Normal, groups[first].Velocity - groups[second].Velocity) < -speed && CanJoin(first, second))
                {
                    Join(first, second, problem.BodyCount);
                    joins = true;
                }
            }
        }

        for (int i = 0; i < problem.BodyCount; i++)
        {
            problem.Bodies[i].Velocity = groups[groupOf[i]].Velocity;
        }
    }

    private void Begin(ContactProblem problem)
    {
        int count = problem.BodyCount + 1;
        if (groups.Length < count)
        {
            groups = new Group[2 * count];
            groupOf = new int[2 * count];
        }

        for (int i = 0; i < problem.BodyCount; i++)
        {
            ref readonly SolverBody body = ref problem.Bodies[i];
            groups[i] = new Group { Mass = 1 / body.InverseMass, Velocity = body.Velocity }; // infinite if it is held
            groupOf[i] = i;
        }

        groups[problem.BodyCount] = new Group { Mass = double.PositiveInfinity };
        groupOf[problem.BodyCount] = problem.BodyCount;
    }

    private bool CanJoin(int first, int second) =>
        first != second && !(double.IsPositiveInfinity(groups[first].Mass) && double.IsPositiveInfinity(groups[second].Mass));

    private void Join(int first, int second, int bodies)
    {
        ref Group a = ref groups[first];
        ref Group b = ref groups[second];
        double mass = a.Mass + b.Mass;
        double part = double.IsPositiveInfinity(b.Mass) ? 1 : b.Mass / mass; // 0 where a cannot give way
        a.Velocity += (b.Velocity - a.Velocity) * part;
        a.Mass = mass;
        for (int i = 0; i <= bodies; i++)
        {
            groupOf[i] = groupOf[i] == second ? first : groupOf[i];
        }
    }

    private struct Group
    {
        internal double Mass;
        internal Vector3D Velocity;
    }
}
