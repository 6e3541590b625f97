using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text.Json;
using LagSim.Net.Recordings;
using LagSim.Tests.Recordings;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>Real processes of the built tool on loopback: the same committed hash at the same printed time, whatever becomes of the others.</summary>
[Collection(RealTime.Name)]
[Trait("Time", "real")]
public sealed class ProcessTests
{
    [Fact]
    public void TwoProcesses_AgreeAndWhatIsWrongIsAnErrorAndControlCEndsTheSession()
    {
        using ToolProcess host = ToolProcess.Start("host --scene pair --key open-sesame --joiners 1 --history-s 0.2");
        using ToolProcess client = ToolProcess.Start($"join {host.Address} --key open-sesame --do set-velocity@0.3:1,3,0");
        string port = host.Address.Split(':')[1];
        using ToolProcess second = ToolProcess.Start($"host --scene pair --port {port}");
        using ToolProcess wrong = ToolProcess.Start($"join {host.Address} --key close-sesame");
        using ToolProcess unknown = ToolProcess.Start("join no-such-host.invalid:5000");
        second.Ends(3);
        wrong.Ends(3);
        unknown.Ends(3);
        Assert.Contains($"UDP port 127.0.0.1:{port} cannot be opened: ", second.Error.ToString(), StringComparison.Ordinal);
        Assert.Contains($"The host at {host.Address} refused: the key is wrong.", wrong.Error.ToString(), StringComparison.Ordinal);
        Assert.Contains("The host 'no-such-host.invalid' is not known", unknown.Error.ToString(), StringComparison.Ordinal);
        Assert.All(new[] { second, wrong, unknown }, process => Assert.Equal("", process.Output.ToString()));

        client.Says("T 1 s ");
        Assert.SkipWhen(OperatingSystem.IsWindows(), "Windows has no signal that a test can send.");
        Assert.SkipWhen(ToolProcess.IgnoresControlC(), "Ctrl-C is ignored here, and by what is started from here.");
        host.PressControlC();
        host.Ends(130);
        client.Ends(0);
        AssertSame([host, client], least: 1);
        Assert.Contains($"ended: The host at {host.Address} ended the session.", client.Output.ToString(), StringComparison.Ordinal);
    }

    [Fact]
    public void ThreeProcesses_OneClientKilledThenTheHost_LeaveTheOthersToGoOnAndThenToEndWithASentence()
    {
        using ToolProcess host = ToolProcess.Start("host --scene pair --joiners 2 --history-s 0.2 --timeout-s 1.5 --do impulse@0.4:1,4,0");
        using ToolProcess first = ToolProcess.Start($"join {host.Address} --timeout-s 1.5");
        using ToolProcess second = ToolProcess.Start($"join {host.Address} --timeout-s 1.5 --rejoin-s 0 --do impulse@1.5:-1,4,0");
        second.Says("T 1 s ");
        first.KillAtOnce();
        Assert.NotNull(host.Error.WaitFor(line => line.EndsWith(" is gone", StringComparison.Ordinal), LiveTool.Deadline));
        host.Says("T 3 s ");
        second.Says("T 3 s ");
        AssertSame([host, second], least: 3);
        Assert.Single(host.Error.Lines, line => line.EndsWith(" is gone", StringComparison.Ordinal));
        host.KillAtOnce();
        second.Ends(3);
        Assert.Contains($"The host at {host.Address} fell silent for 1.5 s.", second.Error.ToString(), StringComparison.Ordinal);
        Assert.Contains("last committed: ", second.Output.ToString(), StringComparison.Ordinal);
        Assert.Contains("events: 2 accepted", second.Output.ToString(), StringComparison.Ordinal);
    }

    [Fact]
    public void EightProcesses_AgreeAndSoDoTheirRecordings()
    {
        using TemporaryFolder folder = new();
        string[] files = Enumerable.Range(0, 8).Select(n => folder[$"{n}.lagsim"]).ToArray();
        ToolProcess host = ToolProcess.Start($"host --scene billiards --joiners 7 --history-s 0.4 --for-s 2 --record {files[0]}");
        ToolProcess[] all =
        [
            host,
            .. Enumerable.Range(1, 7).Select(n => ToolProcess.Start($"join {host.Address} --for-s 2 --do impulse@9.{n}e-1:0.1,0,0.{n} --do impulse@1.{n}:0,0,-0.1 --record {files[n]}")),
        ];
        try
        {
            Assert.All(all, process => process.Ends(0));
            AssertSame(all, least: 2);
            string[] last = all.Select(process => process.Output.Lines.Single(line => line.StartsWith("last committed: 2 s", StringComparison.Ordinal))).ToArray();
            Assert.Single(last.Distinct());
            foreach (string file in files)
            {
                Assert.Contains("agree in all that both hold: 14 log entries and 2 committed states", Tool.Run("diff", files[0], file).Done().Output, StringComparison.Ordinal);
                string replayed = Tool.Run("replay", file).Done().Output;
                Assert.Contains(last[0].Split("s, ")[1], replayed, StringComparison.Ordinal);
            }

            // The control: one event less, and it is named.
            File.WriteAllBytes(folder["less.lagsim"], SessionRecorderTests.Without(Recording.Read(files[3]), 5));
            Tool differs = Tool.Run("diff", files[0], folder["less.lagsim"]);
            Assert.Equal(1, differs.ExitCode);
            Assert.StartsWith("Entry 5 of the log differs, at T ", differs.Output, StringComparison.Ordinal);
            Assert.Equal(1, Tool.Run("replay", folder["less.lagsim"]).ExitCode);
        }
        finally
        {
            Array.ForEach(all, process => process.Dispose());
        }
    }

