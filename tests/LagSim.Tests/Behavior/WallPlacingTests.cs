using System;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>What is put into static geometry: the filter that it has at that instant decides whether that stops it, and what stops it has it
/// outside.</summary>
public sealed class WallPlacingTests
{
    private static readonly CollisionFilter OfOwn = new(4, 2);
    private static readonly CollisionFilter Meets = new(2, 4);
    private static readonly CollisionFilter Ghost = new(2, 2);

    /// <summary>The floor is of a category of its own, the rock of the default.</summary>
    private static readonly Scene Hall = new SceneBuilder("hall").WithGravity(Floating).WithSmallestRadius(0.25)
        .AddPlane("floor", Vector3D.Up, 0, filter: OfOwn).AddStaticSphere("rock", V(9, 9), 1).AddBody("ball", Ball(), V(0, 5)).Build();

    /// <summary>Both a spawn and a teleport of a spawned body, whose filter the default one says nothing about.</summary>
    [Theory]
    [InlineData(WhenOccupied.Overlap, 0.2, 0.5)]
    [InlineData(WhenOccupied.Overlap, -3.0, 0.5)]
    [InlineData(WhenOccupied.Overlap, 0.5, 0.5)]
    [InlineData(WhenOccupied.Skip, -3.0, double.NaN)]
    [InlineData(WhenOccupied.Skip, 0.5, 0.5)]
    [InlineData(WhenOccupied.Beside, -3.0, 0.5)]
    [InlineData(WhenOccupied.Beside, -300.0, 0.5)]
    public void Place_InAFloorThatStopsTheBody_IsOutsideOfItOrNone(WhenOccupied occupied, double y, double expected)
    {
        ExternalEvent spawn = ExternalEvent.Spawn(At(1), 1, 1, Ball().With(Meets), V(1, y), whenOccupied: occupied);
        ExternalEvent elsewhere = ExternalEvent.Spawn(At(1), 1, 2, Ball().With(Meets), V(4, 5));
        ExternalEvent put = ExternalEvent.Teleport(At(2), 1, 3, elsewhere.Body, V(4, y), default, occupied);
        Simulation world = Run(Hall, 3, [spawn, elsewhere, put]);
        Assert.Equal(!double.IsNaN(expected), world.TookEffect(spawn));
        Assert.Equal(!double.IsNaN(expected), world.TookEffect(put));
        Near(V(4, double.IsNaN(expected) ? 5 : expected), Read(world, elsewhere.Body, 3).Position, 1e-12);
        Assert.True(double.IsNaN(expected) || (Read(world, spawn.Body, 3).Position - V(1, expected)).Length < 1e-12);
    }

    [Theory]
    [InlineData(WhenOccupied.Overlap)]
    [InlineData(WhenOccupied.Skip)]
    [InlineData(WhenOccupied.Beside)]
    public void Place_InAFloorThatDoesNotStopTheBody_IsThatPlace(WhenOccupied occupied)
    {
        ExternalEvent spawn = ExternalEvent.Spawn(At(1), 1, 1, Ball().With(Ghost), V(1, 5));
        ExternalEvent put = ExternalEvent.Teleport(At(2), 1, 2, spawn.Body, V(4, -2), default, occupied);
        ExternalEvent other = ExternalEvent.Spawn(At(2), 1, 3, Ball().With(Ghost), V(1, -2), whenOccupied: occupied);
        Simulation world = Run(Hall, 3, [spawn, put, other]);
        Near(V(4, -2), Read(world, spawn.Body, 3).Position, 0);
        Near(V(1, -2), Read(world, other.Body, 3).Position, 0);
    }

    /// <summary>In the centre of a static sphere there is no nearest place outside: up is one.</summary>
    [Fact]
    public void Place_InTheCentreOfARock_IsAboveIt() => Near(
        V(9, 10.25), Read(Run(Hall, 1, [ExternalEvent.Spawn(At(0.5), 1, 1, Ball(0.25), V(9, 9))]), new BodyId(1, 1, 0), 1).Position, 1e-12);

