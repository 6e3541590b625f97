using System.IO;
using System.Linq;
using LagSim.Harness.Verification.Hard;

namespace LagSim.Cli.Output;

/// <summary>The hard cases as a JSON document.</summary>
internal static class HardJson
{
    internal static void Write(TextWriter output, HardReport report) => JsonDocumentWriter.Write(output, "hard", report.Seed, null, null, null, json =>
    {
        json.WriteString("scale", report.Scale == HardScale.Full ? "full" : "small");
        json.WriteBoolean("controls", report.AreControls);
        json.WriteNumber("wall_s", report.WallSeconds);
        json.WriteNumber("rows", report.Rows.Count);
        json.WriteNumber("rows_passed", report.Rows.Count(row => row.Passed));
        json.WriteStartArray("cases");
        foreach (HardRow row in report.Rows)
        {
            json.WriteStartObject();
            json.WriteString("case", row.Case);
            json.WriteString("size", row.Size);
            JsonDocumentWriter.Number(json, "error", row.Error);
            json.WriteString("error_kind", row.ErrorKind);
            JsonDocumentWriter.Number(json, "bound", row.Bound);
            json.WriteBoolean("passed", row.Passed);
            json.WriteBoolean("modelled", row.IsModelled);
            json.WriteString("reference", row.Reference);
            json.WriteString("argument", row.Argument);
            json.WriteString("note", row.Note);
            json.WriteEndObject();
        }

        json.WriteEndArray();
        json.WriteBoolean("stopped_early", report.StoppedAt is not null);
        json.WriteString("stopped_at", report.StoppedAt);
    });
}
