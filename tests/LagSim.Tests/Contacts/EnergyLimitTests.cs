using LagSim.Contacts;
using LagSim.Scenes;
using Xunit;

namespace LagSim.Tests.Contacts;

/// <summary>How far a problem goes from one solution towards another: spin counts, and impulses go along.</summary>
public sealed class EnergyLimitTests
{
    private static readonly Vector3D Fast = new(4, 0, 0), Spin = new(0, 30, 0);

    /// <summary>As far as there is energy for; all the way if there is enough, and back to where it costs least if there is none.</summary>
    [Theory]
    [InlineData(2, 8, 8)]
    [InlineData(2, 1000, 0)]
    [InlineData(-1, 0.1, 0)]
    public void GoTowards_AnotherSolution_StopsAtTheBound(double from, double most, double expected)
    {
        ContactProblem problem = Solution(new Vector3D(from, 0, 0), Vector3D.Zero, 1);
        ContactProblem other = Solution(Fast, Spin, 3);
        EnergyLimit limit = new();
        limit.Remember(other);
        double before = problem.KineticEnergy();
        limit.GoTowards(problem, most);
        double part = (problem.Contacts[0].Impulse - 1) / 2;
        Assert.Equal(from + ((4 - from) * part), problem.Bodies[0].Velocity.X, 1e-12);
        Assert.Equal(30 * part, problem.Bodies[0].Spin.Y, 1e-12);
        if (most > 100)
        {
            Assert.Equal(other.KineticEnergy(), problem.KineticEnergy(), 1e-9);
        }
        else if (expected > 0)
        {
            Assert.Equal(expected, problem.KineticEnergy(), 1e-9);
        }
        else
        {
            Assert.True(problem.KineticEnergy() < before && part < 1); // it has too much, and gets as little as there is on the way
        }
    }

    /// <summary>The control: a solution that has more than it may, and would only get more, stays.</summary>
    [Fact]
    public void GoTowards_WhereNothingIsLeft_StaysWhereItIs()
    {
        ContactProblem problem = Solution(new Vector3D(2, 0, 0), Vector3D.Zero, 1);
        EnergyLimit limit = new();
        limit.Remember(Solution(Fast, Spin, 3));
        limit.GoTowards(problem, 1);
        Assert.Equal((2, 1), (problem.Bodies[0].Velocity.X, problem.Contacts[0].Impulse));
    }

    private static ContactProblem Solution(Vector3D velocity, Vector3D spin, double impulse)
    {
        ContactProblem problem = new();
        problem.AddBody(2, 0.1, velocity, spin);
        problem.AddContact(0, ContactPoint.Static, 0, Vector3D.Up, 0, 0, 0).Impulse = impulse;
        return problem;
    }
}
