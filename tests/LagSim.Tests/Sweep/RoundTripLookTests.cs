using System.Linq;
using LagSim.Harness.Experiments.Sweep;
using Xunit;

namespace LagSim.Tests.Sweep;

/// <summary>How long after a dip a round trip is back, measured from the dip's end, wherever in it the queue filled.</summary>
public sealed class RoundTripLookTests
{
    [Theory]
    [InlineData(10, 16, 1)] // above the bound through the dip, and for a second after it
    [InlineData(14, 22.9, 7.9)] // the queue fills only at the end of the dip
    [InlineData(15, 18, 3)]
    [InlineData(12, 14, 0)] // over before the dip is
    public void Recovery_OfADipFrom10To15_CountsFromItsEnd(double from, double to, double expected)
    {
        RoundTripLook[] course = [.. Enumerable.Range(0, 400).Select(n => n / 10.0).Select(at =>
            new RoundTripLook(at, at >= from && at < to ? 200 : 40, at is >= 10 and < 15))];
        Assert.Equal(expected, RoundTripLook.Recovery(course, 80), 0.11);
    }

    [Fact]
    public void Recovery_OfOneThatIsAway_IsNotThereYet()
    {
        RoundTripLook[] course = [.. Enumerable.Range(0, 400).Select(n => n / 10.0).Select(at => new RoundTripLook(at, at is >= 14 and < 25 ? 0 : 40, at is >= 10 and < 15))];
        Assert.Equal(10, RoundTripLook.Recovery(course, 80), 0.11);
        Assert.Equal(0, RoundTripLook.Recovery([.. course.Select(look => look with { IsInDip = false })], 80));
    }
}
