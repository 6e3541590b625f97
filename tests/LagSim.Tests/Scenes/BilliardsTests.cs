using System.Linq;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Scenes;

public sealed class BilliardsTests
{
    private const double Length = 60;
    private const double Every = 0.05;
    private const double Radius = 0.028575;

    [Fact]
    public void Billiards_ForAMinute_StaysOnTheTableAndApart()
    {
        Simulation world = Run(BuiltInScenes.Billiards(), Length);
        for (double time = 0; time <= Length; time += Every)
        {
            Assert.True(MinGap(world, At(time)) > -1e-9, $"at {time} s");
            Assert.All(Bodies(world), body => Assert.Equal(Radius, Read(world, body, time).Position.Y));
        }
    }

    [Fact]
    public void MinGap_OfATableWithoutItsFootCushion_IsSeenToBeLeft()
    {
        Scene whole = BuiltInScenes.Billiards();
        SceneBuilder open = new("open");
        foreach (StaticPlane plane in whole.Planes.Where(plane => plane.Name != "foot"))
        {
            open.AddPlane(plane.Name, plane.Normal, plane.Offset, plane.Restitution);
        }

        foreach (SceneBody body in whole.Bodies)
        {
            open.AddBody(body.Name, body.Spec, body.Position, body.Velocity);
        }

        Simulation world = Run(open.Build(), 5);
        Assert.Contains(Bodies(world), body => whole.Planes[2].Gap(Read(world, body, 5).Position, Radius) < -1);
    }

    [Fact]
    public void Billiards_AfterTheBreak_HasMovedEveryBall()
    {
        Simulation world = Run(BuiltInScenes.Billiards(), 1);
        Assert.All(Bodies(world), body => Assert.True(Read(world, body, 1).Velocity.Length > 0.01));
        Assert.Equal(16, world.BodyCount);
    }

    [Fact]
    public void Billiards_AsItIs_LosesEnergyInImpactsOnlyAndWithoutAStorm()
    {
        Simulation world = Run(BuiltInScenes.Billiards(), Length);
        double last = Energy(world, At(0));
        for (double time = Every; time <= Length; time += Every)
        {
            double now = Energy(world, At(time));
            Assert.True(now <= last * (1 + 1e-14), $"at {time} s");
            last = now;
        }

        Assert.InRange(Kinetic(world, Length) / Kinetic(world, 0), 1e-4, 0.1); // it goes on, slowly
        Assert.InRange(world.ImpactsProcessed, 100, 1000);
    }

    [Fact]
    public void Billiards_Elastic_KeepsItsEnergy()
    {
        Simulation world = Run(BuiltInScenes.Billiards(1, 1), Length);
        Near(1, Energy(world, At(Length)) / Energy(world, At(0)), 1e-12);
        Assert.InRange(world.ImpactsProcessed, 1000, 5000);
    }

    [Fact]
    public void Billiards_RestitutionOutOfRange_IsRefused()
    {
        Assert.Throws<SceneException>(() => BuiltInScenes.Billiards(ballRestitution: -0.1));
        Assert.Throws<SceneException>(() => BuiltInScenes.Billiards(cushionRestitution: double.NaN));
    }

    private static double Kinetic(Simulation world, double seconds) =>
        Bodies(world).Sum(body => 0.5 * world.SpecOf(body).Mass * Read(world, body, seconds).Velocity.LengthSquared);
}