    /// <summary>Between walls too close for it nothing is put, and no filter stays that would have them stop what is there.</summary>
    [Fact]
    public void Place_BetweenWallsTooClose_IsNone()
    {
        Scene scene = new SceneBuilder("slot").WithGravity(Floating).WithSmallestRadius(0.25).AddPlane("left", V(1), 0).AddPlane("right", V(-1), -0.6)
            .AddBody("ghost", Ball().With(CollisionFilter.None), V(0.3)).Build();
        ExternalEvent spawn = ExternalEvent.Spawn(At(1), 1, 1, Ball(), V(0.3));
        ExternalEvent filter = ExternalEvent.SetFilter(At(1), 1, 2, First, default);
        ExternalEvent fits = ExternalEvent.Spawn(At(1), 1, 3, Ball(0.25), V(0.1, 3));
        Simulation world = Run(scene, 2, [spawn, filter, fits]);
        Assert.Equal((false, false, true), (world.TookEffect(spawn), world.TookEffect(filter), world.TookEffect(fits)));
        Assert.Equal(CollisionFilter.None, Read(world, First, 2).Filter);
        Near(V(0.25, 3), Read(world, fits.Body, 2).Position, 1e-12);
    }

    /// <summary>
    /// Behind an overhanging wall: the nearest place outside of it and of the floor. (One surface after the other, sixteen times, left it 9 cm
    /// deep at 20 degrees, and there it slept.)
    /// </summary>
    [Theory]
    [InlineData(90)]
    [InlineData(45)]
    [InlineData(20)]
    [InlineData(10)]
    [InlineData(1)]
    public void Place_BehindAnOverhangingWall_IsWhereBothAreTouched(double degrees)
    {
        const double Radius = 0.25;
        double angle = degrees * Math.PI / 180;
        Vector3D wall = V(Math.Sin(angle), -Math.Cos(angle));
        BodySpec spec = new(Radius, 1, 0.5, friction: 0.5);
        Scene scene = new SceneBuilder("wedge").WithContactTolerance(1e-3).AddPlane("floor", Vector3D.Up, V(0), 0.5, 0.5)
            .AddPlane("wall", wall, V(0), 0.5, 0.5, OfOwn).AddBody("ball", spec.With(new CollisionFilter(2, 5)), V(100, Radius)).Build();
        Vector3D behind = V(-0.5, 0.1);
        Vector3D outside = V(Radius / Math.Tan(angle / 2), Radius);
        ExternalEvent grab = ExternalEvent.Grab(At(0.1), 1, 1, First, V(0));
        ExternalEvent keyframe = ExternalEvent.HoldKeyframe(At(0.2), 1, 2, First, behind, V(0));
        ExternalEvent[][] ways =
        [
            [grab, keyframe, ExternalEvent.Release(At(0.5), 1, 3, First, V(0))],
            [grab, keyframe], // lets go by itself
            [ExternalEvent.Teleport(At(0.5), 1, 1, First, behind, V(0))],
            [
                ExternalEvent.SetFilter(At(0.3), 1, 1, First, Ghost), ExternalEvent.Teleport(At(0.4), 1, 2, First, behind, V(0)),
                ExternalEvent.SetFilter(At(0.5), 1, 3, First, new CollisionFilter(2, 5)),
            ],
        ];
        foreach (ExternalEvent[] way in ways)
        {
            Simulation world = Run(scene, 10, way);
            double there = way.Length == 2 ? 1.2 : 0.5;
            Near(outside, Read(world, First, there).Position, 1e-9 / Math.Sin(angle / 2));
            Vector3D after = Read(world, First, 10).Position;
            Assert.True(Math.Min(after.Y, Vector3D.Dot(after, wall)) > Radius - 1e-3, $"{after} is inside.");
        }
    }

