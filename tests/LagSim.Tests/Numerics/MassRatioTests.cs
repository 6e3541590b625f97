using System;
using System.Linq;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Numerics;

/// <summary>Elastic balls of very different masses, and several that meet at once.</summary>
public sealed class MassRatioTests
{
    [Theory]
    [InlineData(1, 1)]
    [InlineData(1, 3)]
    [InlineData(1, 1e6)]
    [InlineData(1, 1e12)]
    [InlineData(1e12, 1)]
    [InlineData(1e-12, 1e12)]
    public void TwoBalls_HeadOn_ExchangeWhatTheClosedFormSays(double m1, double m2)
    {
        Scene scene = Line((m1, 0, 1), (m2, 3, 0));
        Simulation simulation = Run(scene, 4);
        Vector3D u1 = Read(simulation, First, 4).Velocity, u2 = Read(simulation, Second, 4).Velocity;
        double ulp = 4 * Math.BitIncrement(1.0) - 4;
        Near((m1 - m2) / (m1 + m2), u1.X, ulp);
        Near(2 * m1 / (m1 + m2), u2.X, ulp * (2 * m1 / (m1 + m2)));
        Near(m1, Momentum(simulation, At(4)).X, ulp * Math.Max(m1, Math.Abs(m1 * u1.X)));
        Near(0.5 * m1, Energy(simulation, At(4)), ulp * m1);
    }

    [Fact]
    public void Line_MassesTwelveDecadesApart_KeepsMomentumAndEnergy()
    {
        Scene scene = Line((1, 0, 1), (1e12, 2, 0), (1e-3, 4, 0), (1e6, 7, -0.5), (1, 9, -2));
        Simulation simulation = Run(scene, 60);
        Assert.True(Impacts(simulation, Third).Count > 5);
        double impulse = 1e6; // the largest momentum that was exchanged is of the order of the 1e6 kg ball's
        Near(Momentum(simulation, At(0)).X, Momentum(simulation, At(60)).X, impulse * 1e-14);
        double energy = Energy(simulation, At(0));
        Near(energy, Energy(simulation, At(60)), energy * 2e-16 * simulation.EventsProcessed); // an ulp an impact
    }

    [Fact]
    public void Break_TwoTouchingBallsHitInTheMiddle_IsSymmetric()
    {
        double z = 0.5;
        Scene scene = new SceneBuilder("break").WithGravity(Floating)
            .AddBody("cue", Ball(), V(-3), V(2)).AddBody("left", Ball(), V(0, 0, -z)).AddBody("right", Ball(), V(0, 0, z)).Build();
        Simulation simulation = Run(scene, 3);
        Vector3D cue = Read(simulation, First, 3).Velocity, left = Read(simulation, Second, 3).Velocity, right = Read(simulation, Third, 3).Velocity;
        double ulps = 4 * (Math.BitIncrement(1.0) - 1); // two contacts are solved one into the other: each costs an ulp or two
        Near(0, cue.Z, ulps);
        Near(right.X, left.X, ulps);
        Near(right.Z, -left.Z, ulps);
        Near(2 * -0.2, cue.X, 1e-14); // both at once: the cue comes back with a fifth
        Near(2 * 0.6, left.X, 1e-14);
    }

    [Theory]
    [InlineData(1, 0)]
    [InlineData(5, 1e-15)]
    [InlineData(1e12, 1e-15)]
    [InlineData(1e-12, 1e-11)] // the simultaneous solution loses the mass ratio in ulp
    public void Middle_HitFromBothSidesAtOnce_StaysWhereItIs(double mass, double tolerance)
    {
        Scene scene = Line((1, -3, 1), (mass, 0, 0), (1, 3, -1));
        Simulation simulation = Run(scene, 5);
        Near(0, Read(simulation, Second, 5).Velocity.X, tolerance);
        Near(-1, Read(simulation, First, 5).Velocity.X, tolerance);
        Near(1, Read(simulation, Third, 5).Velocity.X, tolerance);
        Assert.Single(Impacts(simulation, Second));
    }

    [Fact]
    public void Impact_BodiesInAnyOrderInTheScene_GivesTheSameMotion()
    {
        (double Mass, Vector3D X, Vector3D V)[] balls =
        [
            (1, V(-3, 0, 0), V(2)), (3, V(0, 0, -0.5), V(0)), (1.5, V(0, 0, 0.5), V(0)), (0.25, V(0.9, 0.1, 0), V(0)), (7, V(0, 5, 0), V(0, -2)),
        ];
        int[] straight = [0, 1, 2, 3, 4];
        Vector3D[] expected = Final(balls, straight);
        foreach (int[] order in new int[][] { [4, 3, 2, 1, 0], [1, 0, 2, 4, 3], [2, 4, 0, 3, 1], [3, 1, 4, 0, 2] })
        {
            Vector3D[] actual = Final(balls, order);
            for (int i = 0; i < balls.Length; i++)
            {
                Near(expected[i], actual[i], 1e-12);
            }
        }

        Assert.True((Final([.. balls[..1], (3.0001, balls[1].X, balls[1].V), .. balls[2..]], straight)[0] - expected[0]).Length > 1e-12);
    }

    [Theory]
    [InlineData(1e3, 1)]
    [InlineData(1e3, 0.9)]
    [InlineData(1e12, 0.9)]
    [InlineData(1e13, 0.5)]
    [InlineData(1e30, 0.9)]
    [InlineData(1e14, 1)]
    [InlineData(1e30, 1)]
    public void LightBallJammedAgainstAWall_ByAHeavyOne_EndsWithoutPassing(double ratio, double e)
    {
        Simulation simulation = Run(Squeeze(ratio, e), 3);
        Assert.InRange(simulation.EventsProcessed, 2, 10_000);
        Assert.True(MinGap(simulation, At(3)) >= -1e-9);
        Assert.True(Energy(simulation, At(3)) <= Energy(simulation, At(0)) * (1 + 1e-14));
    }

    private static Scene Squeeze(double ratio, double e) => new SceneBuilder("squeeze").WithGravity(Floating).AddPlane("wall", V(1), V(0), e)
        .AddBody("light", Ball(e: e), V(0.5)).AddBody("heavy", Ball(mass: ratio, e: e), V(2), V(-1)).Build();

    private static Scene Line(params (double Mass, double X, double Speed)[] balls)
    {
        SceneBuilder builder = new SceneBuilder("line").WithGravity(Floating);
        for (int i = 0; i < balls.Length; i++)
        {
            builder.AddBody($"ball {i}", Ball(mass: balls[i].Mass), V(balls[i].X), V(balls[i].Speed));
        }

        return builder.Build();
    }

    private static Vector3D[] Final((double Mass, Vector3D X, Vector3D V)[] balls, int[] order)
    {
        SceneBuilder builder = new SceneBuilder("permuted").WithGravity(Floating);
        foreach (int i in order)
        {
            builder.AddBody($"ball {i}", Ball(mass: balls[i].Mass), balls[i].X, balls[i].V);
        }

        Simulation simulation = Run(builder.Build(), 3);
        return Enumerable.Range(0, balls.Length).Select(i => Read(simulation, simulation.Scene.BodyNamed($"ball {i}"), 3).Velocity).ToArray();
    }
}
