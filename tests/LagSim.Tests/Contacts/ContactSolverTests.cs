using System;
using LagSim.Contacts;
using LagSim.Scenes;
using Xunit;

namespace LagSim.Tests.Contacts;

/// <summary>Drawn problems of a step: what comes of them keeps the law of each contact, and both sides of each impulse.</summary>
public sealed class ContactSolverTests
{
    private const double Tolerance = 1e-6;
    private const int Most = 20_000;

    [Theory]
    [InlineData(0, 0)]
    [InlineData(0.4, 0)]
    [InlineData(0.4, 0.05)]
    [InlineData(2, 0)]
    public void Solve_DrawnProblems_KeepsTheLawOfEachContact(double friction, double lever)
    {
        for (int seed = 0; seed < 40; seed++)
        {
            ContactProblem problem = Draw(seed, friction, lever);
            ContactSolver.ApplyGiven(problem);
            ContactSolver.Solve(problem, Tolerance, Most);
            Assert.True(Worst(problem) < 100 * Tolerance, $"seed {seed}: {Worst(problem)}");
        }
    }

    /// <summary>The control: after two sweeps it is not solved, and that is seen.</summary>
    [Fact]
    public void Solve_TwoSweeps_AreSeenNotToBeEnough()
    {
        ContactProblem problem = Draw(1, 0.4, 0);
        ContactSolver.Solve(problem, Tolerance, 2);
        Assert.True(Worst(problem) > 1000 * Tolerance, $"{Worst(problem)}");
    }

    [Fact]
    public void Solve_TwoFreeBalls_KeepTheirMomentum()
    {
        ContactProblem problem = new();
        problem.AddBody(2, 0.1, new Vector3D(1, 0.3, 0), Vector3D.Zero);
        problem.AddBody(3, 0.1, new Vector3D(-1, 0, 0.2), Vector3D.Zero);
        problem.AddContact(0, 1, -1, new Vector3D(-1, 0, 0), 0, 0.5, 0);
        Vector3D before = (problem.Bodies[0].Velocity * 2) + (problem.Bodies[1].Velocity * 3);
        ContactSolver.Solve(problem, Tolerance, Most);
        Assert.True(((problem.Bodies[0].Velocity * 2) + (problem.Bodies[1].Velocity * 3) - before).Length < 1e-14);
        Assert.Equal(0, ContactSolver.Opening(problem, problem.Contacts[0]), Tolerance);
    }

    /// <summary>What it is given from the step before is where it begins; what comes of it is the same.</summary>
    [Fact]
    public void Solve_FromTheImpulsesOfBefore_TakesFewerSweeps()
    {
        ContactProblem cold = Draw(3, 0.4, 0), warm = Draw(3, 0.4, 0);
        int sweeps = ContactSolver.Solve(cold, Tolerance, Most);
        for (int i = 0; i < warm.ContactCount; i++)
        {
            (warm.Contacts[i].Impulse, warm.Contacts[i].FrictionImpulse) = (cold.Contacts[i].Impulse, cold.Contacts[i].FrictionImpulse);
        }

        ContactSolver.ApplyGiven(warm);
        Assert.InRange(ContactSolver.Solve(warm, Tolerance, Most), 1, (sweeps / 2) + 1);
        for (int b = 0; b < cold.BodyCount; b++)
        {
            Assert.True((cold.Bodies[b].Velocity - warm.Bodies[b].Velocity).Length < 100 * Tolerance);
        }
    }

    [Fact]
    public void Hand_AgainstAWall_GivesNoMoreThanWhatItPressesNeeds()
    {
        ContactProblem problem = new();
        problem.AddBody(2, 0.1, Vector3D.Zero, Vector3D.Zero);
        problem.AddBody(double.PositiveInfinity, 0.1, new Vector3D(-3, 0, 0), Vector3D.Zero);
        problem.AddContact(0, 1, -1, new Vector3D(-1, 0, 0), 0, 0, 0);
        problem.AddContact(0, ContactPoint.Static, 0, new Vector3D(1, 0, 0), 0, 0, 0);
        ContactSolver.LimitHands(problem, 0.1);
        ContactSolver.Solve(problem, Tolerance, Most);
        Assert.Equal(2 * 3.1, problem.Contacts[0].Impulse, Tolerance);
        Assert.True(problem.Bodies[0].Velocity.Length < Tolerance);
    }

    /// <summary>By how much at most a contact's law is broken, in m/s; also friction beyond its cone, and friction that does not stop a slip within it.</summary>
    private static double Worst(ContactProblem problem)
    {
        double worst = 0;
        for (int i = 0; i < problem.ContactCount; i++)
        {
            ref readonly SolverContact c = ref problem.Contacts[i];
            double over = ContactSolver.Opening(problem, c) - c.Target;
            worst = Math.Max(worst, -over);
            worst = Math.Max(worst, c.Impulse > 1e-6 ? Math.Abs(over) : 0);
            Assert.True(c.Impulse >= 0 && Math.Abs(Vector3D.Dot(c.FrictionImpulse, c.Normal)) < 1e-9);
            worst = Math.Max(worst, c.FrictionImpulse.Length - (c.Friction * c.Impulse));
            double slip = Slip(problem, c).Length;
            worst = Math.Max(worst, c.FrictionImpulse.Length < (c.Friction * c.Impulse) - 1e-6 ? slip : 0);
            Assert.True(c.Turn.Length <= (Math.Sqrt(2) * c.Lever * c.Impulse) + 1e-9);
        }

        return worst;
    }

    private static Vector3D Slip(ContactProblem problem, in SolverContact c)
    {
        ref readonly SolverBody a = ref problem.Bodies[c.First];
        Vector3D slip = a.Velocity - (Vector3D.Cross(a.Spin, c.Normal) * a.Radius);
        if (c.Second >= 0)
        {
            ref readonly SolverBody b = ref problem.Bodies[c.Second];
            slip -= b.Velocity + (Vector3D.Cross(b.Spin, c.Normal) * b.Radius);
        }

        return slip - (c.Normal * Vector3D.Dot(slip, c.Normal));
    }

    /// <summary>A floor, some balls on it, some on them.</summary>
    internal static ContactProblem Draw(int seed, double friction, double lever)
    {
        Random random = new(seed);
        ContactProblem problem = new();
        Vector3D Any(double size) => new(size * (random.NextDouble() - 0.5), size * (random.NextDouble() - 0.5), size * (random.NextDouble() - 0.5));
        for (int b = 0; b < 7; b++)
        {
            problem.AddBody(0.5 + random.NextDouble(), 0.1 + (0.1 * random.NextDouble()), Any(1) - new Vector3D(0, 0.5, 0), Any(3));
        }

        for (int b = 0; b < 4; b++)
        {
            problem.AddContact(b, ContactPoint.Static, 0, Vector3D.Up, 0, friction, lever);
        }

        for (int b = 4; b < 7; b++)
        {
            for (int below = 0; below < 3; below++)
            {
                Vector3D normal = new Vector3D(random.NextDouble() - 0.5, 1, random.NextDouble() - 0.5);
                ref SolverContact c = ref problem.AddContact((b + below) % 4, b, -1, normal / -normal.Length, 0, friction, lever);
                c.Target = 0.01 * (random.NextDouble() - 0.5);
            }
        }

        return problem;
    }
}