    /// <summary>Between walls too close for it a hand may carry a body, but cannot let it go: it is out of the world, which goes on.</summary>
    [Theory]
    [InlineData(0.6)]
    [InlineData(1.1)]
    public void Release_BetweenWalls_WhereThereIsNoRoomLosesTheBody(double room)
    {
        Scene scene = new SceneBuilder("slot").WithGravity(Floating).WithSmallestRadius(0.25).AddPlane("left", V(1), 0).AddPlane("right", V(-1), -room)
            .AddBody("ghost", Ball().With(CollisionFilter.None), V(0.3)).AddBody("other", Ball(0.25), V(0.3, 7), V(0, 1)).Build();
        Simulation world = Run(scene, 2,
            [ExternalEvent.Grab(At(0.1), 1, 1, First, V(0)), ExternalEvent.SetFilter(At(0.2), 1, 2, First, default), ExternalEvent.Release(At(0.5), 1, 3, First, V(0))]);
        Assert.Equal(room < 1 ? [LossReason.NoRoom] : [], world.LostBodies().Select(lost => lost.Reason));
        Assert.Equal(room > 1, world.TryRead(First, At(2), out _));
        Near(V(0.3, 9), Read(world, Second, 2).Position, 1e-12);
    }

    /// <summary>The filter of that instant, which a late event changes: a teleport below the floor of a body that is a ghost then, or not.</summary>
    [Theory]
    [InlineData(false, true)]
    [InlineData(true, false)]
    public void Teleport_OfABodyWhoseFilterALateEventChanges_IsDecidedAgain(bool byDefaultFilter, bool isRight)
    {
        ExternalEvent put = ExternalEvent.Teleport(At(2), 1, 1, First, V(1, -2));
        ExternalEvent late = ExternalEvent.SetFilter(At(1), 2, 1, First, Meets);
        Simulation world = new(Hall, KeepAll.WithParts(new FaultyEngineParts { PlacesByDefaultFilter = byDefaultFilter }));
        world.Submit(put);
        world.AdvanceTo(At(3));
        Near(V(1, -2), Read(world, First, 3).Position, 0); // by the default filter the floor does not stop it
        world.Submit(late);
        world.AdvanceTo(At(3));
        Assert.Equal(isRight, (Read(world, First, 3).Position - V(1, 0.5)).Length < 1e-12);
        Assert.Equal(isRight, Run(Hall, 3, [put, late]).StateHash(At(3)) == world.StateHash(At(3)));
        world.Retract(late);
        world.AdvanceTo(At(3));
        Near(V(1, -2), Read(world, First, 3).Position, 0);
    }

    /// <summary>Free, at rest on another body, and in a heap: what a filter has deep inside of a floor that stops it now is outside of it.</summary>
    [Theory]
    [InlineData(0.0)]
    [InlineData(0.5)]
    public void SetFilter_OfABodyInAHeapInsideAFloor_PutsItOutside(double friction)
    {
        BodySpec solid = new(0.5, 1, 0, friction: friction);
        Scene scene = new SceneBuilder("pit").AddPlane("bottom", Vector3D.Up, -4, 0, filter: new CollisionFilter(2)).AddPlane("floor", Vector3D.Up, 0, 0, filter: OfOwn)
            .AddBody("below", solid.With(new CollisionFilter(1, 3)), V(0, -3.5)).AddBody("above", solid.With(new CollisionFilter(1, 3)), V(0.1, -2.4)).Build();
        ExternalEvent filter = ExternalEvent.SetFilter(At(0.75), 1, 1, Second, new CollisionFilter(2, 7));
        Assert.True(Read(Run(scene, 0.75), Second, 0.75).Position.Y < -2);
        Simulation world = Run(scene, 3, [filter]);
        Near(0.5, Read(world, Second, 0.75).Position.Y, 1e-9);
        Near(0.5, Read(world, Second, 3).Position.Y, 1e-3);
    }

    /// <summary>At the centre of a pull without bound there is no direction in which a body would be drawn.</summary>
    [Fact]
    public void Teleport_OfASpawnedBodyIntoTheCentreOfItsPull_HasNoEffect()
    {
        Scene scene = new SceneBuilder("pull").WithGravity(Floating).WithSmallestRadius(0.25).AddForce(Force.Central("sun", V(0), 1)).Build();
        ExternalEvent spawn = ExternalEvent.Spawn(At(0), 1, 1, Ball(flight: MotionLaw.DormandPrince54, force: 1), V(9), V(0, 0.3));
        ExternalEvent put = ExternalEvent.Teleport(At(1), 1, 2, spawn.Body, V(0));
        Assert.False(Run(scene, 2, [spawn, put]).TookEffect(put));
    }
}
