using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Net;
using System.Net.Sockets;
using System.Text.Json;
using System.Threading;
using LagSim.Harness.SceneFiles;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>Host, join and relay over real sockets, in this process: that they work, not how fast.</summary>
[Collection(RealTime.Name)]
[Trait("Time", "real")]
public sealed class SessionCommandTests
{
    private const string Host = "host --scene drop --history-s 0.5 --joiners 1";

    [Fact]
    public void HostAndJoin_AsText_PrintTheSameStatesAtTheSameTimesAndASummary()
    {
        using TemporaryFolder folder = new();
        using LiveTool host = LiveTool.Run(Host + " --for-s 2 --do set-velocity@0.5:2,9,0 --record", folder["host.lagsim"]);
        string address = host.Address;
        Assert.StartsWith("127.0.0.1:", address, StringComparison.Ordinal);
        using LiveTool client = LiveTool.Run($"join {address} --for-s 2 --do teleport@1.2:ball:0,12,0 --do remove@1.4 --record", folder["join.lagsim"]);
        client.Ends(0);
        host.Ends(0);

        Dictionary<string, string> states = LineWriter.States(host.Output.Lines);
        Assert.Equal(["1", "2"], states.Keys);
        Assert.All(states.Values, state => Assert.Matches("^state [0-9a-f]{16} events [0-9a-f]{16}$", state));
        Assert.Equal(states, LineWriter.States(client.Output.Lines));
        Assert.Equal(2, client.Output.Lines.Count(line => line.StartsWith("clock offset ", StringComparison.Ordinal)));
        Assert.Matches("\nclock offset -?[0-9.]+ ms bound [0-9.]+ ms delay [0-9.]+ ms\n", client.Output.ToString());
        Assert.DoesNotContain(host.Output.Lines, line => line.StartsWith("clock ", StringComparison.Ordinal));
        Assert.Contains("events: 3 accepted, 0 refused; heals: ", host.Output.ToString(), StringComparison.Ordinal);
        Assert.Contains($"last committed: 2 s, {states["2"].Replace(" events", ", events", StringComparison.Ordinal)}", client.Output.ToString(), StringComparison.Ordinal);
        Assert.Matches("peer 1 at 127.0.0.1:[0-9]+: [0-9.]+ B/s sent, [0-9.]+ B/s received", host.Output.ToString());
        Assert.Contains("ended: This peer left.", client.Output.ToString(), StringComparison.Ordinal);

        // What each recorded is run again to the same end, and is the same.
        foreach (string name in new[] { "host.lagsim", "join.lagsim" })
        {
            using JsonDocument replay = JsonDocument.Parse(Tool.Run("replay", folder[name], "--json").Done().Output);
            Assert.Contains(replay.RootElement.GetProperty("state_hash").GetString()!, states["2"], StringComparison.Ordinal);
            Assert.Equal((2, 3), (replay.RootElement.GetProperty("committed_s").GetInt32(), replay.RootElement.GetProperty("events_applied").GetInt32()));
        }

        Assert.Contains("3 log entries and 2 committed states", Tool.Run("diff", folder["host.lagsim"], folder["join.lagsim"]).Done().Output, StringComparison.Ordinal);
    }

    /// <summary>With a pass of another host's player, and after all the time that it was to stay for: it says both, and keeps the pass that it got.</summary>
    [Fact]
    public void Join_TooLateAndWithAForeignPass_SaysSo()
    {
        using TemporaryFolder folder = new();
        string foreign = $"1-{new string('0', 31)}7";
        File.WriteAllText(folder["pass"], foreign);
        using LiveTool host = LiveTool.Run("host --scene drop --history-s 0.5 --joiners 0 --for-s 20");
        string address = host.Address;
        host.Output.WaitFor(line => line.StartsWith("T 1 ", StringComparison.Ordinal), LiveTool.Deadline);
        using LiveTool client = LiveTool.Run($"join {address} --for-s 0.5 --pass", folder["pass"]);
        client.Ends(3);
        host.Stop();
        host.Ends(130);
        Assert.Matches("--for-s 0.5 was over when this peer came in at T [0-9.]+ s[.] It counts from the session's start: to stay that long from now on, give --for-s [0-9]+;", client.Error.ToString());
        Assert.Matches("The host does not know the pass of player 1 in '.+'; this is player 1 of its session, whose pass is kept there now; the former one is in '.+pass[.]old'[.]", client.Error.ToString());
        Assert.NotEqual(foreign, File.ReadAllText(folder["pass"]).Trim());
        Assert.Equal(foreign, File.ReadAllText(folder["pass.old"]));
    }

