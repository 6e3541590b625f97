using System;
using System.CommandLine;
using LagSim.Cli.Output;
using LagSim.Net.Recordings;

namespace LagSim.Cli.Commands;

/// <summary><c>lagsim replay</c>: re-simulates a recording.</summary>
internal static class ReplayCommand
{
    internal static Command Create(ToolConsole console)
    {
        CommonOptions common = new();
        Argument<string> file = new("FILE") { Description = "A recording." };
        Command command = new("replay", "Runs a recording again and checks that it gives the same hashes. Exits with 0 if it does, with 1 if it does not or has"
            + " no hashes, and with 3 if it cannot be run, for instance because its fold version is another. A recording that is damaged or has no end record is"
            + " replayed as far as it goes, and the output says so ('whole' in JSON).") { file };
        common.AddSeedAndJsonTo(command, isSeedDrawnFrom: false);
        command.SetAction(parsed =>
        {
            string name = parsed.GetValue(file)!;
            Recording recording = RecordingFile.Read(name);
            RecordingReplay found = console.WithProgress($"replay {name}", 1, _ => RecordingReplay.Run(recording, console.Stop));
            if (found.Outcome == ReplayOutcome.CannotRun)
            {
                throw new InputException($"{name}: {WhyNot(recording, found)}");
            }

            RecordingOutput.WarnUnlessWhole(console.Error, name, recording);
            if (parsed.GetValue(common.Json))
            {
                RecordingOutput.WriteJson(console.Output, parsed.GetValue(common.Seed), name, recording, found);
            }
            else
            {
                console.Output.WriteLine(found.Message);
            }

            return found.Outcome == ReplayOutcome.Agrees ? ExitCode.Done : ExitCode.CheckFailed;
        });
        return command;
    }

    /// <summary>
    /// Reports only what is wrong with a file that is no recording, or is damaged before its scene. That it cannot be run then needs no
    /// message.
    /// </summary>
    private static string WhyNot(Recording recording, RecordingReplay found) =>
        recording is not { Scene: null, Damage: RecordingDamage damage } ? found.Message
        : damage.Offset == 0 ? damage.Reason
        : FormattableString.Invariant($"Damaged at byte {damage.Offset}, before its scene ends: {damage.Reason}");
}
