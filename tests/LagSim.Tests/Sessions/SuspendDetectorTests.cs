using LagSim.Net.Sessions.Core;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>A long time between two looks is a sleep of the machine.</summary>
public sealed class SuspendDetectorTests
{
    [Theory]
    [InlineData(5, 0)]
    [InlineData(5.001, 5.001)]
    public void Look_AfterThatManySeconds_TellsASleep(double seconds, double slept)
    {
        SuspendDetector sleep = new(SimDuration.FromSeconds(5), SimTime.FromSeconds(100));
        Assert.Equal(SimDuration.FromSeconds(slept), sleep.Look(SimTime.FromSeconds(100 + seconds)));
        Assert.Equal(SimDuration.Zero, sleep.Look(SimTime.FromSeconds(100 + seconds)));
    }

    [Fact]
    public void Look_FirstOfAll_IsNoSleep()
    {
        SuspendDetector sleep = new(SimDuration.FromSeconds(5));
        Assert.Equal(SimDuration.Zero, sleep.Look(SimTime.FromSeconds(1000)));
        Assert.Equal(SimDuration.FromSeconds(6), sleep.Look(SimTime.FromSeconds(1006)));
    }
}