    [Fact]
    public void HostAndJoin_AsJson_PrintOneDocumentAndNothingElse()
    {
        // The host's disk is full, which does not end the session, and is told.
        bool isFull = File.Exists("/dev/full");
        using LiveTool host = LiveTool.Run(Host + " --for-s 1 --json --key secret --seed 7" + (isFull ? " --record /dev/full" : ""));
        string? listening = host.Error.WaitFor(line => line.StartsWith("listening on ", StringComparison.Ordinal), LiveTool.Deadline);
        using LiveTool client = LiveTool.Run($"join {listening!.Split(' ')[2]} --for-s 1 --json --key secret");
        client.Ends(0);
        host.Ends(isFull ? 3 : 0);
        using JsonDocument one = JsonDocument.Parse(host.Output.ToString()), two = JsonDocument.Parse(client.Output.ToString());
        foreach (JsonDocument document in new[] { one, two })
        {
            Assert.Equal(
                ["tool", "version", "command", "seed", "scene", "scene_hash", "state_hash", "peer"],
                document.RootElement.EnumerateObject().Take(8).Select(property => property.Name));
            Assert.Equal(("drop", 1), (document.RootElement.GetProperty("scene").GetString(), document.RootElement.GetProperty("committed_s").GetInt32()));
            Assert.Equal("left", document.RootElement.GetProperty("ended_by").GetString());
        }

        Assert.Equal(one.RootElement.GetProperty("states").GetRawText(), two.RootElement.GetProperty("states").GetRawText());
        Assert.Equal(one.RootElement.GetProperty("state_hash").GetString(), two.RootElement.GetProperty("states")[0].GetProperty("state_hash").GetString());
        Assert.Equal(7, one.RootElement.GetProperty("seed").GetInt32());
        Assert.Equal("0", two.RootElement.GetProperty("links")[0].GetProperty("peer").GetRawText());
        Assert.True(two.RootElement.GetProperty("clock_bound_ms").GetDouble() > 0);
        Assert.Equal(JsonValueKind.Null, one.RootElement.GetProperty("clock_bound_ms").ValueKind);
        Assert.Equal(isFull, one.RootElement.GetProperty("recording_failure").GetString() is not null);
        Assert.Equal(isFull, host.Error.ToString().Contains("The recording ends here: ", StringComparison.Ordinal));
    }

    [Fact]
    public void Host_ThatIsStopped_EndsTheSessionForAllWhichIsAnErrorBeforeAClientsTime()
    {
        bool isSix = CanBind(IPAddress.IPv6Loopback);
        using LiveTool host = LiveTool.Run(Host + (isSix ? " --address ::1" : ""));
        Assert.StartsWith(isSix ? "[::1]:" : "127.0.0.1:", host.Address, StringComparison.Ordinal);
        using LiveTool timed = LiveTool.Run($"join {host.Address} --for-s 100");
        using LiveTool client = LiveTool.Run($"join {host.Address}");
        Assert.NotNull(client.Output.WaitFor(line => line.StartsWith("T 1 s ", StringComparison.Ordinal), LiveTool.Deadline));
        host.Stop();
        host.Ends(130);
        timed.Ends(3);
        client.Ends(0);
        Assert.Contains($"The host at {host.Address} ended the session.", timed.Error.ToString(), StringComparison.Ordinal);
        Assert.Contains($"ended: The host at {host.Address} ended the session.", client.Output.ToString(), StringComparison.Ordinal);
        Assert.Contains("ended: This peer left.", host.Output.ToString(), StringComparison.Ordinal);
    }

