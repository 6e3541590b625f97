using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Experiments.Accuracy;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.Reports;
using Spectre.Console;

namespace LagSim.Cli.Output;

/// <summary>Speed against error as tables for a terminal.</summary>
internal static class AccuracyTables
{
    private const string Time = "CPU s";
    private const int Roomy = 100; // columns

    internal static void Write(ToolConsole console, AccuracyReport report, string? folder)
    {
        console.Output.WriteLine($"lagsim {ToolVersion.Text}   accuracy   seed {report.Seed}");
        foreach (WorkScene scene in report.Scenes.Where(scene => !report.IsDrawn(scene)))
        {
            console.Write(AsTable(console, report, scene));
        }

        if (report.Spread.Count > 0)
        {
            Table table = DropTables.NewTable(SpreadTitle, SpreadHeadings);
            foreach (IReadOnlyList<string> row in SpreadRows(report))
            {
                table.AddRow([.. row.Select(Markup.Escape)]);
            }

            console.Write(table);
        }

        foreach (string line in Footnotes(report))
        {
            console.Output.WriteLine(line);
        }

        if (folder is not null)
        {
            console.Output.WriteLine($"Charts, CSV and report.html are in {folder}.");
        }
    }

    /// <summary>
    /// Returns a table in which only the methods' names are wrapped. In a window each name appears once; in a narrow one the time appears
    /// only as speed.
    /// </summary>
    private static Table AsTable(ToolConsole console, AccuracyReport report, WorkScene scene)
    {
        string[] headings = Headings(scene);
        int[] columns = [.. Enumerable.Range(0, headings.Length).Where(n => !console.IsWindow || console.Rich.Profile.Width >= Roomy || headings[n] != Time)];
        Table table = DropTables.NewTable(
            Markup.Escape(Title(scene)), [.. columns.Select(n => headings[n].Replace(" per ", "\nper ", System.StringComparison.Ordinal))]);
        table.Columns[0].NoWrap = false;
        string named = "";
        foreach (IReadOnlyList<string> row in Rows(report, scene))
        {
            table.AddRow([.. columns.Select(n => n == 0 && console.IsWindow && row[0] == named ? "" : Markup.Escape(row[n]))]);
            named = row[0];
        }

        return table;
    }

    /// <summary>Describes the errors and their references.</summary>
    internal static string Title(WorkScene scene) =>
        $"{scene.Name}: the {string.Join(", the ", scene.ErrorKinds.Select(kind => WorkErrorKinds.Of(kind).Sentence))}; held against: {scene.Reference}";

    /// <summary>Returns the columns of a scene's table, one for each kind of error.</summary>
    internal static string[] Headings(WorkScene scene) =>
        ["method", "setting", .. scene.ErrorKinds.Select(kind => WorkErrorKinds.Of(kind).Heading), "simulated s per CPU s", Time, "events", "order"];

    /// <summary>Returns a row for each method and setting.</summary>
    internal static IEnumerable<IReadOnlyList<string>> Rows(AccuracyReport report, WorkScene scene)
    {
        foreach (IGrouping<(string Method, string Setting), WorkPoint> at in report.Work.Points.Where(p => p.Scene == scene.Name)
            .GroupBy(p => (p.Method, p.Setting)))
        {
            WorkPoint point = at.First();
            WorkOrder? order = report.Work.Orders.FirstOrDefault(o => o.Scene == scene.Name && o.Method == point.Method);
            bool isFirst = report.Work.Points.First(p => p.Scene == scene.Name && p.Method == point.Method) == point;
            yield return
            [
                point.Method, point.Setting, .. at.Select(p => double.IsNaN(p.Error) ? "not finite" : NumberText.Short(p.Error)), NumberText.Short(point.Speed),
                NumberText.Short(point.CpuSeconds), NumberText.Short(point.Events), isFirst && order is not null ? Order(order) : "",
            ];
        }
    }

    /// <summary>Returns the random heaps, as a spread.</summary>
    internal const string SpreadTitle = "heaps drawn at random: the least, the median and the greatest";

    /// <summary>Returns the columns of the random heaps.</summary>
    internal static readonly string[] SpreadHeadings = ["method", "setting", "heaps", "error", "of what", "simulated s per CPU s"];

    /// <summary>Returns a row for each method, setting and kind of error.</summary>
    internal static IEnumerable<IReadOnlyList<string>> SpreadRows(AccuracyReport report) =>
        report.Spread.Select(spread => (IReadOnlyList<string>)
        [
            spread.Method, spread.Setting, NumberText.Short(spread.Scenes), Text(spread.Error), WorkErrorKinds.Of(spread.ErrorKind).Heading,
            Text(spread.Speed),
        ]);

    private static string Text(SpreadOf spread) => double.IsNaN(spread.Median) ? "not finite"
        : $"{NumberText.Short(spread.Least)}  {NumberText.Short(spread.Median)}  {NumberText.Short(spread.Greatest)}";

    private static string Order(WorkOrder order) => NumberText.Short(order.Slope) + (order.Points < WorkOrder.Most ? $" ({order.Points} points)" : "");

    internal static IEnumerable<string> Footnotes(AccuracyReport report)
    {
        if (report.Work.StoppedAt is string stopped)
        {
            yield return $"Stopped early, at {stopped}: it and what comes after it has no rows.";
        }

        yield return $"Speed is by {ThreadClock.Name}, the least of several runs after a warm-up, making the world of a scene that is there included. A method without steps counts"
            + " events, any other its steps.";
        yield return "order: slope of error against step, logarithmic, least squares over the finest four points, or three if there are no more, above a"
            + " hundred times rounding and below a tenth of the scene's size.";
        if (report.IsQuick)
        {
            yield return "A quick look: few settings, short runs; its figures of speed are not to be trusted.";
        }

        if (report.Spread.Count > 0)
        {
            yield return "Each of the heaps is a scene of its own in --json and --out. Nothing was tuned on them;"
                + " another --seed draws others.";
        }

        foreach (string sentence in WorkFindings.Sentences(report.Work.Points).Concat(report.Work.LeftOut).Append(WorkFindings.Caution))
        {
            yield return sentence;
        }
    }
}
