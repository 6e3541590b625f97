using System;
using LagSim.Contacts;
using LagSim.Scenes;
using Xunit;

namespace LagSim.Tests.Contacts;

/// <summary>What few sweeps leave of drawn problems is settled along the normals, and friction is left as it was.</summary>
public sealed class NormalRefinementTests
{
    private const double Tolerance = 1e-6;

    /// <summary>The control in each: after the sweeps alone it is not settled.</summary>
    [Theory]
    [InlineData(0, 1, 1)]
    [InlineData(0.4, 1, 1)]
    [InlineData(0.4, 1e6, 1)]
    [InlineData(0.4, 1, 12)]
    [InlineData(0.4, 100, 12)]
    public void Solve_AfterTwoSweeps_SettlesTheNormals(double friction, double ratio, int piles)
    {
        for (int seed = 0; seed < 40; seed++)
        {
            ContactProblem problem = Drawn(seed, friction, ratio, piles);
            ContactProblem before = Drawn(seed, friction, ratio, piles);
            Assert.Equal(piles > 1, problem.ContactCount > NormalImpulses.MaxAtOnce);
            ContactSolver.Solve(problem, Tolerance, 2);
            Assert.True(Worst(problem) > 1000 * Tolerance);
            Settle(problem, before);
            Assert.True(Worst(problem) <= 2 * Tolerance, $"seed {seed}: {Worst(problem)}");
            for (int i = 0; i < problem.ContactCount; i++)
            {
                before.Contacts[i].FrictionImpulse = problem.Contacts[i].FrictionImpulse;
            }

            ContactSolver.ApplyFriction(before);
            for (int b = 0; b < problem.BodyCount; b++)
            {
                Assert.True((before.Bodies[b].Spin - problem.Bodies[b].Spin).Length < 1e-9); // friction as it was, and nothing else turns
            }
        }
    }

    /// <summary>A column of so many at rest: contact k from the top carries k times the weight of one.</summary>
    [Theory]
    [InlineData(50)]
    [InlineData(200)]
    public void Solve_ColumnThatFalls_IsCarried(int balls)
    {
        ContactProblem problem = Column(balls);
        ContactSolver.Solve(problem, Tolerance, ContactStep.MaxSweeps);
        Assert.True(Worst(problem) > 1000 * Tolerance);
        int steps = Settle(problem, Column(balls));
        Assert.InRange(steps, 1, 4 * balls); // where sweeps would take the square
        for (int i = 0; i < balls; i++)
        {
            Assert.Equal(0.1 * (balls - i), problem.Contacts[i].Impulse, 1e-3);
        }
    }

    /// <summary>
    /// A light ball between a floor and a heavy one: what the impulses of before add up to on it may be rounding, and only then is it
    /// not begun with them.
    /// </summary>
    [Theory]
    [InlineData(1e3, true)]
    [InlineData(1e15, false)]
    public void CanAddUp_LightUnderHeavy_IsByRounding(double ratio, bool can)
    {
        ContactProblem problem = new();
        problem.AddBody(1, 0.1, Vector3D.Zero, Vector3D.Zero);
        problem.AddBody(ratio, 0.1, Vector3D.Zero, Vector3D.Zero);
        problem.AddContact(0, ContactPoint.Static, 0, Vector3D.Up, 0, 0, 0).Impulse = 0.1 * ratio;
        problem.AddContact(0, 1, -1, -Vector3D.Up, 0, 0, 0).Impulse = 0.1 * ratio;
        Assert.Equal(can, ContactSolver.CanAddUp(problem, Tolerance));
    }

    private static int Settle(ContactProblem problem, ContactProblem before)
    {
        for (int b = 0; b < problem.BodyCount; b++)
        {
            (problem.Bodies[b].Velocity, problem.Bodies[b].Spin) = (before.Bodies[b].Velocity, before.Bodies[b].Spin);
        }

        return new NormalRefinement().Solve(problem, Tolerance);
    }

    private static ContactProblem Column(int balls)
    {
        ContactProblem problem = new();
        for (int b = 0; b < balls; b++)
        {
            problem.AddBody(1, 0.1, new Vector3D(0, -0.1, 0), Vector3D.Zero);
            problem.AddContact(b, b - 1, b == 0 ? 0 : -1, Vector3D.Up, 0, 0, 0);
        }

        return problem;
    }

    /// <summary>Some piles of another test, with masses that differ by as much as that factor; each leans on the one before.</summary>
    private static ContactProblem Drawn(int seed, double friction, double ratio, int piles)
    {
        ContactProblem problem = new();
        Random random = new(seed);
        for (int pile = 0; pile < piles; pile++)
        {
            ContactProblem like = ContactSolverTests.Draw((40 * pile) + seed, friction, 0);
            int first = problem.BodyCount;
            for (int b = 0; b < like.BodyCount; b++)
            {
                ref readonly SolverBody body = ref like.Bodies[b];
                problem.AddBody(Math.Pow(ratio, random.NextDouble()) / body.InverseMass, body.Radius, body.Velocity, body.Spin);
            }

            for (int i = 0; i < like.ContactCount; i++)
            {
                SolverContact c = like.Contacts[i];
                int second = c.Second == ContactPoint.Static ? c.Second : first + c.Second;
                problem.AddContact(first + c.First, second, c.Surface, c.Normal, c.Gap, c.Friction, c.Lever).Target = c.Target;
            }

            if (pile > 0)
            {
                problem.AddContact(first - 1, first, -1, new Vector3D(-1, 0, 0), 0, friction, 0);
            }
        }

        return problem;
    }

    /// <summary>By how much at most the law along a normal is broken, in m/s.</summary>
    private static double Worst(ContactProblem problem)
    {
        double worst = 0;
        for (int i = 0; i < problem.ContactCount; i++)
        {
            ref readonly SolverContact c = ref problem.Contacts[i];
            double over = ContactSolver.Opening(problem, c) - c.Target;
            Assert.True(c.Impulse >= 0);
            worst = Math.Max(worst, c.Impulse > 0 ? Math.Abs(over) : -over);
        }

        return worst;
    }
}