    [Fact]
    public void Join_HostOfAnotherVersion_IsAnErrorThatNamesBoth()
    {
        using UdpPort other = new(new IPEndPoint(IPAddress.Loopback, 0));
        byte[] buffer = new byte[IDatagramPort.MaxDatagramBytes];
        other.Arrived += () =>
        {
            if (other.TryReceive(buffer, out int length, out PeerAddress from) && ConnectRequestDatagram.TryDecode(buffer.AsSpan(0, length), out ConnectRequestDatagram request, out _))
            {
                byte[] answer = new byte[WireFormat.RefusalBytes];
                new RefusalDatagram(request.Nonce, RefusalReason.VersionDiffers).Encode(answer);
                answer[2] = 77;
                other.Send(answer, from);
            }
        };
        Tool.Refuses(3, ["join", other.LocalAddress.ToString(), "--unprotected"], $"The host at {other.LocalAddress} refused: it speaks version 77 of the protocol, this peer {WireFormat.Version}.");
    }

    [Fact]
    public void Join_NobodyThere_IsAnErrorAfterTheTimeout()
    {
        using UdpPort silent = new(new IPEndPoint(IPAddress.Loopback, 0));
        Tool.Refuses(3, ["join", silent.LocalAddress.ToString(), "--timeout-s", "0.5", "--json"], $"No answer from the host at {silent.LocalAddress} within 0.5 s.");
    }

    /// <summary>Over a WebSocket the last line has the address, and why there is no connection.</summary>
    [Fact]
    public void Join_NobodyThereOverAWebSocket_NamesAddressAndReason()
    {
        using Socket closed = new(AddressFamily.InterNetwork, SocketType.Stream, ProtocolType.Tcp);
        closed.Bind(new IPEndPoint(IPAddress.Loopback, 0)); // and does not listen
        string place = $"ws://127.0.0.1:{((IPEndPoint)closed.LocalEndPoint!).Port}";
        Tool tool = Tool.Run("join", place, "--timeout-s", "0.6");
        Assert.Equal(3, tool.ExitCode);
        Assert.Matches($"^No answer from the host at {place} within 0.6 s[.] .{{10,}}[.]$", tool.Error.TrimEnd().Split('\n')[^1].TrimEnd());
    }

    /// <summary>A pass that cannot be kept is told, the session goes on, and the exit code says so. The control: where it can, all is well.</summary>
    [Theory]
    [InlineData(true, 3)]
    [InlineData(false, 0)]
    public void Pass_ThatCannotBeKept_EndsWithThatExitCode(bool isBlocked, int code)
    {
        using TemporaryFolder folder = new();
        int port;
        using (UdpPort free = new(new IPEndPoint(IPAddress.Loopback, 0)))
        {
            port = free.LocalAddress.ToEndPoint().Port;
        }

        using LiveTool client = LiveTool.Run($"join 127.0.0.1:{port} --timeout-s 30 --pass", folder["pass"]);
        Assert.NotNull(client.Error.WaitFor(line => line.StartsWith("No host answers", StringComparison.Ordinal), LiveTool.Deadline));
        if (isBlocked)
        {
            Directory.CreateDirectory($"{folder["pass"]}.{Environment.ProcessId}.new"); // in the place of what is written first
        }

        using LiveTool host = LiveTool.Run($"host --scene drop --history-s 0.2 --timeout-s 30 --port {port}");
        Assert.NotNull(client.Output.WaitFor(line => line.StartsWith("here: ", StringComparison.Ordinal), LiveTool.Deadline));
        host.Stop();
        client.Ends(code);
        Assert.Equal(isBlocked, client.Error.ToString().Contains("The player's pass was not kept: ", StringComparison.Ordinal));
        Assert.Equal(isBlocked, !File.Exists(folder["pass"]));
    }

    /// <summary>Host and client say for whom a session waits that does not begin.</summary>
    [Fact]
    public void Session_ThatWaitsForPlayers_SaysForHowMany()
    {
        using LiveTool host = LiveTool.Run("host --scene drop --joiners 2 --for-s 60");
        string address = host.Address;
        Assert.NotNull(host.Error.WaitFor(line => line == "0 of the 2 players that this host waits for are in.", LiveTool.Deadline));
        using LiveTool client = LiveTool.Run($"join {address}");
        Assert.NotNull(host.Error.WaitFor(line => line == "1 of the 2 players that this host waits for are in.", LiveTool.Deadline));
        Assert.NotNull(client.Error.WaitFor(line => line == $"This peer is in. The host at {address} has not begun the session: it waits for other players.", LiveTool.Deadline));
        client.Stop();
        host.Stop();
    }

