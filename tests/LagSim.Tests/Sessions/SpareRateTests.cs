using System;
using LagSim.Net.Sessions.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>What a link may carry beyond what has to go: less where there is a queue, as on a new link where there is none, and more only where it is used up.</summary>
public sealed class SpareRateTests
{
    private const int Full = 1228;

    [Fact]
    public void Advance_WithAQueue_IsCutToTheLeast_AndWithoutRecoversToTheFirst()
    {
        SpareRate spare = new();
        RoundTrips trips = new();
        SimTime now = SimTime.FromSeconds(1);
        Add(trips, ref now, 40, 100);
        Assert.Equal(12_000, Rate(spare, trips, now), 50.0);

        double before = 12_000;
        for (int n = 0; n < 60; n++)
        {
            Add(trips, ref now, 200, 8);
            double rate = Rate(spare, trips, now);
            Assert.InRange(rate, 399, Math.Max(401, before));
            before = rate;
        }

        Assert.Equal(400, before, 5.0);
        for (int n = 0; n < 300; n++)
        {
            Add(trips, ref now, 40, 8);
            spare.Advance(now, trips, isSilent: false); // it comes back, and grows no further: nobody uses it up
        }

        Assert.Equal(12_000, Rate(spare, trips, now), 50.0);
        for (int n = 0; n < 300; n++)
        {
            Add(trips, ref now, 40, 8);
            spare.Advance(now, trips, isSilent: false);
            spare.Spend(Full);
            spare.WaitFor(Full); // used up
        }

        Assert.InRange(Rate(spare, trips, now), 20_000, (Full / 0.03) + 1);
    }

    [Fact]
    public void Advance_OfNothingAnswered_StaysWhatItWas()
    {
        SpareRate spare = new();
        RoundTrips trips = new();
        SimTime now = SimTime.FromSeconds(1);
        Add(trips, ref now, 40, 100);
        Rate(spare, trips, now);
        for (int n = 0; n < 100; n++)
        {
            now += SimDuration.FromSeconds(0.2);
            spare.Advance(now, trips, isSilent: true);
        }

        Assert.Equal(12_000, Rate(spare, trips, now), 50.0);
    }

    /// <summary>To one who is not there any more less and less is sent.</summary>
    [Theory]
    [InlineData(0, 12_000)]
    [InlineData(1, 6_000)]
    [InlineData(3, 1_500)]
    public void Advance_OfSilence_HalvesWhatMayGo(int halvings, double expected)
    {
        SpareRate spare = new();
        RoundTrips trips = new();
        SimTime now = SimTime.FromSeconds(1);
        Add(trips, ref now, 40, 100);
        spare.Advance(now, trips, isSilent: false);
        spare.Spend(spare.Bytes);
        int before = spare.Bytes;
        spare.Advance(now, trips, isSilent: true, halvings);
        spare.Advance(now + SimDuration.FromMilliseconds(50), trips, isSilent: true, halvings);

        Assert.Equal(expected * 0.05, spare.Bytes - before, 2.0);
    }

    private static void Add(RoundTrips trips, ref SimTime now, double milliseconds, int count)
    {
        for (int n = 0; n < count; n++)
        {
            now += SimDuration.FromMilliseconds(25);
            trips.Add(SimDuration.FromMilliseconds(milliseconds), now);
        }
    }

    /// <summary>Bytes a second, by how long a datagram of it takes.</summary>
    private static double Rate(SpareRate spare, RoundTrips trips, SimTime now)
    {
        spare.Advance(now, trips, isSilent: false);
        spare.Spend(spare.Bytes);
        int left = spare.Bytes;
        double seconds = spare.WaitFor(Full).ToSeconds();
        return (Full - left) / seconds;
    }
}
