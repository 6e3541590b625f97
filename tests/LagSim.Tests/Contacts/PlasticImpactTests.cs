using System;
using LagSim.Contacts;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Contacts;

/// <summary>Perfectly plastic impacts: in the end nothing closes, momentum is kept and energy is not gained.</summary>
public sealed class PlasticImpactTests
{
    [Fact]
    public void Apply_OfDrawnContacts_LeavesNothingThatCloses()
    {
        int joined = 0, left = 0;
        for (int seed = 0; seed < 2000; seed++)
        {
            Random random = new(seed);
            ContactProblem problem = Draw(random, hasWall: seed % 2 == 0, hasHand: seed % 5 == 0);
            Vector3D[] before = Velocities(problem);
            Vector3D momentum = Momentum(problem);
            double energy = problem.KineticEnergy();
            bool closed = false;
            for (int i = 0; i < problem.ContactCount; i++)
            {
                closed |= ContactSolver.Opening(problem, problem.Contacts[i]) < -1e-6;
            }

            new PlasticImpact().Apply(problem, 1e-6);
            for (int i = 0; i < problem.ContactCount; i++)
            {
                ref readonly SolverContact c = ref problem.Contacts[i];
                bool isJammed = seed % 10 == 0 && IsOfWall(problem, c.First) != IsOfWall(problem, c.Second); // between the hand and the wall
                Assert.True(isJammed || ContactSolver.Opening(problem, c) >= -1.001e-6, $"{seed}");
            }

            joined += closed ? 1 : 0;
            left += closed ? 0 : 1;
            if (!closed)
            {
                Assert.Equal(before, Velocities(problem)); // the control
            }

            if (seed % 2 != 0 && seed % 5 != 0)
            {
                Near(0, (Momentum(problem) - momentum).Length, 1e-9 * (1 + momentum.Length));
                Assert.InRange(problem.KineticEnergy(), 0, energy * (1 + 1e-12));
            }
        }

        Assert.True(joined > 1000 && left > 10, $"{joined} {left}");
    }

    /// <summary>A light ball between two heavy ones that come together: all three go on as one.</summary>
    [Fact]
    public void Apply_LightBetweenHeavy_GoOnTogether()
    {
        ContactProblem problem = new();
        problem.AddBody(1, 0.1, V(1), V(0));
        problem.AddBody(1e-9, 0.1, V(5), V(0));
        problem.AddBody(3, 0.1, V(-1), V(0));
        problem.AddContact(0, 1, -1, V(-1), 0, 0, 0);
        problem.AddContact(1, 2, -1, V(-1), 0, 0, 0);
        new PlasticImpact().Apply(problem, 1e-6);
        Assert.All(Velocities(problem), velocity => Near(-0.5, velocity.X, 1e-8));
    }

    /// <summary>Whether a body goes on with the wall: at rest, though it came otherwise or the hand moves.</summary>
    private static bool IsOfWall(ContactProblem problem, int body) => body == ContactPoint.Static || problem.Bodies[body].Velocity == Vector3D.Zero;

    private static ContactProblem Draw(Random random, bool hasWall, bool hasHand)
    {
        ContactProblem problem = new();
        int bodies = 2 + random.Next(6);
        for (int n = 0; n < bodies; n++)
        {
            double mass = hasHand && n == 0 ? double.PositiveInfinity : Math.Pow(10, random.Next(-9, 4));
            problem.AddBody(mass, 0.1, random.Next(4) == 0 ? V(0) : Direction(random) * (3 * random.NextDouble()), V(0));
        }

        for (int n = 1; n < bodies; n++)
        {
            int other = random.Next(n);
            problem.AddContact(other, n, -1, Direction(random), 0, 0, 0);
        }

        if (hasWall)
        {
            problem.AddContact(bodies - 1, ContactPoint.Static, 0, Direction(random), 0, 0, 0);
        }

        return problem;
    }

    private static Vector3D Direction(Random random) =>
        new Vector3D(random.NextDouble() - 0.5, random.NextDouble() - 0.5, random.NextDouble() - 0.5).Direction;

    private static Vector3D[] Velocities(ContactProblem problem)
    {
        Vector3D[] all = new Vector3D[problem.BodyCount];
        for (int n = 0; n < all.Length; n++)
        {
            all[n] = problem.Bodies[n].Velocity;
        }

        return all;
    }

    private static Vector3D Momentum(ContactProblem problem)
    {
        Vector3D sum = Vector3D.Zero;
        for (int n = 0; n < problem.BodyCount; n++)
        {
            sum += problem.Bodies[n].InverseMass == 0 ? Vector3D.Zero : problem.Bodies[n].Velocity / problem.Bodies[n].InverseMass;
        }

        return sum;
    }
}
