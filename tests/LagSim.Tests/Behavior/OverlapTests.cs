using System;
using System.Linq;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>
/// Rules 6 and 10 (docs/CONTACT.md): what is put into another is out of it, but for the contact tolerance, in the time of a fall by its
/// depth, at any gravity and tolerance; it leaves slowly, and nothing sleeps inside another.
/// </summary>
public sealed class OverlapTests
{
    private const double Radius = 0.5, Depth = 0.5, Put = 0.5;

    [Theory]
    [InlineData(0, 1e-3)]
    [InlineData(0, 1e-2)]
    [InlineData(0.003, 1e-4)]
    [InlineData(1.62, 1e-2)]
    [InlineData(9.81, 1e-9)]
    [InlineData(9.81, 1e-2)]
    [InlineData(9.81, 0.1)]
    [InlineData(100, 1e-3)]
    public void BodyPutIntoAnother_IsOutInTheTimeOfAFall(double gravity, double tolerance)
    {
        Simulation world = WithOverlap(gravity, tolerance);
        double pull = Math.Max(1, gravity);
        double until = Put + Math.Sqrt(2 * Depth / pull) + (2.0 / 64);
        world.AdvanceTo(At(until));
        Assert.InRange(DepthAt(world, until), double.NegativeInfinity, tolerance);

        // What leaves is about as fast as what rises by the tolerance, so that nothing is thrown.
        double later = until + 0.3;
        world.AdvanceTo(At(later));
        double speed = (Read(world, First, later).Velocity - Read(world, Second, later).Velocity).Length;
        Assert.InRange(speed, 0, 2 * Math.Sqrt(2 * pull * tolerance));
    }

    /// <summary>
    /// The control: as slowly as shallow overlap is pushed out it takes far longer, and where slow is still it stays inside.
    /// </summary>
    [Theory]
    [InlineData(0, 1e-3, false)]
    [InlineData(9.81, 1e-2, false)]
    [InlineData(0, 1e-2, true)]
    [InlineData(9.81, 0.1, true)]
    public void BodyPutIntoAnother_PushedOutSlowly_IsSeenInside(double gravity, double tolerance, bool sleeps)
    {
        Simulation world = WithOverlap(gravity, tolerance, sleeps, isSlow: true);
        double until = sleeps ? 1000 : Put + Math.Sqrt(2 * Depth / Math.Max(1, gravity)) + (2.0 / 64);
        world.AdvanceTo(At(until));
        Assert.True(DepthAt(world, until) > 0.3);
        Assert.Equal(sleeps, Read(world, First, until).Motion == MotionLaw.Resting);
    }

    /// <summary>What moves along with the other, or parts too slowly, or flies in, is out as soon; what flies on does so.</summary>
    [Theory]
    [InlineData(3, 3, 1)]
    [InlineData(0, 1e-3, 1)]
    [InlineData(0, -5, 1.5)]
    [InlineData(0, 5, 0.2)]
    public void MovingBodiesPutIntoEachOther_Part(double first, double second, double within)
    {
        Scene scene = new SceneBuilder("moving").WithGravity(V(0)).WithContactTolerance(1e-3)
            .AddBody("a", new BodySpec(Radius, 1, 0.5), V(0), V(first)).Build();
        Simulation world = new(scene, KeepAll);
        double before = 0.5 * ((first * first) + (second * second));
        world.Submit(PlayerAction.Spawn(new BodySpec(Radius, 1, 0.5), V(Depth), V(second)).Stamp(At(0), 0, 1));
        world.AdvanceTo(At(within + 1));
        Assert.InRange(DepthAt(world, within), double.NegativeInfinity, 1e-3);
        BodyState a = Read(world, First, within + 1), b = Read(world, world.BodyAt(1), within + 1);
        Near(V(first + second), a.Velocity + b.Velocity, 1e-9);
        Assert.InRange(0.5 * (a.Velocity.LengthSquared + b.Velocity.LengthSquared), 0, before + 0.01);
        Assert.True(second != 5 || b.Velocity.X > 4.6, "what flies on is hardly held back");
    }

