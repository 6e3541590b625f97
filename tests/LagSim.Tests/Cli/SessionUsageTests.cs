using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text.Json;
using System.Text.RegularExpressions;
using LagSim.Cli.Commands;
using LagSim.Cli.Output;
using LagSim.Net.Recordings;
using LagSim.Net.Sessions;
using LagSim.Tests.Recordings;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>What host, join, relay, diff and replay refuse, and what their ends are to the shell.</summary>
public sealed class SessionUsageTests
{
    private const int Usage = 2;
    private const int Input = 3;

    [Theory]
    [InlineData("host", "--scene")]
    [InlineData("host --scene drop --port 65536", "--port is '65536'; it must be a whole number between 0 and 65535")]
    [InlineData("host --scene drop --joiners 17", "--joiners is '17'; it must be a whole number between 0 and 16")]
    [InlineData("host --scene drop --clients 17", "--clients is '17'; it must be a whole number between 0 and 16")]
    [InlineData("host --scene drop --history-s 6", "--history-s is '6'; it must be a number between 0.05 and 5")]
    [InlineData("host --scene drop --longest-history-s 0.5", "--longest-history-s is '0.5'; it must be at least --history-s, 1.")]
    [InlineData("host --scene drop --longest-history-s 6", "--longest-history-s is '6'; it must be a number between 0.05 and 5")]
    [InlineData("host --scene drop --max-bytes-per-s 100", "--max-bytes-per-s is '100'; it must be a number between 4000 and 100000000")]
    [InlineData("host --scene drop --timeout-s 0.1", "--timeout-s is '0.1'; it must be a number between 0.5 and 600")]
    [InlineData("host --scene drop --for-s NaN", "--for-s is 'NaN'; it must be a number between 0.1 and 1000000")]
    [InlineData("host --scene drop --for-s 2 --do remove@2", "--do is 'remove@2', which is not before the end, --for-s 2")]
    [InlineData("host --scene drop --do remove@2:bell", "scene 'drop' has no body 'bell'; it has ball")]
    [InlineData("host --scene drop --record -", "--record is '-'; a recording is not for stdout")]
    [InlineData("host --scene drop --web 65536", "--web is '65536'; it must be a whole number between 0 and 65535.")]
    [InlineData("host --scene drop --web http", "--web is 'http'; it must be a whole number between 0 and 65535.")]
    [InlineData("host --scene drop --web-origin https://example.org", "--web-origin says nothing without --web PORT.")]
    [InlineData("host --scene drop --web-certificate some.pem", "--web-certificate says nothing without --web PORT.")]
    [InlineData("host --scene drop --web 0 --web-origin example.org", "--web-origin is 'example.org'; it must be a scheme and a host")]
    [InlineData("host --scene drop --web 0 --web-origin https://example.org/path", "--web-origin is 'https://example.org/path'")]
    [InlineData("host --scene drop --web 0 --tokens 0123", "--web contradicts --tokens: the page has no token to show.")]
    [InlineData("join ws://", "'ws://' does not say where the host is: write ws://ADDRESS:PORT")]
    [InlineData("join ws://127.0.0.1:8080#1234", "'ws://127.0.0.1:8080#1234' has no fingerprint after '#'")]
    [InlineData("join http://127.0.0.1:8080", "'http://127.0.0.1:8080' is the address of a page, for browsers; a native peer joins it as ws://127.0.0.1:8080.")]
    [InlineData("join https://lagsim.example", "a native peer joins it as wss://lagsim.example.")]
    [InlineData("join", "ADDRESS is missing: lagsim join ADDRESS.")]
    [InlineData("join 127.0.0.1:9 --for-s 0", "--for-s is '0'")]
    [InlineData("join 127.0.0.1:9 --scene drop", "'--scene'")]
    [InlineData("join 127.0.0.1:9 --pass -", "--pass is '-'; a pass is not for stdout, it must be a file.")]
    [InlineData("join 127.0.0.1:9 --pass x.pass --record ./x.pass", "--pass and --record are both 'x.pass'; they must be different files.")]
    [InlineData("join 127.0.0.1:9 --pass .", "--pass is '.'; that is a folder, it must be a file.")]
    [InlineData("relay 127.0.0.1:9", "The link is missing: --profile NAME, or figures, any of --delay-ms, --jitter-ms, --loss-percent, --rate-kbps.")]
    [InlineData("relay 127.0.0.1:9 --profile lan --loss-percent 3", "--loss-percent and --profile exclude each other: a profile has figures of its own.")]
    [InlineData("relay 127.0.0.1:9 --loss-percent 101", "--loss-percent is '101'; it must be a number between 0 and 100.")]
    [InlineData("relay 127.0.0.1:9 --delay-ms -1", "--delay-ms is '-1'; it must be a number between 0 and 2000.")]
    [InlineData("relay 127.0.0.1:9 --jitter-ms NaN", "--jitter-ms is 'NaN'; it must be a number between 0 and 2000.")]
    [InlineData("relay 127.0.0.1:9 --rate-kbps 0", "--rate-kbps is '0'; it must be a number between 1 and 10000000.")]
    [InlineData("relay 127.0.0.1:9 --profile dreadful", "There is no link profile 'dreadful'; there are loopback")]
    [InlineData("relay :9 --profile lan", "':9' does not say where the host is")]
    [InlineData("diff a.lagsim", "B is missing: lagsim diff A B.")]
    [InlineData("replay", "FILE is missing: lagsim replay FILE.")]
    public void Call_ThatCannotBe_IsRefusedWithWhatIsWrong(string line, string says) => Tool.Refuses(Usage, line.Split(' '), says);

