using LagSim.Events;
using LagSim.Hosting;
using LagSim.Scenes;
using LagSim.Tests.Rules;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Budgets;

/// <summary>That rules are called is charged to the player whose bodies cause it (docs/BUDGETS.md).</summary>
public sealed class CallChargeTests
{
    /// <summary>What rules hear of because of a player's ball is charged to that player; without rules it is charged for the impacts alone.</summary>
    [Theory]
    [InlineData(true, 5)]
    [InlineData(false, 0)]
    public void Calls_ForContactsOfAPlayersBall_AreChargedToThatPlayer(bool hears, double each)
    {
        double charged = ChargedFor(hears, out long impacts), alone = ChargedFor(false, out long same);
        Assert.Equal(same, impacts);
        Assert.InRange(impacts, 1000, 10_000);
        Assert.InRange((charged - alone) / impacts, each - 0.1, each + 0.1);
    }

    private static double ChargedFor(bool hears, out long impacts)
    {
        GivenRules rules = new() { Hears = (_, _, _) => hears };
        Scene scene = new SceneBuilder("gap").WithGravity(Floating).AddPlane("floor", Vector3D.Up, 0).AddPlane("roof", V(0, -1), -0.203)
            .AddBody("ball", new BodySpec(0.1, 1, 1), V(0, 0.1)).WithRules(rules).Build();
        LiveWorld world = new(scene, new SimulationOptions()) { Work = new WorkLedger() };
        world.Submit(PlayerAction.SetVelocity(First, V(0, 20)).Stamp(At(0.1), 3, 1));
        for (double t = 0.01; t < 0.5; t += 0.01)
        {
            world.Step(At(t));
        }

        impacts = world.Simulation.ImpactsProcessed;
        return world.Work.ChargedTo(3);
    }
}
