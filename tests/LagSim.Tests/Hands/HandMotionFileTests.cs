using System;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Text;
using LagSim.Harness.Experiments.Hands;
using LagSim.Scenes;
using Xunit;

namespace LagSim.Tests.Hands;

/// <summary>Recorded hand motions are read, and what is none is refused by line and value.</summary>
public sealed class HandMotionFileTests
{
    [Fact]
    public void Read_EvenOrUnevenTimes_LiesOnTheSameStraightLine()
    {
        // 60 and 90 samples a second by turns, from an origin of their own.
        StringBuilder text = new("time_s,x_m,y_m,z_m\n");
        double time = 100;
        for (int n = 0; time < 103; time += n++ % 2 == 0 ? 1.0 / 60 : 1.0 / 90)
        {
            text.AppendLine(CultureInfo.InvariantCulture, $"{time:R},{2 * (time - 100):R},1e0,-0.5");
        }

        HandMotion motion = HandMotionFile.Read(new StringReader(text.ToString()), "line.csv");
        Assert.Equal("line.csv", motion.Name);
        Assert.InRange(motion.Seconds, 2.9, 3.0);
        Assert.All(Enumerable.Range(0, motion.Count), n => Assert.True((motion.PositionAt(n) - new Vector3D(2.0 * n / 120, 1, -0.5)).Length < 1e-9));
    }

    [Fact]
    public void Read_FileOfAGeneratedMotion_GivesItBack()
    {
        HandMotion motion = HandMotions.Generate(HandMotions.Random, 3);
        string rows = string.Concat(Enumerable.Range(0, motion.Count).Select(n => FormattableString.Invariant(
            $"{n / 120.0:R},{motion.PositionAt(n).X:R},{motion.PositionAt(n).Y:R},{motion.PositionAt(n).Z:R}\r\n")));
        HandMotion read = HandMotionFile.Read(new StringReader(HandMotionFile.Header + "\r\n" + rows), "m");
        Assert.Equal(motion.Count, read.Count);
        Assert.All(Enumerable.Range(0, motion.Count), n => Assert.True((motion.PositionAt(n) - read.PositionAt(n)).Length < 1e-9));
    }

    [Theory]
    [InlineData("", "line 1", "empty")]
    [InlineData("t,x,y,z\n0,0,0,0\n", "line 1", "'t,x,y,z'", "time_s,x_m,y_m,z_m")]
    [InlineData("time_s,x_m,y_m,z_m\n0,0,0\n", "line 2", "'0,0,0'", "3 values")]
    [InlineData("time_s,x_m,y_m,z_m\n0,0,0,0\n\n0.1,0,0,0\n", "line 3", "''")]
    [InlineData("time_s,x_m,y_m,z_m\n0,0,0,0\n0.01,0,NaN,0\n", "line 3", "y_m", "'NaN'", "-1000", "1000")]
    [InlineData("time_s,x_m,y_m,z_m\n0,0,0,0\n0.01,0,0,1001\n", "line 3", "z_m", "'1001'")]
    [InlineData("time_s,x_m,y_m,z_m\n0,\"0,5\",0\n", "line 2", "x_m")]
    [InlineData("time_s,x_m,y_m,z_m\n0,0,0,0\n0.05,0,0,0\n0.05,0,0,0\n", "line 4", "time_s", "0.05 after 0.05")]
    [InlineData("time_s,x_m,y_m,z_m\n0,0,0,0\n0.2,0,0,0\n", "line 3", "0.2 after 0", "0.1 s")]
    [InlineData("time_s,x_m,y_m,z_m\n0,0,0,0\n0.05,0,0,0\n", "line 3", "lasts 0.05 s", "2 s")]
    [InlineData("time_s,x_m,y_m,z_m\n", "line 1", "lasts 0 s")]
    public void Read_WhatIsNoMotion_IsRefusedByLineAndValue(string text, params string[] says)
    {
        string message = Assert.Throws<HandMotionException>(() => HandMotionFile.Read(new StringReader(text), "bad.csv")).Message;
        Assert.All(says.Append("bad.csv"), word => Assert.Contains(word, message, StringComparison.Ordinal));
    }

    [Fact]
    public void Read_NoSuchFile_IsRefusedByName() =>
        Assert.Contains("nowhere.csv", Assert.Throws<HandMotionException>(() => HandMotionFile.Read("nowhere.csv")).Message, StringComparison.Ordinal);
}
