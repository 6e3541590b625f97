using System;
using System.Linq;
using LagSim.Cli.Commands;
using LagSim.Cli.Output;
using LagSim.Events;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Cli;

/// <summary>What <c>--do</c> says.</summary>
public sealed class ScriptedActionTests
{
    private static readonly Scene Two = new SceneBuilder("two").AddBody("ball", Ball(), V(0)).AddBody("a:b", Ball(0.25, 3), V(5)).Build();

    [Fact]
    public void Parse_EveryKind_IsTheActionItSays()
    {
        Assert.Equal(ExternalEvent.Teleport(At(1), 2, 3, First, V(0, 15)), Stamped("teleport@3:0,15,0", 3));
        Assert.Equal(ExternalEvent.SetVelocity(At(1), 2, 3, First, V(-1.5, 0, 1e3)), Stamped("set-velocity@0:-1.5,0,1e3", 0));
        Assert.Equal(ExternalEvent.Impulse(At(1), 2, 3, First, V(0, 4)), Stamped("impulse@2.5:ball:0,4,0", 2.5));
        Assert.Equal(ExternalEvent.Grab(At(1), 2, 3, First, V(0, 0.1)), Stamped("grab@2.5:ball:0,0.1,0", 2.5));
        Assert.Equal(ExternalEvent.HoldKeyframe(At(1), 2, 3, First, V(1, 4), V(0)), Stamped("keyframe@2.5:ball:1,4,0", 2.5));
        Assert.Equal(ExternalEvent.HoldKeyframe(At(1), 2, 3, First, V(1, 4), V(0)), Stamped("knot@2.5:ball:1,4,0", 2.5));
        Assert.Equal(ExternalEvent.Release(At(1), 2, 3, First, V(0, 4)), Stamped("release@2.5:ball:0,4,0", 2.5));
        Assert.Equal(ExternalEvent.Remove(At(1), 2, 3, First), Stamped("remove@9", 9));
        Assert.Equal(ExternalEvent.Remove(At(1), 2, 3, Second), Stamped("remove@9:a:b", 9));
        Assert.Equal(ExternalEvent.Remove(At(1), 2, 3, new BodyId(1, 7, 0)), Stamped("remove@9:1.7.0", 9));
        Assert.Equal(ExternalEvent.Spawn(At(1), 2, 3, Ball(), V(0, 9)), Stamped("spawn@1:0,9,0", 1));
        Assert.Equal(ExternalEvent.Spawn(At(1), 2, 3, Ball(0.25, 3), V(0, 9)), Stamped("spawn@1:a:b:0,9,0", 1));
    }

    [Theory]
    [InlineData("teleport", "it must be KIND@SECONDS:X,Y,Z")]
    [InlineData("", "it must be KIND@SECONDS:X,Y,Z")]
    [InlineData("fly@3:0,1,2", "'fly' must be one of teleport, set-velocity, impulse, spawn, grab, keyframe, release, remove")]
    [InlineData("Teleport@3:0,1,2", "'Teleport' must be one of")]
    [InlineData("teleport@:0,1,2", "its time is ''")]
    [InlineData("teleport@x:0,1,2", "its time is 'x', it must be a number of seconds between 0 and 1000000")]
    [InlineData("teleport@-1:0,1,2", "its time is '-1'")]
    [InlineData("teleport@NaN:0,1,2", "its time is 'NaN'")]
    [InlineData("teleport@1e7:0,1,2", "its time is '1e7'")]
    [InlineData("teleport@3", "teleport needs X,Y,Z besides, where to in m: such as teleport@3:0,5,0.")]
    [InlineData("impulse@3", "impulse needs X,Y,Z besides, how hard in N s: such as impulse@3:0,5,0.")]
    [InlineData("teleport@3:", "'' must be three numbers, X,Y,Z")]
    [InlineData("teleport@3:ball", "'ball' must be three numbers")]
    [InlineData("teleport@3:0,1", "'0,1' must be three numbers")]
    [InlineData("teleport@3:0,1,2,3", "'0,1,2,3' must be three numbers")]
    [InlineData("teleport@3:0,1,NaN", "must be three numbers")]
    [InlineData("teleport@3:0,1,1e999", "must be three numbers")]
    [InlineData("teleport@3::0,1,2", "its body has no name")]
    [InlineData("remove@3:", "its body has no name")]
    public void Parse_WhatIsNone_IsRefusedWithWhatIsWrong(string text, string says)
    {
        string message = Assert.Throws<UsageException>(() => ScriptedAction.Parse(text)).Message;
        Assert.StartsWith($"--do is '{text}'; ", message, StringComparison.Ordinal);
        Assert.Contains(says, message, StringComparison.Ordinal);
        Tool.Refuses(2, ["join", "127.0.0.1:9", "--do", text], message, "Try 'lagsim join --help'.");
    }

    [Fact]
    public void ActionIn_BodyThatIsNotThere_IsRefusedWithThoseThatAre()
    {
        Refused("remove@1:bell", Two, "scene 'two' has no body 'bell'; it has ball, a:b.");
        Refused("remove@1:1.0.0", Two, "has no body '1.0.0'");
        Refused("remove@1:1.2.3", Two, "has no body '1.2.3'");
        Refused("spawn@1:1.2.0:0,1,2", Two, "a new body takes after one of the scene's own.");
        Refused("remove@1", new SceneBuilder("none").Build(), "scene 'none' has no body.");
        SceneBuilder many = new("many");
        Enumerable.Range(0, 12).ToList().ForEach(n => many.AddBody($"b{n}", Ball(), V(3 * n)));
        Refused("remove@1:x", many.Build(), "it has b0, b1, b2, b3, b4, b5, b6, b7, b8, b9, ....");

        static void Refused(string text, Scene scene, string says) =>
            Assert.Contains(says, Assert.Throws<UsageException>(() => ScriptedAction.Parse(text).ActionIn(scene)).Message, StringComparison.Ordinal);
    }

    private static ExternalEvent Stamped(string text, double seconds)
    {
        ScriptedAction action = ScriptedAction.Parse(text);
        Assert.Equal((text, seconds), (action.Text, action.Seconds));
        return action.ActionIn(Two).Stamp(At(1), 2, 3);
    }
}
