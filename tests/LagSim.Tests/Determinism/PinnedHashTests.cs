using System.Linq;
using System.Reflection;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Determinism;

/// <summary>The very bits of some worlds, the same in Debug and Release and on every machine. A hash that moves belongs in the changelog, and raises
/// <see cref="Simulation.FoldVersion"/>.</summary>
public sealed class PinnedHashTests
{
    /// <summary>The worlds.</summary>
    internal static readonly string[] Names = ["drop", "integrated", "pile", "random"];

    [Theory]
    [InlineData("drop", 1663898684166190757UL, 835043358955592738UL)]
    [InlineData("integrated", 11975514299284432918UL, 11092246644800043823UL)]
    [InlineData("pile", 17315898504765221892UL, 14845161739449223774UL)]
    [InlineData("random", 8629658451507482664UL, 13110561069222215826UL)]
    public void Hashes_OfAWorld_AreTheOnesOnRecord(string name, ulong state, ulong events)
    {
        Simulation simulation = World(name);
        SimTime end = simulation.SimulatedTo;
        Assert.Equal((state, events), (simulation.StateHash(end), simulation.EventHash(end)));
    }

    [Fact]
    public void Names_AreThoseOfTheHashesOnRecord() => Assert.Equal(
        Names, typeof(PinnedHashTests).GetMethod(nameof(Hashes_OfAWorld_AreTheOnesOnRecord))!.GetCustomAttributes<InlineDataAttribute>().Select(data => (string)data.Data[0]!));

    [Fact]
    public void Hashes_OneTickEarlier_AreOthers()
    {
        Simulation simulation = World("integrated");
        Assert.NotEqual(simulation.StateHash(simulation.SimulatedTo), simulation.StateHash(simulation.SimulatedTo - SimDuration.OneTick));
    }

    /// <summary>One of the worlds, run to its end.</summary>
    internal static Simulation World(string name)
    {
        switch (name)
        {
            case "drop":
                return Run(Drop(1, 0.8), 3);
            case "integrated":
                Scene scene = new SceneBuilder("integrated").AddPlane("slope", V(0.6, 0.8), V(0), 0.7)
                    .AddForce(Force.Supplied(new FunctionForce((t, x, v) => (v * (-0.1 * v.Length)) + V(0, 0, t - x.Z))))
                    .AddBody("dragged", Ball(0.25, 2, 0.9, MotionLaw.RungeKutta4, force: 1), V(0, 2), V(1, 0, 3))
                    .AddBody("free", Ball(0.25, 1, 0.9), V(0.5, 4), V(0, -1)).Build();
                return Run(scene, 2);
            case "pile":
                SceneBuilder builder = new SceneBuilder("pile").AddPlane("left", V(0.6, 0.8), V(0), 0.5).AddPlane("right", V(-0.6, 0.8), V(0), 0.5)
                    .AddStaticSphere("stone", V(0, 0), 0.5, 0.3);
                for (int i = 0; i < 6; i++)
                {
                    builder.AddBody($"ball {i}", Ball(0.25, 1 + i, 0.6), V(((i * 7) % 5 * 0.1) - 0.2, 1.5 + (0.6 * i), 0.01 * i));
                }

                return Run(builder.Build(), 2);
            default:
                return new RandomWorld(3).OnTime();
        }
    }
}
