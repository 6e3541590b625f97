using System.Collections.Generic;
using System.IO;
using LagSim.Harness.Experiments.Sweep;

namespace LagSim.Cli.Output;

/// <summary>The sweep over full links as a JSON document.</summary>
internal static class SweepJson
{
    internal static void Write(TextWriter output, SweepOptions options, IReadOnlyList<SweepOutcome> outcomes, bool isStopped) =>
        JsonDocumentWriter.Write(output, "sweep", options.Seed, null, null, null, json =>
        {
            json.WriteStartArray("cells");
            foreach (SweepOutcome o in outcomes)
            {
                json.WriteStartObject();
                json.WriteNumber("clients", o.Cell.Clients);
                json.WriteNumber("events_per_s", o.Cell.EventsPerSecond);
                json.WriteNumber("rate_bit_per_s", o.Cell.RateBitsPerSecond);
                json.WriteNumber("queue_ms", o.Cell.QueueMilliseconds);
                json.WriteBoolean("dips", o.Cell.HasDips);
                json.WriteBoolean("bulk_transfer", o.Cell.HasBulkTransfer);
                json.WriteBoolean("shared", o.Cell.IsShared);
                json.WriteNumber("load_share", o.LoadShare);
                json.WriteNumber("offered_bytes_per_s", o.OfferedBytesPerSecond);
                json.WriteNumber("delivered_bytes_per_s", o.DeliveredBytesPerSecond);
                json.WriteNumber("sent_bytes_per_s", o.SentBytesPerSecond);
                json.WriteNumber("sent_up_bytes_per_s", o.SentUpBytesPerSecond);
                json.WriteNumber("idle_round_trip_ms", o.IdleRoundTripMs);
                json.WriteNumber("round_trip_p50_ms", o.RoundTripP50Ms);
                json.WriteNumber("round_trip_p99_ms", o.RoundTripP99Ms);
                json.WriteNumber("recovery_s", o.RecoverySeconds);
                json.WriteNumber("events_done", o.Done);
                json.WriteNumber("events_refused", o.Refused);
                json.WriteNumber("events_unanswered", o.Unanswered);
                json.WriteNumber("events_lost", o.Lost);
                json.WriteNumber("states_differed", o.Differed);
                json.WriteNumber("compared_share", o.ComparedShare);
                json.WriteNumber("copies", o.Copies);
                json.WriteNumber("links_too_slow", o.TooSlow);
                json.WriteNumber("queued_s", o.QueuedSeconds);
                json.WriteNumber("queued_sent_per_needed_byte", o.SentPerNeededByteWhileQueued);
                json.WriteString("failure", o.Shortfall);
                json.WriteBoolean("passed", o.IsGood);
                json.WriteEndObject();
            }

            json.WriteEndArray();
            json.WriteBoolean("stopped_early", isStopped);
        });
}
