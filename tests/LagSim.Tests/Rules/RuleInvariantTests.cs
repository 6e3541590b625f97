using System.Linq;
using LagSim.Rules;
using LagSim.Tests.Determinism;
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
    public void RulesOfRandomWorlds_ManyLateEvents_SomeCallsStandWithoutBeingMadeAgain()
    {
        long kept = 0;
        long made = 0;
        for (int seed = 1; seed <= 30; seed++)
        {
            RandomWorld world = new(seed, rules: true);
            long healed = world.Shuffled(seed).Engine.Caller!.Made;
            long full = world.Shuffled(seed, mode: HealingMode.FullRollback).Engine.Caller!.Made;
            kept += full - healed;
            made += healed; System.Console.WriteLine($"{seed} {healed} {full}");
        }

        Assert.True(kept > made, $"{made} calls were made, {kept} fewer than by full rollbacks.");
    }

    [Fact]
    public void Snapshots_OfWorldsWithRules_GoOnTheSame()
    {
        for (int seed = 1; seed <= 30; seed++)
        {
            RandomWorld world = new(seed, rules: true);
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

    private static void Compare(System.Func<RandomWorld, int, Simulation> shuffled)
    {
        long calls = 0;
        for (int seed = 1; seed <= Seeds; seed++)
        {
            RandomWorld world = new(seed, hands: seed % 3 == 0, forced: seed % 5 == 0, rules: true);
            Simulation expected = world.OnTime();
            Simulation actual = shuffled(world, seed);
            string? difference = RuleComparison.FirstDifference(expected.Engine, actual.Engine) ?? RandomWorld.Difference(expected, actual);
            Assert.True(difference is null, $"seed {seed}: {difference}");
            calls += expected.Engine.Rules!.Position;
        }

        Assert.True(calls > 10 * Seeds, $"only {calls} calls");
    }
}
