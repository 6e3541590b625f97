using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text.Json;
using LagSim.Net.Recordings;
using LagSim.Time;

namespace LagSim.Cli.Output;

/// <summary>Comparisons and replays of recordings as JSON.</summary>
internal static class RecordingOutput
{
    /// <summary>Reports on stderr what an incomplete recording lacks, and up to where it is valid.</summary>
    internal static void WarnUnlessWhole(TextWriter error, string file, Recording recording)
    {
        if (!recording.IsWhole)
        {
            string lacks = recording.Damage is RecordingDamage damage ? FormattableString.Invariant($"is damaged at byte {damage.Offset}") : "has no end record";
            string counts = Since(recording, recording.HoldsUpTo) is double until
                ? FormattableString.Invariant($"what it holds counts, up to T {until} s")
                : "it holds no committed state before that";
            error.WriteLine($"'{file}' {lacks}; {counts}.");
        }
    }

    internal static void WriteJson(TextWriter output, ulong seed, IReadOnlyList<string> files, IReadOnlyList<Recording> recordings, RecordingComparison found)
    {
        bool isSameScene = recordings[0].Header!.SceneHash == recordings[1].Header!.SceneHash;
        ulong? scene = isSameScene ? recordings[0].Header!.SceneHash : null;
        JsonDocumentWriter.Write(output, "diff", seed, isSameScene ? recordings[0].Scene?.Name : null, scene, LastCommon(recordings, found), json =>
        {
            json.WriteString("outcome", found.Outcome switch
            {
                ComparisonOutcome.Agrees => "agrees",
                ComparisonOutcome.SceneDiffers => "scene-differs",
                ComparisonOutcome.StartDiffers => "start-differs",
                ComparisonOutcome.FoldVersionDiffers => "fold-version-differs",
                ComparisonOutcome.EventDiffers => "event-differs",
                ComparisonOutcome.StateDiffers => "state-differs",
                _ => "nothing-in-common",
            });
            json.WriteString("message", found.Message);
            json.WriteNumber("entries_compared", found.EntriesCompared);
            json.WriteNumber("states_compared", found.StatesCompared);
            JsonDocumentWriter.Number(json, "agreed_up_to_s", Since(recordings[0], found.AgreedUpTo));
            json.WriteBoolean("whole", recordings.All(recording => recording.IsWhole));
            JsonDocumentWriter.Number(json, "differs_at_entry", found.FirstEntry?.Index);
            JsonDocumentWriter.Number(json, "differs_at_s", Since(recordings[0], found.FirstState?.Time));
            json.WriteStartArray("recordings");
            for (int n = 0; n < recordings.Count; n++)
            {
                json.WriteStartObject();
                Write(json, files[n], recordings[n]);
                json.WriteEndObject();
            }

            json.WriteEndArray();
        });
    }

    internal static void WriteJson(TextWriter output, ulong seed, string file, Recording recording, RecordingReplay found) => JsonDocumentWriter.Write(
        output, "replay", seed, recording.Scene?.Name, recording.Header?.SceneHash, found.Actual?.StateHash, json =>
        {
            json.WriteString("outcome", found.Outcome switch
            {
                ReplayOutcome.Agrees => "agrees",
                ReplayOutcome.Differs => "differs",
                ReplayOutcome.NothingToCheck => "nothing-to-check",
                _ => "cannot-run",
            });
            json.WriteString("message", found.Message);
            json.WriteNumber("events_applied", found.EventsApplied);
            json.WriteNumber("states_checked", found.StatesChecked);
            JsonDocumentWriter.Number(json, "agreed_up_to_s", Since(recording, found.AgreedUpTo));
            json.WriteBoolean("whole", recording.IsWhole);
            JsonDocumentWriter.Number(json, "committed_s", Since(recording, found.Actual?.Time));
            json.WriteString("event_hash", JsonDocumentWriter.Hash(found.Actual?.EventHash));
            json.WriteString("recorded_state_hash", JsonDocumentWriter.Hash(found.Expected?.StateHash));
            json.WriteString("recorded_event_hash", JsonDocumentWriter.Hash(found.Expected?.EventHash));
            json.WriteStartObject("recording");
            Write(json, file, recording);
            json.WriteEndObject();
        });

    private static void Write(Utf8JsonWriter json, string file, Recording recording)
    {
        json.WriteString("file", file);
        JsonDocumentWriter.Number(json, "peer", recording.Header?.Peer);
        json.WriteString("library_version", recording.Header?.LibraryVersion);
        JsonDocumentWriter.Number(json, "fold_version", recording.Header?.FoldVersion);
        JsonDocumentWriter.Number(json, "joined_s", Since(recording, recording.Joined?.Time));
        json.WriteNumber("entries", recording.Entries.Count);
        json.WriteNumber("states", recording.Committed.Count);
        JsonDocumentWriter.Number(json, "holds_up_to_s", Since(recording, recording.HoldsUpTo));
        json.WriteBoolean("whole", recording.IsWhole);
        json.WriteString("end_reason", recording.EndReason);
        JsonDocumentWriter.Number(json, "damaged_at_byte", recording.Damage?.Offset);
        json.WriteString("damage", recording.Damage?.Reason);
    }

    /// <summary>Returns the seconds since the recorded session's start.</summary>
    private static double? Since(Recording recording, SimTime? time) => recording.Header is RecordingHeader header ? (time - header.Start)?.ToSeconds() : null;

    /// <summary>Returns the state of the last time in both recordings, if they agree.</summary>
    private static ulong? LastCommon(IReadOnlyList<Recording> recordings, RecordingComparison found)
    {
        if (found.Outcome != ComparisonOutcome.Agrees)
        {
            return null;
        }

        HashSet<SimTime> times = recordings[1].Committed.Select(state => state.Time).ToHashSet();
        return recordings[0].Committed.Where(state => times.Contains(state.Time)).Select(state => (ulong?)state.StateHash).LastOrDefault();
    }
}
