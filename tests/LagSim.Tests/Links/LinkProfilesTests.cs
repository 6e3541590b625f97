using System;
using System.Linq;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Links;

public sealed class LinkProfilesTests
{
    [Theory]
    [InlineData("loopback", 0.05, 0.01, 0, 1)]
    [InlineData("lan", 0.3, 0.05, 0, 1)]
    [InlineData("skewed-clock", 0.3, 0.05, 0, 1)]
    [InlineData("wifi-good", 1.5, 0, 0.1, 2)]
    [InlineData("wifi-busy", 10, 0, 1, 3)]
    [InlineData("3g", 125, 50, 0.5, 2)]
    [InlineData("starlink", 25, 7, 0.3, 1 / 0.997)]
    [InlineData("transatlantic", 39, 1, 0.1, 1.5)]
    [InlineData("eu-australia", 174, 3, 0.2, 2)]
    [InlineData("satellite", 325, 10, 0.5, 2)]
    [InlineData("awful", 200, 60, 10, 5, 5, 2)]
    [InlineData("blackout", 40, 2, 0, 1)]
    [InlineData("modem-64k", 60, 5, 0, 1)]
    [InlineData("bufferbloat", 20, 2, 0, 1)]
    [InlineData("dip", 40, 2, 0, 1)]
    [InlineData("delay-0ms", 0, 0, 0, 1)]
    [InlineData("delay-25ms", 25, 0, 0, 1)]
    [InlineData("delay-0.5ms", 0.5, 0, 0, 1)]
    public void TryGet_KnownName_IsTheProfileOfTheDesign(
        string name, double delay, double jitter, double loss, double burst, double reorder = 0, double duplicate = 0)
    {
        LinkProfile profile = Profile(name);
        Assert.Equal(name, profile.Name);
        Assert.Same(profile.ToHost, profile.FromHost);
        Assert.Equal((delay, jitter, loss, burst, reorder, duplicate), Values(profile.ToHost));
    }

    [Theory]
    [InlineData("4g", 45, 15, 45, 5, 0.2)]
    [InlineData("5g", 18, 4, 7, 2, 0.1)]
    [InlineData("dsl-256k", 25, 2, 25, 2, 0, 1)]
    public void TryGet_UnevenProfile_HasTheValuesOfEachDirection(
        string name, double delayUp, double jitterUp, double delayDown, double jitterDown, double loss, double burst = 1.5)
    {
        LinkProfile profile = Profile(name);
        Assert.Equal((delayUp, jitterUp, loss, burst, 0, 0), Values(profile.ToHost));
        Assert.Equal((delayDown, jitterDown, loss, burst, 0, 0), Values(profile.FromHost));
    }

    [Fact]
    public void All_ByWhatTheyDoBesides_AreThoseOfTheDesign()
    {
        string[] table =
        [
            "loopback", "lan", "skewed-clock", "wifi-good", "wifi-busy", "4g", "3g", "5g", "starlink", "transatlantic", "eu-australia", "satellite",
            "awful", "blackout", "dsl-256k", "modem-64k", "bufferbloat", "dip",
        ];
        Assert.Equal(table, LinkProfiles.All.Select(profile => profile.Name).Take(table.Length));
        Assert.Equal(LinkProfiles.Ladder, LinkProfiles.All.Skip(table.Length));

        Assert.Equal(["skewed-clock"], Names(profile => profile.ReceiverClockOffset != SimDuration.Zero));
        Assert.Equal(SimDuration.FromSeconds(1.24), LinkProfiles.SkewedClock.ReceiverClockOffset);
        Assert.Equal(["wifi-good", "wifi-busy"], Names(profile => profile.ToHost.Tail is not null));
        Assert.Equal("1 % above 125 ms", LinkProfiles.WifiGood.ToHost.Tail!.ToString());
        Assert.Equal("10 % above 50 ms", LinkProfiles.WifiBusy.ToHost.Tail!.ToString());
        Assert.Equal(["starlink"], Names(profile => profile.ToHost.Step is not null));
        Assert.Equal(["starlink", "blackout"], Names(profile => profile.ToHost.Outage is not null));
        Assert.Equal(["dsl-256k", "modem-64k", "bufferbloat", "dip"], Names(profile => profile.ToHost.Bottleneck is not null));
        Assert.Equal(["dip"], Names(profile => profile.ToHost.Bottleneck?.Dip is not null));
        Assert.Equal(["bufferbloat"], Names(profile => profile.HasBulkTransfer));
    }

    [Theory]
    [InlineData("dsl-256k", 256_000, 2_000_000, 500)]
    [InlineData("modem-64k", 64_000, 64_000, 1_000)]
    [InlineData("bufferbloat", 1_000_000, 1_000_000, 2_000)]
    [InlineData("dip", 512_000, 512_000, 1_000)]
    public void TryGet_NarrowProfile_HasTheRatesAndTheQueueOfTheDesign(string name, long up, long down, double queue)
    {
        LinkProfile profile = Profile(name);
        Assert.Equal((up, queue), (profile.ToHost.Bottleneck!.RateBitsPerSecond, profile.ToHost.Bottleneck.QueueMilliseconds));
        Assert.Equal((down, queue), (profile.FromHost.Bottleneck!.RateBitsPerSecond, profile.FromHost.Bottleneck.QueueMilliseconds));
        Assert.All(
            new[] { profile.ToHost.Bottleneck, profile.FromHost.Bottleneck },
            narrow => Assert.Equal((QueueDiscipline.DropTail, Bottleneck.DefaultBurstBytes), (narrow.Discipline, narrow.BurstBytes)));
    }

