using System.Collections.Generic;
using System.Globalization;
using LagSim.Harness.Hands;
using LagSim.Harness.Reports;
using LagSim.Net.Display;
using Spectre.Console;

namespace LagSim.Cli.Output;

/// <summary>The prediction of a hand as a table for a person.</summary>
internal static class HoldTables
{
    internal static void Write(ToolConsole console, HandMotion motion, IReadOnlyList<PredictionError> errors, ulong seed, string? folder)
    {
        console.Output.WriteLine($"lagsim {ToolVersion.Text}   hold   seed {seed}");
        console.Output.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"{motion.Name} motion of a hand, {motion.Seconds:0.#} s, at most {NumberText.Short(motion.LargestAcceleration())} m/s^2"));
        Table table = new Table { Border = TableBorder.Horizontal }.Title("where the hand is, by delay in ms: rms error in mm").LeftAligned();
        IReadOnlyList<string> headings = Headings;
        for (int i = 0; i < headings.Count; i++)
        {
            table.AddColumn(new TableColumn(headings[i]).NoWrap().PadLeft(0).PadRight(i == headings.Count - 1 ? 0 : 1).RightAligned());
        }

        foreach (PredictionError error in errors)
        {
            table.AddRow([.. Row(error)]);
        }

        console.Rich.Write(table);
        console.Output.WriteLine("best: of what the adaptive one mixes, in hindsight; linear: 20 taps, fitted to the other nine tenths of this very motion");
        if (folder is not null)
        {
            console.Output.WriteLine($"Charts, CSV and report.html are in {folder}.");
        }
    }

    internal static IReadOnlyList<string> Headings { get; } = ["delay", "adaptive", "of best", "best", "which is", "hold last", "velocity", "linear"];

    internal static IReadOnlyList<string> Row(PredictionError error) =>
    [
        NumberText.Short(error.HorizonMilliseconds), Millimetres(error.AdaptiveMetres),
        error.BestInHindsightMetres > 0 ? error.RatioToBest.ToString("0.000", CultureInfo.InvariantCulture) : "-",
        Millimetres(error.BestInHindsightMetres), error.BestInHindsightMetres > 0 ? AdaptivePredictor.Candidates[error.BestCandidate] : "-",
        Millimetres(error.HoldLastMetres), Millimetres(error.VelocityMetres), Millimetres(error.LinearMetres),
    ];

    private static string Millimetres(double metres) => NumberText.Short(1000 * metres);
}
