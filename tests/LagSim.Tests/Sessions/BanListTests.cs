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
    private static readonly KnownPlayer Ada = new(new PlayerAdmission("ada", "Ada", PlayerRights.All), 0, null);
    private static readonly KnownPlayer Bob = new(new PlayerAdmission("bob", "Bob", PlayerRights.All), 0, null);
    private static readonly KnownPlayer Third = new(null, 3, null);
    private static readonly SimTime Now = SimTime.FromSeconds(1);

    [Fact]
    public void ShutOutForAWhile_AgainAndAgain_LastsTwiceAsLongUpToAnHour()
    {
        BanList shutOuts = new(new JoinLimits());
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
        BanList shutOuts = new(new JoinLimits());
        PlayersPlace first = new(1), second = new(2), third = new(3);
        shutOuts.ShutOutForAWhile(first.Known, Machine, Now);
        Assert.True(shutOuts.IsShutOut(first.Known, Machine, Now));
        Assert.False(shutOuts.IsShutOut(second.Known, Machine, Now));
        SimTime next = Now + SimDuration.FromSeconds(601);
        shutOuts.ShutOutForAWhile(second.Known, Machine, next);
        Assert.False(shutOuts.IsShutOut(default, Machine, next));
        next += SimDuration.FromSeconds(599);
        shutOuts.ShutOutForAWhile(third.Known, Machine, next);
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
        BanList shutOuts = new(new JoinLimits());
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
        BanList shutOuts = new(new JoinLimits());
        KnownPlayer who = isProven ? Ada : default;
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
        BanList shutOuts = new(new JoinLimits());
        shutOuts.ShutOut(Ada, Machine);
        shutOuts.ShutOutForAWhile(Ada, Machine, Now);
        Assert.True(shutOuts.IsShutOut(Ada, Machine, Now + SimDuration.FromSeconds(100_000)));
    }

    /// <summary>
    /// Thousands are sent away, each by its pass or token and from a machine of its own: no more are remembered than is stated, and one that is out
    /// for good stays out. The control: without the limit they are all remembered, and an hour after they are over only who is out for good.
    /// </summary>
    [Theory]
    [InlineData(100)]
    [InlineData(int.MaxValue)]
    public void ShutOutForAWhile_Thousands_AreRememberedUpToTheLimitOrForAnHour(int most)
    {
        BanList shutOuts = new(new JoinLimits { PassingBans = most });
        shutOuts.ShutOut(Bob, Other);
        shutOuts.ShutOut(default, Other);
        SimTime now = Now;
        for (int n = 0; n < 1000; n++, now += SimDuration.FromSeconds(0.01))
        {
            PeerAddress machine = PeerAddress.Virtual(100 + n).Machine;
            shutOuts.ShutOutForAWhile(n % 2 == 0 ? new PlayersPlace((uint)(n % 16) + 1, (uint)n).Known : Account(n), machine, now);
        }

        Assert.Equal(most == int.MaxValue ? 1502 : 202, shutOuts.Count); // of those with tokens no machine
        Assert.True(shutOuts.IsShutOut(Account(999), Machine, now)); // the latest are kept
        Assert.Equal(most == int.MaxValue, shutOuts.IsShutOut(Account(1), Machine, now));
        now += SimDuration.FromSeconds(3661);
        shutOuts.ShutOutForAWhile(default, Machine, now);
        shutOuts.ShutOutForAWhile(Ada, Machine, now);
        Assert.Equal(4, shutOuts.Count);
        Assert.True(shutOuts.IsShutOut(Bob, Machine, now));
        Assert.True(shutOuts.IsShutOut(default, Other, now));

        static KnownPlayer Account(int n) => new(new PlayerAdmission($"account {n}", "", PlayerRights.All), 0, null);
    }

    /// <summary>What is over is forgotten before what goes on, however much later it was added; then what ends first.</summary>
    [Fact]
    public void ShutOutForAWhile_MoreThanTheLimit_ForgetsWhatIsOverThenWhatEndsFirst()
    {
        BanList shutOuts = new(new JoinLimits { PassingBans = 2 });
        shutOuts.ShutOutForAWhile(Ada, Machine, Now);
        SimTime now = Now + SimDuration.FromSeconds(60);
        shutOuts.ShutOutForAWhile(Ada, Machine, now); // for two minutes
        shutOuts.ShutOutForAWhile(Bob, Machine, now); // for one
        now += SimDuration.FromSeconds(61);
        shutOuts.ShutOutForAWhile(Third, Machine, now);
        Assert.Equal((true, true, 2), (shutOuts.IsShutOut(Ada, Other, now), shutOuts.IsShutOut(Third, Other, now), shutOuts.Count)); // Bob's was over
        shutOuts.ShutOutForAWhile(Bob, Machine, now + SimDuration.OneTick);
        Assert.Equal((false, true, true), (shutOuts.IsShutOut(Ada, Other, now), shutOuts.IsShutOut(Third, Other, now), shutOuts.IsShutOut(Bob, Other, now)));
    }

    /// <summary>A player whom nothing but the pass of its place tells from others.</summary>
    private sealed class PlayersPlace
    {
        internal PlayersPlace(uint visit)
            : this(visit, visit)
        {
        }

        internal PlayersPlace(uint number, uint visit)
        {
            PlayerPlaces.Place place = new PlayerPlaces(new HostOptions(), Now)[(byte)number];
            place.Take(isSamePlayer: false, Machine, null, visit);
            Known = new KnownPlayer(null, 0, place);
        }

        internal KnownPlayer Known { get; }
    }
}
