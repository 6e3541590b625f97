using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Numerics;

/// <summary>Galperin's billiard: two balls and a wall count the digits of pi.</summary>
public sealed class GalperinTests
{
    [Theory]
    [InlineData(1, 3)]
    [InlineData(1e2, 31)]
    [InlineData(1e4, 314)]
    [InlineData(1e6, 3141)]
    public void Collisions_MassRatioAPowerOfAHundred_AreTheDigitsOfPi(double ratio, int expected)
    {
        Assert.Equal(expected, Count(ratio, 1));
    }

    [Fact]
    public void Collisions_NotQuiteElastic_AreOthers()
    {
        Assert.NotEqual(314, Count(1e4, 0.9));
    }

    private static int Count(double ratio, double e)
    {
        Scene scene = new SceneBuilder("galperin").WithGravity(Floating).AddPlane("wall", V(1), V(0))
            .AddBody("small", Ball(e: e), V(1.5)).AddBody("big", Ball(mass: ratio, e: e), V(3), V(-1)).Build();
        Simulation simulation = Run(scene, 1000);
        return Impacts(simulation, First).Count;
    }
}