    [Theory]
    [InlineData("host --scene nope", "nope: this is neither a built-in scene (drop, pair, cradle, billiards, crowd, goals, crowd-N for N from 1 to 100000, air-hockey) nor a file that exists")]
    [InlineData("host --scene drop --web 0 --web-certificate nope.pem", "--web-certificate is 'nope.pem'; there is no such file.")]
    public void File_ThatIsNotThere_IsRefusedByName(string line, string says) => Tool.Refuses(Input, line.Split(' '), says);

    /// <summary>A variable that is not set opens no host without a key.</summary>
    [Fact]
    public void Key_ThatIsEmpty_IsRefused()
    {
        Tool.Refuses(Usage, ["host", "--scene", "drop", "--key", ""], "--key is empty; it must be 1 to 256 characters.");
        Tool.Refuses(Usage, ["join", "127.0.0.1:9", "--key", ""], "--key is empty; it must be 1 to 256 characters.");
    }

    /// <summary>Where a decoder put U+FFFD for bytes that it could not read, different bytes would be the same key, or the same player.</summary>
    [Theory]
    [InlineData("a\uFFFD")]
    [InlineData("a\uD800")]
    public void Text_ThatStandsForBytes_IsRefused(string text)
    {
        using TemporaryFolder folder = new();
        Tool.Refuses(Usage, ["host", "--scene", "drop", "--key", text], "--key holds ");
        Tool.Refuses(Usage, ["join", "127.0.0.1:9", "--name", text], "--name is not one to show: it holds ");
        string[] token = ["token", "--secret", folder["secret"], "--host", "lagsim://127.0.0.1:5000#0a1b2c3d4e5f60718293a4b5c6d7e8f9"];
        Tool.Refuses(Usage, [.. token, "--player", text], "The text holds ");
        Tool.Refuses(Usage, [.. token, "--player", "bob", "--name", text], "The player's name is not one to show: it holds ");
        Assert.Throws<ArgumentException>(new ClientOptions { ConnectKey = text }.Check);
        Assert.Throws<ArgumentException>(new HostOptions { PlayerKeys = new Dictionary<byte, string> { [1] = text } }.Check);
        new HostOptions { ConnectKey = "a\U0001F600", PlayerKeys = new Dictionary<byte, string> { [1] = "ä" } }.Check(); // the control
    }

    [Theory]
    [InlineData("--player")]
    [InlineData("--name")]
    [InlineData("--number")]
    [InlineData("--valid-s")]
    public void Token_ForNoHost_IsRefused(string option)
    {
        using TemporaryFolder folder = new();
        Tool.Refuses(Usage, ["token", "--secret", folder["secret"], option, "5"], $"{option} needs --host");
        Assert.False(File.Exists(folder["secret"]));
        Assert.Contains("no token: --host says", Tool.Run("token", "--secret", folder["secret"]).Done().Output, StringComparison.Ordinal); // the control
    }

    [Fact]
    public void Key_ThatIsTooLong_IsRefused() =>
        Tool.Refuses(Usage, ["host", "--scene", "drop", "--key", new string('k', 257)], "--key has 257 characters; at most 256 are allowed");

