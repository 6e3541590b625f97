using System;
using System.Linq;
using LagSim.Scenes;
using LagSim.Tests.Behavior;
using LagSim.Tests.Faults;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Numerics;

/// <summary>Friction of solid spheres against the textbook's formulas: impacts, slipping, rolling, rest.</summary>
public sealed class FrictionTests
{
    private const double R = 0.5;

    /// <summary>A ball thrown along a floor without spin slips for 2 v / (7 mu g) and rolls on with 5/7 of its speed.</summary>
    [Theory]
    [InlineData(0.1, 2)]
    [InlineData(0.7, 9)]
    public void Slipping_OnAFloor_EndsInRollingAtFiveSevenths(double mu, double v)
    {
        Simulation world = OnFloor(new BodySpec(R, 2, 0, friction: mu), V(v, 0, 0.5 * v), Vector3D.Zero);
        double speed = v * Math.Sqrt(1.25), slips = 2 * speed / (7 * mu * Gravity);
        TimelineEntry rolls = world.Timeline(First).Single(entry => entry.State.Motion == MotionLaw.Rolling);
        Near(slips, rolls.Key.Time.SecondsSince(default), 1e-11);
        BodyState end = Read(world, First, 10);
        Near(V(v, 0, 0.5 * v) * (5.0 / 7), end.Velocity, 1e-10);
        Near(Vector3D.Cross(Vector3D.Up, end.Velocity) / R, end.Spin, 1e-10);
        Near(V(v, 0, 0.5 * v) * ((10 * 5.0 / 7) + (slips / 7)), end.Position - V(0, R), 1e-8);
    }

    /// <summary>Backspin: a ball that turns against its way fast enough comes back.</summary>
    [Fact]
    public void Slipping_WithBackspin_ComesBack()
    {
        Simulation world = OnFloor(new BodySpec(R, 1, 0, friction: 0.4), V(2), V(0, 3, 20));
        BodyState end = Read(world, First, 10);
        Near(((5 * 2.0) - (2 * R * 20)) / 7, end.Velocity.X, 1e-10);
        Near(V(0, 3, -end.Velocity.X / R), end.Spin, 1e-9); // what turns about the normal is not slowed down
    }

    [Theory]
    [InlineData(0.2)]
    [InlineData(1)]
    public void OnASlope_RollsOrSlips_AsFrictionAllows(double mu)
    {
        // 3-4-5: sine 0.6, cosine 0.8; rolling needs mu of 2/7 0.6 / 0.8.
        Vector3D normal = V(-0.6, 0.8), down = V(-0.8, -0.6);
        Simulation world = new(
            new SceneBuilder("slope").AddPlane("slope", normal, 0.0).AddBody("ball", new BodySpec(R, 1, 0, friction: mu), normal * R).Build(), KeepAll);
        world.AdvanceTo(At(2));
        bool rolls = mu >= 2.0 / 7 * 0.6 / 0.8;
        double a = rolls ? 5.0 / 7 * 0.6 * Gravity : Gravity * (0.6 - (mu * 0.8));
        BodyState end = Read(world, First, 2);
        Near(down * (2 * a), end.Velocity, 1e-9);
        Assert.Equal(rolls ? MotionLaw.Rolling : MotionLaw.Sliding, end.Motion);
        double spin = rolls ? 2 * a / R : 2 * 2.5 * mu * 0.8 * Gravity / R;
        Near(spin, end.Spin.Z, 1e-8);
    }

    [Fact]
    public void RollingResistance_BringsToRest_AndRestCostsNothing()
    {
        Simulation world = OnFloor(new BodySpec(R, 1, 0, friction: 0.5, rollingResistance: 0.02), V(1), V(0, 0, -1 / R));
        double brake = 5.0 / 7 * 0.02 * Gravity;
        BodyState end = Read(world, First, 10);
        Assert.Equal(MotionLaw.Resting, end.Motion);
        Near(1 / (2 * brake), end.Position.X, 1e-9);
        Assert.Equal(Vector3D.Zero, end.Spin);
        long events = world.EventsProcessed;
        world.AdvanceTo(At(1000));
        Assert.Equal(events, world.EventsProcessed);
    }

