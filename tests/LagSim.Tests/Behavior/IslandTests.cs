using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>Bodies in persistent contact move and rest as one: with friction against statics, without a gain of energy, and all of them wake when something happens to one.</summary>
public sealed class IslandTests
{
    private const double R = 0.5;
    private const double Fine = 1e-7; // a contact tolerance, in metres
    private const double Usual = 1e-6; // one at which a heap that moves all the time is not too long in steps

    /// <summary>A ball on two that touch, on a floor: the friction that keeps them is at least the tangent of 15 degrees, 0.268, between the balls.</summary>
    [Theory]
    [InlineData(0.1, false)]
    [InlineData(0.26, false)]
    [InlineData(0.28, true)]
    [InlineData(1, true)]
    public void Pile_OfThreeWithFriction_HoldsFromTheTangentOf15DegreesOn(double mu, bool holds)
    {
        Simulation world = new(Pile(mu), KeepAll);
        world.AdvanceTo(At(3));
        Assert.Equal(holds, Math.Abs(Read(world, Third, 3).Position.Y - (R + Math.Sqrt(0.75))) < 6 * Fine);
        Assert.Equal(holds, Read(world, First, 3).Motion == MotionLaw.Resting && Read(world, First, 3).Position.X > -R - (2 * Fine));
        Assert.True(MinGap(world, At(3)) > -2 * Fine);
        double islands = holds ? 1 : 3; // at most, in steps all the time
        Assert.InRange(world.EventsProcessed, 1, islands * 3 * Tolerance.StepsASecond(Fine));
    }

    [Theory]
    [InlineData(0)]
    [InlineData(0.4)]
    public void Piles_AtRandom_GainNoEnergyAndSinkIntoNothing(double mu)
    {
        for (int seed = 0; seed < 12; seed++)
        {
            Assert.Null(Wrong(seed, mu, (_, _) => []));
        }
    }

    /// <summary>
    /// A ball in a groove, whose sides slope by an angle of sine s and cosine k, presses each side with N = m g / (2 k) and turns on it,
    /// at speed / (R k), of which k is rolling on a side and s turning about its normal: resistance against both of c R N from each takes
    /// c g (k + s) / (k² + 2/5) from its speed.
    /// </summary>
    /// <remarks>
    /// The sides may also carry weight by friction, up or down, which nothing determines: so N may be off by the factor k / (k +- mu s),
    /// and mu is small here. It is more than rolling needs.
    /// </remarks>
    [Theory]
    [InlineData(0.02)]
    [InlineData(0)]
    public void RollingResistance_InAGroove_BringsToRest(double resistance)
    {
        const double sine = 0.6, k = 0.8, speed = 0.5, mu = 0.04;
        BodySpec ball = new(R, 1, 0, friction: mu, rollingResistance: resistance);
        Simulation world = new(
            new SceneBuilder("groove").WithContactTolerance(Fine)
                .AddPlane("left", V(sine, k), 0.0, friction: 1).AddPlane("right", V(-sine, k), 0.0, friction: 1)
                .AddBody("ball", ball, V(0, R / k), V(0, 0, speed), spin: V(speed / (R * k))).Build(),
            KeepAll);
        double brake = resistance * Gravity * (k + sine) / ((k * k) + 0.4);
        world.AdvanceTo(At(4));
        BodyState end = Read(world, First, 4);
        Assert.Equal(resistance > 0 ? MotionLaw.Resting : MotionLaw.Constrained, end.Motion);
        double way = resistance > 0 ? speed * speed / (2 * brake) : speed * 4;
        Near(way, end.Position.Z, resistance > 0 ? way * mu * sine / k : 1e-6);
    }

