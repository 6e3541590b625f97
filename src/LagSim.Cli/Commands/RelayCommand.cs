using System;
using System.CommandLine;
using System.Globalization;
using System.Net;
using System.Threading;
using LagSim.Cli.Output;
using LagSim.Harness.Relays;
using LagSim.Harness.Reports;
using LagSim.Hosting;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Cli.Commands;

/// <summary><c>lagsim relay</c>: simulates a bad link between real processes.</summary>
internal static class RelayCommand
{
    private static readonly TimeSpan Look = TimeSpan.FromMilliseconds(500);

    internal static Command Create(ToolConsole console)
    {
        CommonOptions common = new();
        Argument<string> host = new("ADDRESS:PORT") { Description = "Where the host is; clients join the relay's own address instead." };
        RelayLink links = new();
        Option<int> port = CommonOptions.Whole("--port", "The UDP port; 0 picks a free one", 0, 0, 65535);
        Option<string> address = new("--address")
        {
            Description = "The address of this machine to listen on.",
            DefaultValueFactory = _ => IPAddress.Loopback.ToString(),
            HelpName = "ADDRESS",
        };
        Option<double?> length = SessionArguments.Seconds("--for-s", "How long to run; by default until Ctrl-C.",
            SessionArguments.MinLength, ScriptedAction.MaxSeconds);
        Option<double?> change = SessionArguments.Seconds(
            "--change-port-s", "How often the host sees each client move to another port; by default never.", 0.5, 3600);
        Command command = new("relay", "Passes datagrams between clients and a host, with the delays and losses of a link: a profile, or figures.")
        {
            host, port, address, length, change,
        };
        links.AddTo(command);
        common.AddSeedAndJsonTo(command);
        command.SetAction(parsed =>
        {
            RelayLinkChoice chosen = links.Read(parsed);
            LinkProfile link = chosen.Link;
            IPAddress local = EndPointText.ParseLocal("--address", parsed.GetValue(address)!);
            IPEndPoint there = EndPointText.Resolve(parsed.GetValue(host)!, "relay to", console.Stop);
            bool json = parsed.GetValue(common.Json);
            ulong seed = parsed.GetValue(common.Seed);
            StopwatchClock clock = new();
            SimDuration? changing = parsed.GetValue(change) is double seconds ? SimDuration.FromSeconds(seconds) : null;
            using UdpRelay relay = Open(new IPEndPoint(local, parsed.GetValue(port)), there, link, seed, clock, changing);
            string listening = new IPEndPoint(local, relay.LocalAddress.ToEndPoint().Port).ToString();
            (json ? console.Error : console.Output).WriteLine($"listening on {listening}");
            (json ? console.Error : console.Output).Flush();
            RelayTraffic traffic = Watch(relay, clock, parsed.GetValue(length), console.Stop);
            if (json)
            {
                JsonDocumentWriter.Write(console.Output, "relay", seed, null, null, null, document =>
                {
                    document.WriteString("listening_on", listening);
                    document.WriteString("profile", chosen.IsByFigures ? null : link.Name);
                    foreach ((string key, double? value) in chosen.Figures)
                    {
                        JsonDocumentWriter.Number(document, key, value);
                    }

                    document.WriteNumber("clients", traffic.Clients);
                    document.WriteNumber("forwarded_to_host", traffic.ForwardedToHost);
                    document.WriteNumber("lost_to_host", traffic.LostToHost);
                    document.WriteNumber("forwarded_from_host", traffic.ForwardedFromHost);
                    document.WriteNumber("lost_from_host", traffic.LostFromHost);
                    document.WriteNumber("refused", traffic.Refused);
                    document.WriteNumber("port_changes", traffic.PortChanges);
                });
            }
            else
            {
                console.Output.WriteLine(string.Create(
                    CultureInfo.InvariantCulture,
                    $"{link.Name}, {NumberText.Count(traffic.Clients, "client")};"
                        + $" to the host {NumberText.Count(traffic.ForwardedToHost, "datagram")},"
                        + $" {traffic.LostToHost} lost; from the host {traffic.ForwardedFromHost}, {traffic.LostFromHost} lost; {traffic.Refused} refused"
                        + $"{(changing is null ? "" : $"; {NumberText.Count(traffic.PortChanges, "port change")}")}"));
            }

            return console.Stop.IsCancellationRequested ? ExitCode.Interrupted : ExitCode.Done;
        });
        return command;
    }

    private static UdpRelay Open(IPEndPoint listen, IPEndPoint host, LinkProfile link, ulong seed, StopwatchClock clock, SimDuration? change)
    {
        try
        {
            return new UdpRelay(listen, host, link, seed, clock, change);
        }
        catch (ArgumentException failure)
        {
            throw new InputException(Sentence.Of(failure), failure);
        }
    }

    private static RelayTraffic Watch(UdpRelay relay, StopwatchClock clock, double? seconds, CancellationToken stop)
    {
        SimTime end = seconds is double length ? clock.Now + SimDuration.FromSeconds(length) : SimTime.MaxValue;
        while (!stop.IsCancellationRequested && clock.Now < end)
        {
            _ = relay.Traffic; // throws if the relay failed
            double left = end == SimTime.MaxValue ? double.MaxValue : (end - clock.Now).ToMilliseconds();
            stop.WaitHandle.WaitOne(TimeSpan.FromMilliseconds(Math.Clamp(Math.Ceiling(left), 0, Look.TotalMilliseconds)));
        }

        relay.Dispose(); // else a datagram in progress would be forwarded and not counted
        return relay.Traffic;
    }
}