    /// <summary>Rolling resistance c takes 5/2 c g / r from what turns about the normal, whether the ball stays, rolls or slips; without it that goes on for ever.</summary>
    [Theory]
    [InlineData(0, 0)]
    [InlineData(0.3, 0)]
    [InlineData(0.3, 1)]
    public void RollingResistance_StopsWhatTurnsOnTheSpot(double v, double slips)
    {
        const double c = 0.02, turning = 3, rate = 2.5 * c * Gravity / R, stops = turning / rate;
        Simulation world = OnFloor(new BodySpec(R, 1, 0, friction: 0.05, rollingResistance: c), V(v), V(0, turning, -v * (1 - slips) / R));
        Near(turning - (rate * 0.1), Read(world, First, 0.1).Spin.Y, 1e-10);
        Near(turning / 2, Read(world, First, stops / 2).Spin.Y, 1e-10);
        BodyState end = Read(world, First, 20);
        Assert.Equal((MotionLaw.Resting, Vector3D.Zero), (end.Motion, end.Spin));
        Near(0, Read(world, First, stops + 1e-9).Spin.Y, 1e-8);
        world = OnFloor(new BodySpec(R, 1, 0, friction: 0.05), V(v), V(0, turning, -v * (1 - slips) / R));
        Assert.Equal(turning, Read(world, First, 20).Spin.Y);
    }

    /// <summary>On a slope that rolling resistance can hold a ball stays where it stops; on a steeper one it turns and rolls down.</summary>
    [Theory]
    [InlineData(0.8, true)]
    [InlineData(0.7, false)]
    public void RollingResistance_OnASlope_HoldsUpToItsAngle(double resistance, bool holds)
    {
        Vector3D normal = V(-0.6, 0.8), up = V(0.8, 0.6);
        Simulation world = new(
            new SceneBuilder("slope").AddPlane("slope", normal, 0.0)
                .AddBody("ball", new BodySpec(R, 1, 0, friction: 2, rollingResistance: resistance), normal * R, up * 2, spin: V(0, 0, -2 / R)).Build(),
            KeepAll);
        world.AdvanceTo(At(3));
        Assert.Equal(holds ? MotionLaw.Resting : MotionLaw.Rolling, Read(world, First, 3).Motion);
        Assert.Equal(!holds, Vector3D.Dot(up, Read(world, First, 3).Velocity) < 0);
    }

    /// <summary>A ball that turns in place between a floor and a wall it is pressed to by that: the floor carries g / (1 + mu²) of it, and both brake.</summary>
    [Theory]
    [InlineData(0.3)]
    [InlineData(1)]
    [InlineData(3)]
    public void Turning_BetweenFloorAndWall_IsBrakedByBoth(double mu)
    {
        Simulation world = BesideWall(new BodySpec(R, 1, 0, friction: mu), 100, V(0), V(0, 0, -20), Gravity);
        double brake = 2.5 * mu * (1 + mu) / (1 + (mu * mu)) * Gravity / R;
        world.AdvanceTo(At(0.1));
        double d = world.Scene.ContactTolerance;
        Near(-20 + (brake * 0.1), Read(world, First, 0.1).Spin.Z, 1.1 * brake * 0.5 / Tolerance.StepsASecond(d)); // what is read is of the middle of a step
        Near(V(0, R), Read(world, First, 0.1).Position, 0.01 * d);
    }

    /// <summary>Whatever friction and gravity, a ball that slips and turns on a floor, beside a wall too, comes through a second in some thousand events.</summary>
    [Fact]
    public void AnyFriction_OnAFloorOrBesideAWall_TakesFewEvents()
    {
        Random random = new(11);
        double[] walls = [0, 0.1, 1, 100], resistances = [0, 0.01, 0.3, 1];
        for (int n = 0; n < 3000; n++)
        {
            BodySpec ball = new(R, 1, 0, friction: Math.Pow(10, 3.0 * random.NextDouble() - 1), rollingResistance: resistances[random.Next(4)]);
            double wall = n % 2 == 0 ? double.NaN : walls[random.Next(4)], gravity = Math.Pow(10, 3 * random.NextDouble());
            Simulation world = BesideWall(ball, wall, V(Any(1) * random.Next(2), 0, Any(1) * random.Next(2)), V(Any(5), Any(5), Any(5)), gravity);
            Assert.True(IsThrough(world), $"{n}: friction {ball.Friction} on the floor, {wall} at the wall, gravity {gravity} m/s²");
        }

        double Any(double size) => ((2 * random.NextDouble()) - 1) * size;
    }

    [Fact]
    public void Control_WithoutIslands_IsStoppedByTheWallForEver()
    {
        Simulation world = BesideWall(new BodySpec(R, 1, 0, friction: 0.3), 100, V(0), V(0, 0, -20), Gravity, ignoresIslands: true);
        Assert.False(IsThrough(world));
    }

    private static bool IsThrough(Simulation world)
    {
        long events = 5000;
        return world.TryAdvanceTo(At(1), ref events);
    }

