using System;
using System.Linq;
using LagSim.Contacts;
using LagSim.Scenes;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Numerics;

/// <summary>Rolling resistance on what slips: by closed form on a plane, and the same in an island's steps.</summary>
public sealed class ResistedSlipTests
{
    private const double R = 0.5;

    /// <summary>Thrown without spin it slips for 2 v / ((7 mu - 5 c) g), for resistance holds back the turning that ends it; where c is mu it never turns.</summary>
    [Theory]
    [InlineData(0.3, 0.1)]
    [InlineData(0.3, 0.29)]
    [InlineData(0.3, 0.3)]
    public void ThrownWithoutSpin_SlipsForLonger(double mu, double c)
    {
        const double v = 2;
        double slips = 2 * v / (((7 * mu) - (5 * c)) * Gravity), left = v - (mu * Gravity * slips);
        Simulation world = OnFloor(Ball(mu, c), v, 0);
        BodyState half = Read(world, First, slips / 2);
        Assert.Equal(MotionLaw.Sliding, half.Motion);
        Near(v - (mu * Gravity * slips / 2), half.Velocity.X, 1e-10);
        Near(2.5 * (mu - c) * Gravity * slips / 2, -half.Spin.Z * R, 1e-10);
        if (c < mu)
        {
            TimelineEntry rolls = world.Timeline(First).First(entry => entry.State.Motion == MotionLaw.Rolling);
            Near(slips, rolls.Key.Time.SecondsSince(default), 1e-11);
            Near(left, rolls.State.Velocity.X, 1e-10);
        }

        BodyState end = Read(world, First, 10);
        Assert.Equal((MotionLaw.Resting, Vector3D.Zero), (end.Motion, end.Spin));
        Near(((v + left) * slips / 2) + (left * left / (2 * 5.0 / 7 * c * Gravity)), end.Position.X, 1e-9);
    }

    /// <summary>A backspin is stopped by friction and resistance together; from there on resistance is against the way.</summary>
    [Fact]
    public void Backspin_IsStoppedByBoth()
    {
        const double mu = 0.3, c = 0.1, stops = 3 / (2.5 * (mu + c) * Gravity);
        Simulation world = OnFloor(Ball(mu, c), 3, 3 / R);
        Near(3 / R / 2, Read(world, First, stops / 2).Spin.Z, 1e-10);
        Near(-2.5 * (mu - c) * Gravity * 0.1 / R, Read(world, First, stops + 0.1).Spin.Z, 1e-9);
    }

    /// <summary>Down a slope resistance needs friction too, 5/7 c of what presses: where that is lacking a ball slips that would roll without it.</summary>
    [Theory]
    [InlineData(0.24, 0.05, MotionLaw.Sliding)]
    [InlineData(0.26, 0.05, MotionLaw.Rolling)]
    [InlineData(0.24, 0, MotionLaw.Rolling)]
    public void DownASlope_ResistanceNeedsFriction(double mu, double c, MotionLaw law)
    {
        Vector3D normal = V(-0.6, 0.8); // 2/7 of 3/4 is 0.214
        Simulation world = Run(new SceneBuilder("slope").AddPlane("slope", normal, 0.0).AddBody("ball", Ball(mu, c), normal * R).Build(), 1);
        BodyState end = Read(world, First, 1);
        Assert.Equal(law, end.Motion);
        double slip = (end.Velocity - (Vector3D.Cross(end.Spin, normal) * R)).Length;
        Near(law == MotionLaw.Rolling ? 0 : (0.6 + (((2.5 * c) - (3.5 * mu)) * 0.8)) * Gravity, slip, 1e-9);
    }

    /// <summary>Thrown at random on a floor or a slope, turning about any axis: the closed form goes where an island's steps go, up to what friction and resistance change in a step.</summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void ClosedForm_AndAnIslandsSteps_Agree(bool isSlope)
    {
        Random random = new(3);
        for (int n = 0; n < 20; n++)
        {
            double mu = 0.1 + (0.9 * random.NextDouble()), c = mu * random.NextDouble();
            Vector3D velocity = Any(2), spin = Any(8);
            Assert.InRange(Apart(isSlope, mu, c, c, velocity, spin), 0, 0.5);
        }

        Vector3D Any(double size) => V(Part(size), Part(size), Part(size));
        double Part(double size) => size * ((2 * random.NextDouble()) - 1);
    }

    /// <summary>The control: steps without resistance, or with one that is a fifth less, part from the closed form.</summary>
    [Theory]
    [InlineData(0)]
    [InlineData(0.16)]
    public void Control_AnotherResistance_IsSeen(double other) => Assert.True(Apart(false, 0.4, 0.2, other, V(2, 0, 1), V(3, 5, -4)) > 2);

