using System;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.SceneFiles.Runs;
using Xunit;

namespace LagSim.Tests.Scenes;

/// <summary>The words for kinds of events in what the tool writes are the contract's, whatever the kinds are called in code.</summary>
public sealed class EventKindTextTests
{
    [Fact]
    public void Of_EachKind_IsTheWordOfTheContract()
    {
        string[] words = ["none", "start", "spawn", "teleport", "setvelocity", "impulse", "grab", "holdknot", "release", "remove", "impact", "stepend"];

        Assert.Equal(words, Enum.GetValues<EventKind>().Order().Select(EventKindText.Of));
    }
}
