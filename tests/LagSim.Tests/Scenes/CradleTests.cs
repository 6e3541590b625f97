using System.Linq;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Scenes;

public sealed class CradleTests
{
    private const double Period = 4;
    private const double Between = 0.1; // of a second, so that no impact is at the instant that is looked at

    [Fact]
    public void Cradle_AtAnyTime_MovesOneBallAndTheEndOnes()
    {
        // 1 s to the row, 1 s to the wall behind it, and back.
        string[] moving = ["ball 1", "ball 5", "ball 5", "ball 1"];
        Simulation world = Run(BuiltInScenes.Cradle(), 40);
        for (int second = 0; second < 40; second++)
        {
            for (int tenth = 1; tenth < 10; tenth++)
            {
                Assert.Equal([moving[second % 4]], Moving(world, second + (tenth * Between)));
            }
        }
    }

    [Fact]
    public void Cradle_AfterAThousandPeriods_IsWhatItWasToTheBit()
    {
        Simulation world = new(BuiltInScenes.Cradle());
        world.AdvanceTo(At(Between));
        BodyState[] start = Bodies(world).Select(body => Read(world, body, Between)).ToArray();
        world.AdvanceTo(At((1000 * Period) + Between));
        for (int n = 0; n < start.Length; n++)
        {
            SameBits(start[n], Read(world, BodyId.OfScene(n), (1000 * Period) + Between));
        }

        // Each way through the row is four impacts and one with a wall, twice a period; at the start five balls come down on the floor.
        Assert.Equal((1000 * 10) + 5, world.ImpactsProcessed);
    }

    [Fact]
    public void Cradle_LessThanElastic_IsSeenToBeAnother()
    {
        Simulation world = Run(BuiltInScenes.Cradle(0.9), 40);
        Assert.Equal(["ball 2", "ball 3", "ball 4", "ball 5"], Moving(world, 1.1).Where(name => name != "ball 1"));
        Assert.True(Energy(world, At(40)) < 0.99 * Energy(world, At(0)));
        Assert.False(Read(world, First, Between).IsSameBits(Read(world, First, Period + Between)));
    }

    [Fact]
    public void Cradle_RestitutionOutOfRange_IsRefused() => Assert.Throws<SceneException>(() => BuiltInScenes.Cradle(1.1));

    private static string[] Moving(Simulation world, double seconds) => Bodies(world)
        .Where(body => Read(world, body, seconds).Velocity.Length > 0)
        .Select(body => world.Scene.Bodies[body.Index].Name)
        .ToArray();
}
