using System;
using System.Linq;
using System.Text.Json;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>Real processes: each says who is there, spectators take no player's place, and sixteen play.</summary>
[Collection(RealTime.Name)]
[Trait("Time", "real")]
public sealed class RosterProcessTests
{
    [Fact]
    public void Processes_WithNamesAndRoles_SayWhoIsThereUntilTheyGo()
    {
        using ToolProcess host = ToolProcess.Start("host --scene pair --name Hedy --joiners 2 --history-s 0.2 --timeout-s 2");
        using ToolProcess watcher = ToolProcess.Start($"join {host.Address} --name Sue --as spectator --timeout-s 2");
        Assert.NotNull(host.Error.WaitFor(line => line.StartsWith("peer 17 ", StringComparison.Ordinal), LiveTool.Deadline));
        using ToolProcess first = ToolProcess.Start($"join {host.Address} --name Ann --timeout-s 2");
        Assert.NotNull(host.Error.WaitFor(line => line.StartsWith("peer 1 ", StringComparison.Ordinal), LiveTool.Deadline));
        using ToolProcess second = ToolProcess.Start($"join {host.Address} --name Bo --as bot --timeout-s 2");
        ToolProcess[] all = [host, watcher, first, second];
        Assert.All(all, one => one.Says("here: 0 player Hedy, 1 player Ann, 2 bot Bo, 17 spectator Sue"));
        second.KillAtOnce();
        Assert.All(all.SkipLast(1), one => one.Says("here: 0 player Hedy, 1 player Ann, 17 spectator Sue"));
        Assert.All(all.SkipLast(1), one => one.Says("T 3 s "));
        Assert.Single(all.SkipLast(1).Select(one => one.Output.Lines.First(line => line.StartsWith("T 3 s ", StringComparison.Ordinal))).Distinct());
    }

    [Fact]
    public void Processes_ThatMayNotBe_AreRefusedWithASentence()
    {
        using ToolProcess acts = ToolProcess.Start("join 127.0.0.1:1 --as spectator --do impulse@1:0,1,0");
        using ToolProcess named = ToolProcess.Start($"join 127.0.0.1:1 --name {new string('x', 65)}");
        using ToolProcess unknown = ToolProcess.Start("join 127.0.0.1:1 --as referee");
        acts.Ends(2);
        named.Ends(2);
        unknown.Ends(2);
        Assert.Contains("a spectator does nothing", acts.Error.ToString(), StringComparison.Ordinal);
        Assert.Contains("has 65 bytes of UTF-8; at most 64 are allowed", named.Error.ToString(), StringComparison.Ordinal);
        Assert.Contains("--as is 'referee'; it must be one of player, spectator, bot.", unknown.Error.ToString(), StringComparison.Ordinal);
    }

    /// <summary>What is said at 3.5 s of an action given too far ahead comes after what was final at 2 s, or before, with a history of 4 s.</summary>
    [Theory]
    [InlineData(" --confirm-early", true)]
    [InlineData("", false)]
    public void Processes_WithALongHistory_CommitEarlyIfTheyMay(string early, bool isEarly)
    {
        using ToolProcess host = ToolProcess.Start($"host --scene pair --joiners 1 --history-s 4 --do impulse@3.5..9:0,1,0{early}");
        using ToolProcess client = ToolProcess.Start($"join {host.Address} --do impulse@3.5..9:0,1,0");
        Assert.All(new[] { host, client }, one =>
        {
            Assert.NotNull(one.Error.WaitFor(line => line.Contains("impulse@3.5..9:0,1,0 was not done", StringComparison.Ordinal), LiveTool.Deadline));
            bool isFinal = one.Output.Lines.Any(line => line.StartsWith("T 2 s ", StringComparison.Ordinal));
            Assert.True(isFinal == isEarly || (one == client && !isEarly), $"{one}"); // a client that comes in late says it late
            one.Says("T 4 s ");
        });
        Assert.Single(new[] { host, client }.Select(one => one.Output.Lines.First(line => line.StartsWith("T 4 s ", StringComparison.Ordinal))).Distinct());
    }

    [Fact]
    public void SixteenPlayersAndASpectator_AsProcesses_Agree()
    {
        const int players = 16;
        ToolProcess host = ToolProcess.Start(
            $"host --scene billiards --name Hedy --joiners {players} --per-address {players} --history-s 1.5 --for-s 3 --json");
        string first = host.Error.WaitFor(line => line.StartsWith("listening on ", StringComparison.Ordinal), LiveTool.Deadline)!;
        string address = first["listening on ".Length..];
        ToolProcess[] all =
        [
            host,
            ToolProcess.Start($"join {address} --as spectator --for-s 3 --json"),
            .. Enumerable.Range(1, players).Select(n => ToolProcess.Start(
                $"join {address} --name p{n} --as bot --for-s 3 --do impulse@1.{n:00}:0.1,0,0.{n} --json")),
        ];
        try
        {
            Assert.All(all, process => process.Ends(0));
            JsonElement[] said = [.. all.Select(process => JsonDocument.Parse(process.Output.ToString()).RootElement)];
            Assert.Single(said.Select(one => one.GetProperty("state_hash").GetString()).Distinct());
            Assert.All(said, one => Assert.Equal(players, one.GetProperty("events_accepted").GetInt32()));
            Assert.Equal(
                Enumerable.Range(0, players + 1).Append(17), said.Select(one => one.GetProperty("peer").GetInt32()).Order());
            Assert.Equal("spectator", said[1].GetProperty("role").GetString());
        }
        finally
        {
            Array.ForEach(all, process => process.Dispose());
        }
    }
}
