using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Harness.Drop;
using LagSim.Harness.Metrics;
using LagSim.Harness.Reports;
using LagSim.Harness.Scenes;
using Spectre.Console;

namespace LagSim.Cli.Output;

/// <summary>A drop test as tables for a person.</summary>
internal static class DropTables
{
    internal static void Write(
        ToolConsole console, DropOptions options, IReadOnlyList<DropRun> runs, IReadOnlyList<DropRun> strategies, string? folder)
    {
        console.Rich.WriteLine($"lagsim {ToolVersion.Text}   drop   seed {options.Seed}   scene {JsonDocumentWriter.Hash(runs[0].SceneHash)}   "
            + $"{options.Strategy}, {MotionNames.Of(options.Motion)}, {options.Peers} peers, {options.Link.Name}, {DropNames.Time(options)} time");
        foreach (DropRun run in runs)
        {
            WritePicture(console, run);
        }

        console.Rich.Write(Summary(runs));
        foreach (DropRun run in runs)
        {
            console.Rich.WriteLine(Line(run));
        }

        console.Rich.WriteLine();
        console.Rich.Write(Strategies(strategies));
        if (folder is not null)
        {
            console.Rich.WriteLine($"Charts, CSV and report.html are in {folder}.");
        }
    }

    /// <summary>The heights of all peers over one another, and below them their distance, which is blank where it is exactly zero.</summary>
    private static void WritePicture(ToolConsole console, DropRun run)
    {
        int columns = Math.Clamp(console.Rich.Profile.Width - 12, 40, 120);
        console.Output.WriteLine($"{DropNames.Case(run.Case)}: height of the ball in m, as {run.Options.Peers} peers showed it");
        console.Output.Write(TextChart.Draw(run.Trace.Seconds, run.Trace.Heights, columns, 8, NumberText.Short));
        double[] logarithms = Array.ConvertAll(run.Trace.SeenTrueTimeError, error => error > 0 ? Math.Log10(error) : double.NaN);
        string errors = TextChart.Draw(run.Trace.Seconds, [logarithms], columns, 4, power => NumberText.Short(Math.Pow(10, power)));
        if (errors.Length > 0)
        {
            console.Output.WriteLine("distance between the peers in m, at the same true time (logarithmic)");
            console.Output.Write(errors);
        }

        console.Output.WriteLine();
    }

    private static Table Summary(IReadOnlyList<DropRun> runs)
    {
        Table table = new Table { Border = TableBorder.Rounded }
            .Title("Height error between peers, in metres, beside what the thesis measured")
            .AddColumns("case", "compared", "phase");
        foreach (string column in new[] { "samples", "max", "mean", "rms", "differing bits", "stalled" })
        {
            table.AddColumn(new TableColumn(column).RightAligned());
        }

        table.AddColumn("thesis: max / mean / rms");
        foreach (DropRun run in runs)
        {
            AddRows(table, run, "seen", run.Seen, Thesis(run.Case));
            AddRows(table, run, "seen, true time", run.SeenTrueTime, "");
            AddRows(table, run, "settled", run.Settled, "");
        }

        return table;
    }

    private static void AddRows(Table table, DropRun run, string compared, PhaseErrors errors, string thesis)
    {
        foreach (Phase phase in new[] { Phase.Before, Phase.During, Phase.After })
        {
            ErrorStatistics of = errors[phase].ToStatistics();
            if (of.Samples + of.StalledSamples == 0 || (run.Case == DropCase.Teleport && phase == Phase.Before))
            {
                continue;
            }

            bool compares = run.Case == DropCase.SameStart || phase == Phase.After;
            table.AddRow(
                DropNames.Case(run.Case), compared, run.Case == DropCase.SameStart ? "" : PhaseName(phase), of.Samples.ToString(CultureInfo.InvariantCulture),
                NumberText.Short(of.MaxMetres), NumberText.Short(of.MeanMetres), NumberText.Short(of.RmsMetres),
                of.DifferingBits.ToString(CultureInfo.InvariantCulture), of.StalledSamples.ToString(CultureInfo.InvariantCulture), compares ? thesis : "");
        }
    }

    private static string PhaseName(Phase phase) => phase == Phase.During ? "during" : "after";

    private static string Thesis(DropCase which) => which == DropCase.SameStart
        ? "0 (one machine)"
        : $"{NumberText.Short(ThesisFigures.TeleportMax)} / {NumberText.Short(ThesisFigures.TeleportMean)} / {NumberText.Short(ThesisFigures.TeleportRms)}";

    private static string Line(DropRun run) =>
        $"{DropNames.Case(run.Case)}: {run.Events} events, {run.Heals} heals, clock error {NumberText.Short(run.ClockErrorMilliseconds)} ms, "
        + $"bytes/s {string.Join(" ", run.BytesSentPerSecond.Select(NumberText.Short))}, "
        + (run.Case == DropCase.Teleport ? $"event {NumberText.Short(run.Lateness.Max)} ms late, " : "")
        + (run.CpuCoresAtRest is double cpu ? $"at rest {NumberText.Short(100 * cpu)} % of a core, " : "")
        + $"event hashes {string.Join(" ", run.EventHashes.Select(h => JsonDocumentWriter.Hash(h)))}"
        + (run.Agrees ? " (equal)" : " (NOT equal)");

    private static Table Strategies(IReadOnlyList<DropRun> runs)
    {
        Table table = new Table { Border = TableBorder.Rounded }
            .Title("Every strategy on the teleport case, virtual time: height error in metres")
            .AddColumn("strategy");
        foreach (string column in new[] { "seen during, max", "seen after, max", "seen after, rms", "settled during, max", "settled after, max", "differing bits after", "heals", "late ms" })
        {
            table.AddColumn(new TableColumn(column).RightAligned());
        }

        foreach (DropRun run in runs)
        {
            ErrorStatistics seen = run.Seen.After.ToStatistics();
            ErrorStatistics settled = run.Settled.After.ToStatistics();
            table.AddRow(
                run.Options.Strategy, NumberText.Short(run.Seen.During.ToStatistics().MaxMetres), NumberText.Short(seen.MaxMetres), NumberText.Short(seen.RmsMetres),
                NumberText.Short(run.Settled.During.ToStatistics().MaxMetres), NumberText.Short(settled.MaxMetres),
                settled.DifferingBits.ToString(CultureInfo.InvariantCulture), run.Heals.ToString(CultureInfo.InvariantCulture), NumberText.Short(run.Lateness.Max));
        }

        return table;
    }
}