    [Theory]
    [InlineData(true, "2.4")]
    [InlineData(false, "1.8")] // the control: without a pass the time-out is all there is
    public void Join_NobodyThere_SaysAtOnceForHowLongItAsksAndNamesThatTimeAtTheEnd(bool hasPass, string seconds)
    {
        using TemporaryFolder folder = new();
        File.WriteAllText(folder["pass"], $"1-{new string('0', 31)}7");
        using UdpPort silent = new(new IPEndPoint(IPAddress.Loopback, 0));
        string[] pass = hasPass ? ["--pass", folder["pass"]] : [];
        Tool tool = Tool.Run(["join", $"{silent.LocalAddress}", "--timeout-s", "1.8", "--rejoin-s", "2.4", .. pass]);
        Assert.Equal(3, tool.ExitCode);
        Assert.Equal(
            [$"No host answers at {silent.LocalAddress} yet; asking for up to {seconds} s. Ctrl-C ends it.", $"No answer from the host at {silent.LocalAddress} within {seconds} s."],
            tool.Error.Split(Environment.NewLine, StringSplitOptions.RemoveEmptyEntries));
    }

    [Fact]
    public void ScriptedAction_WhoseVerdictAFreshCopyOvertook_IsToldOnceAndNotMistakenForALaterOne()
    {
        // What is done while nothing gets through is never heard of, and the next action after it bears the same number.
        using CutPort port = new(new UdpPort(new IPEndPoint(IPAddress.Loopback, 0)));
        HostOptions options = new() { Window = new(SimDuration.FromSeconds(0.2)), KeepAlive = SimDuration.FromSeconds(0.3), Timeout = SimDuration.FromSeconds(2) };
        HostSession session = new(BuiltInScenes.Drop(), port, new StopwatchClock(), options, 5);
        using ManualResetEventSlim gone = new();
        session.ClientGone += _ => gone.Set();
        using PeerThread host = new(session, port, "host");
        host.Start();
        using LiveTool client = LiveTool.Run($"join {port.LocalAddress} --unprotected --timeout-s 2 --for-s 9 --do set-velocity@2:1,3,0 --do set-velocity@8:0,3,0");
        Assert.NotNull(client.Output.WaitFor(line => line.StartsWith("T 1 s ", StringComparison.Ordinal), LiveTool.Deadline));
        port.IsCut = true;
        Assert.NotNull(client.Error.WaitFor(line => line.EndsWith("Asking to be let in again.", StringComparison.Ordinal), LiveTool.Deadline));
        Assert.True(gone.Wait(LiveTool.Deadline, TestContext.Current.CancellationToken));
        port.IsCut = false;
        client.Ends(3);
        Assert.Equal(
            ["Done here, but a fresh copy took the place of the world before the host's verdict came: --do set-velocity@2:1,3,0."],
            client.Error.Lines.Where(line => line.Contains("--do", StringComparison.Ordinal)));
        Assert.Contains("events: 1 accepted, 0 refused", client.Output.ToString(), StringComparison.Ordinal);
        Assert.Contains("events unanswered 1", client.Output.ToString(), StringComparison.Ordinal);
    }

    [Fact]
    public void ScriptedActions_ThatMayNotBeDone_AreToldAndAnError()
    {
        using TemporaryFolder folder = new();
        File.WriteAllText(
            folder["mine.json"],
            """
            {"format": "lagsim-scene-1", "name": "mine", "planes": [{"name": "floor", "normal": [0, 1, 0], "offset_m": 0}], "bodies": [
              {"name": "hers", "radius_m": 0.5, "mass_kg": 1, "restitution": 0.8, "position_m": [0, 10, 0], "players": [1]},
              {"name": "his", "radius_m": 0.5, "mass_kg": 1, "restitution": 0.8, "position_m": [4, 10, 0], "players": [0]}]}
            """);
        using LiveTool host = LiveTool.Run(
            "host --history-s 0.5 --joiners 1 --for-s 1 --do impulse@0.2:hers:0,1,0 --do impulse@0.3:his:0,1,0 --do teleport@0.4:his:0,2e12,0 --scene", folder["mine.json"]);
        using LiveTool client = LiveTool.Run($"join {host.Address} --for-s 1 --do impulse@0.2:hers:0,1,0");
        Assert.NotNull(client.Error.WaitFor(line => line.StartsWith("in as a peer ", StringComparison.Ordinal), LiveTool.Deadline));
        using LiveTool wrong = LiveTool.Run($"join {host.Address} --for-s 1 --do remove@0.2:theirs");
        client.Ends(0);
        host.Ends(3);
        wrong.Ends(2);
        Assert.Contains("--do impulse@0.2:hers:0,1,0 was not done. Peer 0 may not touch body 'hers'; those who may: 1.", host.Error.ToString(), StringComparison.Ordinal);
        Assert.Contains("--do teleport@0.4:his:0,2e12,0 was not done. The position of the Teleport of body 0.0.1", host.Error.ToString(), StringComparison.Ordinal);
        Assert.Contains("events: 2 accepted", client.Output.ToString(), StringComparison.Ordinal);
        Assert.Contains("scene 'mine' has no body 'theirs'; it has hers, his.", wrong.Error.ToString(), StringComparison.Ordinal);
    }

