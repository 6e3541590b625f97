using System.Text.Json;
using LagSim.Harness.Experiments.Peers;
using LagSim.Harness.SceneFiles;

namespace LagSim.Harness.Experiments.Drop;

/// <summary>One case of a drop test as JSON: the same keys from the tool and from the page.</summary>
public static class DropRunJson
{
    /// <summary>Writes it.</summary>
    public static void Write(Utf8JsonWriter json, DropRun run)
    {
        json.WriteStartObject();
        RunJson.Setting(
            json, DropNames.Case(run.Case), run.Options.Strategy, MotionNames.Of(run.Options.Motion), DropNames.Time(run.Options),
            DropNames.Transport(run.Options),
            run.Options.DelayMilliseconds is null ? run.Options.Link.Name : null, run.Options.DelayMilliseconds, run.Options.Peers);
        RunJson.Figures(json, run, run.CpuCoresAtRest);
        json.WriteEndObject();
    }
}
