using System.CommandLine;
using LagSim.Cli.Output;
using LagSim.Net.Recordings;

namespace LagSim.Cli.Commands;

/// <summary><c>lagsim diff</c>: compares two recordings of one session.</summary>
internal static class DiffCommand
{
    internal static Command Create(ToolConsole console)
    {
        CommonOptions common = new();
        Argument<string> first = new("A") { Description = "A recording." };
        Argument<string> second = new("B") { Description = "Another peer's recording of the same session." };
        Command command = new("diff", "Compares two recordings and names the first thing that differs, or says how far they agree. Exits with 0 if they agree"
            + " in at least one committed state, with 1 if they differ or have no committed state in common, and with 3 if one cannot be read. A recording that is"
            + " damaged or has no end record is compared as far as it goes, and the output says so ('whole' in JSON).")
        {
            first, second,
        };
        common.AddSeedAndJsonTo(command, isSeedDrawnFrom: false);
        command.SetAction(parsed =>
        {
            string[] files = [parsed.GetValue(first)!, parsed.GetValue(second)!];
            Recording[] recordings = [RecordingFile.Read(files[0]), RecordingFile.Read(files[1])];
            RecordingComparison found = RecordingComparison.Of(recordings[0], recordings[1], console.Stop);
            if (recordings[0].Header is null || recordings[1].Header is null)
            {
                throw new InputException(found.Message);
            }

            RecordingOutput.WarnUnlessWhole(console.Error, files[0], recordings[0]);
            RecordingOutput.WarnUnlessWhole(console.Error, files[1], recordings[1]);
            if (parsed.GetValue(common.Json))
            {
                RecordingOutput.WriteJson(console.Output, parsed.GetValue(common.Seed), files, recordings, found);
            }
            else
            {
                console.Output.WriteLine(found.Message);
            }

            return found.Outcome == ComparisonOutcome.Agrees ? ExitCode.Done : ExitCode.CheckFailed;
        });
        return command;
    }
}
