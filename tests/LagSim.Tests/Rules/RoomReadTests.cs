using System;
using LagSim.Events;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Rules;

/// <summary>Rules that ask whether there is room for a body, and spawn one only there.</summary>
public sealed class RoomReadTests
{
    private static readonly CollisionFilter Ghost = new(2, 2);

    /// <summary>Around a ball at (0, 1), beside a floor and a rock: touching is room.</summary>
    [Theory]
    [InlineData(5.0, 1.0, true)]
    [InlineData(0.7, 1.0, false)] // in the ball
    [InlineData(0.75, 1.0, true)]
    [InlineData(5.0, 0.2, false)] // in the floor
    [InlineData(5.0, 0.25, true)]
    [InlineData(8.0, 1.2, false)] // in the rock
    [InlineData(8.0, 1.25, true)]
    public void IsRoomFor_ABodyThatIsNotThere_MindsBodiesAndWalls(double x, double y, bool isRoom)
    {
        Assert.Equal(isRoom, Asked(w => w.IsRoomFor(Ball(0.25), V(x, y))));
        Assert.Equal(isRoom, Asked(w => w.TrySpawn(Ball(0.25), V(x, y), out _)));
        Assert.Equal(isRoom || x < 8, Asked(w => w.IsRoomFor(Ball(0.25).With(Ghost), V(x, y)))); // which collides with the rock alone
    }

    /// <summary>A body is not in its own way, and has room by the filter that it has now.</summary>
    [Fact]
    public void IsRoomFor_ABodyThatIsThere_LeavesItOut()
    {
        Assert.True(Asked(w => w.IsRoomFor(First, V(0.1, 1))));
        Assert.False(Asked(w => w.IsRoomFor(First, V(0.1, 0))));
        Assert.True(Asked(w => w.IsRoomFor(First, V(0.1, 0)), ExternalEvent.SetFilter(At(0.1), 1, 1, First, CollisionFilter.None)));
        Assert.False(Asked(w => w.IsRoomFor(Second, V(3, 3)))); // it is not there
    }

    [Fact]
    public void TrySpawn_WhereThisCallHasSpawned_FindsNoRoom()
    {
        bool[] there = new bool[3];
        Simulation world = Run(Scene(w =>
        {
            there[0] = w.TrySpawn(Ball(0.25), V(5, 5), out BodyId first);
            there[1] = w.TrySpawn(Ball(0.25), V(5.3, 5), out BodyId second);
            there[2] = w.TrySpawn(Ball(0.25), V(5.6, 5), out BodyId third);
            return (first, second, third) == (new BodyId(255, 1, 0), default, new BodyId(255, 2, 0));
        }), 1);
        Assert.Equal([true, false, true], there);
        Assert.True(world.TryReadRules(At(1), out GivenState state) && state.Count == 1 && world.BodyCount == 3);
    }

    [Fact]
    public void IsRoomFor_NoPlace_EndsTheWorldWithTheSentence() => Assert.EndsWith(
        "the place must be finite.", Assert.Throws<SimulationException>(() => Asked(w => w.IsRoomFor(Ball(), V(double.NaN)))).Message, StringComparison.Ordinal);

    /// <summary>A late push takes the ball out of the place that was asked for, and the retraction puts it back.</summary>
    [Theory]
    [InlineData(RuleFault.None, true)]
    [InlineData(RuleFault.ForgetsReads, false)]
    internal void TrySpawn_WhereALateEventChangesTheAnswer_IsHealed(RuleFault fault, bool isRight)
    {
        Scene scene = Scene(w => w.TrySpawn(Ball(0.25), V(0.5, 1), out _));
        ExternalEvent push = PlayerAction.SetVelocity(First, V(-10)).Stamp(At(0.1), 1, 1);
        Simulation late = new(scene, KeepAll.WithParts(new FaultyRules(fault)));
        late.AdvanceTo(At(1));
        Assert.Equal(1, late.BodyCount);
        late.Submit(push);
        late.AdvanceTo(At(1));
        Simulation onTime = Run(scene, 1, [push]);
        Assert.Equal(2, onTime.BodyCount);
        Assert.Equal(isRight, onTime.StateHash(At(1)) == late.StateHash(At(1)));
        late.Retract(push);
        late.AdvanceTo(At(1));
        Assert.Equal(Run(scene, 1).StateHash(At(1)), late.StateHash(At(1)));
    }

    private static bool Asked(Func<RuleWorld, bool> ask, params ExternalEvent[] events) =>
        Run(Scene(ask), 1, events).TryReadRules(At(1), out GivenState state) && state.Count == 1;

    private static Scene Scene(Func<RuleWorld, bool> ask)
    {
        GivenRules rules = new()
        {
            Start = w => w.SetTimer(1, SimDuration.FromSeconds(0.25)),
            Timer = (w, _) => w.State<GivenState>().Count = ask(w) ? 1 : 0,
        };
        return new SceneBuilder("room").WithGravity(Floating).WithSmallestRadius(0.25).AddPlane("floor", Vector3D.Up, 0)
            .AddStaticSphere("rock", V(8), 1, filter: new CollisionFilter(3)).AddBody("ball", Ball(), V(0, 1)).WithRules(rules).Build();
    }
}