    [Theory]
    [InlineData("host --scene no-such-scene", "no-such-scene")]
    [InlineData("host --scene crowd-10001", "it has 10001 bodies; at most 10000 are allowed")]
    [InlineData("host --scene drop --address 192.0.2.77", "UDP port 192.0.2.77:0 cannot be opened")]
    [InlineData("host --scene drop --record never-made/x.lagsim", "never-made")]
    [InlineData("join 127.0.0.1:9 --pass never-made/x.pass", "--pass is 'never-made/x.pass'; it must be a file that can be written. There is no folder")]
    [InlineData("diff no-such.lagsim no-such.lagsim", "no-such.lagsim")]
    [InlineData("replay no-such.lagsim", "no-such.lagsim")]
    public void Call_OfWhatIsNotThere_IsRefusedWithItsName(string line, string says) => Tool.Refuses(Input, line.Split(' '), says);

    [Fact]
    public void Record_FileThatWasThere_IsLeftAloneByACallThatIsRefused()
    {
        using TemporaryFolder folder = new();
        File.WriteAllText(folder["kept"], "of yesterday");
        Tool.Refuses(Input, ["join", "no-such-host.invalid:5", "--record", folder["kept"]], "not known");
        Tool.Refuses(Input, ["join", "no-such-host.invalid:5", "--record", folder["new"]], "not known");
        Assert.Equal([folder["kept"]], Directory.GetFileSystemEntries(folder.Path));
        Assert.Equal("of yesterday", File.ReadAllText(folder["kept"]));
    }

    [Fact]
    public void Pass_OfACallThatIsRefused_LeavesNoFile()
    {
        using TemporaryFolder folder = new();
        Tool.Refuses(Input, ["join", "no-such-host.invalid:5", "--pass", folder["new"]], "not known");
        Assert.Empty(Directory.GetFileSystemEntries(folder.Path));
    }

    [Fact]
    public void Replay_OfWhatIsNoRecording_SaysItInOneSentence()
    {
        using TemporaryFolder folder = new();
        File.WriteAllText(folder["none"], "of yesterday");
        Assert.Equal(
            $"{folder["none"]}: This is no recording of LagSim: its first eight bytes are not those of one.",
            LastLine(Tool.Run("replay", folder["none"])));

        // The control: what is a recording, and is damaged further on, is told with the place.
        File.WriteAllBytes(folder["cut"], Recorded.Small()[..30]);
        Assert.StartsWith($"{folder["cut"]}: Damaged at byte 10, before its scene ends: ", LastLine(Tool.Run("replay", folder["cut"])), StringComparison.Ordinal);
    }

    [Fact]
    public void DiffAndReplay_OfWhatIsNoRecording_AreRefused()
    {
        using TemporaryFolder folder = new();
        File.WriteAllText(folder["none"], "of yesterday");
        Tool.Refuses(Input, ["replay", folder["none"]], folder["none"], "This is no recording of LagSim");
        Tool.Refuses(Input, ["replay", folder["none"], "--json"], "This is no recording of LagSim");
        Tool.Refuses(Input, ["diff", folder["none"], folder["none"]], "The first is damaged at byte 0");
    }

    [Fact]
    public void Diff_WithoutACommittedStateThatBothHold_IsACheckThatFailed()
    {
        using TemporaryFolder folder = new();
        File.WriteAllBytes(folder["all"], Recorded.Small());
        File.WriteAllBytes(folder["no state"], Recorded.Bytes(writer => writer.WriteEntry(1, Recorded.Log[0].Verdict, Recorded.Log[0].Event)));
        Tool nothing = Tool.Run("diff", folder["all"], folder["no state"]);
        Assert.Equal(1, nothing.ExitCode);
        Assert.Contains("the same in 1 common log entry, and no committed time in common: of the states nothing is known.", nothing.Output, StringComparison.Ordinal);
        using JsonDocument document = JsonDocument.Parse(Tool.Run("diff", folder["all"], folder["no state"], "--json").Output);
        Assert.Equal("nothing-in-common", document.RootElement.GetProperty("outcome").GetString());
    }

