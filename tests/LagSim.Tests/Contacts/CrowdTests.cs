using System;
using LagSim.Contacts;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using Xunit;

namespace LagSim.Tests.Contacts;

/// <summary>Bodies put into one place: what a step of them costs grows with their number, not with that of their pairs.</summary>
public sealed class CrowdTests
{
    private const double Tolerance = 1e-3; // in m/s
    private const int Most = 7; // contacts a body keeps
    private static readonly Vector3D Down = new(0, -9.81, 0);

    [Theory]
    [InlineData(32, 0)]
    [InlineData(32, 0.1)]
    [InlineData(128, 0)]
    [InlineData(128, 0.1)]
    public void Contacts_OfBodiesInOnePlace_AreAsManyAsOfAHeapAndThenAllHold(int bodies, double spread)
    {
        ContactStep step = Solved(bodies, spread, SolverRules.Usual);
        Assert.InRange(step.Problem.ContactCount, bodies - 1, Most * bodies);
        double seconds = step.Scale.Step.ToSeconds();
        step.LimitEnergy(seconds, Tolerance);
        step.FindHolding(seconds);
        Assert.Equal(bodies * (bodies - 1) / 2, step.Problem.ContactCount);
        for (int i = 1; i < step.Problem.ContactCount; i++)
        {
            ref readonly SolverContact before = ref step.Problem.Contacts[i - 1];
            ref readonly SolverContact c = ref step.Problem.Contacts[i];
            Assert.True(before.First < c.First || (before.First == c.First && before.Second < c.Second));
            Assert.True(c.Holds || ContactSolver.Opening(step.Problem, c) > -Tolerance); // what neither pushes nor was left out does not close
        }
    }

    /// <summary>The control: without the limit all pairs are solved.</summary>
    [Fact]
    public void Contacts_OfACrowdWithoutTheLimit_AreSeenToBeAllPairs() =>
        Assert.Equal(128 * 127 / 2, Solved(128, 0.1, new FaultySolverRules { SolvesCrowds = true }).Problem.ContactCount);

    /// <summary>What lies side by side is solved as ever: no contact of a close packing is left out, and it has six a ball at most.</summary>
    [Fact]
    public void Contacts_OfAClosePacking_AreAllSolved()
    {
        ContactStep step = new(Scene(), new ContactScale(1e-3, Down, default));
        ContactStep all = new(Scene(), new ContactScale(1e-3, Down, default), new FaultySolverRules { SolvesCrowds = true });
        for (int n = 0; n < 512; n++)
        {
            int x = n % 8, y = n / 8 % 8, z = n / 64;
            if ((x + y + z) % 2 == 0)
            {
                Add(step, new Vector3D(x, y, z) * (0.1998 / Math.Sqrt(2)));
                Add(all, new Vector3D(x, y, z) * (0.1998 / Math.Sqrt(2)));
            }
        }

        Solve(step);
        Solve(all);
        Assert.True(step.Problem.ContactCount > 4 * step.Problem.BodyCount);
        Assert.Equal(all.Problem.ContactCount, step.Problem.ContactCount);
        for (int b = 0; b < step.Problem.BodyCount; b++)
        {
            Assert.Equal(all.Problem.Bodies[b].Velocity, step.Problem.Bodies[b].Velocity);
        }
    }

    private static ContactStep Solved(int bodies, double spread, SolverRules rules)
    {
        ContactStep step = new(Scene(), new ContactScale(1e-3, Down, default), rules);
        Random random = new(1);
        for (int n = 0; n < bodies; n++)
        {
            Add(step, new Vector3D(random.NextDouble() - 0.5, 5 + random.NextDouble(), random.NextDouble() - 0.5) * spread);
        }

        Solve(step);
        return step;
    }

    private static void Add(ContactStep step, Vector3D place) =>
        step.AddBody(new BodySpec(0.1, 1, 0.2), place, Vector3D.Zero, Vector3D.Zero, Vector3D.Zero, isHeld: false);

    private static void Solve(ContactStep step)
    {
        double seconds = step.Scale.Step.ToSeconds();
        step.FindContacts(seconds);
        step.Solve(seconds, Tolerance);
    }

    private static Scene Scene() => new SceneBuilder("empty").WithSmallestRadius(0.1).WithContactTolerance(1e-3).Build();
}
