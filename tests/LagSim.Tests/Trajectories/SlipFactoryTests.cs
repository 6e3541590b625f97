using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using LagSim.Trajectories;
using Xunit;
using static LagSim.Tests.LooseParts;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Trajectories;

/// <summary>A solid ball on a plane with friction, against the textbook: it slips, then rolls, then rests.</summary>
public sealed class SlipFactoryTests
{
    private const double Radius = 0.25;
    private const double Speed = 7;

    private static readonly Scene Floor =
        new SceneBuilder("floor").WithGravity(V(0, -Gravity)).AddPlane("floor", Vector3D.Up, V(0)).WithSmallestRadius(Radius).Build();

    private readonly TimelineStore timelines = new(default);

    /// <summary>A ball that does not turn slips for 2 v / (7 mu g), and then rolls with 5/7 of its speed.</summary>
    [Fact]
    public void Open_BallThatDoesNotTurn_SlipsUntilItRollsWithFiveSeventhsOfItsSpeed()
    {
        const double Mu = 0.4;
        MotionSegment slip = Open(Mu, 0, V(Speed), V(0), V(0));
        Assert.Equal(MotionLaw.Sliding, slip.Law);
        Near((0.1 * Speed) - (0.5 * Mu * Gravity * 0.01), slip.PositionAt(0.1, default).X, 1e-14);
        Near(Speed - (Mu * Gravity * 0.1), slip.VelocityAt(0.1, default).X, 1e-14);
        double end = slip.End.SecondsSince(slip.Epoch);
        Near(2 * Speed / (7 * Mu * Gravity), end, 1e-12);
        Near(5.0 / 7 * Speed, slip.VelocityAt(end, default).X, 1e-11);
        Near(V(0, 0, -5.0 / 7 * Speed / Radius), timelines.SpinOf(timelines.Last(0)).At(end), 1e-10);
    }

    [Fact]
    public void Open_WithoutFriction_SlipsOnForEver()
    {
        MotionSegment slip = Open(0, 0, V(Speed), V(0), V(0));
        Assert.Equal(SimTime.MaxValue, slip.End);
        Assert.Equal(V(Speed), slip.VelocityAt(100, default));
        Assert.Equal(V(0), timelines.SpinOf(timelines.Last(0)).At(100));
    }

    /// <summary>One that turns as it moves rolls. Resistance c takes 5/7 c g from it; without any it rolls on for ever.</summary>
    [Theory]
    [InlineData(0.02)]
    [InlineData(0)]
    public void Open_BallThatTurnsAsItMoves_RollsUntilResistanceHasStoppedIt(double resistance)
    {
        MotionSegment roll = Open(0.4, resistance, V(Speed), V(0, 0, -Speed / Radius), V(0));
        Assert.Equal(MotionLaw.Rolling, roll.Law);
        Near(-5.0 / 7 * resistance * Gravity, roll.Acceleration.X, 1e-15);
        if (resistance > 0)
        {
            Near(Speed / (5.0 / 7 * resistance * Gravity), roll.End.SecondsSince(roll.Epoch), 1e-11);
        }
        else
        {
            Assert.Equal(SimTime.MaxValue, roll.End);
        }
    }

    /// <summary>On a slope a ball stays where resistance holds the pull, and else rolls down with 5/7 of what is left.</summary>
    [Theory]
    [InlineData(0.99, MotionLaw.Resting)]
    [InlineData(1.01, MotionLaw.Rolling)]
    public void Open_BallThatStandsAndIsPulled_RestsWhereResistanceHoldsIt(double pulled, MotionLaw law)
    {
        const double Resistance = 0.1;
        MotionSegment path = Open(0.5, Resistance, V(0), V(0), V(pulled * Resistance * Gravity));
        Assert.Equal(law, path.Law);
        Near(law == MotionLaw.Resting ? 0 : 5.0 / 7 * (pulled - 1) * Resistance * Gravity, path.Acceleration.X, 1e-15);
    }

    private MotionSegment Open(double friction, double resistance, Vector3D velocity, Vector3D spin, Vector3D pull)
    {
        BodyTable bodies = new(1);
        BodySpec spec = new(Radius, 1, 0.5, MotionLaw.Ballistic, friction: friction, rollingResistance: resistance);
        timelines.AddSlot(bodies.Add(First, spec));
        SlipFactory factory = new(Floor, bodies, timelines, new StateLimits(Floor));
        factory.Open(0, Key(0, EventKind.Impact), V(0, Radius), velocity, spin, new SupportSet(1, 0, 0, 0), pull, default);
        return timelines.Segment(timelines.Last(0));
    }
}