    /// <summary>Twelve bodies at nearly one place are apart soon, and none is thrown higher than they were deep.</summary>
    [Theory]
    [InlineData(0)]
    [InlineData(9.81)]
    public void ManyBodiesAtOnePlace_Part(double gravity)
    {
        SceneBuilder builder = new SceneBuilder("many").WithGravity(V(0, -gravity)).WithContactTolerance(1e-3).AddPlane("floor", Vector3D.Up, -Radius);
        Simulation world = new(builder.AddBody("first", new BodySpec(Radius, 1, 0.5), V(0)).Build(), KeepAll);
        Random random = new(1);
        for (int n = 1; n < 12; n++)
        {
            Vector3D place = V(0.3 * random.NextDouble(), 0.3 * random.NextDouble(), 0.3 * random.NextDouble());
            world.Submit(PlayerAction.Spawn(new BodySpec(Radius, 1, 0.5), place).Stamp(At(0), 0, (uint)n));
        }

        world.AdvanceTo(At(3));
        Assert.True(MinGap(world, At(3)) >= -1e-3);
        double pull = Math.Max(1, gravity);
        Assert.All(Bodies(world), body => Assert.InRange(Read(world, body, 3).Velocity.Length, 0, Math.Sqrt(2 * pull * 2 * Radius)));
        Assert.All(Bodies(world), body => Assert.InRange(Read(world, body, 3).Position.Y, -Radius, gravity > 0 ? 4 * Radius : 6 * Radius));
    }

    /// <summary>
    /// Balls of unequal masses that are put at exactly one point, above one that they just touch, end as a column. Their contacts are
    /// combinations of one another, and an impact on the one below is solved without rebound, again and again, where that one does not join them.
    /// </summary>
    [Theory]
    [InlineData(0, new[] { 1.0, 5, 4, 1 }, new[] { 0.1, 0.3, 0.1, 0.3 })]
    [InlineData(0.5, new[] { 1.0, 5, 4, 1 }, new[] { 0.1, 0.3, 0.1, 0.3 })]
    [InlineData(0.5, new[] { 1.24, 180, 2.08 }, new[] { 0.1, 0.2, 0.2 })]
    [InlineData(0, new[] { 0.206, 0.215, 0.888, 0.148 }, new[] { 0.1, 0.2, 0.1, 0.3 })]
    public void UnequalBodiesAtOnePoint_AboveOneThatTheyTouch_EndAsAColumn(double restitution, double[] masses, double[] radii)
    {
        Scene scene = new SceneBuilder("column").WithContactTolerance(1e-3).WithSmallestRadius(0.1).AddPlane("floor", Vector3D.Up, 0)
            .AddBody("below", new BodySpec(radii[0], masses[0], restitution, friction: 0.5), V(0, radii[0])).Build();
        Simulation world = Column(scene, restitution, masses, radii, SolverRules.Usual);
        Assert.True(MinGap(world, At(8)) >= -1e-3);
        Assert.All(Bodies(world), body => Assert.Equal(MotionLaw.Resting, Read(world, body, 8).Motion));

        // The control: where what does not rebound counts as bounced off, the heavy ball stays in the light one.
        bool stays = restitution > 0 && masses[1] == 180;
        Simulation bounced = Column(scene, restitution, masses, radii, new FaultySolverRules { DropsWhatDoesNotRebound = true });
        Assert.Equal(stays, MinGap(bounced, At(8)) < -0.1);
    }

    /// <summary>
    /// Elastic bodies at one place part, however unlike their masses are. A light one that was left to impacts would bounce between the floor and the
    /// heavy one without end, and what a step pushes out would never get anywhere. The control: elastic ones that are not in one another bounce on.
    /// </summary>
    [Theory]
    [InlineData(1e-3, new[] { 100.0, 1 }, new[] { 0.3, 0.2 })]
    [InlineData(1e-2, new[] { 100.0, 1 }, new[] { 0.3, 0.2 })]
    [InlineData(1e-3, new[] { 20.0, 1 }, new[] { 0.3, 0.2 })]
    [InlineData(1e-2, new[] { 10.0, 1 }, new[] { 0.2, 0.3 })]
    [InlineData(1e-3, new[] { 50.0, 1, 50 }, new[] { 0.2, 0.2, 0.3 })]
    public void ElasticBodiesOfUnlikeMasses_AtOnePlace_Part(double tolerance, double[] masses, double[] radii)
    {
        Scene scene = new SceneBuilder("elastic").WithContactTolerance(tolerance).WithSmallestRadius(0.1).AddPlane("floor", Vector3D.Up, 0)
            .AddBody("far", new BodySpec(0.1, 1, 1), V(9, 0.6)).Build();
        Simulation world = new(scene, KeepAll);
        for (int n = 0; n < masses.Length; n++)
        {
            world.Submit(PlayerAction.Spawn(new BodySpec(radii[n], masses[n], 1), V(0, 0.3)).Stamp(At(1), 0, (uint)n + 1));
        }

        world.AdvanceTo(At(6));
        foreach (double time in new[] { 3.0, 4, 5, 6 })
        {
            Assert.True(MinGap(world, At(time)) >= -2 * tolerance, $"{MinGap(world, At(time))} at {time} s");
        }

        BodyState far = Read(world, First, 6);
        Near(9.81 * 0.6, (0.5 * far.Velocity.LengthSquared) + (9.81 * far.Position.Y), 1e-9);
    }

