using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Net.Sessions.Hosts;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>Players and machines are shut out for good, or for a while that doubles; a machine only where nothing proves who the player is.</summary>
public sealed class BanListTests
{
    private static readonly PeerAddress Machine = PeerAddress.Virtual(1).Machine;
    private static readonly PeerAddress Other = PeerAddress.Virtual(2).Machine;
    private static readonly PlayerNames Ada = new(new PlayerAdmission("ada", "Ada", PlayerRights.All), 0, null);
    private static readonly PlayerNames Bob = new(new PlayerAdmission("bob", "Bob", PlayerRights.All), 0, null);
    private static readonly PlayerNames Third = new(null, 3, null);
    private static readonly SimTime Now = SimTime.FromSeconds(1);

    [Fact]
    public void ShutOutForAWhile_AgainAndAgain_LastsTwiceAsLongUpToAnHour()
    {
        BanList shutOuts = new();
        SimTime now = Now;
        foreach (int seconds in (int[])[60, 120, 240, 480, 960, 1920, 3600, 3600])
        {
            shutOuts.ShutOutForAWhile(Ada, Machine, now);
            Assert.True(shutOuts.IsShutOut(Ada, Other, now + SimDuration.FromSeconds(seconds - 1)));
            Assert.False(shutOuts.IsShutOut(Bob, Machine, now));
            now += SimDuration.FromSeconds(seconds);
            Assert.False(shutOuts.IsShutOut(Ada, Machine, now));
        }
    }

    /// <summary>Who shares an address with one that is sent away gets in, and a machine from which one after the other is sent away does not.</summary>
    [Fact]
    public void ShutOutForAWhile_NobodyProven_TheMachineIsOutFromTheSecondOnWithinTenMinutes()
    {
        BanList shutOuts = new();
        PlayersPlace first = new(1), second = new(2), third = new(3);
        shutOuts.ShutOutForAWhile(first.Names, Machine, Now);
        Assert.True(shutOuts.IsShutOut(first.Names, Machine, Now));
        Assert.False(shutOuts.IsShutOut(second.Names, Machine, Now));
        SimTime next = Now + SimDuration.FromSeconds(601);
        shutOuts.ShutOutForAWhile(second.Names, Machine, next);
        Assert.False(shutOuts.IsShutOut(default, Machine, next));
        next += SimDuration.FromSeconds(599);
        shutOuts.ShutOutForAWhile(third.Names, Machine, next);
        Assert.True(shutOuts.IsShutOut(default, Machine, next + SimDuration.FromSeconds(59)));
        Assert.False(shutOuts.IsShutOut(default, Other, next));
        Assert.False(shutOuts.IsShutOut(Ada, Machine, next)); // a token proves that it is somebody else
        Assert.False(shutOuts.IsShutOut(default, Machine, next + SimDuration.FromSeconds(60)));

        // It has been out before: the next is enough, and it is out for twice as long.
        next += SimDuration.FromSeconds(1000);
        shutOuts.ShutOutForAWhile(default, Machine, next);
        Assert.True(shutOuts.IsShutOut(default, Machine, next + SimDuration.FromSeconds(119)));
    }

    [Fact]
    public void ShutOutForAWhile_ProvenPlayers_NeverTheirMachine()
    {
        BanList shutOuts = new();
        shutOuts.ShutOutForAWhile(Ada, Machine, Now);
        shutOuts.ShutOutForAWhile(Bob, Machine, Now);
        shutOuts.ShutOutForAWhile(Third, Machine, Now);
        Assert.True(shutOuts.IsShutOut(Third, Other, Now));
        Assert.False(shutOuts.IsShutOut(default, Machine, Now));
        shutOuts.ShutOut(Bob, Machine);
        Assert.False(shutOuts.IsShutOut(default, Machine, Now));
        Assert.True(shutOuts.IsShutOut(Bob, Other, Now + SimDuration.FromSeconds(100_000)));
    }

    [Theory]
    [InlineData(true, true)]
    [InlineData(true, false)]
    [InlineData(false, true)]
    public void LetInAgain_EndsBothKindsForThePlayersOfTheMachine(bool isForGood, bool isProven)
    {
        BanList shutOuts = new();
        PlayerNames who = isProven ? Ada : default;
        SimTime now = Now;
        Assert.False(shutOuts.LetInAgain(Machine, now));
        if (isForGood)
        {
            shutOuts.ShutOut(who, Machine);
            now += SimDuration.FromSeconds(100_000);
        }
        else
        {
            shutOuts.ShutOutForAWhile(who, Machine, now);
        }

        Assert.True(shutOuts.IsShutOut(who, Machine, now));
        Assert.False(shutOuts.LetInAgain(Other, now));
        Assert.True(shutOuts.LetInAgain(Machine, now));
        Assert.False(shutOuts.IsShutOut(who, Machine, now));
    }

    /// <summary>One that is banned for good does not get in sooner for having cost too much as well.</summary>
    [Fact]
    public void ShutOutForAWhile_WhoIsOutForGood_StaysOut()
    {
        BanList shutOuts = new();
        shutOuts.ShutOut(Ada, Machine);
        shutOuts.ShutOutForAWhile(Ada, Machine, Now);
        Assert.True(shutOuts.IsShutOut(Ada, Machine, Now + SimDuration.FromSeconds(100_000)));
    }

    /// <summary>A player whom nothing but the pass of its place tells from others.</summary>
    private sealed class PlayersPlace
    {
        internal PlayersPlace(uint visit)
        {
            PlayerPlaces.Place place = new PlayerPlaces(new HostOptions(), Now)[(byte)visit];
            place.Take(isSamePlayer: false, Machine, null, visit);
            Names = new PlayerNames(null, 0, place);
        }

        internal PlayerNames Names { get; }
    }
}