    [Fact]
    public void DiffAndReplay_OfDamagedRecordings_AreDecidedByWhatStandsBefore()
    {
        using TemporaryFolder folder = new();
        byte[] bytes = Recorded.Small();
        File.WriteAllBytes(folder["all"], bytes);
        File.WriteAllBytes(folder["cut late"], bytes[..^60]);
        int first = Enumerable.Range(1, bytes.Length).First(n => Recorded.Read(bytes[..n]).Committed.Count == 1);
        File.WriteAllBytes(folder["cut early"], bytes[..(first - 1)]);
        Assert.Contains("The second is damaged at byte ", Tool.Run("diff", folder["all"], folder["cut late"]).Done().Output, StringComparison.Ordinal);
        Tool replay = Tool.Run("replay", folder["cut late"]).Done();
        Assert.Matches($"^'{Regex.Escape(folder["cut late"])}' is damaged at byte [0-9]+; what it holds counts, up to T [0-9.]+ s[.]$", LastLine(replay));
        Assert.Matches(@"up to T [0-9.]+ s, with", replay.Output);
        Assert.Equal(1, Tool.Run("diff", folder["all"], folder["cut early"]).ExitCode);
        Assert.Equal(1, Tool.Run("replay", folder["cut early"]).ExitCode);
    }

    [Fact]
    public void DiffAndReplay_OfRecordingsThatAreCut_TellItAlikeWhereverTheCutIs()
    {
        using TemporaryFolder folder = new();
        byte[] bytes = Recorded.Small();
        File.WriteAllBytes(folder["all"], bytes);
        List<int> at = Recorded.Boundaries(bytes);
        int committed = 0;
        for (int record = 2; record < at.Count - 1; record++)
        {
            committed += bytes[at[record - 1]] == 5 ? 1 : 0;
            foreach (int length in new[] { at[record], at[record] + 1, at[record + 1] - 1 })
            {
                File.WriteAllBytes(folder["cut"], bytes[..length]);
                bool isAtEnd = length == at[record];
                double? until = committed > 0 ? (committed - 1) / 2.0 : null;
                int exit = committed > 0 ? 0 : 1;
                string told = $"'{folder["cut"]}' {(isAtEnd ? "has no end record" : $"is damaged at byte {at[record]}")}; "
                    + (until is double time ? FormattableString.Invariant($"what it holds counts, up to T {time} s.") : "it holds no committed state before that.");
                foreach (string[] call in new string[][] { ["diff", folder["all"], folder["cut"]], ["diff", folder["cut"], folder["all"]], ["replay", folder["cut"]] })
                {
                    Tool text = Tool.Run(call), json = Tool.Run([.. call, "--json"]);
                    Assert.Equal((exit, exit), (text.ExitCode, json.ExitCode));
                    Assert.Equal((told, told), (LastLine(text), LastLine(json)));
                    Assert.Contains(isAtEnd ? " has no end record: its writer was ended or still writes, or the file is cut; it holds " : " is damaged at byte ", text.Output, StringComparison.Ordinal);
                    using JsonDocument document = JsonDocument.Parse(json.Output);
                    JsonElement root = document.RootElement;
                    JsonElement cut = call[0] == "replay" ? root.GetProperty("recording") : root.GetProperty("recordings")[call[1] == folder["all"] ? 1 : 0];
                    Assert.Equal((false, false), (root.GetProperty("whole").GetBoolean(), cut.GetProperty("whole").GetBoolean()));
                    Assert.Equal((until, until), (Number(root.GetProperty("agreed_up_to_s")), Number(cut.GetProperty("holds_up_to_s"))));
                    Assert.Equal(isAtEnd ? null : at[record], Number(cut.GetProperty("damaged_at_byte")));
                    Assert.Equal((null, committed), (cut.GetProperty("end_reason").GetString(), cut.GetProperty("states").GetInt32()));
                }
            }
        }

        // The control: nothing of it where nothing is missing.
        foreach (string[] call in new string[][] { ["diff", folder["all"], folder["all"]], ["replay", folder["all"]] })
        {
            Assert.DoesNotContain(folder["all"] + "'", Tool.Run(call).Done().Error, StringComparison.Ordinal);
            using JsonDocument document = JsonDocument.Parse(Tool.Run([.. call, "--json"]).Done().Output);
            Assert.True(document.RootElement.GetProperty("whole").GetBoolean());
            Assert.Equal(2, document.RootElement.GetProperty("agreed_up_to_s").GetDouble());
        }
    }

