using System;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Rules;

/// <summary>The sentence on a call that failed says which, by the names that the scene has.</summary>
public sealed class RuleCallTextTests
{
    public static TheoryData<string, string> Calls => new()
    {
        { "start", "failed at 0s, round 0, in OnStart: broken" },
        { "timer", "failed at 0.25s, round 0, in OnTimer for timer 7: broken" },
        { "command", "failed at 0.125s, round 0, in OnCommand for command 5 of peer 2: broken" },
        { "player", "failed at 0.125s, round 0, in OnPlayer for Joined of bot 3 Ann: broken" },
        { "plane", "in OnContact for body 'ball' (0.0.0) and plane 'floor': broken" },
        { "sphere", "in OnContact for body 'high' (0.0.1) and static sphere 'dome': broken" },
        { "body", "in OnContact for body 'ball' (0.0.0) and body 2.1.0: broken" },
        { "heard", "in HearsContact for body 'ball' (0.0.0) and body 2.1.0: broken" },
        { "crossing", "in OnCrossing for body 'ball' (0.0.0), which enters 'goal': broken" },
        { "heard crossing", "in HearsCrossing for body 'ball' (0.0.0), which enters 'goal': broken" },
        { "hears bodies", "in HearsBodies for body 2.1.0: broken" },
        { "spawn", "failed at 0.0625s, round 0, in OnSpawned for body 2.1.0: broken" },
        { "remove", "failed at 0.75s, round 0, in OnRemoved for body 2.1.0: broken" },
    };

    [Theory]
    [MemberData(nameof(Calls))]
    public void Failure_OfACall_NamesWhatItWasFor(string which, string part)
    {
        Scene scene = new SceneBuilder("named").AddPlane("floor", Vector3D.Up, V(0)).AddStaticSphere("dome", V(9), 1)
            .AddBody("ball", Ball(), V(0, 3)).AddBody("high", Ball(), V(9, 4)).AddSensorPlane("goal", Vector3D.Up, 2).WithRules(Breaking(which)).Build();
        SimulationException failure = Assert.Throws<SimulationException>(() => Run(scene, 2, [
            PlayerAction.Spawn(Ball(), V(0, 5), V(0, -8)).Stamp(At(0.0625), 2, 1),
            PlayerAction.Command(new GameCommand(5)).Stamp(At(0.125), 2, 2),
            new PlayerEvent(PlayerEventKind.Joined, 3, 7, "Ann", PeerRole.Bot).Stamp(At(0.125), 1),
            PlayerAction.Remove(new BodyId(2, 1, 0)).Stamp(At(0.75), 2, 3)]));
        Assert.StartsWith("The rules 'given 1' failed at ", failure.Message, StringComparison.Ordinal);
        Assert.EndsWith($"{part}.", failure.Message, StringComparison.Ordinal);
    }

    private static GivenRules Breaking(string which) => new()
    {
        Start = w =>
        {
            Break(which == "start");
            w.SetTimer(7, SimDuration.FromSeconds(0.25));
        },
        Timer = (_, _) => Break(which == "timer"),
        Player = (_, _) => Break(which == "player"),
        Command = (_, _, _) => Break(which == "command"),
        Hears = (_, _, _) => Break(which == "heard"),
        Contact = (_, contact) => Break(
            (which == "plane" && contact.Surface == 0) || (which == "sphere" && contact.Surface == 1) || (which == "body" && contact.Surface < 0)),
        HearsSensor = (_, _) => Break(which == "heard crossing"),
        Crossed = (_, _) => Break(which == "crossing"),
        HearsAll = true,
        AskedForBodies = () => Break(which == "hears bodies"),
        Spawned = (_, _) => Break(which == "spawn"),
        Removed = (_, _) => Break(which == "remove"),
    };

    private static bool Break(bool now) => now ? throw new InvalidOperationException("broken") : true;
}