    /// <summary>
    /// What turns on the top of another is slowed down as that is set turning, by what both have; and once they turn as one, they go on,
    /// also asleep, which they are after half a second, since they stay at their places.
    /// </summary>
    [Fact]
    public void RollingResistance_OfOneThatTurnsOnAnother_TurnsBoth()
    {
        const double c = 0.05, turning = 2;
        BodySpec ball = new(R, 1, 0, friction: 0.5, rollingResistance: c);
        Simulation world = new(
            new SceneBuilder("two").WithContactTolerance(Fine).AddStaticSphere("bed", V(0), 1, 0, friction: 0)
                .AddBody("lower", ball, V(0, 1 + R)).AddBody("upper", ball, V(0, 1 + (3 * R)), spin: V(0, turning)).Build(),
            KeepAll);
        double rate = 2.5 * c * Gravity / R, equal = turning / (2 * rate);
        double step = rate / Tolerance.StepsASecond(Fine); // what a step changes
        Assert.True(equal < 0.45, "they turn as one before they sleep");
        world.AdvanceTo(At(3));
        Near(turning - (rate * equal / 2), Read(world, Second, equal / 2).Spin.Y, step);
        Near(rate * equal / 2, Read(world, First, equal / 2).Spin.Y, step);
        foreach (double t in new[] { 0.45, 3 })
        {
            Near(turning / 2, Read(world, Second, t).Spin.Y, step);
            Near(turning / 2, Read(world, First, t).Spin.Y, step);
        }

        Assert.Equal((MotionLaw.Constrained, MotionLaw.Resting), (Read(world, First, 0.45).Motion, Read(world, First, 3).Motion));
    }

    /// <summary>
    /// In steps that never end what turns against a resistance comes to stand, in a groove as on a floor, but for what sweeps leave: its
    /// surface does not turn by the contact tolerance in half a second. Without resistance it turns on.
    /// </summary>
    [Theory]
    [InlineData(0.02, false)]
    [InlineData(0.02, true)]
    [InlineData(0, false)]
    public void Turning_InStepsWithoutEnd_EndsInNothing(double resistance, bool isGroove)
    {
        Vector3D weight = V(0, -Gravity);
        SceneBuilder scene = new SceneBuilder("endless").WithGravity(V(0)).WithContactTolerance(Usual)
            .AddForce(Force.Supplied(new FunctionForce((_, _, _) => weight)), out ForceSet force);
        scene = isGroove ? scene.AddPlane("left", V(0.6, 0.8), 0.0).AddPlane("right", V(-0.6, 0.8), 0.0) : scene.AddPlane("floor", Vector3D.Up, 0.0);
        BodySpec ball = new(R, 1, 0, MotionLaw.Automatic, forces: force, friction: 1, rollingResistance: resistance);
        Simulation world = new(scene.AddBody("ball", ball, V(0, isGroove ? R / 0.8 : R), spin: V(0, 1)).Build());
        world.AdvanceTo(At(3));
        BodyState end = Read(world, First, 3);
        Assert.Equal(MotionLaw.Constrained, end.Motion);
        Assert.Equal(resistance > 0, end.Spin.Length * R < Usual / 0.5);
        Assert.True(resistance > 0 || end.Spin.Length > 0.99, $"{end.Spin}");
    }

    /// <summary>What is left touching, closes by rounding alone, parts by itself and falls back is struck then, not looked for when the rounding would have got deep.</summary>
    [Theory]
    [InlineData(0)]
    [InlineData(1e-9)]
    public void Touching_PartsAndFallsBack_IsStruck(double further)
    {
        Simulation world = new(
            new SceneBuilder("back").WithContactTolerance(Fine).AddPlane("floor", Vector3D.Up, 0.0, 1, 1)
                .AddBody("falls", new BodySpec(0.25, 1, 0.3, friction: 2, rollingResistance: 0.01), V(0.7414639853172622, 0.2956019980417861 + further, 0.7500000000024419),
                    V(-0.20394043781556367, 0.7189095752636673, -1.7606551020872233E-11), spin: V(2.875638301035462, 0.815761751292646, 3.831282350740072))
                .AddBody("rolls", new BodySpec(0.29552200226836, 1, 0.3, friction: 2, rollingResistance: 0.01), V(0.25323853557908804, 0.29552200226836, 0.5066275307559448),
                    V(-0.1874658218841395, 0, -0.03281314880166998), spin: V(-0.11103453736034433, -0.813787171040385, 0.6343548718714487)).Build(),
            KeepAll);
        for (int n = 1; n <= 30; n++)
        {
            world.AdvanceTo(At(0.01 * n));
            Assert.True(MinGap(world, At(0.01 * n)) > -2 * Fine, $"{MinGap(world, At(0.01 * n))} m at {0.01 * n} s");
        }
    }

