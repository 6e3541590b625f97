using System;
using System.Linq;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Numerics;

/// <summary>Ten micrometres at a thousand kilometres a second, and worlds a thousand kilometres from the origin.</summary>
public sealed class SmallFastFarTests
{
    private const double Radius = 1e-5;
    private const double Speed = 1e6;

    [Theory]
    [InlineData(MotionLaw.Ballistic, 1)]
    [InlineData(MotionLaw.Ballistic, 1000)]
    [InlineData(MotionLaw.RungeKutta4, 1)]
    [InlineData(MotionLaw.RungeKutta4, 7)]
    public void SmallAndFast_HeadOnAgainstEachOther_NeverPass(MotionLaw flight, int frames)
    {
        Scene scene = new SceneBuilder("bullets").WithGravity(Floating)
            .AddBody("left", Bullet(flight), V(-1), V(Speed)).AddBody("right", Bullet(flight), V(1.37), V(-Speed)).Build();
        Simulation simulation = InFrames(scene, 3e-6, frames);
        double expected = (2.37 - (2 * Radius)) / (2 * Speed);
        Near(expected, Assert.Single(Impacts(simulation, First)).Key.Time.ToSeconds(), 1e-12);
        Assert.Equal(-Speed, Read(simulation, First, 3e-6).Velocity.X);
        Assert.True(MinGapOver(simulation, 3e-6) > -1e-9);
    }

    [Theory]
    [InlineData(MotionLaw.Ballistic)]
    [InlineData(MotionLaw.RungeKutta4)]
    public void SmallAndFast_AgainstAPlaneAndAStaticSphere_BouncesBetweenThem(MotionLaw flight)
    {
        // 1 m between the two surfaces: a million bounces a second.
        Scene scene = new SceneBuilder("rattle").WithGravity(Floating).AddPlane("wall", V(1), V(0)).AddStaticSphere("post", V(1 + 1e-4), 1e-4)
            .AddBody("bullet", Bullet(flight), V(0.3), V(Speed)).Build();
        Simulation simulation = InFrames(scene, 1e-4, 13);
        double lap = 1 - (2 * Radius);
        int expected = (int)(((1e-4 * Speed) - (1 - Radius - 0.3)) / lap) + 1;
        Assert.Equal(expected, Impacts(simulation, First).Count);
        Assert.True(MinGapOver(simulation, 1e-4) > -1e-9);
    }

    [Fact]
    public void SmallAndFast_SteppedOneByOneMicrosecond_WouldPass()
    {
        // The negative control: whoever looks once a microsecond sees the two apart and on the wrong sides, never touching.
        double[] gaps = Enumerable.Range(0, 4).Select(i => Math.Abs((-1 + (i * 1e-6 * Speed)) - (1.37 - (i * 1e-6 * Speed))) - (2 * Radius)).ToArray();
        Assert.All(gaps, gap => Assert.True(gap > 0));
    }

    [Fact]
    public void FarFromTheOrigin_EventsAreTheSameInTheSameOrder()
    {
        Simulation near = Run(Cluster(0), 3), far = Run(Cluster(1e6), 3), other = Run(Cluster(0, nudge: 1e-3), 3);
        Assert.Equal(Story(near), Story(far));
        Assert.NotEqual(Story(near), Story(other)); // the check sees another order where there is one
        double[] a = Times(near), b = Times(far);
        double worst = a.Zip(b, (x, y) => Math.Abs(x - y)).Max();
        Assert.InRange(worst, 0, 1e-6); // the loss: an ulp of 1e6 m is 1.2e-10 m, and every hit magnifies it
    }

    [Fact]
    public void LargeCoordinates_BallAtAMillionMetres_BouncesOnTime()
    {
        Scene scene = new SceneBuilder("far").AddPlane("floor", Vector3D.Up, V(0, 1e6)).AddBody("ball", Ball(), V(1e6, 1e6 + 1.5, -1e6), V(3, 0, 1)).Build();
        Simulation simulation = Run(scene, 100);
        double t1 = Math.Sqrt(2 / Gravity);
        var impacts = Impacts(simulation, First);
        for (int n = 1; n <= impacts.Count; n++)
        {
            Near(((2 * n) - 1) * t1, impacts[n - 1].Key.Time.ToSeconds(), 1e-8);
        }

        Assert.True(impacts.Count > 100);
    }

    private static BodySpec Bullet(MotionLaw flight) => Ball(Radius, flight: flight, step: flight == MotionLaw.RungeKutta4 ? 1e-6 : 0);

    private static Simulation InFrames(Scene scene, double seconds, int frames)
    {
        Simulation simulation = new(scene, KeepAll);
        for (int i = 1; i <= frames; i++)
        {
            simulation.AdvanceTo(At(seconds * i / frames));
        }

        return simulation;
    }

    private static double MinGapOver(Simulation simulation, double seconds) =>
        Enumerable.Range(0, 5001).Min(i => MinGap(simulation, SimTime.FromTicks(At(seconds).Ticks / 5000 * i)));

    private static Scene Cluster(double offset, double nudge = 0)
    {
        Random random = new(11);
        SceneBuilder builder = new SceneBuilder("cluster").AddPlane("floor", Vector3D.Up, V(offset, offset, offset), 0.9)
            .AddPlane("left", V(1), V(offset - 3)).AddPlane("right", V(-1), V(offset + 3));
        for (int i = 0; i < 5; i++)
        {
            Vector3D x = V(offset - 2.25 + i + (i == 2 ? nudge : 0), offset + 1 + (random.Next(1 << 16) / 65536.0), offset);
            builder.AddBody($"ball {i}", Ball(0.25, 1 + i), x, V(random.Next(-8, 8) / 4.0, 0, 0));
        }

        return builder.Build();
    }

    private static string[] Story(Simulation simulation) => Bodies(simulation)
        .SelectMany(body => Impacts(simulation, body)).Select(entry => entry.Key).Distinct().Order()
        .Select(key => $"{key.Body}/{key.Other}").Take(30).ToArray();

    private static double[] Times(Simulation simulation) => Bodies(simulation)
        .SelectMany(body => Impacts(simulation, body)).Select(entry => entry.Key).Distinct().Order()
        .Select(key => key.Time.ToSeconds()).Take(30).ToArray();
}
