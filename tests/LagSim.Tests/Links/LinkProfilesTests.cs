using System;
using System.Linq;
using LagSim.Harness.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Links;

public sealed class LinkProfilesTests
{
    [Theory]
    [InlineData("loopback", 0.05, 0.01, 0, 1, 0, 0)]
    [InlineData("lan", 0.3, 0.05, 0, 1, 0, 0)]
    [InlineData("awful", 200, 60, 10, 5, 5, 2)]
    [InlineData("delay-0ms", 0, 0, 0, 1, 0, 0)]
    [InlineData("delay-25ms", 25, 0, 0, 1, 0, 0)]
    [InlineData("delay-0.5ms", 0.5, 0, 0, 1, 0, 0)]
    public void TryGet_KnownName_IsTheProfileOfTheDesign(
        string name, double delay, double jitter, double loss, double burst, double reorder, double duplicate)
    {
        Assert.True(LinkProfiles.TryGet(name, out LinkProfile? profile, out string? error));
        Assert.Null(error);
        Assert.Equal(name, profile.Name);
        Assert.Equal(SimDuration.Zero, profile.ReceiverClockOffset);
        foreach (LinkLeg leg in new[] { profile.ToHost, profile.FromHost })
        {
            Assert.Equal(
                (delay, jitter, loss, burst, reorder, duplicate),
                (leg.DelayMilliseconds, leg.JitterMilliseconds, leg.LossPercent, leg.MeanBurstLength, leg.ReorderPercent, leg.DuplicatePercent));
        }
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
}