    [Fact]
    public void ScriptedAction_ThatTheHostRefuses_IsToldAndAnError()
    {
        // An event that is 200 ms old, to a host that takes what is 100 ms old, and waits for nothing older.
        using LiveTool host = LiveTool.Run("host --scene drop --history-s 0.1 --longest-history-s 0.1 --joiners 1");
        using LiveTool relay = LiveTool.Run($"relay {host.Address} --profile delay-200ms");
        using LiveTool client = LiveTool.Run($"join {relay.Address} --for-s 1.9 --do set-velocity@1.8:2,9,0 --do teleport@1.85:0,12,0");
        client.Ends(3);
        Assert.DoesNotContain("set-velocity@1.8", client.Error.ToString(), StringComparison.Ordinal); // happened later, when it came
        Assert.Contains("The host refused --do teleport@1.85:0,12,0: it came too late, ", client.Error.ToString(), StringComparison.Ordinal);
        Assert.Contains("events: 1 accepted, 1 refused", client.Output.ToString(), StringComparison.Ordinal);
    }

    [Fact]
    public void ScriptedActions_AfterTheHostsEndOrBeforeThePeerCameIn_AreNamedAndAnError()
    {
        using LiveTool host = LiveTool.Run("host --scene drop --history-s 0.2 --for-s 3");
        Assert.NotNull(host.Output.WaitFor(line => line.StartsWith("T 1 s ", StringComparison.Ordinal), LiveTool.Deadline));
        using LiveTool early = LiveTool.Run($"join {host.Address} --do remove@0.2 --do impulse@0.1:0,1,0");
        using LiveTool late = LiveTool.Run($"join {host.Address} --do teleport@30:0,15,0 --do remove@31");
        using LiveTool idle = LiveTool.Run($"join {host.Address}");
        host.Ends(0);
        early.Ends(3);
        late.Ends(3);
        idle.Ends(0); // without an action the host's orderly end is nobody's error
        Assert.Matches(
            @"Not done, for the time was past when this peer came in at T [0-9.]+ s: --do impulse@0\.1:0,1,0, --do remove@0\.2\.\r?\n", early.Error.ToString());
        Assert.Contains("Not done, for the session ended before: --do teleport@30:0,15,0, --do remove@31.", late.Error.ToString(), StringComparison.Ordinal);
        Assert.DoesNotContain("Not done", idle.Error.ToString(), StringComparison.Ordinal);
        Assert.Contains("events: 0 accepted, 0 refused", host.Output.ToString(), StringComparison.Ordinal);
    }

    [Fact]
    public void Host_ClientThatIsGoneAtOnce_IsToldOfNevertheless()
    {
        using LiveTool host = LiveTool.Run("host --scene drop --unprotected");
        using UdpPort port = new(new IPEndPoint(IPAddress.Loopback, 0));
        ClientSession brief = new(null, port, new StopwatchClock(), new ClientOptions(), PeerAddress.From(IPEndPoint.Parse(host.Address)), 9);
        Assert.True(SpinWait.SpinUntil(
            () =>
            {
                brief.Step();
                return brief.Peer > 0;
            },
            LiveTool.Deadline));
        brief.Leave();
        Assert.NotNull(host.Error.WaitFor(line => line == $"peer 1 at {port.LocalAddress} is gone", LiveTool.Deadline));
        Assert.Contains($"peer 1 at {port.LocalAddress} came\n", host.Error.ToString(), StringComparison.Ordinal);
        host.Stop();
        host.Ends(130);
    }

