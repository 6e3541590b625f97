using System;
using System.Globalization;
using System.Linq;
using System.Net;
using System.Text.Json;
using LagSim.Net.Sessions;
using LagSim.Rules;
using LagSim.Scenes;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>Real processes play the built-in scene with rules: the state of the rules is the same in all of them.</summary>
[Collection(RealTime.Name)]
[Trait("Time", "real")]
public sealed class RuleProcessTests
{
    [Fact]
    public void Commands_OfProcesses_CountOnceAndAtTheirInstantOnAllAndALaterJoiner()
    {
        using ToolProcess host = ToolProcess.Start("host --scene goals --joiners 2 --do command@1.2:1");
        using ToolProcess first = ToolProcess.Start($"join {host.Address} --do command@1.5:1 --do command@1.7:9,hello");
        using ToolProcess second = ToolProcess.Start($"join {host.Address} --do command@1.5:1 --do command@1.6..2:2,0x01");
        first.Says("rules goals 1: ");
        using ToolProcess late = ToolProcess.Start($"join {host.Address}");
        late.Says("rules goals 1: ");
        string since = late.Output.Lines.First(line => line.StartsWith("T ", StringComparison.Ordinal)).Split(' ')[1];
        int common = Math.Max(3, int.Parse(since, CultureInfo.InvariantCulture)); // after all that was done
        ToolProcess[] all = [host, first, second, late];
        string[] said = [.. all.Select(one => StateAt(one, common))];
        Assert.Single(said.Distinct());
        Assert.Contains(" cheers 3, kicks 1, ignored 1, ", said[0], StringComparison.Ordinal);
        Assert.EndsWith(", last_command_s 2", said[0], StringComparison.Ordinal); // to the tick for which it was scheduled
        Assert.DoesNotContain(": left 0, right 0,", said[0], StringComparison.Ordinal); // there is something to agree on
        Assert.NotEqual(said[0], StateAt(host, 1)); // the control
    }

    [Fact]
    public void Spawns_OfProcesses_BelongToWhomTheySayAndYieldInsideTheFold()
    {
        const int seconds = 3;
        using ToolProcess host = Host("--joiners 2", seconds);
        using ToolProcess owner = Join(host, "--do spawn@1..1.4:0,2,0/players=me --do impulse@2:1.1.0:0,0.1,0", seconds);
        Assert.NotNull(host.Error.WaitFor(line => line.StartsWith("peer 1 ", StringComparison.Ordinal), LiveTool.Deadline));
        using ToolProcess other = Join(
            host,
            "--do spawn@1..1.4:0,2,0/skip --do spawn@1.1..1.4:0,2,0/beside --do spawn@1.2..1.4:0,2,0 --do impulse@2:1.1.0:0,9,0 --do command@2.1..2.9:1",
            seconds);
        JsonElement[] said = Ended([host, owner, other], (other, 3));
        Assert.Contains("--do impulse@2:1.1.0:0,9,0 was not done. Peer 2 may not touch the spawned body 1.1.0", other.Error.ToString());
        Assert.Contains("--do command@2.1..2.9:1 was not done. An action can be done from now", other.Error.ToString());
        Assert.Single(said.Select(one => one.GetProperty("spawned").GetRawText()).Distinct());
        string[] spawned = [.. said[0].GetProperty("spawned").EnumerateArray().Select(one => one.GetProperty("body").GetString()!)];
        Assert.Contains("1.1.0", spawned);
        Assert.DoesNotContain("2.1.0", spawned); // the place was taken, by an event of that very tick
        Assert.Contains("2.2.0", spawned); // beside it
        Assert.Contains("2.3.0", spawned); // the control: one that overlaps is put there all the same
        Assert.All(said, one => Assert.Equal(5, one.GetProperty("events_accepted").GetInt32()));
    }

    [Fact]
    public void Join_SceneWithRulesThatTheToolHasNot_IsRefusedWithASentence()
    {
        foreach ((GameRules rules, string says) in new (GameRules, string)[]
        {
            (new Other("goals", 2), "The scene needs the rules 'goals' of version 2; here they are of version 1."),
            (new Other("chess", 1), "The scene needs the rules 'chess' of version 1, which this peer was not given (ClientOptions.Rules, or for a recording the rules of Recording.Read)."),
        })
        {
            using PeerThread host = PeerThread.Host(new SceneBuilder("board").WithRules(rules).Build(), bind: IPAddress.Loopback);
            using ToolProcess client = ToolProcess.Start($"join 127.0.0.1:{host.LocalAddress.ToEndPoint().Port} --unprotected --for-s 2");
            client.Ends(3);
            Assert.Contains(says, client.Error.ToString(), StringComparison.Ordinal);
        }
    }

    /// <summary>What a peer says of a committed state: its hashes, and the state of the rules.</summary>
    private static string StateAt(ToolProcess process, int seconds)
    {
        process.Says($"T {seconds + 1} s "); // until then all was said
        string[] lines = [.. process.Output.Lines.SkipWhile(line => !line.StartsWith($"T {seconds} s ", StringComparison.Ordinal))];
        return $"{lines[0]}\n{lines.First(line => line.StartsWith("rules goals 1: ", StringComparison.Ordinal))}";
    }

    private static ToolProcess Host(string more, int seconds) => ToolProcess.Start($"host --scene goals --for-s {seconds} --json {more}");

    private static ToolProcess Join(ToolProcess host, string more, int seconds)
    {
        string first = host.Error.WaitFor(line => line.StartsWith("listening on ", StringComparison.Ordinal), LiveTool.Deadline)!;
        return ToolProcess.Start(string.Create(CultureInfo.InvariantCulture, $"join {first["listening on ".Length..]} --for-s {seconds} --json {more}").TrimEnd());
    }

    private static JsonElement[] Ended(params ToolProcess[] all) => Ended(all, default);

    private static JsonElement[] Ended(ToolProcess[] all, (ToolProcess? Process, int Code) unlike)
    {
        Assert.All(all, one => one.Ends(one == unlike.Process ? unlike.Code : 0));
        JsonElement[] said = [.. all.Select(process => JsonDocument.Parse(process.Output.ToString()).RootElement)];
        Assert.Single(said.Select(one => one.GetProperty("state_hash").GetString()).Distinct());
        Assert.All(said, one => Assert.Equal(0, one.GetProperty("states_differed").GetInt32()));
        return said;
    }

    private sealed class Other(string name, int version) : GameRules(name, version);
}
