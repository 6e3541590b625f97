using System;
using LagSim.Contacts;
using LagSim.Scenes;
using Xunit;

namespace LagSim.Tests.Contacts;

/// <summary>One step of an island: which contacts it has, and that a gap may be used up and no more.</summary>
public sealed class ContactStepTests
{
    private const double Tolerance = 1e-3;
    private static readonly Vector3D Down = new(0, -9.81, 0);

    [Theory]
    [InlineData(0)]
    [InlineData(2e-4)]
    public void Gap_IsUsedUpAndNoMore(double gap)
    {
        ContactStep step = On(new BodySpec(0.1, 1, 0.2), gap, new Vector3D(0, -0.2, 0));
        double seconds = Solve(step);
        Assert.Equal(0, gap + (step.Problem.Bodies[0].Velocity.Y * seconds), 1e-9);
        Assert.True(step.Problem.Contacts[0].Holds);
    }

    [Fact]
    public void Overlap_IsPushedOutNoFasterThanAFallOfAStep()
    {
        ContactStep step = On(new BodySpec(0.1, 1, 0.2), -0.05, Vector3D.Zero);
        double seconds = Solve(step);
        Assert.Equal(9.81 * seconds, step.Problem.Bodies[0].Velocity.Y, 1e-9);
    }

    /// <summary>Rule 6: bodies that nothing drives are pushed apart as fast as the pull would, though they bring no energy.</summary>
    [Fact]
    public void Overlap_WhereNothingFalls_IsPushedOutToo()
    {
        ContactStep step = new(Floor(0.2), new ContactScale(Tolerance, Down, default));
        step.AddBody(new BodySpec(0.1, 1, 0.2), new Vector3D(0, 5, 0), Vector3D.Zero, Vector3D.Zero, Vector3D.Zero, isHeld: false);
        step.AddBody(new BodySpec(0.1, 1, 0.2), new Vector3D(0.15, 5, 0), Vector3D.Zero, Vector3D.Zero, Vector3D.Zero, isHeld: false);
        double seconds = Solve(step);
        Assert.Equal(9.81 * seconds, step.Problem.Bodies[1].Velocity.X - step.Problem.Bodies[0].Velocity.X, 1e-9);
    }

    /// <summary>
    /// Rule 9: what held before holds on while it opens by less than a quarter of the tolerance; what did not hold does not.
    /// </summary>
    [Theory]
    [InlineData(true, 0.24, true)]
    [InlineData(true, 0.26, false)]
    [InlineData(false, 0.24, false)]
    public void WhatOpensByLessThanAQuarterOfTheTolerance_HoldsOnIfItHeld(bool held, double part, bool holds)
    {
        double seconds = new ContactScale(Tolerance, Down, default).Step.ToSeconds();
        ContactStep step = On(new BodySpec(0.1, 1, 0.2), 0, new Vector3D(0, part * Tolerance / seconds, 0));
        step.FindContacts(seconds);
        step.Problem.Contacts[0].Held = held;
        step.Solve(seconds, 1e-12);
        step.FindHolding(seconds);
        Assert.Equal(holds, step.Problem.Contacts[0].Holds);
    }

    [Fact]
    public void WhatClosesFast_IsLeftToImpacts()
    {
        Assert.Equal(1, Contacts(new BodySpec(0.1, 1, 0.5), 1e-4, -0.2));
        Assert.Equal(0, Contacts(new BodySpec(0.1, 1, 0.5), 1e-4, -2)); // its rebound would rise by more than the tolerance
        Assert.Equal(1, Contacts(new BodySpec(0.1, 1, 0), 1e-4, -2)); // it has none
        Assert.Equal(0, Contacts(new BodySpec(0.1, 1, 0.5), 0.01, -0.2)); // it does not get there
    }

    /// <summary>
    /// Rule 5: at a coarse tolerance the longest step decides what is a contact of it, and not the tolerance, which would take in all that
    /// is near.
    /// </summary>
    [Fact]
    public void WhatNothingCanClose_IsNoContactAtACoarseTolerance()
    {
        double margin = new ContactScale(0.1, Down, default).SpeculativeMargin;
        Assert.Equal(1, Contacts(new BodySpec(0.1, 1, 0.5), 0.99 * margin, 0, 0.1));
        Assert.Equal(0, Contacts(new BodySpec(0.1, 1, 0.5), 1.01 * margin, 0, 0.1));
        Assert.InRange(margin, 0, 0.005);
    }

    [Theory]
    [InlineData(false, 0)]
    [InlineData(true, 1)]
    public void Elastic_IsOfAStepOnlyIfItHeld(bool held, int expected)
    {
        ContactStep step = On(new BodySpec(0.1, 1, 1), 0, new Vector3D(0, -0.1, 0));
        step.FindContacts(step.Scale.Step.ToSeconds());
        Assert.Equal(1, step.Problem.ContactCount);
        step.Problem.Contacts[0].Held = held;
        step.DropElastic();
        Assert.Equal(expected, step.Problem.ContactCount);
    }

    [Fact]
    public void Pairs_AreThoseThatAreNear_InOrder()
    {
        Random random = new(5);
        Scene scene = Floor(1);
        ContactStep step = new(scene, new ContactScale(Tolerance, Down, default));
        Vector3D[] places = new Vector3D[60];
        for (int i = 0; i < places.Length; i++)
        {
            places[i] = new Vector3D(random.NextDouble(), 1 + random.NextDouble(), random.NextDouble());
            step.AddBody(new BodySpec(0.1, 1, 0.2), places[i], Vector3D.Zero, Vector3D.Zero, Vector3D.Zero, isHeld: false);
        }

        step.FindContacts(step.Scale.Step.ToSeconds());
        int n = 0;
        for (int i = 0; i < places.Length; i++)
        {
            for (int j = i + 1; j < places.Length; j++)
            {
                if ((places[i] - places[j]).Length - 0.2 <= Tolerance)
                {
                    Assert.Equal((i, j), (step.Problem.Contacts[n].First, step.Problem.Contacts[n].Second));
                    n++;
                }
            }
        }

        Assert.True(n > 20);
        Assert.Equal(n, step.Problem.ContactCount);
    }

    private static int Contacts(BodySpec spec, double gap, double speed, double tolerance = Tolerance)
    {
        ContactStep step = On(spec, gap, new Vector3D(0, speed, 0), tolerance);
        step.FindContacts(step.Scale.Step.ToSeconds());
        return step.Problem.ContactCount;
    }

    private static double Solve(ContactStep step)
    {
        double seconds = step.Scale.Step.ToSeconds();
        step.FindContacts(seconds);
        step.Solve(seconds, 1e-12);
        step.FindHolding(seconds);
        return seconds;
    }

    private static ContactStep On(BodySpec spec, double gap, Vector3D velocity, double tolerance = Tolerance)
    {
        ContactStep step = new(Floor(spec.Restitution), new ContactScale(tolerance, Down, default));
        step.AddBody(spec, new Vector3D(0, spec.Radius + gap, 0), velocity, Vector3D.Zero, Vector3D.Zero, isHeld: false);
        return step;
    }

    private static Scene Floor(double restitution) =>
        new SceneBuilder("floor").WithSmallestRadius(0.1).WithContactTolerance(Tolerance).AddPlane("floor", Vector3D.Up, Vector3D.Zero, restitution).Build();
}