    [Fact]
    public void Relay_ForATime_PassesDatagramsOnAndCounts()
    {
        using UdpPort host = new(new IPEndPoint(IPAddress.Loopback, 0)), client = new(new IPEndPoint(IPAddress.Loopback, 0));
        using ManualResetEventSlim arrived = new();
        host.Arrived += arrived.Set;
        using LiveTool relay = LiveTool.Run($"relay {host.LocalAddress} --profile delay-10ms --json");
        string? listening = relay.Error.WaitFor(line => line.StartsWith("listening on ", StringComparison.Ordinal), LiveTool.Deadline);
        client.Send([1, 2, 3], PeerAddress.From(IPEndPoint.Parse(listening!.Split(' ')[2])));
        Assert.True(arrived.Wait(LiveTool.Deadline, TestContext.Current.CancellationToken));
        relay.Stop();
        relay.Ends(130);
        using JsonDocument document = JsonDocument.Parse(relay.Output.ToString());
        Assert.Equal(("relay", "delay-10ms", 1, 1), (
            document.RootElement.GetProperty("command").GetString(), document.RootElement.GetProperty("profile").GetString(),
            document.RootElement.GetProperty("clients").GetInt32(), document.RootElement.GetProperty("forwarded_to_host").GetInt32()));

        using LiveTool brief = LiveTool.Run($"relay {host.LocalAddress} --profile awful --for-s 0.1").Ends(0);
        Assert.StartsWith("listening on 127.0.0.1:", brief.Output.ToString(), StringComparison.Ordinal);
        Assert.Contains("awful, 0 clients; to the host 0 datagrams, 0 lost", brief.Output.ToString(), StringComparison.Ordinal);
        Assert.DoesNotContain("port change", brief.Output.ToString(), StringComparison.Ordinal); // none was asked for
        Tool.Refuses(3, ["relay", "0.0.0.0:7", "--profile", "lan"], "'0.0.0.0:7' is no host to relay to");
    }

    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Relay_ThatChangesPorts_CountsTheChanges(bool isJson)
    {
        using UdpPort host = new(new IPEndPoint(IPAddress.Loopback, 0)), client = new(new IPEndPoint(IPAddress.Loopback, 0));
        using LiveTool relay = LiveTool.Run($"relay {host.LocalAddress} --profile loopback --change-port-s 0.5 --for-s 2{(isJson ? " --json" : "")}");
        LineWriter said = isJson ? relay.Error : relay.Output;
        string? listening = said.WaitFor(line => line.StartsWith("listening on ", StringComparison.Ordinal), LiveTool.Deadline);
        client.Send([1, 2, 3], PeerAddress.From(IPEndPoint.Parse(listening!.Split(' ')[2])));
        relay.Ends(0);
        if (isJson)
        {
            using JsonDocument document = JsonDocument.Parse(relay.Output.ToString());
            Assert.InRange(document.RootElement.GetProperty("port_changes").GetInt64(), 1, 4);
        }
        else
        {
            Assert.Matches("; 0 refused; (1 port change|[2-4] port changes)\r?\n", relay.Output.ToString());
        }
    }

    private static bool CanBind(IPAddress address)
    {
        try
        {
            using Socket socket = new(address.AddressFamily, SocketType.Dgram, ProtocolType.Udp);
            socket.Bind(new IPEndPoint(address, 0));
            return true;
        }
        catch (SocketException)
        {
            return false;
        }
    }

    /// <summary>A port through which nothing goes while it is cut.</summary>
    private sealed class CutPort(UdpPort inner) : IDatagramPort
    {
        private volatile bool isCut;

        public event Action? Arrived
        {
            add => inner.Arrived += value;
            remove => inner.Arrived -= value;
        }

        public PeerAddress LocalAddress => inner.LocalAddress;

        internal bool IsCut
        {
            get => isCut;
            set => isCut = value;
        }

        public void Send(ReadOnlySpan<byte> datagram, PeerAddress to)
        {
            if (!isCut)
            {
                inner.Send(datagram, to);
            }
        }

        public bool TryReceive(Span<byte> buffer, out int length, out PeerAddress from)
        {
            while (inner.TryReceive(buffer, out length, out from))
            {
                if (!isCut)
                {
                    return true;
                }
            }

            return false;
        }

        public void Dispose() => inner.Dispose();
    }
}