    /// <summary>A ball on a floor; and, unless its friction is no number, at a wall.</summary>
    private static Simulation BesideWall(BodySpec ball, double wall, Vector3D velocity, Vector3D spin, double gravity, bool ignoresIslands = false)
    {
        SceneBuilder builder = new SceneBuilder("wall").WithGravity(V(0, -gravity)).AddPlane("floor", V(0, 1), 0.0, 0.5);
        builder = double.IsNaN(wall) ? builder : builder.AddPlane("wall", V(-1), V(R), 1, wall);
        Scene scene = builder.AddBody("ball", ball, V(0, R + (ignoresIslands ? 1e-3 : 0)), velocity, spin: spin).Build();
        return new Simulation(scene, KeepAll.WithParts(new FaultyEngineParts { IgnoresIslands = ignoresIslands }));
    }

    /// <summary>Across a slope the slip turns: against a reference by small steps of its equation, u' = g_t - 7/2 mu g_n u / |u|.</summary>
    [Fact]
    public void Slipping_AcrossASlope_FollowsItsEquation()
    {
        const double mu = 0.4;
        Vector3D normal = V(-0.6, 0.8), pull = V(-0.8, -0.6) * (0.6 * Gravity);
        Simulation world = new(
            new SceneBuilder("slope").AddPlane("slope", normal, 0.0).AddBody("ball", new BodySpec(R, 1, 0, friction: mu), normal * R, V(0, 0, 3)).Build(), KeepAll);
        world.AdvanceTo(At(0.25));
        Vector3D u = V(0, 0, 3), v = u, x = normal * R;
        const int steps = 250_000;
        const double h = 0.25 / steps;
        for (int i = 0; i < steps; i++)
        {
            Vector3D middle = u + ((pull - (u * (3.5 * mu * 0.8 * Gravity / u.Length))) * (h / 2));
            Vector3D frictionImpulse = middle * (mu * 0.8 * Gravity / middle.Length);
            x += (v + ((pull - frictionImpulse) * (h / 2))) * h;
            v += (pull - frictionImpulse) * h;
            u += (pull - (frictionImpulse * 3.5)) * h;
        }

        BodyState end = Read(world, First, 0.25);
        Near(v, end.Velocity, 3e-5); // pieces of 1/128 rad, right to the second order: some 1/128² / 24 of what turns, each
        Near(x, end.Position, 1e-5);
    }

    /// <summary>A ball that strikes a floor aslant without spin keeps 5/7 of its speed along it where friction can stop the slip, and loses mu (1 + e) of the normal speed where not.</summary>
    [Theory]
    [InlineData(1, 2)]
    [InlineData(0.1, 2)]
    public void Impact_OnAFloor_GripsOrSlips(double mu, double along)
    {
        const double e = 0.6, down = 5;
        Scene scene = new SceneBuilder("oblique").WithGravity(Floating).AddPlane("floor", Vector3D.Up, V(0))
            .AddBody("ball", new BodySpec(R, 3, e, friction: mu), V(0, 1.5), V(along, -down)).Build();
        BodyState after = Read(Run(scene, 1), First, 1);
        double lost = Math.Min(2.0 / 7 * along, mu * (1 + e) * down);
        Near(V(along - lost, e * down), after.Velocity, 1e-14);
        Near(V(0, 0, -2.5 * lost / R), after.Spin, 1e-13);
    }

    /// <summary>Two balls that strike each other aslant: momentum and angular momentum stay, and so does the point at which they grip.</summary>
    [Fact]
    public void Impact_OfTwo_KeepsMomentumAndAngularMomentum()
    {
        Scene scene = new SceneBuilder("two").WithGravity(Floating)
            .AddBody("a", new BodySpec(0.5, 2, 0.8, friction: 0.3), V(0, 0.1, 0.2), V(3, 0.2), spin: V(5, -2, 7))
            .AddBody("b", new BodySpec(0.3, 0.7, 0.9, friction: 0.5), V(2), V(-1, 0, 0.3), spin: V(1, 9, -4)).Build();
        Simulation world = Run(scene, 1);
        Assert.Single(Impacts(world, First));
        Near(Momentum(world, At(0)), Momentum(world, At(1)), 1e-14);
        Near(AngularMomentum(world, 0), AngularMomentum(world, 1), 1e-13);
        Assert.True(Kinetic(world, 1) < Kinetic(world, 0));
        Assert.NotEqual(Read(world, First, 0).Spin, Read(world, First, 1).Spin);
    }

