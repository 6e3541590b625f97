using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Testing.Links;

namespace LagSim.Play;

/// <summary>A link profile as the page's sliders show it, and what they cannot show.</summary>
/// <param name="Shown">Its figures, as a person would set them: means of both ways where these differ.</param>
/// <param name="Besides">What else it has, in words; none if the figures are all of it.</param>
internal sealed record ProfileFigures(LinkSettings Shown, IReadOnlyList<string> Besides)
{
    /// <summary>Returns the figures of a profile.</summary>
    internal static ProfileFigures Of(LinkProfile profile)
    {
        (LinkLeg to, LinkLeg from) = (profile.ToHost, profile.FromHost);
        LinkSettings shown = new()
        {
            DelayMilliseconds = Mean(to.DelayMilliseconds, from.DelayMilliseconds),
            JitterMilliseconds = Mean(to.JitterMilliseconds, from.JitterMilliseconds),
            LossPercent = Mean(to.LossPercent, from.LossPercent),
            MeanBurstLength = Mean(to.MeanBurstLength, from.MeanBurstLength),
            AsymmetryMilliseconds = to.DelayMilliseconds - from.DelayMilliseconds,
            ClockOffsetMilliseconds = Math.Round(profile.ReceiverClockOffset.ToSeconds() * 1000, 6),
        };
        List<string> besides = [];
        AddApart(besides, "jitter", to.JitterMilliseconds, from.JitterMilliseconds, "ms");
        AddApart(besides, "loss", to.LossPercent, from.LossPercent, "%");
        AddApart(besides, "losses in a row", to.MeanBurstLength, from.MeanBurstLength, "");
        string[] up = [.. More(to)], down = [.. More(from)];
        besides.AddRange(up.SequenceEqual(down) ? up : [.. up.Select(one => $"{one} to the host"), .. down.Select(one => $"{one} back")]);
        if (profile.HasBulkTransfer)
        {
            besides.Add("a download in the same queue");
        }

        return new ProfileFigures(shown, besides);
    }

    private static double Mean(double one, double other) => (one + other) / 2;

    private static void AddApart(List<string> besides, string name, double to, double from, string unit)
    {
        if (to != from)
        {
            besides.Add(Text($"{name} {to} {unit} to the host and {from} {unit} back"));
        }
    }

    private static IEnumerable<string> More(LinkLeg leg)
    {
        if (leg.Tail is LongTail tail)
        {
            yield return Text($"{tail.Percent} % take more than {tail.AboveMilliseconds} ms");
        }

        if (leg.ReorderPercent > 0)
        {
            yield return Text($"{leg.ReorderPercent} % reordered");
        }

        if (leg.DuplicatePercent > 0)
        {
            yield return Text($"{leg.DuplicatePercent} % twice");
        }

        if (leg.Step is DelayStep step)
        {
            yield return Text($"the delay steps by {step.Milliseconds} ms each {step.Period.ToSeconds():0.###} s");
        }

        if (leg.Outage is PeriodicOutage gone)
        {
            yield return Text($"{gone.LossPercent} % lost for {gone.Length.ToSeconds():0.###} s each {gone.Period.ToSeconds():0.###} s")
                + (gone.PeriodPercent < 100 ? Text($", in {gone.PeriodPercent} % of these") : "");
        }

        if (leg.Bottleneck is Bottleneck narrow)
        {
            yield return Text($"{narrow.RateBitsPerSecond / 1000.0} kbit/s with a queue of {narrow.QueueMilliseconds} ms")
                + (narrow.Dip is PeriodicDip dip
                    ? Text($", and {dip.RateBitsPerSecond / 1000.0} kbit/s for {dip.Length.ToSeconds():0.###} s each {dip.Period.ToSeconds():0.###} s") : "");
        }
    }

    private static string Text(FormattableString text) => text.ToString(CultureInfo.InvariantCulture);
}
