using System;
using System.Linq;
using LagSim.Cli.Commands;
using LagSim.Cli.Output;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
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

    [Fact]
    public void Parse_Placing_SaysWhatIfOccupiedAndWhose()
    {
        Assert.Equal(ExternalEvent.Teleport(At(1), 2, 3, First, V(0, 15), whenOccupied: WhenOccupied.Skip), Stamped("teleport@3:0,15,0/skip", 3));
        Assert.Equal(
            ExternalEvent.Spawn(At(1), 2, 3, Ball(), V(0, 9), players: PeerSet.Of(0, 2), whenOccupied: WhenOccupied.Beside),
            Stamped("spawn@1:0,9,0/players=0+me/beside", 1));
        Assert.NotEqual(ExternalEvent.Spawn(At(1), 2, 3, Ball(), V(0, 9), players: PeerSet.Of(0, 2)), Stamped("spawn@1:0,9,0/players=0+1", 1)); // the control
    }

    [Theory]
    [InlineData("command@2:7", 7, new byte[0])]
    [InlineData("command@2:65535,0x01ff", 65535, new byte[] { 1, 255 })]
    [InlineData("command@2:1,0x", 1, new byte[0])]
    [InlineData("command@2:1,a:b,c", 1, new byte[] { 97, 58, 98, 44, 99 })]
    public void Parse_Command_HasItsNumberAndBytes(string text, int number, byte[] data)
    {
        Scene ruled = BuiltInScenes.Goals();
        Assert.Equal(PlayerAction.Command(new GameCommand(number, data)).Stamp(At(1), 2, 3), ScriptedAction.Parse(text).ActionIn(ruled, 2).Stamp(At(1), 2, 3));
        Assert.Contains("scene 'two' has no rules", Assert.Throws<UsageException>(() => ScriptedAction.Parse(text).ActionIn(Two, 2)).Message);
    }

    [Theory]
    [InlineData("grab@2:ball:0,0,0.1", 0, 0)]
    [InlineData("grab@2:ball:0,0,0.1/force=40", 40, 0)]
    [InlineData("grab@2:ball:0,0,0.1/power=5e3/force=40", 40, 5000)]
    public void Parse_Grab_HasTheHandsStrength(string text, double force, double power)
    {
        ExternalEvent grab = Stamped(text, 2);
        Assert.Equal((EventKind.Grab, force, power), (grab.Kind, grab.MaxForce, grab.MaxPower));
    }

    [Fact]
    public void Parse_Ahead_HasBothTimes()
    {
        ScriptedAction ahead = ScriptedAction.Parse("impulse@2.5..2.75:ball:0,4,0");
        Assert.Equal((2.5, 2.75), (ahead.Seconds, ahead.At));
        Assert.Null(ScriptedAction.Parse("impulse@2.5:ball:0,4,0").At);
    }

    [Theory]
    [InlineData("teleport", "it must be KIND@SECONDS:X,Y,Z")]
    [InlineData("", "it must be KIND@SECONDS:X,Y,Z")]
    [InlineData("grab@1:0,0,0/strength=3", "'/strength=3' must be one of /force=NEWTONS, /power=WATTS")]
    [InlineData("grab@1:0,0,0/force=-3", "'/force=-3' must be a number above 0, up to 1e30")]
    [InlineData("fly@3:0,1,2", "'fly' must be one of teleport, set-velocity, impulse, spawn, grab, keyframe, release, remove, command")]
    [InlineData("teleport@3..:0,1,2", "its time is '', it must be a number of seconds between 0 and 1000000")]
    [InlineData("teleport@3..2:0,1,2", "it is to be done at 3 s for 2 s, which must be later")]
    [InlineData("teleport@3..3:0,1,2", "it is to be done at 3 s for 3 s, which must be later")]
    [InlineData("teleport@3..4..5:0,1,2", "its time is '4..5'")]
    [InlineData("command@3", "its number is '', it must be a whole number from 0 to 65535, such as command@3:1")]
    [InlineData("command@3:65536", "its number is '65536'")]
    [InlineData("command@3:-1,x", "its number is '-1'")]
    [InlineData("command@3:1,0x1", "its data is '0x1'; after 0x come hexadecimal digits, two for each byte")]
    [InlineData("command@3:1,0xgg", "its data is '0xgg'")]
    [InlineData("spawn@1:0,9,0/fly", "'/fly' must be one of /skip, /beside, /players=NUMBERS")]
    [InlineData("spawn@1:0,9,0/", "'/' must be one of")]
    [InlineData("impulse@1:0,9,0/skip", "'/skip' is not for impulse, but for spawn and teleport")]
    [InlineData("teleport@1:0,9,0/players=1", "'/players=1' is not for teleport, but for spawn")]
    [InlineData("spawn@1:0,9,0/skip/beside", "'/beside' comes after another of its kind; one is allowed")]
    [InlineData("spawn@1:0,9,0/players=1/players=2", "'/players=2' comes after another of its kind")]
    [InlineData("spawn@1:0,9,0/players=17", "'17' in /players=17 must be me, or a player's number from 0 to 16")]
    [InlineData("spawn@1:0,9,0/players=1+", "'' in /players=1+ must be me")]
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
        string long129 = $"command@1:1,{new string('x', 129)}";
        Assert.Contains("it carries 129 bytes; at most 128 are allowed", Assert.Throws<UsageException>(() => ScriptedAction.Parse(long129)).Message);
        Refused("remove@1:bell", Two, "scene 'two' has no body 'bell'; it has ball, a:b.");
        Refused("remove@1:1.0.0", Two, "has no body '1.0.0'");
        Refused("remove@1:1.2.3", Two, "has no body '1.2.3'");
        Refused("spawn@1:1.2.0:0,1,2", Two, "a new body takes after one of the scene's own.");
        Refused("remove@1", new SceneBuilder("none").Build(), "scene 'none' has no body.");
        SceneBuilder many = new("many");
        Enumerable.Range(0, 12).ToList().ForEach(n => many.AddBody($"b{n}", Ball(), V(3 * n)));
        Refused("remove@1:x", many.Build(), "it has b0, b1, b2, b3, b4, b5, b6, b7, b8, b9, ....");

        static void Refused(string text, Scene scene, string says) =>
            Assert.Contains(says, Assert.Throws<UsageException>(() => ScriptedAction.Parse(text).ActionIn(scene, 2)).Message, StringComparison.Ordinal);
    }

    private static ExternalEvent Stamped(string text, double seconds)
    {
        ScriptedAction action = ScriptedAction.Parse(text);
        Assert.Equal((text, seconds), (action.Text, action.Seconds));
        return action.ActionIn(Two, 2).Stamp(At(1), 2, 3);
    }
}
