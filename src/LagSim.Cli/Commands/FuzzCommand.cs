using System.CommandLine;
using System.Globalization;
using LagSim.Cli.Output;
using LagSim.Harness.Reports;
using LagSim.Harness.Verification.Fuzz;

namespace LagSim.Cli.Commands;

/// <summary><c>lagsim fuzz</c>: sessions under hostile datagrams.</summary>
internal static class FuzzCommand
{
    internal static Command Create(ToolConsole console)
    {
        CommonOptions common = new();
        Option<int> packets = CommonOptions.Whole("--packets", "How many hostile datagrams to send at most; in real time as many as fit", 1_000_000, 1, 2_000_000_000);
        Option<string> time = CommonOptions.Word("--time", "Sessions in virtual time, or one over real UDP, flooded at full speed.", "virtual", "virtual", "real");
        Option<double> length = CommonOptions.Number("--for-s", "How long to flood in real time", 10, 0.1, 86_400);
        Option<bool> isProtected = new("--protected")
        {
            Description = "Protect the sessions. Then not even datagrams with the peers' own addresses may disturb one.",
        };
        Command command = new("fuzz", "Sends hostile datagrams at sessions; nothing may throw, and no stranger may end a session.")
        {
            packets, time, length, isProtected,
        };
        command.Options.Add(common.Seed);
        command.Options.Add(common.Json);
        command.SetAction(parsed =>
        {
            int count = parsed.GetValue(packets);
            ulong seed = parsed.GetValue(common.Seed);
            if (parsed.GetValue(time) == "real")
            {
                long most = parsed.GetResult(packets)?.Implicit == false ? count : long.MaxValue;
                return Flood(console, parsed.GetValue(length), most, seed, parsed.GetValue(isProtected), parsed.GetValue(common.Json));
            }

            FuzzReport report = console.WithProgress("fuzz", count, progress => SessionFuzz.Run(
                count, seed, done => progress(done), console.Stop, parsed.GetValue(isProtected)));
            if (parsed.GetValue(common.Json))
            {
                WriteJson(console, report, seed);
            }
            else
            {
                WriteText(console, report);
            }

            return report.Failure is null ? ExitCode.Done : ExitCode.CheckFailed;
        });
        return command;
    }

    private static int Flood(ToolConsole console, double seconds, long packets, ulong seed, bool isProtected, bool asJson)
    {
        FloodReport report = console.WithProgress(
            "flood", seconds, progress => RealFlood.Run(seconds, packets, seed, isProtected, progress, console.Stop));
        CultureInfo culture = CultureInfo.InvariantCulture;
        if (asJson)
        {
            JsonDocumentWriter.Write(console.Output, "fuzz", seed, null, null, null, json =>
            {
                json.WriteNumber("flood_s", report.Seconds);
                json.WriteNumber("garbage_sent", report.GarbageSent);
                json.WriteNumber("replays_sent", report.ReplaysSent);
                json.WriteNumber("joins_sent", report.JoinsSent);
                json.WriteNumber("received", report.Received);
                json.WriteNumber("malformed", report.Malformed);
                json.WriteNumber("ignored", report.Ignored);
                json.WriteNumber("forged", report.Forged);
                json.WriteNumber("events_done", report.EventsDone);
                json.WriteNumber("events_agreed", report.EventsAgreed);
                JsonDocumentWriter.Number(json, "join_s", report.JoinSeconds);
                json.WriteNumber("retained_bytes", report.RetainedBytes);
                json.WriteNumber("max_lateness_ms", report.MaxLatenessMilliseconds);
                json.WriteString("failure", report.Failure);
            });
        }
        else
        {
            console.Output.WriteLine(string.Create(culture, $"{report.GarbageSent:N0} datagrams of garbage and {report.ReplaysSent:N0} replayed ones in"
                + $" {report.Seconds:0.0} s at a host and a client, and {report.JoinsSent:N0} of joins at the host"));
            console.Output.WriteLine(string.Create(culture, $"taken in {report.Received:N0}, refused by a decoder {report.Malformed:N0}, ignored"
                + $" {report.Ignored:N0}, forged {report.Forged:N0}"));
            string joined = report.JoinSeconds is double took ? string.Create(culture, $"was in after {took:0.00} s") : "did not get in";
            console.Output.WriteLine($"a client that joined meanwhile {joined}");
            console.Output.WriteLine(string.Create(culture, $"{report.EventsAgreed} of {report.EventsDone} events that the two did meanwhile are on both;"
                + $" memory grew by {report.RetainedBytes:N0} bytes; a world was at most {report.MaxLatenessMilliseconds:0.0} ms behind"));
            console.Output.WriteLine(report.Failure ?? "The session went on, and both have the same world.");
        }

        return report.Failure is null ? ExitCode.Done : ExitCode.CheckFailed;
    }

    private static void WriteText(ToolConsole console, FuzzReport report)
    {
        CultureInfo culture = CultureInfo.InvariantCulture;
        console.Output.WriteLine(string.Create(culture, $"{NumberText.Count(report.Packets, "hostile datagram", "N0")} at"
            + $" {NumberText.Count(report.Sessions, "session", "N0")}, every other of which got them from strangers, or as true ones played again"));
        console.Output.WriteLine(string.Create(culture, $"refused by a decoder {report.Malformed:N0}, ignored {report.Ignored:N0},"
            + $" forged {report.Forged:N0}"));
        console.Output.WriteLine(string.Create(culture, $"strangers sent {report.StrangerBytesSent:N0} bytes and got {report.StrangerBytesReceived:N0}"));
        console.Output.WriteLine(string.Create(culture, $"sessions broken by who had a peer's own address {report.SessionsBroken:N0}; memory grew by"
            + $" {report.RetainedBytes:N0} bytes, within a session by {report.SessionGrowthBytes:N0}"));
        console.Output.WriteLine(report.Failure ?? "Nothing threw, and no stranger ended a session.");
    }

    private static void WriteJson(ToolConsole console, FuzzReport report, ulong seed) =>
        JsonDocumentWriter.Write(console.Output, "fuzz", seed, null, null, null, json =>
        {
            json.WriteNumber("packets", report.Packets);
            json.WriteNumber("sessions", report.Sessions);
            json.WriteNumber("malformed", report.Malformed);
            json.WriteNumber("ignored", report.Ignored);
            json.WriteNumber("forged", report.Forged);
            json.WriteNumber("sessions_broken", report.SessionsBroken);
            json.WriteNumber("stranger_sent_bytes", report.StrangerBytesSent);
            json.WriteNumber("stranger_received_bytes", report.StrangerBytesReceived);
            json.WriteNumber("retained_bytes", report.RetainedBytes);
            json.WriteNumber("session_growth_bytes", report.SessionGrowthBytes);
            json.WriteString("failure", report.Failure);
        });
}
