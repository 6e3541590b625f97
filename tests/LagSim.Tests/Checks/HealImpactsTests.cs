using LagSim.Events;
using LagSim.Harness.Verification.Check;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Checks;

/// <summary>Counting the heals that change an impact.</summary>
public sealed class HealImpactsTests
{
    [Theory]
    [InlineData(0.4, true)] // it is not where the other one comes to: the impact at 0.5 s is gone
    [InlineData(0.6, false)] // the impact was before
    public void HealImpacts_OneLateEvent_CountsWhetherAnImpactIsGone(double stamp, bool changes)
    {
        Scene scene = new SceneBuilder("two").WithGravity(Floating)
            .AddBody("left", Ball(0.5), V(-1)).AddBody("right", Ball(0.5), V(1), V(-2)).Build();
        Simulation simulation = new(scene, KeepAll);
        HealImpacts heals = new(simulation, _ => true);
        simulation.AdvanceTo(At(1));
        Assert.Equal(0, heals.Heals);
        simulation.Submit(ExternalEvent.Teleport(At(stamp), 1, 1, First, V(-1, 5)));
        simulation.AdvanceTo(At(1));
        Assert.Equal((1L, changes ? 1L : 0L), (heals.Heals, heals.Changed));

        // The same impact made again is no change: the body that was to be hit only turns out to have had its velocity set to what it was.
        simulation.Submit(ExternalEvent.SetVelocity(At(0.2), 1, 2, Second, V(-2)));
        simulation.AdvanceTo(At(1));
        Assert.Equal((2L, changes ? 1L : 0L), (heals.Heals, heals.Changed));
    }
}
