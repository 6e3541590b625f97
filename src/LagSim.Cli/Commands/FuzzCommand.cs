using System.CommandLine;
using System.Globalization;
using LagSim.Cli.Output;
using LagSim.Harness.Fuzz;

namespace LagSim.Cli.Commands;

/// <summary><c>lagsim fuzz</c>: sessions under hostile datagrams.</summary>
internal static class FuzzCommand
{
    internal static Command Create(ToolConsole console)
    {
        CommonOptions common = new();
        Option<int> packets = CommonOptions.Whole("--packets", "How many hostile datagrams to send", 1_000_000, 1, 2_000_000_000);
        Command command = new("fuzz", "Sends hostile datagrams at sessions in virtual time; nothing may throw, and no stranger may end a session.") { packets };
        command.Options.Add(common.Seed);
        command.Options.Add(common.Json);
        command.SetAction(parsed =>
        {
            int count = parsed.GetValue(packets);
            ulong seed = parsed.GetValue(common.Seed);
            FuzzReport report = console.WithProgress("fuzz", count, progress => SessionFuzz.Run(count, seed, done => progress(done), console.Stop));
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

    private static void WriteText(ToolConsole console, FuzzReport report)
    {
        CultureInfo culture = CultureInfo.InvariantCulture;
        console.Output.WriteLine(string.Create(culture, $"{report.Packets:N0} hostile datagrams at {report.Sessions:N0} sessions, every other of which got them from strangers, or as true ones played again"));
        console.Output.WriteLine(string.Create(culture, $"refused by a decoder {report.Malformed:N0}, ignored {report.Ignored:N0}"));
        console.Output.WriteLine(string.Create(culture, $"strangers sent {report.StrangerBytesSent:N0} bytes and got {report.StrangerBytesReceived:N0}"));
        console.Output.WriteLine(string.Create(culture, $"sessions broken by who had a peer's own address {report.SessionsBroken:N0}; memory grew by {report.RetainedBytes:N0} bytes"));
        console.Output.WriteLine(report.Failure ?? "Nothing threw, and no stranger ended a session.");
    }

    private static void WriteJson(ToolConsole console, FuzzReport report, ulong seed) =>
        JsonDocumentWriter.Write(console.Output, "fuzz", seed, null, null, null, json =>
        {
            json.WriteNumber("packets", report.Packets);
            json.WriteNumber("sessions", report.Sessions);
            json.WriteNumber("malformed", report.Malformed);
            json.WriteNumber("ignored", report.Ignored);
            json.WriteNumber("sessions_broken", report.SessionsBroken);
            json.WriteNumber("stranger_sent_bytes", report.StrangerBytesSent);
            json.WriteNumber("stranger_received_bytes", report.StrangerBytesReceived);
            json.WriteNumber("retained_bytes", report.RetainedBytes);
            json.WriteString("failure", report.Failure);
        });
}
