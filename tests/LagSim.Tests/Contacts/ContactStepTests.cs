using System;
using LagSim.Contacts;
using LagSim.Scenes;
using LagSim.Tests.Faults;
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

    /// <summary>Rule 6: what is deeper than the tolerance is pushed out faster by the speed of a fall by what is deeper.</summary>
    [Theory]
    [InlineData(0.9 * Tolerance)]
    [InlineData(0.05)]
    public void Overlap_IsPushedOutNoFasterThanAFall(double depth)
    {
        ContactStep step = On(new BodySpec(0.1, 1, 0.2), -depth, Vector3D.Zero);
        double seconds = Solve(step);
        Assert.Equal(PushSpeed(depth, seconds), step.Problem.Bodies[0].Velocity.Y, 1e-9);
    }

    /// <summary>
    /// Rule 6: two that are deep in each other and part faster than they are pushed apart are slowed down by what the pull gives in two
    /// steps
    /// at most, and not further than that. The control: shallow overlap is not held back.
    /// </summary>
    [Theory]
    [InlineData(0.05, 0.1)]
    [InlineData(0.05, 5)]
    [InlineData(0.9 * Tolerance, 5)]
    public void Overlap_ThatEndsBySpeed_IsHeldBackALittle(double depth, double faster)
    {
        ContactStep step = new(Floor(0.2), new ContactScale(Tolerance, Down, default));
        double seconds = step.Scale.Step.ToSeconds(), speed = PushSpeed(depth, seconds);
        step.AddBody(new BodySpec(0.1, 1, 0.2), new Vector3D(0, 5, 0), Vector3D.Zero, Vector3D.Zero, Vector3D.Zero, isHeld: false);
        Vector3D place = new(0.2 - depth, 5, 0), velocity = new(speed + faster, 0, 0);
        step.AddBody(new BodySpec(0.1, 3, 0.2), place, velocity, Vector3D.Zero, Vector3D.Zero, isHeld: false);
        Solve(step);
        double slowed = depth > Tolerance ? Math.Min(faster, 2 * 9.81 * seconds) : 0;
        Assert.Equal(speed + faster - slowed, step.Problem.Bodies[1].Velocity.X - step.Problem.Bodies[0].Velocity.X, 1e-9);
        Assert.Equal(3 * (speed + faster), step.Problem.Bodies[0].Velocity.X + (3 * step.Problem.Bodies[1].Velocity.X), 1e-9);
    }

    private static double PushSpeed(double depth, double seconds) =>
        (9.81 * seconds) + Math.Sqrt(2 * 9.81 * Math.Max(0, depth - Tolerance));

    /// <summary>Rule 6: bodies that nothing drives are pushed apart as fast as the pull would, though they bring no energy.</summary>
    [Fact]
    public void Overlap_WhereNothingFalls_IsPushedOutToo()
    {
        ContactStep step = new(Floor(0.2), new ContactScale(Tolerance, Down, default));
        step.AddBody(new BodySpec(0.1, 1, 0.2), new Vector3D(0, 5, 0), Vector3D.Zero, Vector3D.Zero, Vector3D.Zero, isHeld: false);
        step.AddBody(new BodySpec(0.1, 1, 0.2), new Vector3D(0.15, 5, 0), Vector3D.Zero, Vector3D.Zero, Vector3D.Zero, isHeld: false);
        double seconds = Solve(step);
        step.LimitEnergy(seconds, 1e-12);
        Assert.Equal(PushSpeed(0.05, seconds), step.Problem.Bodies[1].Velocity.X - step.Problem.Bodies[0].Velocity.X, 1e-9);
    }

    /// <summary>
    /// Rule 6: what pushes overlap out adds up along a stack, and would throw its top into the air. It gets all the energy that it may
    /// have, and no more, whether the stack rests or slides along. The control: without a bound it would have more.
    /// </summary>
    [Theory]
    [InlineData(0)]
    [InlineData(5)]
    public void OverlapOfAStack_IsPushedOutAsFastAsEnergyAllows(double slides)
    {
        ContactStep step = Stack(slides, heldAt: -1);
        double seconds = step.Scale.Step.ToSeconds();
        double fall = Balls * 0.5 * 9.81 * seconds * 9.81 * seconds;
        double most = (Balls * 0.5 * slides * slides) + fall;
        Assert.True(step.Problem.KineticEnergy() > most + fall);
        step.LimitEnergy(seconds, 1e-12);
        Assert.InRange(step.Problem.KineticEnergy(), most * (1 - 1e-9), most * (1 + 1e-9));
        for (int i = 0; i < step.Problem.ContactCount; i++)
        {
            double opening = ContactSolver.Opening(step.Problem, step.Problem.Contacts[i]);
            Assert.InRange(opening, 0.1 * 9.81 * seconds, 9.81 * seconds);
        }
    }

    /// <summary>Rules 6 and 11: a hand at rest does no work, so its island is bounded too; not where a control takes the bound away.</summary>
    [Fact]
    public void OverlapOfAStack_InAHand_IsPushedOutAsFastAsEnergyAllows()
    {
        ContactStep step = Stack(0, heldAt: Balls - 1);
        double seconds = step.Scale.Step.ToSeconds();
        double most = 2 * (Balls - 1) * 0.5 * 9.81 * seconds * 9.81 * seconds; // what they came with by a step of gravity, and what rule 6 allows
        Assert.True(step.Problem.KineticEnergy() > most);
        step.LimitEnergy(seconds, 1e-12);
        Assert.InRange(step.Problem.KineticEnergy(), most * (1 - 1e-9), most * (1 + 1e-9));
    }

    [Theory]
    [InlineData(Balls - 1, false)]
    [InlineData(-1, true)]
    public void OverlapOfAStack_WithoutTheBound_IsPushedOutAtOnce(int heldAt, bool gains)
    {
        ContactStep step = Stack(0, heldAt, new FaultySolverRules { GainsEnergy = gains, HasUnboundedHands = heldAt >= 0 });
        double seconds = step.Scale.Step.ToSeconds();
        double before = step.Problem.KineticEnergy();
        Assert.True(before > Balls * 0.5 * 9.81 * seconds * 9.81 * seconds);
        step.LimitEnergy(seconds, 1e-12);
        Assert.Equal(before, step.Problem.KineticEnergy());
    }

    /// <summary>
    /// Rule 6: what overlaps two walls at once cannot be pushed out of both, and then nothing of its row is; many or few. The control is
    /// one that overlaps only one of them.
    /// </summary>
    [Theory]
    [InlineData(20, true)]
    [InlineData(20, false)]
    [InlineData(150, true)]
    [InlineData(150, false)]
    public void Row_JammedBetweenTwoWalls_StaysWhereItIs(int balls, bool isJammed)
    {
        double east = (0.2 * balls) - (0.5 * Tolerance * (balls + 1));
        Scene walls = new SceneBuilder("walls").WithSmallestRadius(0.1).WithContactTolerance(Tolerance)
            .AddPlane("west", new Vector3D(1, 0, 0), Vector3D.Zero, 0)
            .AddPlane("east", new Vector3D(-1, 0, 0), new Vector3D(isJammed ? east : east + 1, 0, 0), 0).Build();
        ContactStep step = new(walls, new ContactScale(Tolerance, Down, default));
        for (int n = 0; n < balls; n++)
        {
            Vector3D place = new(0.1 - (0.5 * Tolerance) + (n * (0.2 - (0.5 * Tolerance))), 0, 0);
            step.AddBody(new BodySpec(0.1, 1, 0), place, Vector3D.Zero, Vector3D.Zero, Vector3D.Zero, isHeld: false);
        }

        double seconds = step.Scale.Step.ToSeconds();
        step.FindContacts(seconds);
        step.Solve(seconds, 1e-9);
        step.LimitEnergy(seconds, 1e-9);
        double fastest = 0;
        for (int b = 0; b < balls; b++)
        {
            fastest = Math.Max(fastest, Math.Abs(step.Problem.Bodies[b].Velocity.X));
        }

        double largest = 0;
        for (int i = 0; i < step.Problem.ContactCount; i++)
        {
            largest = Math.Max(largest, step.Problem.Contacts[i].Impulse);
        }

        Assert.Equal(isJammed, fastest < 1e-6);
        Assert.InRange(largest, 0, 2 * balls * 9.81 * seconds); // and no impulse without end
    }

    private const int Balls = 10;

    /// <summary>A step, solved, of balls on each other and on a floor; each is in the next by half the tolerance.</summary>
    private static ContactStep Stack(double slides, int heldAt, SolverRules? rules = null)
    {
        ContactStep step = new(Floor(0.2), new ContactScale(Tolerance, Down, default), rules);
        double seconds = step.Scale.Step.ToSeconds();
        for (int n = 0; n < Balls; n++)
        {
            bool isHeld = n == heldAt;
            Vector3D place = new(0, 0.1 + (n * 0.2) - ((n + 1) * 0.5 * Tolerance), 0);
            Vector3D gain = isHeld ? Vector3D.Zero : Down * seconds;
            step.AddBody(new BodySpec(0.1, 1, 0.2), place, new Vector3D(slides, 0, 0), gain, Vector3D.Zero, isHeld);
        }

        step.FindContacts(seconds);
        step.Solve(seconds, 1e-12);
        return step;
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
        step.DropImpacts(step.Scale.Step.ToSeconds());
        Assert.Equal(expected, step.Problem.ContactCount);
    }

    /// <summary>
    /// Rule 5: what goes so fast past something round that its surface curves away by more than the tolerance within the step is no contact of
    /// it, unless it held or touches; past a plane it is.
    /// </summary>
    [Theory]
    [InlineData(0.99, 1e-4, false, 1)]
    [InlineData(1.01, 1e-4, false, 0)]
    [InlineData(1.01, 1e-4, true, 1)]
    [InlineData(1.01, -1e-6, false, 1)]
    public void WhatCurvesAwayWithinTheStep_IsLeftToImpacts(double part, double gap, bool held, int expected)
    {
        ContactStep step = new(Floor(0), new ContactScale(Tolerance, Down, default));
        double seconds = step.Scale.Step.ToSeconds();
        double speed = part * Math.Sqrt(2 * 0.2 * Tolerance) / seconds;
        BodySpec ball = new(0.1, 1, 0);
        step.AddBody(ball, new Vector3D(0, 5, 0), Vector3D.Zero, Vector3D.Zero, Vector3D.Zero, isHeld: false);
        step.AddBody(ball, new Vector3D(0, 5.2 + gap, 0), new Vector3D(speed, 0, 0), Vector3D.Zero, Vector3D.Zero, isHeld: false);
        step.FindContacts(seconds);
        Assert.Equal(1, step.Problem.ContactCount);
        step.Problem.Contacts[0].Held = held;
        step.DropImpacts(seconds);
        Assert.Equal(expected, step.Problem.ContactCount);
    }

    [Fact]
    public void FastOnAPlane_IsAContact()
    {
        ContactStep step = On(new BodySpec(0.1, 1, 0), 1e-4, new Vector3D(50, 0, 0));
        step.FindContacts(step.Scale.Step.ToSeconds());
        step.DropImpacts(step.Scale.Step.ToSeconds());
        Assert.Equal(1, step.Problem.ContactCount);
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
