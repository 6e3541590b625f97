using System;
using System.CommandLine;
using System.Diagnostics;
using System.Net;
using System.Text.Json;
using System.Threading;
using LagSim.Cli.Commands;
using LagSim.Net.Carriers;
using LagSim.Testing.Links;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>The link that a relay plays, by name or by figures.</summary>
public sealed class RelayLinkTests
{
    [Fact]
    public void Read_Figures_AreTheLinkBothWays()
    {
        RelayLinkChoice chosen = Read("--delay-ms 40 --jitter-ms 5.5 --loss-percent 20 --rate-kbps 64.5");
        LinkLeg leg = chosen.Link.ToHost;
        Assert.Same(leg, chosen.Link.FromHost);
        Assert.Equal((40, 5.5, 20, 64_500L, 1_000.0), (leg.DelayMilliseconds, leg.JitterMilliseconds, leg.LossPercent, leg.Bottleneck!.RateBitsPerSecond, leg.Bottleneck.QueueMilliseconds));
        Assert.Equal(1.25, leg.MeanBurstLength, 12); // one by one: a loss makes no other likelier
        Assert.Equal("40 ms, jitter 5.5 ms, 20 % lost, 64.5 kbit/s", chosen.Link.Name);

        leg = Read("--loss-percent 100").Link.ToHost;
        Assert.Equal((0, 0, 100, null), (leg.DelayMilliseconds, leg.JitterMilliseconds, leg.LossPercent, leg.Bottleneck));

        // The control: a profile is as it was, and has no figures.
        chosen = Read("--profile awful");
        Assert.Same(LinkProfiles.Awful, chosen.Link);
        Assert.False(chosen.IsByFigures);
        Assert.All(chosen.Figures, figure => Assert.Null(figure.Value));
    }

    [Fact]
    [Trait("Time", "real")]
    public void Relay_ByFigures_DelaysAndSaysWhatItPlayed()
    {
        using UdpPort host = new(new IPEndPoint(IPAddress.Loopback, 0)), client = new(new IPEndPoint(IPAddress.Loopback, 0));
        using ManualResetEventSlim arrived = new();
        host.Arrived += arrived.Set;
        using LiveTool relay = LiveTool.Run($"relay {host.LocalAddress} --delay-ms 30 --rate-kbps 1000 --json");
        string? listening = relay.Error.WaitFor(line => line.StartsWith("listening on ", StringComparison.Ordinal), LiveTool.Deadline);
        Stopwatch sent = Stopwatch.StartNew();
        client.Send([1, 2, 3], PeerAddress.From(IPEndPoint.Parse(listening!.Split(' ')[2])));
        Assert.True(arrived.Wait(LiveTool.Deadline, TestContext.Current.CancellationToken));
        Assert.True(sent.Elapsed >= TimeSpan.FromMilliseconds(30));
        relay.Stop();
        relay.Ends(130);
        using JsonDocument document = JsonDocument.Parse(relay.Output.ToString());
        Assert.Equal(JsonValueKind.Null, document.RootElement.GetProperty("profile").ValueKind);
        Assert.Equal((30, 0, 0, 1_000, 1), (Number("delay_ms"), Number("jitter_ms"), Number("loss_percent"), Number("rate_kbps"), Number("forwarded_to_host")));

        double Number(string key) => document.RootElement.GetProperty(key).GetDouble();
    }

    private static RelayLinkChoice Read(string line)
    {
        RelayLink link = new();
        Command command = new("relay");
        link.AddTo(command);
        return link.Read(command.Parse(line.Split(' ')));
    }
}
