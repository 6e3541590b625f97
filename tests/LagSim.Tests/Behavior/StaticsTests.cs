using System;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>
/// Rule 10 (docs/CONTACT.md): a body sleeps where statics holds it, and not where it is only slow. What a weak pull sets going goes, and
/// what
/// is held costs nothing.
/// </summary>
public sealed class StaticsTests
{
    /// <summary>
    /// A ball without friction slides off a rock as it does under gravity on Earth, but slower by the root of the ratio, however weak
    /// gravity, however flat the place and however coarse the tolerance. The control: where slow is still, it lies there for ever.
    /// </summary>
    [Theory]
    [InlineData(0.003, 45, 5e-3)]
    [InlineData(0.003, 2, 1e-3)]
    [InlineData(1.62, 1.3, 1e-2)]
    [InlineData(1e-4, 20, 1e-3)]
    [InlineData(9.81, 0.05, 1e-3)]
    public void BallOnARock_SlidesOffAtAnyGravity(double gravity, double degrees, double tolerance)
    {
        double slower = Math.Sqrt(9.81 / gravity);
        double time = 0.35 * Math.Log(90 / degrees);
        double expected = DegreesAfter(time, 9.81, degrees, 1e-6);
        Assert.InRange(expected, degrees + 0.05, 90);
        Assert.Equal(1, DegreesAfter(time * slower, gravity, degrees, tolerance) / expected, 2e-2);
        Assert.InRange(DegreesAfter(time * slower, gravity, degrees, tolerance, sleeps: true), degrees, gravity < 9 ? 0.98 * expected : expected);
    }

    private static double DegreesAfter(double time, double gravity, double degrees, double tolerance, bool sleeps = false)
    {
        double angle = degrees * Math.PI / 180;
        Scene scene = new SceneBuilder("rock").WithGravity(V(0, -gravity)).WithContactTolerance(tolerance).AddStaticSphere("rock", V(0), 1, 0)
            .AddBody("ball", new BodySpec(0.5, 1, 0), V(1.5 * Math.Sin(angle), 1.5 * Math.Cos(angle))).Build();
        Simulation world = new(scene, KeepAll.WithParts(new FaultyEngineParts { SleepsWhereSlow = sleeps }));
        world.AdvanceTo(At(time));
        Vector3D place = Read(world, First, time).Position;
        return Math.Atan2(place.X, place.Y) * 180 / Math.PI;
    }

    /// <summary>A weak wind carries a ball along a floor, and a weak spring pulls it; where slow is still neither moves it.</summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void WeakForce_MovesWhatNothingHolds(bool sleeps)
    {
        const double Drag = 1e-3, Wind = 0.5, Stiffness = 1e-4, Length = 2;
        Vector3D blown = PlaceAfter(20, Force.LinearDrag("wind", Drag, V(Wind)), 0, sleeps);
        Vector3D pulled = PlaceAfter(20, Force.Spring("spring", V(Length, 0.1), Stiffness), 0, sleeps);
        double way = Wind * (20 - ((1 - Math.Exp(-20 * Drag)) / Drag));
        Assert.Equal(!sleeps, Math.Abs(blown.X - way) < 1e-3 * way);
        Assert.Equal(!sleeps, Math.Abs(pulled.X - (Length * (1 - Math.Cos(20 * Math.Sqrt(Stiffness))))) < 1e-3);
    }

    /// <summary>
    /// Two that touch and drift along a slot without friction, where nothing brakes them, however slow; where all is rough resistance stops
    /// them. The control: where slow is still they stop without friction too.
    /// </summary>
    [Theory]
    [InlineData(0.95)]
    [InlineData(0.1)]
    public void BallsThatDriftTogether_GoOn(double part)
    {
        double speed = part * 2e-3; // of the still speed
        Assert.Equal(20 * speed, WayOf(speed, 0, sleeps: false), 1e-6);
        Assert.InRange(WayOf(speed, 0, sleeps: true), 0, 2 * speed);
        Assert.InRange(WayOf(speed, 0.5, sleeps: false), -1e-5, 2 * speed);
    }

    /// <summary>How far one that stands on another has drifted with it.</summary>
    private static double WayOf(double speed, double friction, bool sleeps)
    {
        BodySpec spec = new(0.1, 1, 0, friction: friction, rollingResistance: friction / 5);
        Scene scene = new SceneBuilder("slot").WithContactTolerance(1e-3)
            .AddPlane("floor", Vector3D.Up, 0, 0, 1).AddPlane("left", V(1), -0.1, 0, 1).AddPlane("right", V(-1), -0.1, 0, 1)
            .AddBody("below", spec, V(0, 0.1), V(0, 0, speed)).AddBody("above", spec, V(0, 0.3), V(0, 0, speed)).Build();
        Simulation world = new(scene, KeepAll.WithParts(new FaultyEngineParts { SleepsWhereSlow = sleeps }));
        world.AdvanceTo(At(20));
        return (Read(world, First, 20).Position.Z + Read(world, Second, 20).Position.Z) / 2;
    }

    /// <summary>What friction holds against the same force sleeps, where it was put.</summary>
    [Fact]
    public void WeakForce_AgainstRollingResistance_MovesNothing() =>
        Assert.Equal(0, PlaceAfter(20, Force.LinearDrag("wind", 1e-3, V(0.5)), 0.01, sleeps: false, rests: true).X, 1e-9);

    private static Vector3D PlaceAfter(double time, Force force, double resistance, bool sleeps, bool rests = false)
    {
        Scene scene = new SceneBuilder("floor").WithContactTolerance(1e-3).AddPlane("floor", Vector3D.Up, 0).AddForce(force, out ForceSet set)
            .AddBody("ball", new BodySpec(0.1, 1, 0, friction: resistance, rollingResistance: resistance, forces: set), V(0, 0.1)).Build();
        Simulation world = new(scene, KeepAll.WithParts(new FaultyEngineParts { SleepsWhereSlow = sleeps }));
        world.AdvanceTo(At(time));
        Assert.Equal(rests || sleeps, Read(world, First, time).Motion == MotionLaw.Resting);
        return Read(world, First, time).Position;
    }

    /// <summary>
    /// On a dome rolling resistance holds a ball up to the slope that is its coefficient, and there it sleeps as soon as it may; on its top
    /// it needs none. A little beyond it rolls off.
    /// </summary>
    [Theory]
    [InlineData(0, 0, true)]
    [InlineData(0.02, 0.95, true)]
    [InlineData(0.02, 1.05, false)]
    public void BallOnADome_SleepsWhereItIsHeld(double resistance, double part, bool rests)
    {
        double angle = Math.Atan(part * resistance);
        Scene scene = new SceneBuilder("dome").WithContactTolerance(1e-3).AddStaticSphere("dome", V(0), 1, 0)
            .AddBody("ball", new BodySpec(0.5, 1, 0, friction: 0.5, rollingResistance: resistance), V(1.5 * Math.Sin(angle), 1.5 * Math.Cos(angle))).Build();
        Simulation world = Run(scene, 1.5);
        Assert.Equal(rests, Read(world, First, 0.6).Motion == MotionLaw.Resting);
        long events = world.EventsProcessed;
        world.AdvanceTo(At(20));
        Assert.Equal(rests, world.EventsProcessed == events);
    }
}