    /// <summary>However many rub at once: elastic balls with friction in a box never gain energy.</summary>
    [Fact]
    public void Impacts_ManyAtOnce_NeverGainEnergy()
    {
        for (int seed = 0; seed < 20; seed++)
        {
            Random random = new(seed);
            SceneBuilder builder = new SceneBuilder("box").WithGravity(Floating);
            foreach (Vector3D side in new[] { V(1), V(-1), V(0, 1), V(0, -1), V(0, 0, 1), V(0, 0, -1) })
            {
                builder.AddPlane($"wall {side}", side, -1.6);
            }

            for (int i = 0; i < 27; i++)
            {
                builder.AddBody(
                    $"ball {i}", new BodySpec(0.5, 1 + random.Next(3), 1, friction: random.NextDouble()), V(i % 3, i / 3 % 3, i / 9) - V(1, 1, 1),
                    i == 13 ? V(9, 7, -8) : Vector3D.Zero, spin: V(random.Next(9), random.Next(9), random.Next(9)));
            }

            Simulation world = Run(builder.Build(), 0.3);
            double before = Kinetic(world, 0);
            for (double t = 0.02; t <= 0.3; t += 0.02)
            {
                double now = Kinetic(world, t);
                Assert.True(now <= before * (1 + 1e-9), $"seed {seed}, {t}: {before:R} to {now:R}");
                before = now;
            }

            Assert.True(world.ImpactsProcessed > 20);
        }
    }

    /// <summary>The control: with friction left out the energy of an elastic box stays, so it is friction that the test above sees.</summary>
    [Fact]
    public void Impact_WithoutFriction_TurnsNothing()
    {
        Scene scene = new SceneBuilder("two").WithGravity(Floating).AddPlane("wall", V(-1), V(4), friction: 0)
            .AddBody("a", new BodySpec(0.5, 2, 1, friction: 1), V(0, 0.1, 0.2), V(3, 0.2), spin: V(5, -2, 7)).AddBody("b", new BodySpec(0.3, 0.7, 1), V(2), V(-1, 0, 0.3)).Build();
        Simulation world = Run(scene, 3);
        Assert.True(world.ImpactsProcessed > 1);
        Near(Kinetic(world, 0), Kinetic(world, 3), 1e-13);
        Assert.Equal(V(5, -2, 7), Read(world, First, 3).Spin);
    }

    /// <summary>A curve ball: the Magnus force turns the velocity evenly about the spin, in closed form.</summary>
    [Fact]
    public void Magnus_OfAnEvenSpin_IsACircle()
    {
        Scene scene = new SceneBuilder("curve").WithGravity(Floating).AddForce(Force.Magnus("air", 0.5), out ForceSet air)
            .AddBody("ball", new BodySpec(0.1, 2, 1, forces: air, tolerance: 0), V(0), V(4), spin: V(0, 0, 6)).Build();
        Assert.Equal(MotionLaw.ClosedForm, scene.Bodies[0].Spec.Flight);
        double t = At(3).SecondsSince(default), turn = 1.5;
        BodyState end = Read(Run(scene, 3), First, 3);
        Near(V(Math.Sin(turn * t), 1 - Math.Cos(turn * t)) * (4 / turn), end.Position, 1e-12);
        Near(V(Math.Cos(turn * t), Math.Sin(turn * t)) * 4, end.Velocity, 1e-12);
        Assert.Equal(V(0, 0, 6), end.Spin);
    }

    [Fact]
    public void Friction_OfABodyWithNone_ChangesNoBit()
    {
        Scene rough = new SceneBuilder("s").AddPlane("floor", Vector3D.Up, 0.0, 0.9, 0.5).AddBody("ball", Ball(e: 0.8), V(0, 3), V(1)).Build();
        Scene smooth = new SceneBuilder("s").AddPlane("floor", Vector3D.Up, 0.0, 0.9).AddBody("ball", Ball(e: 0.8), V(0, 3), V(1)).Build();
        Assert.NotEqual(rough.Hash, smooth.Hash);
        Assert.Equal(Run(smooth, 9).EventHash(At(9)), Run(rough, 9).EventHash(At(9)));
    }

    private static Simulation OnFloor(BodySpec spec, Vector3D velocity, Vector3D spin)
    {
        Simulation world = new(new SceneBuilder("floor").AddPlane("floor", Vector3D.Up, 0.0).AddBody("ball", spec, V(0, spec.Radius), velocity, spin: spin).Build(), KeepAll);
        world.AdvanceTo(At(10));
        return world;
    }

    private static double Kinetic(Simulation world, double t) => Bodies(world).Sum(body =>
    {
        BodyState state = Read(world, body, t);
        BodySpec spec = world.SpecOf(body);
        return 0.5 * spec.Mass * (state.Velocity.LengthSquared + (0.4 * spec.Radius * spec.Radius * state.Spin.LengthSquared));
    });

    private static Vector3D AngularMomentum(Simulation world, double t) => Bodies(world).Aggregate(Vector3D.Zero, (sum, body) =>
    {
        BodyState state = Read(world, body, t);
        BodySpec spec = world.SpecOf(body);
        return sum + (Vector3D.Cross(state.Position, state.Velocity) * spec.Mass) + (state.Spin * (0.4 * spec.Mass * spec.Radius * spec.Radius));
    });
}