    [Fact]
    public void TryGet_Dip_IsFiveSecondsOfAHundredKilobitsEveryThirty()
    {
        PeriodicDip dip = Profile("dip").ToHost.Bottleneck!.Dip!;
        Assert.Equal((SimDuration.FromSeconds(30), SimDuration.FromSeconds(5), 100_000), (dip.Period, dip.Length, dip.RateBitsPerSecond));
    }

    [Fact]
    public void LinkProfile_BulkTransferWithoutABottleneck_IsRefused()
    {
        LinkLeg wide = new(10), narrow = new(10) { Bottleneck = new Bottleneck(1_000_000, 100) };
        Assert.Contains("'wide'", Assert.Throws<ArgumentException>(() => new LinkProfile("wide", narrow, wide) { HasBulkTransfer = true }).Message, StringComparison.Ordinal);
        Assert.True(new LinkProfile("narrow down", wide, narrow) { HasBulkTransfer = true }.HasBulkTransfer);
    }

    [Theory]
    [InlineData("")]
    [InlineData("Lan")]
    [InlineData("wifi")]
    [InlineData("delay-ms")]
    [InlineData("delay--5ms")]
    [InlineData("delay-NaNms")]
    [InlineData("delay-1e3ms")]
    [InlineData("delay-60001ms")]
    [InlineData("delay-25")]
    public void TryGet_UnknownName_SaysWhatThereIs(string name)
    {
        Assert.False(LinkProfiles.TryGet(name, out LinkProfile? profile, out string? error));
        Assert.Null(profile);
        Assert.Contains($"'{name}'", error, StringComparison.Ordinal);
        Assert.All(LinkProfiles.All, known => Assert.Contains(known.Name, error, StringComparison.Ordinal));
        Assert.Contains("delay-Nms for any N from 0 to 2000", error, StringComparison.Ordinal);
    }

    [Fact]
    public void TryGet_EveryProfileOfTheCatalogue_FindsThatVeryOne()
    {
        Assert.All(LinkProfiles.All, known =>
        {
            Assert.True(LinkProfiles.TryGet(known.Name, out LinkProfile? found, out _));
            Assert.Same(known, found);
        });
    }

    [Fact]
    public void Ladder_Always_HasTheStepsOfTheDesign()
    {
        double[] steps = [0, 10, 20, 50, 100, 200, 500, 1000, 2000];
        Assert.Equal(steps, LinkProfiles.Ladder.Select(profile => profile.ToHost.DelayMilliseconds));
    }

    [Theory]
    [InlineData(-1)]
    [InlineData(double.NaN)]
    [InlineData(double.PositiveInfinity)]
    [InlineData(60_000.1)]
    public void PureDelay_OutOfRange_IsRefused(double milliseconds)
    {
        Assert.Throws<ArgumentOutOfRangeException>(() => LinkProfiles.PureDelay(milliseconds));
    }

    [Fact]
    public void LinkLeg_ValueOutOfRange_IsRefused()
    {
        Assert.Throws<ArgumentOutOfRangeException>(() => new LinkLeg(-1));
        Assert.Throws<ArgumentOutOfRangeException>(() => new LinkLeg(double.NaN));
        Assert.Throws<ArgumentOutOfRangeException>(() => new LinkLeg(1, jitterMilliseconds: double.PositiveInfinity));
        Assert.Throws<ArgumentOutOfRangeException>(() => new LinkLeg(1, lossPercent: 100.1));
        Assert.Throws<ArgumentOutOfRangeException>(() => new LinkLeg(1, lossPercent: 1, meanBurstLength: 0.5));
        Assert.Throws<ArgumentOutOfRangeException>(() => new LinkLeg(1, duplicatePercent: -1));
    }

    [Fact]
    public void LinkLeg_LossThatItsBurstsCannotMake_IsRefused()
    {
        ArgumentException error = Assert.Throws<ArgumentException>(() => new LinkLeg(1, lossPercent: 80, meanBurstLength: 2));
        Assert.Contains("at least 4 datagrams", error.Message, StringComparison.Ordinal);
        Assert.Throws<ArgumentException>(() => new LinkLeg(0, reorderPercent: 1));
    }

    [Fact]
    public void LinkProfile_ValuesPerDirection_KeepsThemApart()
    {
        LinkProfile asymmetric = new("asymmetric", new LinkLeg(10), new LinkLeg(200), SimDuration.FromSeconds(1.24));
        Assert.Equal(10, asymmetric.ToHost.DelayMilliseconds);
        Assert.Equal(200, asymmetric.FromHost.DelayMilliseconds);
        Assert.Equal(210, asymmetric.RoundTripMilliseconds);
        Assert.Equal(SimDuration.FromSeconds(1.24), asymmetric.ReceiverClockOffset);
    }

    private static LinkProfile Profile(string name)
    {
        Assert.True(LinkProfiles.TryGet(name, out LinkProfile? profile, out string? error), error);
        return profile;
    }

    private static (double, double, double, double, double, double) Values(LinkLeg leg) =>
        (leg.DelayMilliseconds, leg.JitterMilliseconds, leg.LossPercent, leg.MeanBurstLength, leg.ReorderPercent, leg.DuplicatePercent);

    private static string[] Names(Func<LinkProfile, bool> condition) => LinkProfiles.All.Where(condition).Select(profile => profile.Name).ToArray();
}
