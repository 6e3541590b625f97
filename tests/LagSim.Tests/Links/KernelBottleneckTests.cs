using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Testing.Links;
using LagSim.Time;
using MathNet.Numerics.Statistics;
using Xunit;

namespace LagSim.Tests.Links;

/// <summary>The model of a bottleneck against the kernel's <c>tbf</c>: the same datagrams at the times at which they were really sent.</summary>
[Trait("Time", "real")]
public sealed class KernelBottleneckTests
{
    private const int Attempts = 3;

    [Theory]
    [InlineData("below the rate", 256_000, 500, 0.7)]
    [InlineData("above the rate", 256_000, 500, 1.5)]
    [InlineData("a modem, too full", 64_000, 1_000, 1.6)]
    [InlineData("a short queue", 2_000_000, 50, 1.2)]
    [InlineData("far apart", 64_000, 200, 0.25)]
    public void Send_SamePattern_DelaysAndLosesAsTheKernelDoes(string what, long rate, double queue, double load)
    {
        Bottleneck bottleneck = new(rate, queue);
        KernelLink.Passage[] passages = [];
        int[] bytes = [];
        Outcome kernel = new(0, 0, 0), model = new(double.NaN, 0, 0);
        for (int i = 0; i < Attempts && !model.IsNear(kernel); i++) // a busy machine hands over late what has arrived
        {
            passages = Pass(bottleneck, Pattern(rate, load, what == "far apart"), out bytes);
            kernel = Outcome.Of([.. passages.Select(passage => double.IsNaN(passage.Arrived) ? null : (double?)((passage.Arrived - passage.Sent) * 1_000))], bytes);
            model = Model(bottleneck, passages, bytes);
        }

        Outcome faster = Model(new Bottleneck(rate * 5 / 4, queue), passages, bytes), without = Model(new Bottleneck(rate, queue) { BurstBytes = 0 }, passages, bytes);
        TestContext.Current.TestOutputHelper?.WriteLine(
            $"{what}, {rate} bit/s, {queue} ms, load {load}: {bytes.Length} datagrams; kernel {kernel}; model {model}; at 1.25 of the rate {faster}; without a burst {without}");
        Assert.True(model.IsNear(kernel), $"kernel {kernel}; model {model}");

        // Negative controls: the comparison sees a rate that is wrong by a quarter wherever there is a queue to tell it, and a burst that is left out where there is none.
        Assert.Equal(what == "far apart", faster.IsNear(kernel));
        Assert.True(what != "far apart" || !without.IsNear(kernel), $"kernel {kernel}; without a burst {without}");
    }

    [Fact]
    public void IsNear_JustInsideAndJustOutside_IsTold()
    {
        Outcome kernel = new(100, 500, 0.2);
        Assert.True(new Outcome(109, 549, 0.219).IsNear(kernel));
        Assert.False(new Outcome(111, 500, 0.2).IsNear(kernel));
        Assert.False(new Outcome(100, 449, 0.2).IsNear(kernel));
        Assert.False(new Outcome(100, 500, 0.179).IsNear(kernel));
        Assert.True(new Outcome(4, 4, 0.009).IsNear(new Outcome(0, 0, 0)));
        Assert.False(new Outcome(6, 6, 0).IsNear(new Outcome(0, 0, 0)));
    }

    /// <summary>Some seconds of datagrams of all lengths, at times that come in heaps.</summary>
    private static (double At, int Bytes)[] Pattern(long rate, double load, bool apart)
    {
        SeededRandom random = new(2026);
        List<(double, int)> pattern = [];
        double tide = 1;
        for (double at = 0.3; at < 4.3;)
        {
            int bytes = apart ? 600 : (int)random.NextDouble(40, 1_200);
            pattern.Add((at, bytes));
            tide = pattern.Count % 40 == 0 ? random.NextDouble(0.6, 1.4) : tide;
            at += (apart ? 1 : random.NextDouble(0, 2)) * (bytes + Bottleneck.OverheadBytes) * 8 / (rate * load * tide);
        }

        return [.. pattern];
    }

    /// <summary>Sends by the kernel, again if the machine was so busy that it is not known when.</summary>
    private static KernelLink.Passage[] Pass(Bottleneck bottleneck, (double At, int Bytes)[] pattern, out int[] bytes)
    {
        bytes = [.. pattern.Select(sent => sent.Bytes)];
        for (int i = 0; i < Attempts; i++)
        {
            KernelLink.Passage[] passages = KernelLink.Send(bottleneck, pattern);
            if (passages.Count(passage => passage.Took > 0.001) <= passages.Length / 50)
            {
                return passages;
            }
        }

        Assert.Skip($"In {Attempts} attempts more than one of fifty datagrams took longer than 1 ms to hand to the kernel: this machine is too busy to say when it sends.");
        return [];
    }

    private static Outcome Model(Bottleneck bottleneck, KernelLink.Passage[] passages, int[] bytes)
    {
        LinkModel link = new(new LinkLeg(0) { Bottleneck = bottleneck }, new SeededRandom(1));
        return Outcome.Of([.. passages.Select((passage, i) =>
        {
            SimTime at = SimTime.FromSeconds(passage.Sent - passages[0].Sent + 1);
            LinkDeliveries deliveries = link.Send(at, bytes[i]);
            return deliveries.Count == 0 ? null : (double?)(deliveries[0] - at).ToMilliseconds();
        })], bytes);
    }

    /// <summary>What a link did to many datagrams: delays in milliseconds of those that arrived, and the share of bytes that did not.</summary>
    /// <remarks>
    /// In bytes, because those are what a rate and a queue let through: where the queue is nearly full, a send that is a hair later decides which of a large
    /// and several small datagrams is dropped, so that their number differs between two runs of the same kernel.
    /// </remarks>
    private sealed record Outcome(double P50, double P99, double Lost)
    {
        internal static Outcome Of(double?[] delays, int[] bytes)
        {
            double[] arrived = [.. delays.Where(delay => delay is not null).Select(delay => delay!.Value)];
            long lost = delays.Zip(bytes).Sum(sent => sent.First is null ? (long)sent.Second + Bottleneck.OverheadBytes : 0);
            return new Outcome(arrived.Quantile(0.5), arrived.Quantile(0.99), lost / (double)bytes.Sum(each => (long)each + Bottleneck.OverheadBytes));
        }

        internal bool IsNear(Outcome kernel) =>
            Math.Abs(P50 - kernel.P50) <= Math.Max(5, 0.1 * kernel.P50)
            && Math.Abs(P99 - kernel.P99) <= Math.Max(5, 0.1 * kernel.P99)
            && Math.Abs(Lost - kernel.Lost) <= Math.Max(0.01, 0.1 * kernel.Lost);

        public override string ToString() => FormattableString.Invariant($"p50 {P50:0.0} ms, p99 {P99:0.0} ms, {100 * Lost:0.0} % of bytes lost");
    }
}
