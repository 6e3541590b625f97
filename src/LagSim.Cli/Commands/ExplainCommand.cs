using System.CommandLine;
using LagSim.Cli.Output;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;

namespace LagSim.Cli.Commands;

/// <summary><c>lagsim explain</c>: what the engine simulates for a scene, what it leaves out, and why.</summary>
internal static class ExplainCommand
{
    internal static Command Create(ToolConsole console)
    {
        CommonOptions common = new();
        Argument<string> scene = new("SCENE") { Description = CommonOptions.SceneText };
        Command command = new("explain", "Explains what LagSim models in a scene, what it leaves out, and why.") { scene };
        common.AddSeedAndJsonTo(command, isSeedDrawnFrom: false);
        command.SetAction(parsed =>
        {
            Scene loaded = SceneSource.Load(parsed.GetValue(scene)!);
            SceneExplanation explanation = loaded.Explain();
            if (parsed.GetValue(common.Json))
            {
                ExplainOutput.WriteJson(console.Output, loaded, explanation, parsed.GetValue(common.Seed));
            }
            else
            {
                ExplainOutput.WriteTables(console, loaded, explanation);
            }

            return ExitCode.Done;
        });
        return command;
    }
}
