using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Sessions.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>The least of the last while, against all samples there were.</summary>
public sealed class WindowedMinimumTests
{
    private static readonly SimDuration Window = SimDuration.FromSeconds(60);

    /// <summary>
    /// Samples come all the time, or seldom, or not for a while: no older one than the while counts, and all of its last half do.
    /// </summary>
    [Theory]
    [InlineData(0.03)]
    [InlineData(5)]
    [InlineData(25)]
    [InlineData(50)]
    [InlineData(100)]
    public void Value_IsTheLeastOfAllButThoseInTheFirstHalfOfTheWhile(double meanPause)
    {
        for (int seed = 0; seed < 20; seed++)
        {
            Random random = new(seed);
            WindowedMinimum minimum = default;
            List<(SimTime Time, SimDuration Sample)> all = [];
            SimTime now = SimTime.FromSeconds(random.NextDouble() * 100);
            for (int n = 0; n < 300; n++)
            {
                now += SimDuration.FromSeconds(meanPause * random.NextDouble() * 2);
                SimDuration sample = SimDuration.FromMilliseconds(random.Next(1000) + n); // the oldest tend to be the least
                minimum.Add(sample, now, Window);
                all.Add((now, sample));
                all.RemoveAll(s => now - s.Time > Window);
                SimDuration least = all.Min(s => s.Sample), minOfLate = all.Where(s => now - s.Time <= Window / 2).Min(s => s.Sample);
                string what = $"seed {seed}, {n}: {minimum.Value.ToSeconds()} s";
                Assert.True(minimum.Value >= least, $"{what} is of a sample older than the while; since then {least} was the least");
                Assert.True(minimum.Value <= minOfLate, $"{what}, though {minOfLate} is in the last half of the while");
            }
        }
    }

    [Fact]
    public void Value_BeforeThereIsASample_IsZero() => Assert.Equal(SimDuration.Zero, default(WindowedMinimum).Value);
}
