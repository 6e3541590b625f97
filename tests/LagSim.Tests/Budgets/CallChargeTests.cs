using System;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Rules;
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

    /// <summary>What a call says that it costs is charged to who sent the command, once for each time that it is made.</summary>
    [Theory]
    [InlineData(2000)]
    [InlineData(0)]
    public void Charge_InACommand_IsOnTheAccountOfItsSender(double each)
    {
        LiveWorld world = Commanded((rules, _, _) =>
        {
            rules.Charge(each / 2);
            rules.Charge(each / 2);
        });
        for (uint n = 1; n <= 10; n++)
        {
            world.Submit(PlayerAction.Command(new GameCommand(1)).Stamp(At(0.01 * n), 3, n));
        }

        world.Step(At(1));
        Assert.InRange(world.Work!.ChargedTo(3), 10 * each, (10 * each) + 100);
        Assert.Equal(0, world.Work.ChargedTo(2));
    }

    /// <summary>It counts also for a command that then fails and counts as none: the work was done.</summary>
    [Fact]
    public void Charge_InACommandThatFails_CountsAllTheSame()
    {
        LiveWorld world = Commanded((rules, _, _) =>
        {
            rules.Charge(2000);
            throw new InvalidOperationException("no");
        });
        world.Submit(PlayerAction.Command(new GameCommand(1)).Stamp(At(0.1), 3, 1));
        world.Step(At(1));
        Assert.InRange(world.Work!.ChargedTo(3), 2000, 2100);
    }

    [Theory]
    [InlineData(-1)]
    [InlineData(1.1e9)]
    [InlineData(double.NaN)]
    public void Charge_OutOfRange_EndsTheWorldWithTheRange(double work)
    {
        LiveWorld world = Commanded((rules, _, _) => rules.Charge(work), isSkipped: false);
        world.Submit(PlayerAction.Command(new GameCommand(1)).Stamp(At(0.1), 3, 1));
        Assert.Contains("it must be 0 to 1e9 units", Assert.ThrowsAny<SimulationException>(() => world.Step(At(1))).Message, StringComparison.Ordinal);
    }

    /// <summary>
    /// A player's ball that rules touch stays on its account: no game has to let it off, as it would by setting a filter for what is spawned. The
    /// control: rules that leave it alone.
    /// </summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Work_ForAPlayersBallThatRulesTouch_StaysOnThatAccount(bool isTouched)
    {
        GivenRules rules = new() { HearsAll = true, Spawned = (world, body) => world.SetFilter(body, isTouched ? new CollisionFilter(2, 1) : default) };
        Scene scene = new SceneBuilder("gap").WithGravity(Floating).WithSmallestRadius(0.1).AddPlane("floor", Vector3D.Up, 0).AddPlane("roof", V(0, -1), -0.203)
            .WithRules(isTouched ? rules : new GivenRules()).Build();
        LiveWorld world = new(scene, new SimulationOptions()) { Work = new WorkLedger() };
        world.Submit(PlayerAction.Spawn(new BodySpec(0.1, 1, 1), V(0, 0.1), V(0, 20)).Stamp(At(0.1), 3, 1));
        for (double t = 0.01; t < 0.5; t += 0.01)
        {
            world.Step(At(t));
        }

        Assert.InRange(world.Simulation.ImpactsProcessed, 1000, 10_000);
        Assert.True(world.Work.ChargedTo(3) > world.Simulation.ImpactsProcessed, $"{world.Work.ChargedTo(3)}");
    }

    private static LiveWorld Commanded(Action<RuleWorld, byte, GameCommand> command, bool isSkipped = true)
    {
        Scene scene = new SceneBuilder("told").AddBody("ball", new BodySpec(0.1, 1, 1), V(0, 1)).WithRules(new GivenRules(isSkipping: isSkipped) { Command = command }).Build();
        return new LiveWorld(scene, new SimulationOptions()) { Work = new WorkLedger() };
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
