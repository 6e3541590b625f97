using System;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Determinism;

/// <summary>The invariant where bodies and surfaces have collision filters, and those of bodies change, late as well.</summary>
public sealed class FilterInvariantTests
{
    private const int Worlds = 400;

    [Theory]
    [InlineData(HealingMode.CausalCone)]
    [InlineData(HealingMode.FullRollback)]
    [InlineData(HealingMode.SyncTest)]
    public void State_FiltersThatChangeLateTwiceOrAreTakenBack_IsThatOfAWorldThatHadThemBefore(HealingMode mode)
    {
        int changed = 0;
        int passed = 0;
        for (int seed = 0; seed < Worlds; seed++)
        {
            RandomWorld world = new(seed, hands: seed % 4 == 3, forced: seed % 8 == 5, filters: true);
            Simulation expected = world.OnTime();
            Simulation actual = world.Shuffled(seed, mode: mode, inPieces: seed % 2 == 0, bruteForceLimit: seed % 3 * 64);
            string? difference = RandomWorld.Difference(expected, actual);
            Assert.True(difference is null, $"seed {seed}: {difference}");
            changed += world.Events.Count(e => e.Kind == EventKind.SetFilter && expected.TookEffect(e));
            passed += MinGap(expected, At(RandomWorld.End)) < -0.01 ? 1 : 0;
        }

        Assert.True(changed > Worlds, $"{changed} changes took effect");
        Assert.True(passed > Worlds / 10, $"something passed through something in {passed} worlds");
    }

    /// <summary>The two ways to find and to solve the same impacts leave out the same pairs.</summary>
    [Fact]
    public void State_FoundTheLongWay_IsTheSame()
    {
        for (int seed = 0; seed < Worlds; seed++)
        {
            RandomWorld world = new(seed, filters: true);
            Simulation expected = world.OnTime();
            SimulationOptions options = KeepAll.WithParts(new FaultyEngineParts { TakesNoShortcut = true });
            string? difference = RandomWorld.Difference(expected, world.OnTime(options: options));
            Assert.True(difference is null, $"seed {seed}: {difference}");
        }
    }

    [Fact]
    public void State_ContinuedFromASnapshot_IsTheSame()
    {
        for (int seed = 0; seed < Worlds; seed++)
        {
            RandomWorld world = new(seed, hands: seed % 4 == 3, filters: true);
            Simulation expected = world.OnTime();
            Simulation continued = world.GoOnFrom(expected, At(0.625));
            string? difference = RandomWorld.Difference(expected, continued);
            Assert.True(difference is null, $"seed {seed}: {difference}");
            Assert.All(Bodies(continued).Where(body => Read(continued, body, RandomWorld.End).Motion != MotionLaw.Absent), body => Assert.Equal(expected.TagOf(body), continued.TagOf(body)));
        }
    }

    /// <summary>
    /// The control: a heal that ends where paths are the old ones again, though one body collides with other things on them. A body whose
    /// filter changed late comes back on its path where it is put somewhere.
    /// </summary>
    [Theory]
    [InlineData(HealingFault.None, true)]
    [InlineData(HealingFault.IgnoresFilters, false)]
    internal void Heal_ThatEndsWhateverBodiesCollideWith_IsSeenToDiffer(HealingFault fault, bool isRight)
    {
        Scene scene = new SceneBuilder("scene").WithGravity(Floating).AddBody("a", Ball(), V(0)).AddBody("b", Ball(), V(6)).Build();
        ExternalEvent put = ExternalEvent.Teleport(At(1), 1, 1, First, V(3), V(1));
        ExternalEvent ghost = ExternalEvent.SetFilter(At(0.5), 2, 1, First, CollisionFilter.None);
        ExternalEvent push = ExternalEvent.SetVelocity(At(1.5), 1, 2, First, V(1));
        Simulation expected = Run(scene, 4, [put, push, ghost]);
        Simulation late = new(scene, KeepAll.WithParts(new FaultyEngineParts { Healing = fault }));
        late.Submit(put);
        late.Submit(push);
        late.AdvanceTo(At(4));
        Assert.Equal(SubmitResult.RolledBack, late.Submit(ghost));
        late.AdvanceTo(At(4));
        Assert.Equal(isRight, expected.StateHash(At(4)) == late.StateHash(At(4)));
        Assert.Equal(isRight, expected.EventHash(At(4)) == late.EventHash(At(4)));
    }
}