    [Fact]
    public void HostAndThreeClients_ThroughARelayThatPlaysAwful_Agree()
    {
        // This link loses bursts. The clients have a second to come in before the first action, and each action has three to reach the host.
        using TemporaryFolder folder = new();
        using ToolProcess host = ToolProcess.Start($"host --scene pair --joiners 3 --history-s 3 --for-s 3 --do impulse@2:0,5,0 --record {folder["0"]}");
        using ToolProcess relay = ToolProcess.Start($"relay {host.Address} --profile awful --for-s 60");
        ToolProcess[] clients = Enumerable.Range(1, 3)
            .Select(n => ToolProcess.Start($"join {relay.Address} --for-s 3 --do impulse@1.{n}:0,3,{n} --do set-velocity@2.{n}:{n},2,0 --record {folder[$"{n}"]}")).ToArray();
        try
        {
            Assert.All(clients, client => client.Ends(0));
            host.Ends(0);
            AssertSame([host, .. clients], least: 3);
            foreach (string file in Enumerable.Range(1, 3).Select(n => folder[$"{n}"]))
            {
                Assert.Contains("7 log entries", Tool.Run("diff", folder["0"], file).Done().Output, StringComparison.Ordinal);
                Tool.Run("replay", file).Done();
            }

            Assert.All(clients, client => Assert.Matches("heals: [1-9]", client.Output.ToString())); // else nothing came late
            Assert.All(clients, client => Assert.Matches(@"round trip [1-9]\d\d", client.Output.ToString())); // else the link is another
        }
        finally
        {
            Array.ForEach(clients, client => client.Dispose());
        }
    }

    /// <summary>A second process does not write into a recording of another; it says so, and the first one's stays whole.</summary>
    [Fact]
    public void HostAndJoin_RecordingToOneFile_TheSecondSaysSoAndLeavesIt()
    {
        Assert.SkipUnless(OperatingSystem.IsLinux(), "Linux locks files only for those who ask; Windows does by itself.");
        using TemporaryFolder folder = new();
        using ToolProcess host = ToolProcess.Start($"host --scene pair --joiners 1 --for-s 2 --record {folder["both"]}");
        using ToolProcess client = ToolProcess.Start($"join {host.Address} --for-s 2 --record {folder["both"]}");
        ToolProcess[] all = [host, client];
        Assert.Equal([0, 3], all.Select(process => process.ExitCode()).Order());
        Assert.Single(all, process => process.ToString().Contains("another process is writing it", StringComparison.Ordinal));
        Assert.Contains("2 committed states", Tool.Run("diff", folder["both"], folder["both"]).Done().Output, StringComparison.Ordinal);
        Assert.DoesNotContain("damaged", Tool.Run("replay", folder["both"]).Done().Output, StringComparison.Ordinal);
    }

    /// <summary>A terminal that is closed ends a session as a request to terminate does.</summary>
    [Fact]
    public void Host_WhoseTerminalIsClosed_SaysGoodbyeAndWritesItsDocumentAndTheEndOfItsRecording()
    {
        Assert.SkipWhen(OperatingSystem.IsWindows(), "Windows has no signal that a test can send.");
        Assert.SkipWhen(ToolProcess.IgnoresHangup(), "The signal is ignored here, and by what is started from here.");
        using TemporaryFolder folder = new();
        using ToolProcess host = ToolProcess.Start($"host --scene pair --joiners 1 --history-s 0.2 --json --record {folder["0"]}");
        string listening = host.Error.WaitFor(line => line.StartsWith("listening on ", StringComparison.Ordinal), LiveTool.Deadline) ?? $"{host}";
        using ToolProcess client = ToolProcess.Start($"join {listening.Split(' ')[2]}");
        client.Says("T 1 s ");
        host.CloseTerminal();
        host.Ends(129);
        client.Ends(0); // at once, and not by its timeout
        Assert.Contains(" ended the session.", client.Output.ToString(), StringComparison.Ordinal);
        using JsonDocument document = JsonDocument.Parse(host.Output.ToString());
        Assert.Equal("left", document.RootElement.GetProperty("ended_by").GetString());
        using JsonDocument replayed = JsonDocument.Parse(Tool.Run("replay", folder["0"], "--json").Done().Output);
        Assert.True(replayed.RootElement.GetProperty("whole").GetBoolean());
    }

    /// <summary>That all print the same at each time that they share, which must be so many.</summary>
    private static void AssertSame(IReadOnlyList<ToolProcess> processes, int least)
    {
        Dictionary<string, string>[] states = processes.Select(process => LineWriter.States(process.Output.Lines)).ToArray();
        string[] common = states[0].Keys.Where(time => states.All(of => of.ContainsKey(time))).ToArray();
        Assert.True(common.Length >= least, $"{common.Length} times are common: {string.Join("", processes)}");
        Assert.All(common, time => Assert.Single(states.Select(of => of[time]).Distinct()));
        Assert.Equal(common.Length, common.Select(time => states[0][time]).Distinct().Count()); // and it is not the same all the time
    }
}
