using System;
using LagSim.Collisions;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.LooseParts;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Collisions;

/// <summary>When segments made by hand next touch, against closed forms. All balls have a radius of half a metre.</summary>
public sealed class CollisionPredictorTests
{
    private const double Tick = 1e-12; // and a little more

    private static readonly Scene Floor = new SceneBuilder("floor").AddPlane("floor", Vector3D.Up, V(0)).WithSmallestRadius(0.5).Build();
    private static readonly SupportSet OnTheFloor = new(1, 0, 0, 0);

    private readonly BodyTable bodies = new(2);
    private readonly TimelineStore timelines = new(default);
    private readonly CollisionPredictor predictor;

    public CollisionPredictorTests()
    {
        predictor = Predictor(Floor, bodies, timelines);
    }

    [Theory]
    [InlineData(10, -1)]
    [InlineData(5, 0)]
    [InlineData(1.5, 1.75)]
    public void TryTouchBody_TwoOnALine_TouchWhenTheGapIsUsedUp(double distance, double velocity)
    {
        Add(Flight(0, V(0, 9), V(2)));
        Add(Flight(0, V(distance, 9), V(velocity)));
        Assert.True(predictor.TryTouchBody(0, 1, timelines.Last(1), out ContactTime contact, out _));
        Near((distance - 1) / (2 - velocity), Seconds(contact), Tick);
    }

    [Theory]
    [InlineData(2.0)] // as fast as the other
    [InlineData(3.0)] // faster
    public void TryTouchBody_TwoThatDoNotClose_NeverTouch(double velocity)
    {
        Add(Flight(0, V(0, 9), V(2)));
        Add(Flight(0, V(5, 9), V(velocity)));
        Assert.False(predictor.TryTouchBody(0, 1, timelines.Last(1), out _, out _));
    }

    /// <summary>Past each other at a distance less than both radii they touch; at more they miss.</summary>
    [Theory]
    [InlineData(0.6, true)]
    [InlineData(1.1, false)]
    public void TryTouchBody_TwoThatPassAtADistance_TouchIfThatIsLessThanBothRadii(double aside, bool touches)
    {
        Add(Flight(0, V(0, 9), V(2)));
        Add(Flight(0, V(5, 9, aside), V(0)));
        Assert.Equal(touches, predictor.TryTouchBody(0, 1, timelines.Last(1), out ContactTime contact, out _));
        if (touches)
        {
            Near((5 - Math.Sqrt(1 - (aside * aside))) / 2, Seconds(contact), Tick);
        }
    }

    [Fact]
    public void TryTouchBody_OneFallsOnOneAtRest_TouchesAfterTheTimeOfTheFall()
    {
        Add(Flight(0, V(0, 5.5), V(0), V(0, -Gravity)));
        Add(MotionSegment.AtRest(default, V(0, 0.5), OnTheFloor));
        Assert.True(predictor.TryTouchBody(0, 1, timelines.Last(1), out ContactTime contact, out _));
        Near(Math.Sqrt(2 * 4 / Gravity), Seconds(contact), Tick);
    }

    /// <summary>A segment says nothing about the time after its end.</summary>
    [Theory]
    [InlineData(2.25, true)]
    [InlineData(1.75, false)]
    public void TryTouchBody_SegmentThatEnds_TouchesNothingAfterItsEnd(double end, bool touches)
    {
        Add(Flight(0, V(0, 9), V(2)));
        Add(new MotionSegment(MotionLaw.Sliding, default, At(end), V(5, 9), V(0), default));
        Assert.Equal(touches, predictor.TryTouchBody(0, 1, timelines.Last(1), out _, out _)); // at two seconds
    }

    /// <summary>What an event causes at its own tick comes a round after it; what comes later is no effect of it in that sense.</summary>
    [Theory]
    [InlineData(1.0, 3u, 1.0, 4u)]
    [InlineData(1.0, 0u, 1.0, 1u)]
    [InlineData(0.5, 3u, 1.5, 0u)]
    public void TryTouchBody_OpenedByAnEventOfSomeRound_TouchesARoundLaterIfAtOnce(double place, uint round, double seconds, uint expected)
    {
        AddBody(bodies, timelines, Ball(), Key(1, EventKind.Impact, 0, round), Flight(1, V(place, 9), V(1)));
        Add(Flight(0, V(2, 9), V(0)));
        Assert.True(predictor.TryTouchBody(0, 1, timelines.Last(1), out ContactTime contact, out uint found));
        Near(seconds, Seconds(contact), Tick);
        Assert.Equal(expected, found);
    }

    [Theory]
    [InlineData(0)]
    [InlineData(3)]
    [InlineData(-3)]
    public void TryTouchSurface_BallThrownAboveTheFloor_TouchesAtTheRootOfTheParabola(double up)
    {
        Add(Flight(0, V(0, 2.5), V(1, up), V(0, -Gravity)));
        Assert.True(predictor.TryTouchSurface(0, 0, out ContactTime contact, out uint round));
        Near((up + Math.Sqrt((up * up) + (2 * Gravity * 2))) / Gravity, Seconds(contact), Tick);
        Assert.Equal(0u, round);
    }

    [Fact]
    public void TryTouchSurface_BallThatRisesAndDoesNotFall_NeverTouches()
    {
        Add(Flight(0, V(0, 2.5), V(1, 3)));
        Assert.False(predictor.TryTouchSurface(0, 0, out _, out _));
    }

    /// <summary>A plane that carries a body is no obstacle to it; to a body that is not carried it is one, on the very same path.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void TryTouchSurface_PlaneThatCarriesTheBody_IsNotTouched(bool isCarried)
    {
        Add(new MotionSegment(MotionLaw.Sliding, default, SimTime.MaxValue, V(0, 1), V(1, -1), default, isCarried ? OnTheFloor : default));
        Assert.Equal(!isCarried, predictor.TryTouchSurface(0, 0, out _, out _));
    }

    /// <summary>
    /// What is as deep as it may get is struck in the instant in which its path was opened. If that lies before the edge of the history it
    /// was not struck then, or it would be on another path: how often it was struck before, nobody knows any more.
    /// </summary>
    [Theory]
    [InlineData(0, true)]
    [InlineData(1, false)]
    public void TryTouchSurface_OpenedBeforeTheEdgeOfTheHistory_IsNotStruckInThatInstant(long later, bool isStruck)
    {
        EventKey opened = Key(1, EventKind.Impact, round: CollisionPredictor.CollapseRound + 1);
        AddBody(bodies, timelines, Ball(), opened, Flight(1, V(0, 0.5 - (2e-3 * Floor.RestitutionThreshold)), V(0, -1e-7)));
        timelines.ForgetBefore(At(1) + SimDuration.FromTicks(later));
        bool touches = predictor.TryTouchSurface(0, 0, out ContactTime contact, out _);
        Assert.Equal(isStruck, touches && contact.Tick == At(1));
    }

    private static double Seconds(in ContactTime contact) => contact.Tick.ToSeconds() + contact.Residual;

    private void Add(MotionSegment segment) => AddBody(bodies, timelines, Ball(), Key(0, EventKind.Start, bodies.Count), segment);
}
