using System.Collections.Generic;
using System.IO;
using System.Linq;
using LagSim.Harness.Experiments.Drop;
using LagSim.Harness.Experiments.Peers;

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
                DropRunJson.Write(json, run);
            }

            json.WriteEndArray();
        });
    }
}
