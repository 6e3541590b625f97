using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Hosts;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>Machines are shut out for good, or for a while that doubles.</summary>
public sealed class BanListTests
{
    private static readonly PeerAddress Machine = PeerAddress.Virtual(1).Machine;
    private static readonly PeerAddress Other = PeerAddress.Virtual(2).Machine;

    [Fact]
    public void ShutOutForAWhile_AgainAndAgain_LastsTwiceAsLongUpToAnHour()
    {
        BanList shutOuts = new();
        SimTime now = SimTime.FromSeconds(1);
        foreach (int seconds in (int[])[60, 120, 240, 480, 960, 1920, 3600, 3600])
        {
            shutOuts.ShutOutForAWhile(Machine, now);
            Assert.True(shutOuts.IsShutOut(Machine, now + SimDuration.FromSeconds(seconds - 1)));
            Assert.False(shutOuts.IsShutOut(Other, now));
            now += SimDuration.FromSeconds(seconds);
            Assert.False(shutOuts.IsShutOut(Machine, now));
        }
    }

    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void LetInAgain_EndsBothKinds(bool isForGood)
    {
        BanList shutOuts = new();
        SimTime now = SimTime.FromSeconds(1);
        Assert.False(shutOuts.LetInAgain(Machine, now));
        if (isForGood)
        {
            shutOuts.Ban(Machine);
            now += SimDuration.FromSeconds(100_000);
        }
        else
        {
            shutOuts.ShutOutForAWhile(Machine, now);
        }

        Assert.True(shutOuts.IsShutOut(Machine, now));
        Assert.True(shutOuts.LetInAgain(Machine, now));
        Assert.False(shutOuts.IsShutOut(Machine, now));
    }
}
