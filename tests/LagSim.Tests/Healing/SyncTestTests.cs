using LagSim.Tests.Determinism;
using LagSim.Tests.Faults;
using Xunit;

namespace LagSim.Tests.Healing;

/// <summary>The mode in which every heal is held against a full rollback.</summary>
public sealed class SyncTestTests
{
    [Fact]
    public void SyncTest_RandomWorlds_FindsNothing()
    {
        for (int seed = 0; seed < 60; seed++)
        {
            RandomWorld world = new(seed);
            Simulation late = world.Shuffled(seed, mode: HealingMode.SyncTest, inPieces: seed % 2 == 0);
            Assert.Null(RandomWorld.Difference(world.OnTime(), late));
        }
    }

    [Fact]
    public void SyncTest_HealingThatIsWrong_EndsWithTheFirstDifferenceInBothVersions()
    {
        RandomWorld world = new(3);
        FaultyEngineParts parts = new() { Healing = HealingFault.ForgetsThePast };
        string message = Assert.Throws<SimulationException>(() => world.Shuffled(3, mode: HealingMode.SyncTest, parts: parts)).Message;
        Assert.StartsWith("The sync test failed: the world as healed and the world as fully rolled back differ. Body ", message, System.StringComparison.Ordinal);
        Assert.Matches(": expected .+ (Impact|StepEnd) .+ m/s .+\\), got .+\\.$", message);
    }
}
