using System.Collections.Generic;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.Experiments.Peers;
using LagSim.Harness.Reports;

namespace LagSim.Cli.Output;

/// <summary>A run's errors between peers by phase, as a table of a report.</summary>
internal static class ErrorTable
{
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
