using System;
using System.Diagnostics;
using System.Globalization;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Testing.Running;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>Sessions beside the same sessions protected: bytes a second, the host's time for each datagram, and for each join.</summary>
internal static class ProtectionTable
{
    private const int Clients = 3;

    private static readonly Scene Scene = new SceneBuilder("protection")
        .AddPlane("floor", Vector3D.Up, Vector3D.Zero).AddBody("ball", new BodySpec(0.5, 1, 0.5), new Vector3D(0, 0.5, 0)).Build();

    internal static void Print(bool isBrief)
    {
        Console.WriteLine("Host and 3 clients on a lan in virtual time, plain and protected; time is that of the host's steps, the best round");
        Console.WriteLine("| what | plain | protected | ratio |");
        Console.WriteLine("|---|---|---|---|");
        (int rounds, double seconds, int joins) = isBrief ? (1, 5, 20) : (7, 60, 200);
        using HostIdentity identity = HostIdentity.Draw();
        foreach (double rate in new[] { 0.0, 1, 60 })
        {
            (Load plain, Load sealedOnes) = (Load.None, Load.None);
            for (int round = 0; round < rounds; round++)
            {
                plain = plain.Better(Play(null, rate, seconds));
                sealedOnes = sealedOnes.Better(Play(identity, rate, seconds));
            }

            string events = rate == 0 ? "at rest" : string.Create(CultureInfo.InvariantCulture, $"{rate:0} events a second of each");
            Row($"{events}: bytes a second up, one client", plain.BytesUp, sealedOnes.BytesUp, "0");
            Row($"{events}: bytes a second down", plain.BytesDown, sealedOnes.BytesDown, "0");
            Row($"{events}: us of the host, a datagram in or out", plain.PerDatagram, sealedOnes.PerDatagram, "0.00");
        }

        (double plainJoin, double sealedJoin) = (double.MaxValue, double.MaxValue);
        for (int round = 0; round < rounds; round++)
        {
            plainJoin = Math.Min(plainJoin, Join(null, joins));
            sealedJoin = Math.Min(sealedJoin, Join(identity, joins));
        }

        Row("us of the host, a client that joins and leaves", plainJoin, sealedJoin, "0");
        Row("joins and leaves a second that fill a core", 1e6 / plainJoin, 1e6 / sealedJoin, "0");
    }

    private static void Row(string what, double plain, double sealedOnes, string format)
    {
        (string one, string other) = (plain.ToString(format, CultureInfo.InvariantCulture), sealedOnes.ToString(format, CultureInfo.InvariantCulture));
        Console.WriteLine(FormattableString.Invariant($"| {what} | {one} | {other} | {sealedOnes / plain:0.00} |"));
    }

    /// <summary>Lets all clients act for a while.</summary>
    private static Load Play(HostIdentity? identity, double rate, double seconds)
    {
        Group group = new(identity, expected: Clients);
        for (int client = 0; client < Clients; client++)
        {
            group.Join(client, (ulong)client + 1);
        }

        group.Steps.RunFor(SimDuration.FromSeconds(10));
        (LinkTraffic[] before, TimeSpan was) = (group.Links(), group.Host);
        double gap = rate == 0 ? seconds : 1 / rate;
        for (double done = 0; done < seconds; done += gap)
        {
            for (int client = 1; rate > 0 && client <= Clients; client++)
            {
                group.Steps.Sessions[client].Do(PlayerAction.Impulse(BodyId.OfScene(0), new Vector3D(0, 0.01, 0)));
                group.Steps.Wake(client);
            }

            group.Steps.RunFor(SimDuration.FromSeconds(gap));
        }

        LinkTraffic[] after = group.Links();
        double Total(Func<LinkTraffic, long> of) => after.Select(of).Sum() - before.Select(of).Sum();
        return new Load(
            Total(l => l.BytesSent) / seconds / Clients,
            Total(l => l.BytesReceived) / seconds / Clients,
            (group.Host - was).TotalMicroseconds / (Total(l => l.DatagramsSent) + Total(l => l.DatagramsReceived)));
    }

    /// <summary>Lets clients join and leave, one after the other; the host's time for each in us.</summary>
    private static double Join(HostIdentity? identity, int joins)
    {
        Group group = new(identity, expected: 0);
        group.Steps.RunFor(SimDuration.FromSeconds(2));
        TimeSpan was = group.Host;
        for (int join = 0; join < joins; join++)
        {
            (Session client, IDatagramPort port) = group.Join(join, (ulong)join + 1);
            while (client.State != SessionState.Running)
            {
                group.Steps.RunFor(SimDuration.FromMilliseconds(10));
            }

            client.Leave();
            group.Steps.Wake(1);
            group.Steps.RunFor(SimDuration.FromMilliseconds(100));
            group.Steps.RemoveLast();
            port.Dispose();
        }

        return (group.Host - was).TotalMicroseconds / joins;
    }

    private readonly record struct Load(double BytesUp, double BytesDown, double PerDatagram)
    {
        internal static Load None => new(0, 0, double.MaxValue);

        internal Load Better(Load other) => other.PerDatagram < PerDatagram ? other : this;
    }

    /// <summary>A host whose steps are timed, and its clients.</summary>
    private sealed class Group
    {
        private readonly HostIdentity? identity;
        private readonly VirtualClock clock = new(SimTime.FromSeconds(100));
        private readonly VirtualNetwork network;
        private readonly Stopwatch host = new();

        internal Group(HostIdentity? identity, int expected)
        {
            this.identity = identity;
            network = new VirtualNetwork(clock, 1, LinkProfiles.Lan);
            Steps = new VirtualSteps(network) { BeforeStep = Begin, AfterStep = _ => host.Stop() };
            IDatagramPort port = network.CreatePort(0);
            HostOptions options = new() { ExpectedClients = expected, Protection = identity is null ? null : new SecureHost(identity) };
            Steps.Add(new HostSession(Scene, port, clock, options, 1), port);
        }

        internal VirtualSteps Steps { get; }

        internal TimeSpan Host => host.Elapsed;

        internal (Session Session, IDatagramPort Port) Join(int node, ulong seed)
        {
            IDatagramPort port = network.CreatePort(node + 1);
            ClientOptions options = new() { Protection = identity is null ? null : new SecureClient(identity.Fingerprint) };
            ClientSession client = new(null, port, clock, options, PeerAddress.Virtual(0), seed);
            Steps.Add(client, port);
            return (client, port);
        }

        internal LinkTraffic[] Links() => [.. Steps.Sessions.Skip(1).Select(s => s.Links[0])];

        private void Begin(int number)
        {
            if (number == 0)
            {
                host.Start();
            }
        }
    }
}
