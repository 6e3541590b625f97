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

/// <summary>Bytes a second on each link of a session in virtual time: not a matter of speed, so not a benchmark of time.</summary>
internal static class TrafficTable
{
    private const double Seconds = 100;

    internal static void Print()
    {
        Console.WriteLine("Bytes a second of payload, host and 3 clients on a lan, over 100 s (28 more a datagram with UDP and IPv4)");
        Console.WriteLine("| events a second of one client | it sends | it gets | another client sends | another gets |");
        Console.WriteLine("|---|---|---|---|---|");
        foreach (double rate in new[] { 0, 1, 10, 60 })
        {
            Console.WriteLine(Row(rate));
        }
    }

    private static string Row(double rate)
    {
        const int peers = 4;
        VirtualClock clock = new(SimTime.FromSeconds(100));
        VirtualNetwork network = new(clock, 1, LinkProfiles.Lan);
        Scene scene = new SceneBuilder("traffic").AddPlane("floor", Vector3D.Up, Vector3D.Zero).AddBody("ball", new BodySpec(0.5, 1, 0.5), new Vector3D(0, 0.5, 0)).Build();
        VirtualSteps steps = new(network);
        for (int peer = 0; peer < peers; peer++)
        {
            IDatagramPort port = network.CreatePort(peer);
            HostOptions options = new() { ExpectedClients = peers - 1 };
            steps.Add(
                peer == 0 ? new HostSession(scene, port, clock, options, 1) : new ClientSession(null, port, clock, ClientOptions.From(options), PeerAddress.Virtual(0), (ulong)peer),
                port);
        }

        steps.RunFor(SimDuration.FromSeconds(10));
        LinkTraffic[] before = steps.Sessions.Skip(1).Select(s => s.Links[0]).ToArray();
        for (double done = 0; done < Seconds; done += rate == 0 ? Seconds : 1 / rate)
        {
            if (rate > 0)
            {
                steps.Sessions[1].Do(PlayerAction.Impulse(BodyId.OfScene(0), new Vector3D(0, 0.1, 0)));
                steps.Wake(1);
            }

            steps.RunFor(SimDuration.FromSeconds(rate == 0 ? Seconds : 1 / rate));
        }

        LinkTraffic[] after = steps.Sessions.Skip(1).Select(s => s.Links[0]).ToArray();
        double PerSecond(Func<LinkTraffic, long> of, int client) => (of(after[client]) - of(before[client])) / Seconds;
        return string.Create(
            CultureInfo.InvariantCulture,
            $"| {rate:0} | {PerSecond(l => l.BytesSent, 0):0} | {PerSecond(l => l.BytesReceived, 0):0} | {PerSecond(l => l.BytesSent, 1):0} | {PerSecond(l => l.BytesReceived, 1):0} |");
    }
}
