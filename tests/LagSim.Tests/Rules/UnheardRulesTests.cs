using System;
using LagSim.Events;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Rules;

/// <summary>Rules with a method that would never be called are refused by the scene, with a sentence; the state of rules asked for as another type is, too.</summary>
public sealed class UnheardRulesTests
{
    [Fact]
    public void Build_WithAMethodThatNothingCalls_NamesItAndWhatIsMissing()
    {
        (GameRules Rules, string Called, string Missing)[] all =
        [
            (new ContactAlone(), "OnContact", "HearsContact"),
            (new CrossingAlone(), "OnCrossing", "HearsCrossing"),
            (new SpawnedAlone(), "OnSpawned", "HearsBodies"),
            (new RemovedAlone(), "OnRemoved", "HearsBodies"),
            (new LostAlone(), "OnLost", "HearsBodies"),
            (new PlayerAlone(), "OnPlayer", "HearsPlayers"),
            (new Derived(), "OnContact", "HearsContact"),
            (new Hiding(), "OnContact", "HearsContact"),
        ];
        Assert.All(all, one => Assert.Equal(
            $"Scene 'given' has the rules '{one.Rules}', which override {one.Called} but not {one.Missing}, so it would never be called: override {one.Missing} too.",
            Assert.Throws<SceneException>(() => Built(one.Rules)).Message));
    }

    /// <summary>The controls: who hears, who is heard by a base, who hears nothing, and who has a method of that name alone.</summary>
    [Fact]
    public void Build_WithMethodsThatAreCalledOrAreOthers_IsAScene()
    {
        Assert.All(
            new GameRules[] { new Heard(), new HeardByItsBase(), new Silent(), new Overloads(), new GivenRules(bodies: true), new GivenRules { Player = (_, _) => { } } }, rules => Assert.Same(rules, Built(rules).Rules));
    }

    [Fact]
    public void TryReadRules_AsAnotherType_ThrowsWithBoth()
    {
        Simulation world = new(Built(new GivenRules()));
        string given = typeof(GivenState).FullName!;
        world.AdvanceTo(At(1));
        Assert.Equal(
            $"The state of the world is asked for as System.Int64; the rules 'given 1' declare {given}.",
            Assert.Throws<InvalidOperationException>(() => world.TryReadRules(At(1), out long _)).Message);
        Assert.Equal(
            $"The state of a body is asked for as {given}; the rules 'given 1' declare none.",
            Assert.Throws<InvalidOperationException>(() => world.TryReadRules(First, At(1), out GivenState _)).Message);
        Assert.True(world.TryReadRules(At(1), out GivenState _)); // the controls: the type that they declare, and a scene without rules
        Assert.False(Run(Drop(5, 0.8), 1).TryReadRules(At(1), out long _));
        Assert.False(Run(Drop(5, 0.8), 1).TryReadRules(First, At(1), out long _));
    }

    private static Scene Built(GameRules rules) => new SceneBuilder("given").AddBody("ball", Ball(), V(0, 4)).WithRules(rules).Build();

    private class ContactAlone() : GameRules("contact alone", 1)
    {
        public override void OnContact(RuleWorld world, in RuleContact contact)
        {
        }
    }

    private sealed class CrossingAlone() : GameRules("crossing alone", 1)
    {
        public override void OnCrossing(RuleWorld world, in Crossing crossing)
        {
        }
    }

    private sealed class PlayerAlone() : GameRules("player alone", 1)
    {
        public override void OnPlayer(RuleWorld world, PlayerEvent player)
        {
        }
    }

    private sealed class SpawnedAlone() : GameRules("spawned alone", 1)
    {
        public override void OnSpawned(RuleWorld world, BodyId body)
        {
        }
    }

    private sealed class RemovedAlone() : GameRules("removed alone", 1)
    {
        public override void OnRemoved(RuleWorld world, BodyId body)
        {
        }
    }

    private sealed class LostAlone() : GameRules("lost alone", 1)
    {
        public override void OnLost(RuleWorld world, BodyId body, LossReason why)
        {
        }
    }

    private sealed class Derived : ContactAlone;

    private sealed class Hiding : ContactAlone
    {
        public static new bool HearsContact(BodyId first, BodyId second, int surface) => first != second && surface == 0;
    }

    private sealed class HeardByItsBase : Hearing
    {
        public override void OnContact(RuleWorld world, in RuleContact contact)
        {
        }
    }

    private abstract class Hearing() : GameRules("hearing", 1)
    {
        public override bool HearsContact(BodyId first, BodyId second, int surface) => surface == 0;
    }

    private sealed class Heard : ContactAlone
    {
        public override bool HearsContact(BodyId first, BodyId second, int surface) => false;
    }

    private sealed class Silent() : GameRules("silent", 1)
    {
        public override void OnStart(RuleWorld world)
        {
        }
    }

    private sealed class Overloads() : GameRules("overloads", 1)
    {
        public static void OnContact(RuleWorld world, int number) => world.Tell(number);

        public static void OnSpawned(RuleWorld world, BodyId body, int number) => world.Tell(number, body.Index);
    }
}
