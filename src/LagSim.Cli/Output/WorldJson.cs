using System;
using System.Linq;
using System.Text.Json;
using LagSim.Harness.Verification.Worlds;

namespace LagSim.Cli.Output;

/// <summary>A check of single worlds as part of the JSON document of <c>check</c>.</summary>
internal static class WorldJson
{
    /// <summary>Writes its keys; none played counts as none that failed.</summary>
    internal static void Write(Utf8JsonWriter json, WorldReport? report)
    {
        report ??= new WorldReport([], 0, 0);
        json.WriteNumber("worlds", report.Outcomes.Count);
        json.WriteNumber("worlds_asked_for", report.AskedFor);
        json.WriteNumber("worlds_ended", report.CountOf(WorldFailureKind.Ended));
        json.WriteNumber("worlds_differing", report.CountOf(WorldFailureKind.Differs));
        json.WriteNumber("broken_promises", report.CountOf(WorldFailureKind.Promise));
        json.WriteNumber("worlds_unfinished", report.Outcomes.Count(o => o.IsUnfinished));
        json.WriteNumber("worlds_wall_s", report.WallSeconds);
        json.WriteStartArray("world_kinds");
        foreach (IGrouping<WorldKind, WorldOutcome> kind in report.Outcomes.GroupBy(o => o.Kind).OrderBy(g => g.Key))
        {
            json.WriteStartObject();
            json.WriteString("kind", kind.Key.ToString());
            json.WriteNumber("worlds", kind.Count());
            json.WriteNumber("acts", kind.Sum(o => (long)o.Acts));
            json.WriteNumber("acts_at_events", kind.Sum(o => (long)o.ActsAtEvents));
            json.WriteNumber("meetings", kind.Sum(o => (long)o.Meetings));
            json.WriteNumber("events", kind.Sum(o => o.Events));
            json.WriteNumber("compared", kind.Sum(o => o.Compared));
            json.WriteNumber("worlds_ended", kind.Count(o => o.FailureKind == WorldFailureKind.Ended));
            json.WriteNumber("worlds_differing", kind.Count(o => o.FailureKind == WorldFailureKind.Differs));
            json.WriteNumber("broken_promises", kind.Count(o => o.FailureKind == WorldFailureKind.Promise));
            json.WriteNumber("worlds_unfinished", kind.Count(o => o.IsUnfinished));
            json.WriteNumber("full_timelines", kind.Count(o => o.HasFullTimelines));
            json.WriteNumber("lost_bodies", kind.Sum(o => (long)o.LostBodies));
            json.WriteEndObject();
        }

        json.WriteEndArray();
        json.WriteStartArray("unfinished_seeds");
        foreach (WorldOutcome world in report.Outcomes.Where(o => o.IsUnfinished))
        {
            json.WriteNumberValue(world.Seed);
        }

        json.WriteEndArray();
        json.WriteStartArray("failing_worlds");
        foreach (WorldOutcome world in report.Failures)
        {
            Write(json, world);
        }

        json.WriteEndArray();
    }

    private static void Write(Utf8JsonWriter json, WorldOutcome world)
    {
        json.WriteStartObject();
        json.WriteNumber("seed", world.Seed);
        json.WriteString("kind", world.Kind.ToString());
        json.WriteString("failure_kind", world.FailureKind.ToString());
        json.WriteString("promise", world.Promise);
        json.WriteString("failure", world.Failure);
        json.WriteString("replay", world.Command);
        json.WriteStartArray("least_acts");
        foreach (string act in world.LeastActs)
        {
            json.WriteStringValue(act);
        }

        json.WriteEndArray();
        json.WriteEndObject();
    }
}
