using System;
using System.IO;
using System.Linq;
using System.Text.Json;
using LagSim.Events;
using LagSim.Harness.Verification.Check;
using LagSim.Harness.Verification.Worlds;
using LagSim.Testing;

namespace LagSim.Cli.Output;

/// <summary>A check as a JSON document.</summary>
internal static class CheckJson
{
    internal static void Write(TextWriter output, CheckOptions options, CheckReport report, WorldReport? worlds = null) =>
        JsonDocumentWriter.Write(output, "check", options.Seed, null, null, null, json =>
        {
            json.WriteNumber("sessions", report.Outcomes.Count);
            json.WriteNumber("sessions_asked_for", report.AskedFor);
            json.WriteBoolean("stopped_early", report.IsStopped);
            json.WriteStartArray("stopped_seeds");
            foreach (ulong seed in report.StoppedSeeds)
            {
                json.WriteNumberValue(seed);
            }

            json.WriteEndArray();
            json.WriteStartArray("unfinished_session_seeds");
            foreach (ulong seed in report.UnfinishedSeeds)
            {
                json.WriteNumberValue(seed);
            }

            json.WriteEndArray();
            json.WriteNumber("events", report.Events);
            json.WriteNumber("external_events", report.ExternalEvents);
            json.WriteNumber("tied_events", report.Outcomes.Sum(o => (long)o.TiedEvents));
            json.WriteNumber("late_events", report.LateEvents);
            json.WriteNumber("heals", report.Heals);
            json.WriteNumber("heals_that_changed_an_impact", report.HealsThatChangedAnImpact);
            json.WriteNumber("too_late_events", report.TooLateEvents);
            json.WriteNumber("lost_events", report.LostEvents);
            json.WriteNumber("refused_events", report.Outcomes.Sum(o => o.RefusedEvents));
            json.WriteNumber("differing_bits", report.DifferingBits);
            json.WriteNumber("compared", report.Outcomes.Sum(o => o.Compared));
            json.WriteNumber("events_rerun", report.Outcomes.Sum(o => o.EventsRerun));
            json.WriteNumber("impacts", report.Outcomes.Sum(o => o.Impacts));
            json.WriteNumber("peers", report.Outcomes.Sum(o => (long)o.Peers));
            json.WriteNumber("late_joiners", report.Outcomes.Sum(o => (long)o.LateClients));
            json.WriteNumber("leavers", report.Outcomes.Sum(o => (long)o.Leavers));
            json.WriteNumber("copies", report.Outcomes.Sum(o => o.Copies));
            json.WriteStartObject("sessions_that_met");
            json.WriteNumber("full_links", report.Outcomes.Count(o => o.HasFullLinks));
            json.WriteNumber("stops", report.Outcomes.Count(o => o.HasStops));
            foreach ((string name, Func<SceneFeatures, bool> isMet) in SceneFeatures.All)
            {
                json.WriteNumber(name, report.SessionsThatMet(isMet));
            }

            json.WriteEndObject();
            json.WriteString("profile", options.Profile?.Name ?? "all");
            json.WriteString("strategy", options.Strategy);
            json.WriteNumber("wall_s", report.WallSeconds);
            json.WriteStartArray("failing_seeds");
            foreach (CheckFailure failure in report.Failures)
            {
                json.WriteNumberValue(failure.Whole.Seed);
            }

            json.WriteEndArray();
            json.WriteStartArray("failures");
            foreach (CheckFailure failure in report.Failures)
            {
                Write(json, failure);
            }

            json.WriteEndArray();
            WorldJson.Write(json, worlds);
        });

    private static void Write(Utf8JsonWriter json, CheckFailure failure)
    {
        json.WriteStartObject();
        json.WriteNumber("seed", failure.Whole.Seed);
        json.WriteString("failure", failure.Whole.Failure);
        json.WriteString("replay", failure.Command);
        json.WriteBoolean("shrunk", failure.IsShrunk);
        json.WriteNumber("bodies", failure.Least.Bodies.Count);
        json.WriteNumber("deeds", failure.Least.Actions.Count);
        if (failure.Least.Difference is FirstDifference difference)
        {
            json.WriteStartObject("first_difference");
            json.WriteNumber("peer", difference.Peer);
            json.WriteString("body", difference.Body.ToString());
            json.WriteNumber("time_s", difference.SinceStartSeconds);
            Version(json, "expected", difference.ExpectedKey, difference.Expected);
            Version(json, "actual", difference.ActualKey, difference.Actual);
            json.WriteEndObject();
        }
        else
        {
            json.WriteNull("first_difference");
        }

        json.WriteEndObject();
    }

    private static void Version(Utf8JsonWriter json, string name, EventKey? key, BodyState state)
    {
        if (key is null)
        {
            json.WriteNull(name);
            return;
        }

        json.WriteStartObject(name);
        json.WriteString("key", key.Value.ToString());
        json.WriteString("motion", state.Motion.ToString());
        json.WriteString("position_m", state.Position.ToString());
        json.WriteString("velocity_m_per_s", state.Velocity.ToString());
        json.WriteEndObject();
    }
}
