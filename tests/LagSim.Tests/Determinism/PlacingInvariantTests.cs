using System.Linq;
using LagSim.Events;
using LagSim.Tests.Faults;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Determinism;

/// <summary>The invariant where spawns and teleports look whether their place is free: what is there may change with any late event before.</summary>
public sealed class PlacingInvariantTests
{
    private const int Worlds = 400;

    [Theory]
    [InlineData(HealingMode.CausalCone)]
    [InlineData(HealingMode.FullRollback)]
    [InlineData(HealingMode.SyncTest)]
    public void State_PlacesThatLateEventsTakeOrFree_IsThatOfAWorldThatHadThemBefore(HealingMode mode)
    {
        int skipped = 0;
        int beside = 0;
        for (int seed = 0; seed < Worlds; seed++)
        {
            RandomWorld world = new(seed, hands: seed % 4 == 3, filters: seed % 3 == 1, placings: true);
            Simulation expected = world.OnTime();
            Simulation actual = world.Shuffled(seed, mode: mode, inPieces: seed % 2 == 0, bruteForceLimit: seed % 3 * 64);
            string? difference = RandomWorld.Difference(expected, actual);
            Assert.True(difference is null, $"seed {seed}: {difference}");
            Assert.All(world.Events, e => Assert.Equal(expected.TookEffect(e), actual.TookEffect(e)));
            skipped += world.Events.Count(e => e.Kind == EventKind.Spawn && e.WhenOccupied == WhenOccupied.Skip && !expected.TookEffect(e));
            beside += world.Events.Count(e => e.Kind == EventKind.Spawn && e.WhenOccupied == WhenOccupied.Beside && expected.TookEffect(e)
                && Read(expected, e.Body, e.Time).Motion != LagSim.Scenes.MotionLaw.Absent && Read(expected, e.Body, e.Time).Position != e.Position);
        }

        Assert.True(skipped > Worlds / 10 && beside > Worlds / 10, $"{skipped} skipped, {beside} beside");
    }

    /// <summary>The control: who is there is not asked again.</summary>
    [Fact]
    public void State_PlacesThatAreNotAskedForAgain_IsSeenToDiffer() => Assert.True(Enumerable.Range(0, 100).Count(seed =>
    {
        RandomWorld world = new(seed, placings: true);
        Simulation late = world.Shuffled(seed, parts: new FaultyEngineParts { Healing = HealingFault.LeavesPlacings });
        return RandomWorld.Difference(world.OnTime(), late) is not null;
    }) > 3);

    [Fact]
    public void State_ContinuedFromASnapshot_IsTheSame()
    {
        for (int seed = 0; seed < Worlds; seed++)
        {
            RandomWorld world = new(seed, placings: true);
            Simulation expected = world.OnTime();
            Simulation continued = world.GoOnFrom(expected, At(0.625));
            string? difference = RandomWorld.Difference(expected, continued);
            Assert.True(difference is null, $"seed {seed}: {difference}");
        }
    }
}
