using LagSim.Contacts;
using LagSim.Scenes;
using Xunit;

namespace LagSim.Tests.Contacts;

/// <summary>How far a problem goes from one solution towards another: spin counts, and impulses go along.</summary>
public sealed class EnergyLimitTests
{
    private static readonly Vector3D Slow = new(2, 0, 0), Fast = new(4, 0, 0), Spin = new(0, 30, 0);

    /// <summary>With 4 J on its way to 19.6 J it goes to what it may have, or all the way if it may have more.</summary>
    [Theory]
    [InlineData(8, 8)]
    [InlineData(1000, 19.6)]
    public void GoTowards_AnotherSolution_StopsAtTheBound(double most, double expected)
    {
        ContactProblem problem = Solution(Slow, Vector3D.Zero, 1);
        double part = Go(problem, most);
        Assert.Equal(expected, problem.KineticEnergy(), 1e-9);
        Assert.Equal(2 + (2 * part), problem.Bodies[0].Velocity.X, 1e-12);
        Assert.Equal(30 * part, problem.Bodies[0].Spin.Y, 1e-12);
    }

    /// <summary>A solution that has more than it may goes to where there is least on the way.</summary>
    [Fact]
    public void GoTowards_FromMoreThanItMayHave_GetsTheLeastOfTheWay()
    {
        ContactProblem problem = Solution(-Slow, Vector3D.Zero, 1);
        double part = Go(problem, 0.1);
        double least = problem.KineticEnergy();
        Assert.InRange(part, 0.01, 0.99);
        foreach (double other in new[] { part - 0.01, part + 0.01 })
        {
            ContactProblem near = Solution((-Slow) + ((Fast + Slow) * other), Spin * other, 1);
            Assert.True(near.KineticEnergy() > least);
        }
    }

    /// <summary>The control: a solution that has more than it may, and would only get more, stays.</summary>
    [Fact]
    public void GoTowards_WhereNothingIsLeft_StaysWhereItIs()
    {
        ContactProblem problem = Solution(Slow, Vector3D.Zero, 1);
        Assert.Equal(0, Go(problem, 1));
        Assert.Equal(2, problem.Bodies[0].Velocity.X);
    }

    /// <summary>Which part of the way it went, by the impulse, which goes from 1 to 3.</summary>
    private static double Go(ContactProblem problem, double most)
    {
        EnergyLimit limit = new();
        limit.Remember(Solution(Fast, Spin, 3));
        limit.GoTowards(problem, most);
        return (problem.Contacts[0].Impulse - 1) / 2;
    }

    private static ContactProblem Solution(Vector3D velocity, Vector3D spin, double impulse)
    {
        ContactProblem problem = new();
        problem.AddBody(2, 0.1, velocity, spin);
        problem.AddContact(0, ContactPoint.Static, 0, Vector3D.Up, 0, 0, 0).Impulse = impulse;
        return problem;
    }
}
