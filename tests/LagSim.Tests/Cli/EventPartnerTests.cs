using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.SceneFiles.Runs;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>Whom a body met, where one impact has many parties.</summary>
public sealed class EventPartnerTests
{
    [Fact]
    public void Partner_InARowStruckFromBothEnds_IsTheNeighbour()
    {
        // One impact of three parties, which is named by its first and second.
        Assert.Equal(
            ["left-middle", "middle-left", "right-middle"],
            Met(Row().AddBody("left", Ball(), X(-3), X(1)).AddBody("middle", Ball(), X(0)).AddBody("right", Ball(), X(3), X(-1))));

        // The same with the one in the middle last: the two at the ends are nobody's neighbours.
        Assert.Equal(
            ["left-middle", "middle-left", "right-middle"],
            Met(Row().AddBody("left", Ball(), X(-3), X(1)).AddBody("right", Ball(), X(3), X(-1)).AddBody("middle", Ball(), X(0))));
    }

    [Fact]
    public void Partner_OfARowThatLeansOnAWall_IsTheNeighbourOrTheWall() =>
        Assert.Equal(
            ["a-b", "b-a", "b-c", "c-b", "c-wall"],
            Met(Row().AddPlane("wall", X(-1), X(4)).AddBody("a", Ball(), X(-3), X(1)).AddBody("b", Ball(), X(0)).AddBody("c", Ball(), X(3))));

    [Theory]
    [InlineData(0)]
    [InlineData(0.4)]
    [InlineData(-0.4)]
    public void Partner_OfABallThatSlidesIntoAWall_IsTheWallAndNotTheFloor(double lean)
    {
        // The floor is as near as the wall, and nearer by rounding.
        SceneBuilder scene = new SceneBuilder("corner").AddPlane("floor", Vector3D.Up, Vector3D.Zero)
            .AddPlane("wall", new Vector3D(-1, lean, 0), X(5)).AddPlane("far", X(1), X(-7))
            .AddBody("ball", new BodySpec(0.7, 1, 0), new Vector3D(-1, 0.7, 0), X(7));
        Assert.Contains("ball-wall", Met(scene));
    }

    [Fact]
    public void Partner_OfAStaticSphere_IsThatSphere() =>
        Assert.Equal(["ball-rock"], Met(Row().AddPlane("floor", Vector3D.Up, Vector3D.Zero).AddStaticSphere("rock", new Vector3D(0, 1, 0), 1)
            .AddBody("ball", Ball(), new Vector3D(-3, 2, 0), X(1.5))));

    [Theory]
    [InlineData(1e6)]
    [InlineData(1e9)]
    public void Partner_FarFromTheOriginAndFast_IsStillFound(double at)
    {
        SceneBuilder scene = Row()
            .AddBody("left", Ball(), X(at - 1024), X(1e5)).AddBody("right", Ball(), X(at + 1024), X(-1e5)).AddBody("middle", Ball(), X(at));
        Assert.Equal(["left-middle", "middle-left", "right-middle"], Met(scene));
    }

    [Fact]
    public void Partner_OfACarriedBodyThatIsStruck_IsTheOneThatStruck()
    {
        SceneBuilder scene = new SceneBuilder("floor").AddPlane("floor", Vector3D.Up, Vector3D.Zero)
            .AddBody("left", Ball(), new Vector3D(-3, 1, 0), X(1)).AddBody("right", Ball(), new Vector3D(3, 1, 0), X(-1))
            .AddBody("middle", Ball(), new Vector3D(0, 1, 0));
        string[] met = Met(scene).Where(pair => !pair.EndsWith("-floor", StringComparison.Ordinal)).ToArray();
        Assert.Equal(["left-middle", "middle-left", "right-middle"], met);
    }

    private static SceneBuilder Row() => new SceneBuilder("row").WithGravity(Vector3D.Zero);

    private static BodySpec Ball() => new(1, 1, 0.5);

    private static Vector3D X(double x) => new(x, 0, 0);

    /// <summary>Who met whom in ten seconds, each pair once.</summary>
    private static string[] Met(SceneBuilder scene)
    {
        Scene built = scene.Build();
        List<string> pairs = [];
        new SceneRun(built)
        {
            OnEvent = e =>
            {
                if (e.Kind == "impact")
                {
                    pairs.Add($"{built.Bodies[e.Body.Index].Name}-{e.Other}");
                }
            },
        }.Run(SimDuration.FromSeconds(10));
        return pairs.Distinct().Order(StringComparer.Ordinal).ToArray();
    }
}