    /// <summary>In a periodic box nothing pushes (docs/LIMITS.md): what rests in another stays there, what moves out of it parts, and what is
    /// put beside it was never in it.</summary>
    [Theory]
    [InlineData(WhenOccupied.Overlap, 0, true)]
    [InlineData(WhenOccupied.Overlap, 0.1, false)]
    [InlineData(WhenOccupied.Beside, 0, false)]
    public void BodyPutIntoAnother_InAPeriodicBox_IsNotPushedOut(WhenOccupied when, double speed, bool stays)
    {
        Scene scene = new SceneBuilder("box").WithGravity(V(0)).WithPeriodicBox(V(20, 20, 20)).AddBody("a", new BodySpec(Radius, 1, 0.5), V(5, 5, 5)).Build();
        Simulation world = new(scene, KeepAll);
        world.Submit(PlayerAction.Spawn(new BodySpec(Radius, 1, 0.5), V(6 - Depth, 5, 5), V(speed), whenOccupied: when).Stamp(At(0), 0, 1));
        world.AdvanceTo(At(50));
        Assert.Equal(stays ? Depth : 0, Math.Max(0, DepthAt(world, 50)), 9);
    }

    private static Simulation Column(Scene scene, double restitution, double[] masses, double[] radii, SolverRules rules)
    {
        Simulation world = new(scene, KeepAll.WithParts(new FaultyEngineParts { Rules = rules }));
        for (int n = 1; n < masses.Length; n++)
        {
            world.Submit(PlayerAction.Spawn(new BodySpec(radii[n], masses[n], restitution, friction: 0.5), V(0, 0.5)).Stamp(At(1), 0, (uint)n));
        }

        world.AdvanceTo(At(8));
        return world;
    }

    private static Simulation WithOverlap(double gravity, double tolerance, bool sleeps = false, bool isSlow = false)
    {
        SceneBuilder builder = new SceneBuilder("overlap").WithGravity(V(0, -gravity)).WithContactTolerance(tolerance);
        builder = gravity > 0 ? builder.AddPlane("floor", Vector3D.Up, 0) : builder;
        Scene scene = builder.AddBody("a", new BodySpec(Radius, 1, 0.5), V(0, Radius)).Build();
        FaultyEngineParts parts = new() { SleepsWhereSlow = sleeps, Scale = isSlow ? new FaultyContactScale(scene) { PushesSlowly = true } : null };
        Simulation world = new(scene, KeepAll.WithParts(parts));
        world.Submit(PlayerAction.Spawn(new BodySpec(Radius, 1, 0.5), V((2 * Radius) - Depth, Radius)).Stamp(At(Put), 0, 1));
        return world;
    }

    private static double DepthAt(Simulation world, double time) =>
        (2 * Radius) - (Read(world, world.BodyAt(0), time).Position - Read(world, world.BodyAt(1), time).Position).Length;

    /// <summary>Eight at one place part with no more energy than each would have that is pushed out of another.</summary>
    [Fact]
    public void Bodies_AtOnePlace_PartAsFastInTheMeanAsTwoWould()
    {
        const int Count = 8;
        double each = 0.5 * 2 * 1; // m v² / 2 with v² = 2 a s: the pull of 1 m/s² over the metre that they are deep
        Assert.InRange(MostEnergy(Count, null), each, Count * each * 1.1);
        Assert.InRange(MostEnergy(Count, new FaultyEngineParts { Rules = new FaultySolverRules { GainsEnergy = true } }), Count * each * 2, double.MaxValue); // the control
    }

    private static double MostEnergy(int count, FaultyEngineParts? parts)
    {
        Scene scene = new SceneBuilder("void").WithGravity(Vector3D.Zero).AddBody("far", new BodySpec(0.5, 1, 0), V(50)).Build();
        SimulationOptions options = new(history: SimDuration.MaxValue);
        Simulation world = new(scene, parts is null ? options : options.WithParts(parts));
        for (uint n = 1; n <= count; n++)
        {
            world.Submit(PlayerAction.Spawn(new BodySpec(0.5, 1, 0), V(0)).Stamp(At(1), 1, n));
        }

        double most = 0;
        for (double time = 1; time < 3; time += 0.02)
        {
            world.AdvanceTo(At(time));
            most = Math.Max(most, Bodies(world).Where(body => world.TryRead(body, At(time), out _)).Sum(body => 0.5 * Read(world, body, time).Velocity.LengthSquared));
        }

        return most;
    }
}
