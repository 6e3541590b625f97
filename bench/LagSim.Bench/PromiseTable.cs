using System;
using System.Globalization;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Testing.Running;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>
/// What it costs on a link that clients promise what they stamp no more: bytes a second of a client in virtual time, with a host that waits for
/// promises, and with one that does not.
/// </summary>
internal static class PromiseTable
{
    private const int Clients = 3;
    private const double Seconds = 100, Second = 1;

    internal static void Print(bool isBrief)
    {
        Console.WriteLine("Payload of one client, a host and 3 clients who all act on a lan, over 100 s (28 bytes more a datagram with UDP and IPv4)");
        Console.WriteLine("| acts a second of each client | it sends without promises: bytes/s | datagrams/s | with: bytes/s | datagrams/s | it gets without: bytes/s | datagrams/s | with: bytes/s | datagrams/s |");
        Console.WriteLine("|---|---|---|---|---|---|---|---|---|");
        foreach (double rate in isBrief ? [0, 1.0] : new[] { 0, 0.05, 0.2, 1, 5, 30 })
        {
            (double sent, double sentIn, double got, double gotIn) = Play(rate, waits: false);
            (double sentWith, double sentInWith, double gotWith, double gotInWith) = Play(rate, waits: true);
            Console.WriteLine(string.Create(
                CultureInfo.InvariantCulture,
                $"| {rate} | {sent:0} | {sentIn:0.0} | {sentWith:0} | {sentInWith:0.0} | {got:0} | {gotIn:0.0} | {gotWith:0} | {gotInWith:0.0} |"));
        }
    }

    private static (double Sent, double SentIn, double Got, double GotIn) Play(double rate, bool waits)
    {
        VirtualClock clock = new(SimTime.FromSeconds(100));
        VirtualNetwork network = new(clock, 1, LinkProfiles.Lan);
        SceneBuilder builder = new SceneBuilder("promises").AddPlane("floor", Vector3D.Up, Vector3D.Zero);
        for (int n = 0; n <= Clients; n++)
        {
            builder.AddBody(FormattableString.Invariant($"ball {n}"), new BodySpec(0.5, 1, 0.5), new Vector3D(3 * n, 0.5, 0));
        }

        Scene scene = builder.Build();
        VirtualSteps steps = new(network);
        for (int peer = 0; peer <= Clients; peer++)
        {
            IDatagramPort port = network.CreatePort(peer);
            HostOptions options = new() { ExpectedClients = Clients };
            options = waits ? options : options with { LongestHistory = options.Window.History };
            steps.Add(
                peer == 0 ? new HostSession(scene, port, clock, options, 1) : new ClientSession(null, port, clock, ClientOptions.From(options), PeerAddress.Virtual(0), (ulong)peer),
                port);
        }

        steps.RunFor(SimDuration.FromSeconds(10));
        LinkTraffic[] before = [.. steps.Sessions.Skip(1).Select(s => s.Links[0])];
        for (int n = 0; n < Seconds * Math.Max(rate, Second); n++)
        {
            for (int peer = 1; peer <= Clients && rate > 0 && (rate >= Second || n % (Second / rate) == 0); peer++)
            {
                steps.Sessions[peer].Do(PlayerAction.Impulse(BodyId.OfScene(peer), new Vector3D(0, 0.1, 0)));
                steps.Wake(peer);
            }

            steps.RunFor(SimDuration.FromSeconds(1 / Math.Max(rate, Second)));
        }

        LinkTraffic[] after = [.. steps.Sessions.Skip(1).Select(s => s.Links[0])];
        double PerSecond(Func<LinkTraffic, long> of) => Enumerable.Range(0, Clients).Average(n => of(after[n]) - of(before[n])) / Seconds;
        return (PerSecond(l => l.BytesSent), PerSecond(l => l.DatagramsSent), PerSecond(l => l.BytesReceived), PerSecond(l => l.DatagramsReceived));
    }
}
