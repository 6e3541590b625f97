using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Rules;

/// <summary>Rules that ask whether a body is inside of a sensor: at their call, whatever is known beyond it.</summary>
public sealed class SensorReadTests
{
    /// <summary>A ball that bounces through a sphere. A timer asks in each twentieth of a second, and a late push makes other crossings.</summary>
    [Fact]
    public void IsInside_OnTimeAndLate_IsWhatTheWorldSaysOfThatInstant()
    {
        ExternalEvent push = PlayerAction.Impulse(First, V(0, 2)).Stamp(At(0.42), 1, 1);
        Simulation onTime = Run(Scene(), 3, [push]);
        Simulation late = Late(KeepAll, push);
        Assert.Equal(Asked(onTime), Asked(late));
        Assert.Equal(Expected(onTime), Asked(late));
        Assert.Contains(true, Asked(late));
        Assert.Contains(false, Asked(late));
        Assert.NotEqual(Asked(Run(Scene(), 3)), Asked(late)); // the push changes what is asked, or nothing was shown
    }

    /// <summary>The control: where calls do not note what they read, those stand that were made with the crossings before the push.</summary>
    [Fact]
    public void IsInside_ThatIsNotNoted_StaysWhatItWas()
    {
        ExternalEvent push = PlayerAction.Impulse(First, V(0, 2)).Stamp(At(0.42), 1, 1);
        Assert.NotEqual(Asked(Run(Scene(), 3, [push])), Asked(Late(KeepAll.WithParts(new FaultyRules(RuleFault.ForgetsReads)), push)));
    }

    /// <summary>A crossing has happened for the call that hears it, and not for one of the same tick before it.</summary>
    [Fact]
    public void IsInside_InTheCallForACrossing_IsAfterIt()
    {
        List<bool> entered = [];
        GivenRules rules = new()
        {
            HearsSensor = (_, _) => true,
            Crossed = (w, crossing) => entered.Add(w.IsInside(First, 0) == crossing.Entered),
        };
        Run(Scene(rules), 3);
        Assert.True(entered.Count > 3);
        Assert.DoesNotContain(false, entered);
    }

    [Theory]
    [InlineData(-1)]
    [InlineData(1)]
    public void IsInside_OfNoSensor_IsRefusedByNumber(int sensor)
    {
        GivenRules rules = new() { Start = w => w.SetTimer(3, SimDuration.FromSeconds(0.25)), Timer = (w, _) => w.IsInside(First, sensor) };
        SimulationException failure = Assert.Throws<SimulationException>(() => Run(Scene(rules), 1));
        Assert.Equal(
            $"The rules 'given 1' failed at 0.25s, round 0, in OnTimer for timer 3: Sensor {sensor} is asked for; the scene has 1 sensor, numbered from 0.",
            failure.Message);
    }

    [Fact]
    public void IsInside_OfABodyThatNeverWas_IsFalse()
    {
        bool isInside = true;
        Run(Scene(new GivenRules { Start = w => isInside = w.IsInside(new BodyId(3, 3, 0), 0) }), 1);
        Assert.False(isInside);
    }

    private static Simulation Late(SimulationOptions options, in ExternalEvent push)
    {
        Simulation world = new(Scene(), options);
        world.AdvanceTo(At(3));
        world.Submit(push);
        world.AdvanceTo(At(3));
        return world;
    }

    private static Scene Scene(GivenRules? rules = null)
    {
        rules ??= new GivenRules
        {
            Start = w => w.SetTimer(1, SimDuration.FromSeconds(0.05)),
            Timer = (w, timer) =>
            {
                w.SetTimer(timer, SimDuration.FromSeconds(0.05));
                w.State<GivenState>().Draw = (w.State<GivenState>().Draw << 1) | (w.IsInside(First, 0) ? 1UL : 0);
            },
        };
        return new SceneBuilder("asked").AddPlane("floor", Vector3D.Up, V(0), 0.9).AddBody("ball", Ball(e: 0.9), V(0, 3))
            .AddSensorSphere("ring", V(0, 2), 0.4).WithRules(rules).Build();
    }

    /// <summary>What was asked, the last first.</summary>
    private static bool[] Asked(Simulation world) =>
        world.TryReadRules(At(3), out GivenState state) ? [.. Enumerable.Range(0, 59).Select(n => (state.Draw >> n & 1) == 1)] : [];

    private static bool[] Expected(Simulation world) =>
        [.. Enumerable.Range(0, 59).Select(n => world.IsInside(First, 0, At(0) + (SimDuration.FromSeconds(0.05) * (59 - n))))];
}
