using System;
using LagSim.Cli.Commands;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Cli;

/// <summary>When a session says that its machine is too slow: if the world stays behind, and not while it catches up.</summary>
public sealed class PaceWatchTests
{
    [Theory]
    [InlineData(0, 0.5, true)] // half as fast as time passes
    [InlineData(0, 1.5, false)] // fast enough
    [InlineData(30, 1.01, false)] // has come late, and catches up
    [InlineData(30, 1, true)] // has come late, and stays as far behind
    [InlineData(30, 0.5, true)]
    [InlineData(1.9, 1, false)] // a little behind
    public void Finds_OnlyWhatStaysBehind_AndOnce(double behindAtFirst, double pace, bool expected)
    {
        PaceWatch watch = new();
        double behind = behindAtFirst;
        int found = 0;
        for (double now = 0; now < 10; now += 0.1)
        {
            found += watch.Finds(At(now), SimDuration.FromSeconds(behind)) ? 1 : 0;
            behind = Math.Max(0, behind + (0.1 * (1 - pace)));
        }

        Assert.Equal(expected ? 1 : 0, found);
    }

    [Fact]
    public void Finds_AfterASleep_NothingIfItCatchesUp()
    {
        PaceWatch watch = new();
        Assert.False(watch.Finds(At(1), SimDuration.Zero));
        Assert.False(watch.Finds(At(61), SimDuration.FromSeconds(60)));
        Assert.False(watch.Finds(At(62), SimDuration.FromSeconds(20)));
        Assert.False(watch.Finds(At(63), SimDuration.FromSeconds(1)));
        Assert.False(watch.Finds(At(90), SimDuration.FromSeconds(3)));
        Assert.False(watch.Finds(At(91), SimDuration.FromSeconds(3)));
        Assert.True(watch.Finds(At(93), SimDuration.FromSeconds(3)));
    }
}
