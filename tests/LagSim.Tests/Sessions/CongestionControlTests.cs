using System;
using System.Collections.Generic;
using LagSim.Net.Sessions.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>
/// The window of a link: never too small, smaller where there is a queue, and no greater for what is not used.
/// </summary>
public sealed class CongestionControlTests(ITestOutputHelper output)
{
    private const int Full = 1228;
    private static readonly SimDuration Trip = SimDuration.FromMilliseconds(40);

    [Fact]
    public void AnyLossesAndAcknowledgements_KeepTheWindowInItsBounds_AndCutItByNoMoreThanItSays()
    {
        for (int seed = 0; seed < 60; seed++)
        {
            Random random = new(seed);
            CongestionControl control = new();
            List<(int Bytes, SimTime Sent)> onTheirWay = [];
            SimTime now = SimTime.FromSeconds(1), cut = SimTime.MinValue;
            int inFlight = 0;
            for (int step = 0; step < 2000; step++)
            {
                now += SimDuration.FromMilliseconds(random.Next(3));
                int before = control.Window;
                bool hasQueue = random.Next(3) == 0;
                if (onTheirWay.Count == 0 || random.Next(2) == 0)
                {
                    int bytes = random.Next(60, Full + 1);
                    control.OnSent(bytes);
                    onTheirWay.Add((bytes, now));
                    inFlight += bytes;
                    Assert.Equal(before, control.Window);
                }
                else
                {
                    (int bytes, SimTime sent) = onTheirWay[0];
                    onTheirWay.RemoveAt(0);
                    bool isUsed = 2 * inFlight >= before;
                    inFlight -= bytes;
                    if (random.Next(12) > 0)
                    {
                        control.OnAcknowledged(bytes, hasQueue);
                        Assert.InRange(control.Window, before, isUsed ? before + bytes + 1 : before); // no growth for what is not used
                    }
                    else
                    {
                        control.OnLost(bytes, sent, now, hasQueue);
                        Assert.InRange(control.Window, 2 * Full, before);
                        bool mayCut = hasQueue && sent > cut; // once for all that was on its way then
                        int most = (int)Math.Max(2 * Full, (before * 0.7) + 1);
                        Assert.True(mayCut ? control.Window <= most : !hasQueue || control.Window == before);
                        cut = control.Window < before || mayCut ? now : cut;
                    }
                }

                Assert.Equal(inFlight, control.InFlight);
                Assert.InRange(control.Window, 2 * Full, 400 * Full);
                Assert.InRange(control.DatagramBytes, Full / 4, Full); // a quarter holds the longest entry
                Assert.Equal(inFlight + Full <= control.Window || inFlight == 0, control.HasRoom);
            }
        }
    }

    /// <summary>A bad radio link loses a tenth, and no queue shows: that is borne. What loses more is a queue that was full from the start.</summary>
    [Theory]
    [InlineData(0.08, true)]
    [InlineData(0.2, false)]
    [InlineData(0.35, false)]
    public void Loss_WithoutAQueue_IsBorneUpToAShare(double share, bool isBorne)
    {
        CongestionControl control = new();
        Random random = new(1);
        SimTime now = SimTime.FromSeconds(1);
        int first = control.Window;
        for (int n = 0; n < 400; n++)
        {
            now += Trip;
            control.OnSent(Full);
            if (random.NextDouble() < share)
            {
                control.OnLost(Full, now - (Trip / 2), now, hasQueue: false);
            }
            else
            {
                control.OnAcknowledged(Full, hasQueue: false);
            }
        }

        Assert.Equal(isBorne, control.Window == first);
    }

    /// <summary>
    /// A sender with all there is to send, over a link with a long queue: it keeps well below it. One that never backs off fills it, and is
    /// noticed.
    /// </summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Window_OverALinkWithALongQueue_KeepsItShortOnlyIfItBacksOff(bool backsOff)
    {
        const double bytesPerSecond = 32_000, most = 2.0; // 256 kbit/s, a queue of two seconds
        CongestionControl control = new();
        RoundTrips trips = new();
        Queue<(int Bytes, SimTime Sent, SimTime Back, bool IsLost)> onTheirWay = new();
        SimTime now = SimTime.FromSeconds(1), free = now, end = now + SimDuration.FromSeconds(50);
        long sent = 0, lost = 0, looked = 0;
        double waited = 0;
        while (now < end)
        {
            now += SimDuration.FromMilliseconds(1);
            while (onTheirWay.TryPeek(out (int Bytes, SimTime Sent, SimTime Back, bool IsLost) next) && next.Back <= now)
            {
                onTheirWay.Dequeue();
                if (next.IsLost && backsOff)
                {
                    control.OnLost(next.Bytes, next.Sent, now, trips.HasQueue);
                }
                else
                {
                    trips.Add(now - next.Sent, now);
                    control.OnAcknowledged(next.Bytes, backsOff && trips.HasQueue);
                }
            }

            free = SimTime.Max(free, now);
            while (control.HasRoom)
            {
                SimDuration wait = free - now;
                bool isLost = wait.ToSeconds() > most;
                free += isLost ? SimDuration.Zero : SimDuration.FromSeconds(Full / bytesPerSecond);
                control.OnSent(Full);
                onTheirWay.Enqueue((Full, now, free + Trip, isLost));
                sent++;
                lost += isLost ? 1 : 0;
            }

            waited += (free - now).ToSeconds();
            looked++;
        }

        output.WriteLine(
            $"backs off: {backsOff}; {(double)lost / sent:P1} of {sent} lost, {waited / looked:F2} s in the queue in the mean");
        Assert.Equal(backsOff, (double)lost / sent < 0.05);
    }
}
