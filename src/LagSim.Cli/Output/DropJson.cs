using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text.Json;
using LagSim.Harness.Experiments.Drop;
using LagSim.Harness.SceneFiles;

namespace LagSim.Cli.Output;

/// <summary>A drop test as JSON.</summary>
internal static class DropJson
{
    internal static void Write(TextWriter output, DropOptions options, IReadOnlyList<DropRun> runs)
    {
        ulong? scene = RunJson.Common(runs.Select(run => run.SceneHash));
        ulong? state = RunJson.Common(runs.SelectMany(run => run.StateHashes));
        JsonDocumentWriter.Write(output, "drop", options.Seed, "drop", scene, state, json =>
        {
            json.WriteStartArray("runs");
            foreach (DropRun run in runs)
            {
                Run(json, run);
            }

            json.WriteEndArray();
        });
    }

    private static void Run(Utf8JsonWriter json, DropRun run)
    {
        json.WriteStartObject();
        RunJson.Setting(
            json, DropNames.Case(run.Case), run.Options.Strategy, MotionNames.Of(run.Options.Motion), DropNames.Time(run.Options), DropNames.Transport(run.Options),
            run.Options.DelayMilliseconds is null ? run.Options.Link.Name : null, run.Options.DelayMilliseconds, run.Options.Peers);
        RunJson.Figures(json, run, run.CpuCoresAtRest);
        json.WriteEndObject();
    }
}
