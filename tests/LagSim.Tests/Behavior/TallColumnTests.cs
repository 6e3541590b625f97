using System;
using LagSim.Contacts;
using LagSim.Scenes;
using LagSim.Tests.Faults;
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
        (double off, MotionLaw motion, _) = Run(Column(balls, restitution, gap));
        Assert.InRange(off, 0, 0.02 * Fine);
        Assert.Equal(MotionLaw.Resting, motion);
    }

    [Fact]
    public void Column_BySweepsAlone_IsSeenToSink()
    {
        Simulation world = Column(64, 0, 0, new FaultySolverRules { SweepsAlone = true });
        (double off, MotionLaw motion, _) = Run(world);
        Assert.True(off > 2 * Fine, $"{off} m");
        Assert.Equal(MotionLaw.Constrained, motion);
    }

    /// <summary>
    /// Rule 6: what sweeps alone leave of a column overlaps; pushed out without a bound it throws the top into the air.
    /// </summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Column_ThatHasSunk_IsPushedOutWithoutMakingEnergy(bool gains)
    {
        Simulation world = Column(64, 0, 0, new FaultySolverRules { SweepsAlone = true, GainsEnergy = gains });
        (_, _, double gain) = Run(world);
        Assert.Equal(gains, gain > 2);
    }

    private const double Fine = 1e-3;

    private static Simulation Column(int balls, double restitution, double gap, SolverRules? rules = null)
    {
        SceneBuilder builder = new SceneBuilder("column").WithContactTolerance(Fine).AddPlane("floor", Vector3D.Up, 0.0, restitution);
        for (int n = 0; n < balls; n++)
        {
            builder.AddBody($"ball {n}", new BodySpec(Radius, 1, restitution, friction: 0.5), V(0, Radius + (((2 * Radius) + gap) * n)));
        }

        FaultyEngineParts parts = new() { Rules = rules ?? SolverRules.Usual };
        return new Simulation(builder.Build(), new SimulationOptions().WithParts(parts));
    }

    /// <summary>How far from its place the top is after 4 s, how it moves, and how much energy was gained meanwhile, in J.</summary>
    private static (double Off, MotionLaw Motion, double Gain) Run(Simulation world)
    {
        double start = Energy(world, At(0));
        double gain = 0;
        for (double t = 0.02; t <= 4; t += 0.02)
        {
            world.AdvanceTo(At(t));
            gain = Math.Max(gain, Energy(world, At(t)) - start);
        }

        world.AdvanceTo(At(4));
        int balls = world.BodyCount;
        BodyState top = Read(world, BodyId.OfScene(balls - 1), 4);
        return (Math.Abs(top.Position.Y - (Radius * ((2 * balls) - 1))), top.Motion, gain);
    }
}
