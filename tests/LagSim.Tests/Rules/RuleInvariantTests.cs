using System.Linq;
using LagSim.Tests.Determinism;
using LagSim.Tests.Faults;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;

namespace LagSim.Tests.Rules;

/// <summary>The state of drawn rules, and what they do, against a world that had every event on time.</summary>
public sealed class RuleInvariantTests
{
    private const int Seeds = 120;

    [Fact]
    public void RulesOfRandomWorlds_EventsInAnyOrder_SameAsOnTime() => Compare((world, seed) => world.Shuffled(seed));

    [Fact]
    public void RulesOfRandomWorlds_InPieces_SameAsOnTime() => Compare((world, seed) => world.Shuffled(seed, inPieces: true));

    [Fact]
    public void RulesOfRandomWorlds_FullRollback_SameAsOnTime() => Compare((world, seed) => world.Shuffled(seed, mode: HealingMode.FullRollback));

    [Fact]
    public void RulesOfRandomWorlds_StoppedWithinInstants_SameAsOnTime() =>
        Compare((world, seed) => world.Shuffled(seed, prepare: simulation => InvariantTests.Interrupt(simulation, seed), inPieces: true));

    [Theory]
    [InlineData(RuleFault.StopsTooEarly)]
    [InlineData(RuleFault.LeavesActs)]
    [InlineData(RuleFault.ForgetsReads)]
    [InlineData(RuleFault.IgnoresState)]
    internal void RulesOfRandomWorlds_AFault_IsSeen(RuleFault fault)
    {
        int seen = 0;
        for (int seed = 1; seed <= Seeds && seen == 0; seed++)
        {
            RandomWorld world = new(seed, sensors: seed % 2 == 0, rules: true);
            seen += IsSeen(world, seed, fault) ? 1 : 0;
        }

        Assert.True(seen > 0, $"{fault} changed nothing in {Seeds} worlds.");
    }

    [Fact]
    public void Snapshots_OfWorldsWithRules_GoOnTheSame()
    {
        for (int seed = 1; seed <= 30; seed++)
        {
            RandomWorld world = new(seed, filters: seed % 4 == 1, sensors: seed % 2 == 0, rules: true);
            Simulation expected = world.OnTime();
            SimTime middle = SimTime.FromSeconds(RandomWorld.End / 2);
            WorldSnapshot snapshot = expected.Snapshot(middle);
            Simulation actual = new(world.Scene, snapshot, TestWorlds.KeepAll);
            foreach (Events.ExternalEvent late in world.Events.Where(e => e.Time >= middle))
            {
                actual.Submit(late);
            }

            actual.AdvanceTo(SimTime.FromSeconds(RandomWorld.End));
            Assert.True(RandomWorld.Difference(expected, actual) is null, $"seed {seed}: {RandomWorld.Difference(expected, actual)}");
        }
    }

    private static bool IsSeen(RandomWorld world, int seed, RuleFault fault)
    {
        try
        {
            Simulation actual = world.Shuffled(seed, parts: new FaultyRules(fault));
            Simulation expected = world.OnTime();
            return (RuleComparison.FirstDifference(expected.Engine, actual.Engine) ?? RandomWorld.Difference(expected, actual)) is not null;
        }
        catch (SimulationException)
        {
            return true;
        }
    }

    private static void Compare(System.Func<RandomWorld, int, Simulation> shuffled)
    {
        long calls = 0;
        for (int seed = 1; seed <= Seeds; seed++)
        {
            RandomWorld world = new(seed, hands: seed % 3 == 0, forced: seed % 5 == 0, filters: seed % 4 == 1, sensors: seed % 2 == 0, rules: true);
            Simulation expected = world.OnTime();
            Simulation actual = shuffled(world, seed);
            string? difference = RuleComparison.FirstDifference(expected.Engine, actual.Engine) ?? RandomWorld.Difference(expected, actual);
            Assert.True(difference is null, $"seed {seed}: {difference}");
            calls += expected.Engine.Rules!.Position;
        }

        Assert.True(calls > 10 * Seeds, $"only {calls} calls");
    }
}