    [Fact]
    public void DiffAndReplay_OfAnotherFoldVersion_SayBoth()
    {
        using TemporaryFolder folder = new();
        File.WriteAllBytes(folder["ours"], Recorded.Small());
        File.WriteAllBytes(folder["theirs"], Recorded.OfFold(Recorded.Small(), Recorded.OtherFold));
        string theirs = $"of fold version {Recorded.OtherFold}, ";
        Tool.Refuses(
            Input, ["replay", folder["theirs"]], folder["theirs"], theirs,
            $"this library computes fold version {Simulation.FoldVersion}, which gives other hashes.");
        Tool.Refuses(Input, ["replay", folder["theirs"], "--json"], theirs);
        Tool diff = Tool.Run("diff", folder["ours"], folder["theirs"]);
        Assert.Equal(1, diff.ExitCode);
        Assert.StartsWith($"The fold versions differ: {Simulation.FoldVersion} in the first, by the library ", diff.Output, StringComparison.Ordinal);
        using JsonDocument document = JsonDocument.Parse(Tool.Run("diff", folder["ours"], folder["theirs"], "--json").Output);
        Assert.Equal("fold-version-differs", document.RootElement.GetProperty("outcome").GetString());
        Assert.Equal(
            [Simulation.FoldVersion, Recorded.OtherFold],
            document.RootElement.GetProperty("recordings").EnumerateArray().Select(each => each.GetProperty("fold_version").GetInt32()));

        // A file of the version before this one's is refused by its number, as any other.
        byte[] old = Recorded.Small();
        old[8] = RecordingFormat.Version - 1;
        File.WriteAllBytes(folder["old"], old);
        string says = $"The recording is of version {RecordingFormat.Version - 1}; this library reads version {RecordingFormat.Version}.";
        Tool.Refuses(Input, ["replay", folder["old"]], says);
        Tool.Refuses(Input, ["diff", folder["ours"], folder["old"]], says);
    }

    /// <summary>Of stderr; a replay has its progress before it.</summary>
    private static string LastLine(Tool tool) => tool.Error.TrimEnd().Split('\n')[^1].TrimEnd();

    private static double? Number(JsonElement value) => value.ValueKind == JsonValueKind.Null ? null : value.GetDouble();

    [Theory]
    [InlineData("host")]
    [InlineData("join")]
    public void Help_OfASession_HasTheSyntaxOfWhatAPlayerDoes(string command) =>
        Assert.Contains(ScriptedAction.Syntax, Tool.Run(command, "--help").Done().OutputOnOneLine, StringComparison.Ordinal);

    [Theory]
    [InlineData(SessionEnd.Left, true, 0, 0, false, false, ExitCode.Done)]
    [InlineData(SessionEnd.Left, false, 0, 0, false, true, ExitCode.Interrupted)]
    [InlineData(SessionEnd.Left, true, 0, 0, true, false, ExitCode.Input)]
    [InlineData(SessionEnd.Left, true, 1, 0, true, true, ExitCode.CheckFailed)]
    [InlineData(SessionEnd.HostEnded, true, 0, 0, false, false, ExitCode.Done)]
    [InlineData(SessionEnd.HostEnded, false, 0, 0, false, false, ExitCode.Input)]
    [InlineData(SessionEnd.HostEnded, true, 2, 0, false, false, ExitCode.CheckFailed)]
    [InlineData(SessionEnd.HostSilent, true, 0, 0, false, false, ExitCode.Input)]
    [InlineData(SessionEnd.HostSilent, true, 1, 0, false, false, ExitCode.CheckFailed)]
    [InlineData(SessionEnd.Refused, true, 0, 0, false, false, ExitCode.Input)]
    [InlineData(SessionEnd.Disconnected, true, 0, 0, false, false, ExitCode.Input)]
    [InlineData(SessionEnd.Failed, true, 0, 0, false, false, ExitCode.Input)]
    [InlineData(SessionEnd.Left, true, 0, 1, false, false, ExitCode.CheckFailed)]
    [InlineData(SessionEnd.HostSilent, true, 0, 1, true, true, ExitCode.CheckFailed)]
    public void ExitCodeOf_EveryEnd_IsTheDocumentedOne(SessionEnd by, bool isTimeReached, long differed, long lost, bool hasFailedAction, bool isInterrupted, int expected) =>
        Assert.Equal(expected, SessionRunner.ExitCodeOf(by, isTimeReached, differed, lost, hasFailedAction, isInterrupted));
}
