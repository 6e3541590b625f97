using System.Collections.Generic;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.Experiments.Peers;
using LagSim.Harness.Reports;

namespace LagSim.Cli.Output;

/// <summary>A run's errors between peers by phase, as a table of a report.</summary>
internal static class ErrorTable
{
    /// <summary>Explains the words of the table.</summary>
    internal static readonly IReadOnlyList<(string Word, string Meaning)> Terms =
    [
        ("seen", "What each peer showed when its shared clock read T, compared at the same T."),
        ("true time", "What the peers showed at the same true instant. The error of their clocks comes on top."),
        ("settled", "What the peers' timelines say of T once every late event has arrived."),
        ("stalled", "Samples that a peer could not show: what it had ready to draw did not cover T. They are counted, never left out."),
        ("before, during, after", "Before the event's timestamp; from then until the last peer has dealt with it; after that."),
        ("differing bits", "Samples in which any bit differs, however small the error."),
    ];

    internal static ReportTable Of(string title, IPeerRun run)
    {
        List<IReadOnlyList<string>> rows = [];
        foreach ((string compared, PhaseErrors errors) in new[] { ("seen", run.Seen), ("seen, true time", run.SeenTrueTime), ("settled", run.Settled) })
        {
            foreach (Phase phase in new[] { Phase.Before, Phase.During, Phase.After })
            {
                ErrorStatistics of = errors[phase].ToStatistics();
                if (of.Samples + of.StalledSamples > 0)
                {
                    rows.Add([compared, phase.ToString().ToLowerInvariant(), $"{of.Samples}", NumberText.Short(of.MaxMetres), NumberText.Short(of.MeanMetres),
                        NumberText.Short(of.RmsMetres), $"{of.DifferingBits}", $"{of.StalledSamples}"]);
                }
            }
        }

        return new ReportTable(title, ["compared", "phase", "samples", "max", "mean", "rms", "differing bits", "stalled"], rows);
    }
}