    /// <summary>Beside the top of a dome a ball stays where the slope is no more than its rolling resistance.</summary>
    [Theory]
    [InlineData(0.11, true)]
    [InlineData(0.09, false)]
    public void RollingResistance_OnADome_HoldsUpToItsSlope(double resistance, bool holds)
    {
        Vector3D place = V(0.1, 1) / V(0.1, 1).Length * (2 + R);
        Simulation world = new(
            new SceneBuilder("dome").WithContactTolerance(Fine).AddStaticSphere("dome", V(0), 2, 0, friction: 1)
                .AddBody("ball", new BodySpec(R, 1, 0, friction: 1, rollingResistance: resistance), place).Build(), KeepAll);
        world.AdvanceTo(At(1));
        Assert.Equal(holds ? MotionLaw.Resting : MotionLaw.Constrained, Read(world, First, 1).Motion);
        Assert.Equal(holds, (Read(world, First, 1).Position - place).Length < 2 * Fine);
    }

    /// <summary>The control: a world that lets its balls go a fiftieth too fast, twenty times a second, is seen to gain energy in each of the piles.</summary>
    [Theory]
    [InlineData(0)]
    [InlineData(0.4)]
    public void Piles_WhoseBallsBecomeFaster_AreSeenToGainEnergy(double mu)
    {
        for (int seed = 0; seed < 12; seed++)
        {
            Assert.Contains(" J more at ", Wrong(seed, mu, (world, t) => Bodies(world).Select((body, n) =>
                ExternalEvent.SetVelocity(At(t), 1, (uint)((Math.Round(t * 20) * 8) + n), body, Read(world, body, t).Velocity * 1.02))), StringComparison.Ordinal);
        }
    }

    /// <summary>And one that puts a ball twice as deep as it may be into what it lies on is seen to do so.</summary>
    [Fact]
    public void Piles_WhoseBallsSink_AreSeenToSink()
    {
        Assert.Contains(" m at ", Wrong(0, 0.4, (world, t) =>
        {
            Vector3D first = Read(world, First, t).Position, second = Read(world, Second, t).Position;
            Vector3D into = second + ((first - second) / (first - second).Length * ((2 * R) - (4 * Usual)));
            return t < 1 ? [] : [ExternalEvent.Teleport(At(t), 1, (uint)Math.Round(t * 20), First, into)];
        }), StringComparison.Ordinal);
    }

    /// <summary>What is done to one of an island that rests is done to what lay on it too, late or in time.</summary>
    [Theory]
    [InlineData(EventKind.Remove)]
    [InlineData(EventKind.Teleport)]
    [InlineData(EventKind.SetVelocity)]
    [InlineData(EventKind.Grab)]
    public void Stack_WhoseLowerBallIsTakenAway_Falls(EventKind kind)
    {
        ExternalEvent taken = kind switch
        {
            EventKind.Remove => ExternalEvent.Remove(At(1), 1, 1, First),
            EventKind.Teleport => ExternalEvent.Teleport(At(1), 1, 1, First, V(10, 3), V(0)),
            EventKind.SetVelocity => ExternalEvent.SetVelocity(At(1), 1, 1, First, V(20)),
            _ => ExternalEvent.Grab(At(1), 1, 1, First),
        };
        Scene scene = new SceneBuilder("stack").AddPlane("floor", Vector3D.Up, V(0), 0.5).AddBody("below", Ball(e: 0.5), V(0, R)).AddBody("above", Ball(e: 0.5), V(0, 3 * R)).Build();
        Simulation world = new(scene, KeepAll);
        world.Submit(taken);
        Simulation late = new(scene, KeepAll);
        late.AdvanceTo(At(2));
        Assert.Equal(MotionLaw.Resting, Read(late, Second, 2).Motion);
        late.Submit(taken);
        foreach (Simulation simulation in new[] { world, late })
        {
            if (kind == EventKind.Grab)
            {
                simulation.Submit(ExternalEvent.HoldKeyframe(At(1.1), 1, 2, First, V(5, R), V(0)));
            }

            simulation.AdvanceTo(At(2));
        }

        Assert.True(Read(world, Second, 1.6).Position.Y < 3 * R - 0.1, $"{Read(world, Second, 1.6).Position.Y} m");
        Assert.Equal(world.StateHash(At(2)), late.StateHash(At(2)));
        Assert.Equal(world.EventHash(At(2)), late.EventHash(At(2)));
    }

