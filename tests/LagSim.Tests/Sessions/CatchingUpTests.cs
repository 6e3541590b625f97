using LagSim.Net.Sessions.Hosts;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>Who catches up is waited for, and who does not gets a fresh copy.</summary>
public sealed class CatchingUpTests
{
    private const double Limit = 10;

    [Theory]
    [InlineData(0, 0, null)] // keeps up
    [InlineData(9, 0, null)] // is behind, and not too far
    [InlineData(60, -0.2, null)] // came in with a large copy
    [InlineData(60, -0.11, null)]
    [InlineData(60, -0.09, 20.0)] // too slowly
    [InlineData(60, 0, 20.0)]
    [InlineData(0, 1, 10.01)] // hears nothing of what happens
    [InlineData(5, 0.5, 10.01)] // was never far behind before
    public void Lag_OfOneWho(double lag, double perSecond, double? failsAfter)
    {
        CatchingUp catching = new();
        SimTime start = SimTime.FromSeconds(100);
        double? failed = null;
        for (double seconds = 0; seconds < 120 && failed is null; seconds += 0.01)
        {
            SimDuration behind = SimDuration.FromSeconds(System.Math.Max(0, lag + (perSecond * seconds)));
            failed = catching.HasFailed(behind, start + SimDuration.FromSeconds(seconds), SimDuration.FromSeconds(Limit)) ? seconds : null;
        }

        Assert.Equal(failsAfter is null, failed is null);
        Assert.Equal(failsAfter ?? 0, failed ?? 0, 0.02);
    }

    /// <summary>One that catches up, and hears nothing for five seconds of every thirty.</summary>
    [Theory]
    [InlineData(1, false)]
    [InlineData(0.6, false)]
    [InlineData(0.1, true)] // comes nearer no more
    public void Lag_WithDips_IsMadeGoodInBetween(double perSecond, bool fails)
    {
        CatchingUp catching = new();
        double lag = 60;
        bool failed = false;
        for (int n = 0; n < 12_000 && !failed; n++)
        {
            lag = System.Math.Max(0, lag + (n % 3000 >= 2500 ? 0.01 : -0.01 * perSecond));
            failed = lag > 0.1 && catching.HasFailed(SimDuration.FromSeconds(lag), SimTime.FromSeconds(n * 0.01), SimDuration.FromSeconds(Limit));
        }

        Assert.Equal(fails, failed);
    }

    /// <summary>Acknowledgements come in bursts, and in between everybody falls behind a little.</summary>
    [Fact]
    public void Lag_ThatFallsInSteps_IsProgress()
    {
        CatchingUp catching = new();
        for (int n = 0; n < 1000; n++)
        {
            double seconds = n * 0.1;
            double lag = 60 - (n / 20 * 0.5) + (n % 20 * 0.1); // 2 s later each time, then half a second nearer
            Assert.False(catching.HasFailed(SimDuration.FromSeconds(lag), SimTime.FromSeconds(seconds), SimDuration.FromSeconds(Limit)));
        }
    }
}
