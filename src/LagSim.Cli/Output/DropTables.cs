using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Harness.Experiments.Drop;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.Reports;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Strategies;
using LagSim.Time;
using Spectre.Console;

namespace LagSim.Cli.Output;

/// <summary>A drop test as tables for a terminal.</summary>
internal static class DropTables
{
    internal static void Write(
        ToolConsole console, DropOptions options, IReadOnlyList<DropRun> runs, IReadOnlyList<DropRun> strategies, string? folder)
    {
        console.Output.WriteLine($"lagsim {ToolVersion.Text}   drop   seed {options.Seed}   scene {JsonDocumentWriter.Hash(runs[0].SceneHash)}");
        console.Output.WriteLine(
            $"{options.Strategy}, {MotionNames.Of(options.Motion)}, {options.Peers} peers, {options.Link.Name},"
                + $" {(options.IsVirtual ? "virtual time" : $"real time over {options.Carrier}")}");
        foreach (DropRun run in runs)
        {
            WritePicture(console, run);
            console.Write(Summary(run));
            WriteFacts(console, run);
        }

        if (strategies.Count > 0)
        {
            console.Write(Strategies(strategies));
        }

        foreach (DropRun late in strategies.Where(run => DelayOf(run) > SimDuration.Zero))
        {
            console.Output.WriteLine($"{late.Options.Strategy} shows everything {NumberText.Short(DelayOf(late).ToMilliseconds())} ms late, what a player"
                + " does itself included.");
        }

        if (folder is not null)
        {
            console.Output.WriteLine($"Charts, CSV and report.html are in {folder}.");
        }
    }

    /// <summary>
    /// Draws the heights of all peers over one another, and below them their distance, which is blank where it is exactly zero.
    /// </summary>
    private static void WritePicture(ToolConsole console, DropRun run)
    {
        int columns = Math.Clamp(console.Rich.Profile.Width - 13, 40, 120);
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

    private static Table Summary(DropRun run)
    {
        Table table = NewTable($"{DropNames.Case(run.Case)}: height error between peers, in metres", "compared", "max", "mean", "rms", "bits differ", "stalled");
        AddRows(table, run.Case, "as seen", run.Seen);
        if (run.Options.IsThesisSetting)
        {
            AddThesis(table, run.Case);
        }

        AddRows(table, run.Case, "at true time", run.SeenTrueTime);
        AddRows(table, run.Case, "as settled", run.Settled);
        return table;
    }

    private static void AddRows(Table table, DropCase which, string compared, PhaseErrors errors)
    {
        foreach (Phase phase in new[] { Phase.Before, Phase.During, Phase.After })
        {
            ErrorStatistics of = errors[phase].ToStatistics();
            bool isOfThisCase = which == DropCase.SameStart == (phase == Phase.Before);
            if (isOfThisCase && of.Samples + of.StalledSamples > 0)
            {
                string when = phase == Phase.Before ? "" : phase == Phase.During ? ", during" : ", after";
                table.AddRow(
                    compared + when, NumberText.Short(of.MaxMetres), NumberText.Short(of.MeanMetres), NumberText.Short(of.RmsMetres),
                    string.Create(CultureInfo.InvariantCulture, $"{of.DifferingBits} of {of.Samples}"), of.StalledSamples.ToString(CultureInfo.InvariantCulture));
            }
        }
    }

    private static void AddThesis(Table table, DropCase which)
    {
        if (which == DropCase.SameStart)
        {
            string zero = NumberText.Short(ThesisFigures.SameStart);
            table.AddRow("thesis, one machine", zero, zero, zero, "", "");
        }
        else
        {
            table.AddRow(
                "thesis, after", NumberText.Short(ThesisFigures.TeleportMax), NumberText.Short(ThesisFigures.TeleportMean),
                NumberText.Short(ThesisFigures.TeleportRms), "", "");
        }
    }

    private static void WriteFacts(ToolConsole console, DropRun run)
    {
        string late = run.Case == DropCase.Teleport ? $", event {NumberText.Short(run.Lateness.Max)} ms late" : "";
        string rest = run.CpuCoresAtRest is double cpu ? $", at rest {NumberText.Short(100 * cpu)} % of a core" : "";
        console.Output.WriteLine($"{NumberText.Count(run.Events, "event")}, {NumberText.Count(run.Heals, "heal")}, clock error"
            + $" {NumberText.Short(run.ClockErrorMilliseconds)} ms{late}{rest}");
        if (!run.BallRested)
        {
            console.Output.WriteLine("The ball had not come to rest when it was lifted: this is not the thesis's test.");
        }

        console.Output.WriteLine($"bytes/s {string.Join(" ", run.BytesSentPerSecond.Select(NumberText.Short))}");
        console.Output.WriteLine($"event hashes {string.Join(" ", run.EventHashes.Select(h => JsonDocumentWriter.Hash(h)))}"
            + $" {(run.Agrees ? "(equal)" : "(NOT equal)")}");
        console.Output.WriteLine();
    }

    private static SimDuration DelayOf(DropRun run) => LateEventStrategies.Create(run.Options.Strategy, run.Options.DisplayDelay).DisplayDelay;

    private static Table Strategies(IReadOnlyList<DropRun> runs)
    {
        Table table = NewTable(
            "every strategy, lifted from rest, virtual time: error as seen, in metres",
            "strategy", "during", "after", "after, rms", "settled differ", "heals", "late ms");
        foreach (DropRun run in runs)
        {
            ErrorStatistics seen = run.Seen.After.ToStatistics();
            ErrorStatistics settled = run.Settled.After.ToStatistics();
            table.AddRow(
                run.Options.Strategy, NumberText.Short(run.Seen.During.ToStatistics().MaxMetres), NumberText.Short(seen.MaxMetres), NumberText.Short(seen.RmsMetres),
                string.Create(CultureInfo.InvariantCulture, $"{settled.DifferingBits} of {settled.Samples}"),
                run.Heals.ToString(CultureInfo.InvariantCulture), NumberText.Short(run.Lateness.Max));
        }

        return table;
    }

    /// <summary>Returns a table that fits a terminal of 80 columns: no frame, the first column text, the others numbers.</summary>
    internal static Table NewTable(string title, params string[] columns)
    {
        Table table = new Table { Border = TableBorder.Horizontal }.Title(title).LeftAligned();
        for (int i = 0; i < columns.Length; i++)
        {
            TableColumn column = new TableColumn(columns[i]).NoWrap().PadLeft(0).PadRight(i == columns.Length - 1 ? 0 : 1);
            table.AddColumn(i == 0 ? column : column.RightAligned());
        }

        return table;
    }
}
