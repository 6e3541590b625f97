using System;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Scenes;

/// <summary>The built-in scene with rules: what it counts, and that it heals, comes back from files, and keeps its rules on other motion laws.</summary>
public sealed class GoalsSceneTests
{
    private static readonly Scene Goals = BuiltInScenes.Goals();

    [Fact]
    public void Rules_CountWhatTheSensorsSaw()
    {
        Simulation world = Play(20);
        Crossing[] goals = [.. world.Crossings(At(0), At(20)).Where(one => one.Entered && one.Body.Sequence == 0)];
        GoalsState state = State(world, 20);
        GoalsBall[] balls = [.. Enumerable.Range(0, 3).Select(n => world.TryReadRules(BodyId.OfScene(n), At(20), out GoalsBall ball) ? ball : default)];
        Assert.True(state.PowerUpsTaken > 1);
        Assert.True(goals.Length > 10);
        Assert.Equal(state.Left + state.Right, balls.Sum(ball => ball.Goals));
        Assert.InRange(state.Left + state.Right, goals.Length + 1, goals.Length + state.PowerUpsTaken); // a power-up makes one goal count twice
        Assert.Equal((goals[^1].Time - At(0)).Ticks, state.LastGoalTicks);
        Assert.Equal(2, State(world, 0.4).CountDown);
        Assert.Equal(0, State(world, 1).CountDown);
        Assert.Equal(0, State(world, 0.99).LastGoalTicks);
    }

    [Fact]
    public void Rules_AfterTheWhistle_CountNoMore()
    {
        Simulation world = Play(80);
        (GoalsState before, GoalsState after) = (State(world, 60), State(world, 80));
        Assert.Equal((1, before.Left, before.Right), (after.IsOver, after.Left, after.Right));
        Assert.Equal(0, State(world, 59.9).IsOver);
    }

    [Fact]
    public void Commands_ThatComeLate_GiveTheStateThatTheyWouldHaveGivenInTime()
    {
        ExternalEvent[] commands =
        [
            Command(2.1, 1, GoalsRules.Cheer), Command(2.5, 2, GoalsRules.Kick, 1), Command(2.6, 3, GoalsRules.Kick, 3), Command(2.7, 4, GoalsRules.Cheer, 0),
        ];
        Simulation inTime = Play(8, commands), late = Play(2.9);
        Array.ForEach(commands, one => late.Submit(one));
        late.AdvanceTo(At(8));
        Assert.Equal(inTime.StateHash(At(8)), late.StateHash(At(8)));
        GoalsState state = State(late, 8);
        Assert.Equal((1, 1, 2), (state.Cheers, state.Kicks, state.Ignored)); // no ball 3, and a cheer carries nothing
        Assert.NotEqual(Play(8).StateHash(At(8)), late.StateHash(At(8))); // the control
    }

    [Fact]
    public void Rules_InTheSyncTest_AreAFunctionOfTheWorld()
    {
        Simulation world = new(Goals, new SimulationOptions(default, SimDuration.FromSeconds(10), healing: HealingMode.SyncTest));
        world.AdvanceTo(At(4));
        world.Submit(Command(3, 1, GoalsRules.Kick, 0));
        world.AdvanceTo(At(10));
        Assert.Equal(1, State(world, 10).Kicks);
    }

    [Fact]
    public void File_NamesTheRules_AndRefusesOthers()
    {
        string text = SceneFile.ToJson(Goals);
        Assert.Contains("\"rules\": \"goals\"", text, StringComparison.Ordinal);
        Assert.IsType<GoalsRules>(SceneText.Parse(text).Rules);
        Assert.Equal(Goals.Hash, SceneText.Parse(text).Hash);
        Assert.Contains(
            "there are no built-in rules \"chess\"; there are goals", SceneText.Refusal("{\"rules\": \"chess\"}").Message, StringComparison.Ordinal);
        Scene foreign = new SceneBuilder("board").WithRules(new Chess()).Build();
        Assert.Contains(
            "the scene has the rules 'goals 2', written in C#; a JSON file can name built-in rules only (goals)",
            Assert.Throws<SceneFileException>(() => SceneFile.ToJson(foreign)).Message, StringComparison.Ordinal);
    }

    [Fact]
    public void WithMotion_KeepsRulesSensorsAndSeed()
    {
        Scene now = BuiltInScenes.WithMotion(Goals, MotionLaw.RungeKutta4, BodySpec.DefaultStep);
        Assert.Equal((Goals.Rules, Goals.Seed, 2), (now.Rules, now.Seed, now.Sensors.Count));
        Assert.NotEqual(Goals.Hash, now.Hash);
        Scene sphere = new SceneBuilder("sphere").AddSensorSphere("spot", V(1, 2, 3), 4, SensorCoverage.Part, new CollisionFilter(6, 7), "ball").AddSensorPlane("edge", V(1), 2.0, filter: new CollisionFilter(8, 9))
            .AddPlane("floor", Vector3D.Up, Vector3D.Zero, filter: new CollisionFilter(2, 3))
            .AddStaticSphere("rock", V(0, 9), 1, filter: new CollisionFilter(4, 5)).AddBody("ball", Ball(), V(0, 5)).Build();
        Assert.Equal(sphere.Hash, BuiltInScenes.WithMotion(sphere, sphere.Bodies[0].Spec.Flight, sphere.Bodies[0].Spec.Step).Hash);
    }

    private static Simulation Play(double seconds, params ExternalEvent[] commands)
    {
        Simulation world = new(Goals, new SimulationOptions(default, SimDuration.FromSeconds(100)));
        Array.ForEach(commands, one => world.Submit(one));
        world.AdvanceTo(At(seconds));
        return world;
    }

    private static GoalsState State(Simulation world, double seconds) => world.TryReadRules(At(seconds), out GoalsState state) ? state : throw new InvalidOperationException();

    private static ExternalEvent Command(double seconds, uint sequence, int number, params byte[] data) =>
        PlayerAction.Command(new GameCommand(number, data)).Stamp(At(seconds), 1, sequence);

    private sealed class Chess() : GameRules("goals", 2);
}
