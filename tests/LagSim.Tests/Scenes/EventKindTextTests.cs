using System;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.SceneFiles.Runs;
using LagSim.Scenes;
using Xunit;

namespace LagSim.Tests.Scenes;

/// <summary>The words for kinds of events in what the tool writes are the contract's, whatever the kinds are called in code.</summary>
public sealed class EventKindTextTests
{
    [Fact]
    public void Of_EachKind_IsTheWordOfTheContract()
    {
        string[] words =
        [
            "none", "start", "spawn", "teleport", "setvelocity", "impulse", "grab", "holdknot", "release", "remove", "player", "setfilter", "command", "timer", "impact", "stepend", "crossing", "lost",
        ];

        Assert.Equal(words, Enum.GetValues<EventKind>().Order().Select(EventKindText.Of));
    }

    /// <summary>What a game prints of an action that was refused names it.</summary>
    [Fact]
    public void ToString_OfAnAction_NamesItsKindAndItsBody()
    {
        BodyId body = BodyId.OfScene(3);
        Assert.Equal("Grab of body 0.0.3", PlayerAction.Grab(body, default).ToString());
        Assert.Equal("Spawn", PlayerAction.Spawn(new BodySpec(1, 1, 1), default).ToString());
        Assert.Equal("None", default(PlayerAction).ToString());
    }
}
