using System;
using LagSim.Hosting;
using LagSim.Net.Sessions;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Api;

/// <summary>Values that no call has a use for are refused with what is allowed; the nearest good ones are the controls.</summary>
public sealed class RefusedValueTests
{
    [Theory]
    [InlineData(-1, true)]
    [InlineData(0, false)]
    [InlineData(1, true)]
    public void BodyAt_APlaceThatNoBodyHas_NamesHowManyThereAre(int n, bool isRefused)
    {
        Simulation world = Run(Drop(1, 0.5), 1);
        Refuses(isRefused, "1 body", () => _ = world.BodyAt(n));
        LiveWorld live = new(Drop(1, 0.5), new SimulationOptions());
        live.Step(At(0.1));
        RenderSnapshot shown = live.RenderSnapshots.Latest()!;
        Refuses(isRefused, "1 body", () => _ = shown.BodyAt(n));
    }

    [Theory]
    [InlineData((HealingMode)9, true)]
    [InlineData(HealingMode.SyncTest, false)]
    public void Healing_ThatThereIsNot_NamesThoseThatThereAre(HealingMode healing, bool isRefused) =>
        Refuses(isRefused, nameof(HealingMode.FullRollback), () => _ = new SimulationOptions(healing: healing));

    [Theory]
    [InlineData(-1, true)]
    [InlineData(0, false)]
    public void HistoryFor_AnEventThatCameBeforeItsTime_IsRefused(int ticks, bool isRefused) =>
        Refuses(isRefused, "zero or more", () => _ = LatencyCompensationWindow.HistoryFor([SimDuration.FromTicks(ticks)]));

    [Theory]
    [InlineData(double.NaN, 0, true)]
    [InlineData(0, double.PositiveInfinity, true)]
    [InlineData(1, 1, false)]
    public void TrySample_AHandThatIsNoNumber_IsRefused(double position, double velocity, bool isRefused)
    {
        HandSender sender = new(First);
        Refuses(isRefused, "finite numbers", () => sender.TrySample(At(0), V(position), V(velocity), out _));
        Assert.Equal(isRefused ? 0 : 1, sender.KeyframesSent);
    }

    [Fact]
    public void Snapshot_OfAWorldThatNothingIsSimulatedOf_SaysSo()
    {
        Simulation world = new(Drop(1, 0.5));
        Refuses(true, "advance the world first", () => _ = world.Snapshot(world.Start));
        world.AdvanceTo(At(0.1));
        Refuses(true, "can be taken from", () => _ = world.Snapshot(world.Start));
        Refuses(false, "", () => _ = world.Snapshot(At(0.1)));
    }

    [Theory]
    [InlineData(double.NaN, true)]
    [InlineData(-1, true)]
    [InlineData(0, false)]
    [InlineData(double.PositiveInfinity, false)]
    public void HandOfAPlayer_WhoseBoundIsNoNumber_IsRefused(double bound, bool isRefused)
    {
        Refuses(isRefused, "a number above 0 N", () => new HostOptions { MaxHandForce = bound }.Check());
        Refuses(isRefused, "a number above 0 W", () => new HostOptions { MaxHandPower = bound }.Check());
    }

    [Theory]
    [InlineData(0.009, true)]
    [InlineData(0.01, false)]
    [InlineData(1, false)]
    [InlineData(1.001, true)]
    public void KeepAlive_BeyondAThirdOfTheTimeout_SaysOfWhat(double seconds, bool isRefused) => Refuses(
        isRefused, "a third of the timeout of 3s", () => new HostOptions { Timeout = SimDuration.FromSeconds(3), KeepAlive = SimDuration.FromSeconds(seconds) }.Check());

    [Theory]
    [InlineData(double.NaN, true)]
    [InlineData(0.5, true)]
    [InlineData(1, false)]
    public void Budget_OutOfRange_SaysWhichOfTheTwo(double work, bool isRefused)
    {
        Refuses(isRefused, "per second", () => _ = new PlayerBudget(work, 1));
        Refuses(isRefused, "at once", () => _ = new PlayerBudget(1, work));
    }

    private static void Refuses(bool isRefused, string word, Action act)
    {
        if (isRefused)
        {
            Assert.Contains(word, Assert.Throws<ArgumentOutOfRangeException>(act).Message, StringComparison.Ordinal);
        }
        else
        {
            act();
        }
    }
}
