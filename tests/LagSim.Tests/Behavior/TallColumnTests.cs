using System;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>
/// A column of many balls stands, and sleeps (docs/CONTACT.md, rule 4). The control is a world whose normals are solved by sweeps alone.
/// </summary>
public sealed class TallColumnTests
{
    private const double Radius = 0.1;

    [Theory]
    [InlineData(64, 0, 0)]
    [InlineData(64, 1, 0)]
    [InlineData(200, 0.5, 0)]
    [InlineData(64, 0, 1e-4)]
    public void Column_PutDownAtRest_Stands(int balls, double restitution, double gap)
    {
        (double off, MotionLaw motion) = Run(balls, restitution, gap, sweepsAlone: false);
        Assert.InRange(off, 0, 0.02 * Fine);
        Assert.Equal(MotionLaw.Resting, motion);
    }

    [Fact]
    public void Column_BySweepsAlone_IsSeenToSink()
    {
        (double off, MotionLaw motion) = Run(64, 0, 0, sweepsAlone: true);
        Assert.True(off > 2 * Fine, $"{off} m");
        Assert.Equal(MotionLaw.Constrained, motion);
    }

    private const double Fine = 1e-3;

    /// <summary>How far from its place the top is after 4 s, and how it moves.</summary>
    private static (double Off, MotionLaw Motion) Run(int balls, double restitution, double gap, bool sweepsAlone)
    {
        SceneBuilder builder = new SceneBuilder("column").WithContactTolerance(Fine).AddPlane("floor", Vector3D.Up, 0.0, restitution);
        for (int n = 0; n < balls; n++)
        {
            builder.AddBody($"ball {n}", new BodySpec(Radius, 1, restitution, friction: 0.5), V(0, Radius + (((2 * Radius) + gap) * n)));
        }

        Simulation world = new(builder.Build()) { SweepsAlone = sweepsAlone };
        world.AdvanceTo(At(4));
        BodyState top = Read(world, BodyId.OfScene(balls - 1), 4);
        return (Math.Abs(top.Position.Y - (Radius * ((2 * balls) - 1))), top.Motion);
    }
}