    /// <summary>A spring that pulls through a floor: the ball comes to rest where both hold it.</summary>
    [Fact]
    public void Spring_ThroughAFloor_EndsAtRest()
    {
        Scene scene = new SceneBuilder("spring").WithContactTolerance(Fine).AddPlane("floor", Vector3D.Up, V(0), 0.3)
            .AddForce(Force.Spring("spring", V(0, -1), 40, 4), out ForceSet spring)
            .AddBody("ball", new BodySpec(R, 1, 0.3, forces: spring), V(0.4, 1)).Build();
        Simulation world = new(scene, KeepAll);
        world.AdvanceTo(At(20));
        BodyState state = Read(world, First, 20);
        // It swings to and fro over its end at 6 rad/s: who does not move by d in half a second has less than d to go.
        Near(V(0, R), state.Position, Fine);
        Assert.Equal(MotionLaw.Resting, state.Motion);
    }

    /// <summary>What is wrong with a heap that falls for two seconds, to which something is done after each look; null if nothing is.</summary>
    private static string? Wrong(int seed, double mu, Func<Simulation, double, IEnumerable<ExternalEvent>> fault)
    {
        Simulation world = new(Heap(seed, mu), KeepAll);
        double last = Energy(world, At(0)), off = 0, weight = Bodies(world).Sum(body => world.SpecOf(body).Mass) * Gravity;
        for (double t = 0.05; t <= 2; t += 0.05)
        {
            world.AdvanceTo(At(t));
            double energy = Energy(world, At(t)) + Turning(world, At(t));

            // What was 2 d deep is pushed out. Velocities are those of the middle of a step, by when weight and friction have done work.
            double before = off;
            off = Bodies(world).Max(body => Read(world, body, t).Velocity.Length) * weight / Tolerance.StepsASecond(Usual);
            if (!(energy <= last + (weight * 2 * Usual) + before + off))
            {
                return $"seed {seed}: {energy - last} J more at {t} s";
            }

            last = energy;
            foreach (ExternalEvent external in fault(world, t).ToArray())
            {
                world.Submit(external);
            }

            world.AdvanceTo(At(t));
            double gap = MinGap(world, At(t));
            if (!(gap > -2 * Usual))
            {
                return $"seed {seed}: {gap} m at {t} s";
            }
        }

        // As if each ball were an island of its own, always in steps: those on the floor that are not taken in are struck 20 times a step.
        double most = 2 * Tolerance.StepsASecond(Usual) * world.BodyCount;
        return world.EventsProcessed <= most ? null : $"seed {seed}: {world.EventsProcessed} events";
    }

    private static Scene Pile(double mu) => new SceneBuilder("pile").WithContactTolerance(Fine)
        .AddPlane("floor", Vector3D.Up, V(0), 0.5).AddBody("left", Rough(mu), V(-R, R)).AddBody("right", Rough(mu), V(R, R))
        .AddBody("top", Rough(mu), V(0, R + Math.Sqrt(0.75))).Build();

    private static BodySpec Rough(double mu) => new(R, 1, 0.5, friction: mu);

    private static Scene Heap(int seed, double mu)
    {
        Random random = new(seed);
        SceneBuilder builder = new SceneBuilder("heap").WithContactTolerance(Usual)
            .AddPlane("floor", Vector3D.Up, V(0), 0.4).AddPlane("west", V(1), V(-1.1), 0.4).AddPlane("east", V(-1), V(1.1), 0.4)
            .AddPlane("back", V(0, 0, 1), V(0, 0, -0.8), 0.4).AddPlane("front", V(0, 0, -1), V(0, 0, 0.8), 0.4);
        for (int i = 0; i < 5; i++)
        {
            builder.AddBody($"ball {i}", new BodySpec(R, random.Next(1, 4), 0.4, friction: mu), V((random.NextDouble() - 0.5) * 1.1, R + (1.05 * i), (random.NextDouble() - 0.5) * 0.5));
        }

        return builder.Build();
    }

    private static double Turning(Simulation world, SimTime time)
    {
        double sum = 0;
        foreach (BodyId body in Bodies(world))
        {
            sum += 0.2 * world.SpecOf(body).Mass * R * R * Read(world, body, time).Spin.LengthSquared;
        }

        return sum;
    }
}