    /// <summary>While bounces too low to be resolved are left out resistance acts on what turns about the normal, and does not turn it back.</summary>
    [Theory]
    [InlineData(3)]
    [InlineData(0.01)]
    public void Pivoting_WhileBouncesAreLeftOut_IsSlowedDown(double turning)
    {
        BodySpec ball = new(R, 1, 0.999, friction: 0.5, rollingResistance: 0.02);
        Simulation world = Run(new SceneBuilder("low").AddPlane("floor", Vector3D.Up, 0.0, 1).AddBody("ball", ball, V(0, R + 5e-10), spin: V(0, turning)).Build(), 10);
        TimelineEntry low = world.Timeline(First).First(entry => entry.State.Motion == MotionLaw.Sliding);
        TimelineEntry after = world.Timeline(First).First(entry => entry.Key.Time > low.Key.Time);
        double left = after.Key.Time.SecondsSince(low.Key.Time), rate = 2.5 * 0.02 * Gravity / R;
        Assert.InRange(left, 0.015, 0.03);
        Near(Math.Max(0, turning - (rate * left)), after.State.Spin.Y, 1e-9);
        Near(turning - Math.Min(rate * left, turning) / 2, Read(world, First, low.Key.Time.SecondsSince(default) + (left / 2)).Spin.Y, 1e-9);
        Assert.Equal((MotionLaw.Resting, Vector3D.Zero), (Read(world, First, 10).Motion, Read(world, First, 10).Spin));
    }

    /// <summary>How far a ball under gravity and one under a program's own weight, which moves in steps, get apart in velocity, turning or way; by what may be.</summary>
    private static double Apart(bool isSlope, double mu, double c, double inSteps, Vector3D velocity, Vector3D spin)
    {
        Vector3D normal = isSlope ? V(-0.6, 0.8) : V(0, 1), weight = V(0, -Gravity);
        velocity -= normal * Vector3D.Dot(normal, velocity);
        Simulation closed = Run(new SceneBuilder("closed").AddPlane("plane", normal, 0.0).AddBody("ball", Ball(mu, c), normal * R, velocity, spin: spin).Build(), 1);
        SceneBuilder steps = new SceneBuilder("steps").WithContactTolerance(1e-6).WithGravity(Floating).AddForce(Force.Supplied(new FunctionForce((_, _, _) => weight)), out ForceSet force).AddPlane("plane", normal, 0.0);
        Simulation stepped = Run(
            steps.AddBody("ball", new BodySpec(R, 1, 0, MotionLaw.Automatic, forces: force, friction: mu, rollingResistance: inSteps), normal * R, velocity, spin: spin).Build(), 1);
        double longest = new ContactScale(stepped.Scene.ContactTolerance, stepped.Scene.Gravity, default).Step.ToSeconds();
        double change = Gravity * (1 + (3.5 * mu) + (2.5 * c)) * longest, apart = 0; // of a speed in a step
        for (double t = 0.05; t <= 1; t += 0.05)
        {
            BodyState a = Read(closed, First, t), b = Read(stepped, First, t);
            Assert.Equal(MotionLaw.Constrained, b.Motion);
            apart = Math.Max(apart, Math.Max((a.Velocity - b.Velocity).Length, Math.Max((a.Spin - b.Spin).Length * R, (a.Position - b.Position).Length / t)) / change);
        }

        return apart;
    }

    private static BodySpec Ball(double mu, double c) => new(R, 1, 0, friction: mu, rollingResistance: c);

    private static Simulation OnFloor(BodySpec ball, double v, double spin) =>
        Run(new SceneBuilder("floor").AddPlane("floor", Vector3D.Up, 0.0).AddBody("ball", ball, V(0, R), V(v), spin: V(0, 0, spin)).Build(), 10);

    /// <summary>
    /// However little a ball turns, and with whatever resistance: the direction in which it turns follows that of the slip in no time then, and takes no pieces
    /// for it.
    /// </summary>
    [Theory]
    [InlineData(0.9)]
    [InlineData(0.9999)]
    [InlineData(1)]
    [InlineData(3)]
    public void Slip_WhateverItTurns_TakesFewEvents(double resistanceByFriction)
    {
        Random random = new(11);
        double Within(double most) => most * ((2 * random.NextDouble()) - 1);
        for (int n = 0; n < 60; n++)
        {
            double mu = new[] { 0.05, 0.1, 0.3, 0.5, 1 }[n % 5], tilt = n % 2 == 0 ? 0 : 0.3 * random.NextDouble(), turning = Math.Pow(10, -9 + (n % 10));
            Vector3D up = V(Math.Sin(tilt), Math.Cos(tilt)), across = V(0, 0, 1), along = Vector3D.Cross(up, across);
            BodySpec ball = new(0.1, 1, 0, friction: mu, rollingResistance: Math.Min(1, mu * resistanceByFriction));
            Vector3D velocity = (along * Within(1)) + (across * Within(1)), spin = V(Within(turning), Within(turning), Within(turning));
            Simulation world = new(new SceneBuilder("slope").AddPlane("slope", up, 0.0).AddBody("ball", ball, up * 0.1, velocity, spin: spin).Build());
            for (double t = 0.025; t <= 1; t += 0.025)
            {
                long left = 2000;
                Assert.True(world.TryAdvanceTo(At(t), ref left) && left >= 1000, $"{n}: {2000 - left} events before {t} s");
            }
        }
    }
}
