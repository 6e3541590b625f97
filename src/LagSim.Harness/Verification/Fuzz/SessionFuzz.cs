using System;
using System.Linq;
using System.Threading;
using LagSim.Events;
using LagSim.Harness.Experiments.Peers;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Testing.Running;
using LagSim.Time;

namespace LagSim.Harness.Verification.Fuzz;

/// <summary>Sessions of a host and two clients in virtual time, under hostile datagrams from their first connect request on.</summary>
/// <remarks>
/// <para>In every other session all hostile datagrams come from strangers' addresses, or are replays from the true ones. That session must
/// continue and all its worlds agree. In the others they have the peers' own addresses. Then nothing may throw, and no more can be
/// required; unless the sessions are protected: then these must continue and agree, too.</para>
/// <para>Deterministic: the same seed and number of datagrams give the same report, except the memory. Protected sessions draw their keys
/// from the system, so there the counts differ.</para>
/// </remarks>
public static class SessionFuzz
{
    /// <summary>The number of datagrams that strangers send to one session.</summary>
    private const int PacketsOfStrangers = 2_000;

    /// <summary>The number of datagrams with peers' own addresses: a session seldom survives more.</summary>
    private const int PacketsOfPeers = 200;
    private const int Peers = 3;

    /// <summary>
    /// The interval, in full-length sessions under strangers' datagrams, at which memory is measured: after the first quarter of the
    /// datagrams, when an honest session has allocated what it keeps, and after the last. A forced collection takes some milliseconds.
    /// </summary>
    private const int LookEvery = 5;

    /// <summary>
    /// The allowed growth of a running session's memory over its last 1,500 datagrams. A window of entries that arrive out of order may
    /// grow to its full 4,096, a megabyte. Everything else that an honest session and the collector keep was 41 kB at most in 4,000
    /// sessions. A kilobyte kept for each hostile datagram would be 1.5 MB.
    /// </summary>
    private const long MaxGrowth = 1_200_000;

    private const int Stranger = 100;
    private const int Strangers = 5;
    private static readonly SimDuration Pace = SimDuration.FromMilliseconds(1);

    /// <summary>Sends a number of datagrams, spread over sessions.</summary>
    /// <param name="packets">The number of datagrams, at least 1.</param>
    /// <param name="seed">The seed of the datagrams.</param>
    /// <param name="progress">Called from time to time with the number sent; may be null.</param>
    /// <param name="cancellation">Ends it between two sessions.</param>
    /// <param name="isProtected">Whether the sessions are protected.</param>
    public static FuzzReport Run(
        long packets, ulong seed, Action<long>? progress, CancellationToken cancellation, bool isProtected = false) =>
        Run(packets, seed, progress, static port => port, cancellation, isProtected);

    /// <summary>The same, with a wrapper between each session and its port.</summary>
    internal static FuzzReport Run(
        long packets, ulong seed, Action<long>? progress, Func<IDatagramPort, IDatagramPort> between, CancellationToken cancellation,
        bool isProtected = false)
    {
        ArgumentOutOfRangeException.ThrowIfLessThan(packets, 1);
        FuzzReport report = new(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, null);
        using HostIdentity? identity = isProtected ? HostIdentity.Draw() : null;
        long atFirst = 0;
        while (report.Packets < packets && report.Failure is null)
        {
            cancellation.ThrowIfCancellationRequested();
            bool isFromStrangers = report.Sessions % 2 == 0;
            int count = (int)Math.Min(isFromStrangers ? PacketsOfStrangers : PacketsOfPeers, packets - report.Packets);
            bool isMeasured = count == PacketsOfStrangers && report.Sessions / 2 % LookEvery == 0;
            report = new Round(seed + (ulong)report.Sessions, isFromStrangers, isMeasured, identity, between).Play(count, report);
            progress?.Invoke(report.Packets);
            if (report.Sessions == 2)
            {
                atFirst = LiveMemory.Read(); // everything allocated once exists now
            }
        }

        return report with { RetainedBytes = report.Sessions > 2 ? LiveMemory.Read() - atFirst : 0 };
    }

    /// <summary>Plays one session.</summary>
    private sealed class Round
    {
        private readonly ulong seed;
        private readonly bool isFromStrangers;
        private readonly bool isMeasured;
        private readonly bool isProtected;
        private readonly VirtualClock clock = new(SimTime.FromSeconds(100));
        private readonly VirtualNetwork network;
        private readonly Session[] sessions = new Session[Peers];
        private readonly IDatagramPort[] ports = new IDatagramPort[Peers];
        private readonly IDatagramPort[] strangers;
        private readonly VirtualSteps steps;
        private readonly SeededRandom random;
        private readonly HostileDatagrams hostile;
        private bool isLearning = true;

        internal Round(
            ulong seed, bool isFromStrangers, bool isMeasured, HostIdentity? identity, Func<IDatagramPort, IDatagramPort> between)
        {
            this.seed = seed;
            this.isFromStrangers = isFromStrangers;
            this.isMeasured = isMeasured;
            isProtected = identity is not null;
            random = new SeededRandom(seed);
            hostile = new HostileDatagrams(random.Fork(1));
            network = new VirtualNetwork(clock, seed, LinkProfiles.Lan);
            steps = new VirtualSteps(network);
            network.Lose((from, to, datagram) =>
            {
                if (isLearning && from < Peers && to < Peers)
                {
                    hostile.Learn(datagram.Span, from, to);
                }

                return false;
            });
            Scene scene = new SceneBuilder("fuzz").WithSmallestRadius(0.25)
                .AddPlane("floor", Vector3D.Up, Vector3D.Zero, 0.9)
                .AddBody("a", new BodySpec(0.3, 1, 0.9), new Vector3D(-1, 3, 0))
                .AddBody("b", new BodySpec(0.3, 2, 0.9), new Vector3D(1, 3, 0))
                .Build();
            for (int peer = 0; peer < Peers; peer++)
            {
                ports[peer] = between(network.CreatePort(peer));
                HostOptions options = new() { ExpectedClients = Peers - 1, ConnectKey = "fuzz", PlayerBudget = null };
                (HostOptions hosting, ClientOptions joining) = ProtectedOptions.Of(options, identity);
                SkewedClock own = new(clock, 5 * peer, SimDuration.FromSeconds(peer));
                sessions[peer] = peer == 0
                    ? new HostSession(scene, ports[0], own, hosting, random.NextUInt64())
                    : new ClientSession(null, ports[peer], own, joining, PeerAddress.Virtual(0), random.NextUInt64());
                steps.Add(sessions[peer], ports[peer]);
            }

            strangers = Enumerable.Range(Stranger, Strangers).Select(network.CreatePort).ToArray();
        }

        internal FuzzReport Play(int packets, FuzzReport sum)
        {
            string? failure = null;
            int sent = 0;
            long held = 0;
            try
            {
                for (; sent < packets; sent++)
                {
                    held = isMeasured && sent == packets / 4 ? LiveMemory.Read() : held;
                    SendOne();
                    steps.RunFor(Pace);
                    if (sent % 100 == 50)
                    {
                        Act(sent / 100 % Peers);
                    }
                }

                held = isMeasured ? LiveMemory.Read() - held : 0;
                steps.RunFor(SimDuration.FromSeconds(2));
            }
            catch (Exception thrown)
            {
                failure = $"Seed {seed}, packet {sent}: {thrown.GetType().Name} out of a session: {thrown.Message}";
            }

            bool isWhole = failure is null && IsWhole();
            long strangersSent = strangers.Sum(p => network.Traffic(Number(p)).BytesSent - (28 * network.Traffic(Number(p)).DatagramsSent));
            long strangersGot = strangers.Sum(p => network.Traffic(Number(p)).BytesReceived - (28 * network.Traffic(Number(p)).DatagramsReceived));
            string? whose = isFromStrangers ? "of strangers and replays" : isProtected ? "in its peers' names, though protected" : null;
            failure ??= whose is not null && !isWhole ? $"Seed {seed}: a session came apart under datagrams {whose}: {State()}." : null;
            failure ??= held > MaxGrowth ? $"Seed {seed}: the memory of a living session grew by {held} bytes over its last {packets - (packets / 4)}"
                + " packets." : null;
            failure ??= strangersGot > strangersSent ? $"Seed {seed}: strangers sent {strangersSent} bytes and got {strangersGot}." : null;
            return new FuzzReport(
                sum.Packets + packets,
                sum.Sessions + 1,
                sum.Malformed + sessions.Sum(s => s.Counters.DatagramsMalformed),
                sum.Ignored + sessions.Sum(s => s.Counters.DatagramsIgnored),
                sum.Forged + sessions.Sum(s => s.Counters.DatagramsForged),
                sum.SessionsBroken + (isWhole ? 0 : 1),
                sum.StrangerBytesSent + strangersSent,
                sum.StrangerBytesReceived + strangersGot,
                0,
                Math.Max(sum.SessionGrowthBytes, held),
                failure);
        }

        private static int Number(IDatagramPort port) => int.Parse(port.LocalAddress.ToString().AsSpan("virtual:".Length), System.Globalization.CultureInfo.InvariantCulture);

        private void SendOne()
        {
            byte[] datagram = hostile.Next();
            int to = hostile.Replayed?.To ?? (int)(random.NextUInt64() % Peers);
            int from = hostile.Replayed?.From ?? (int)(random.NextUInt64() % Peers);
            bool isOwn = from != to && (hostile.Replayed is not null ? random.NextUInt64() % 4 > 0 : !isFromStrangers);
            isLearning = false;
            (isOwn ? ports[from] : strangers[(int)(random.NextUInt64() % Strangers)]).Send(datagram, PeerAddress.Virtual(to));
            isLearning = true;
        }

        private void Act(int peer)
        {
            if (sessions[peer].State == SessionState.Running)
            {
                BodyId body = BodyId.OfScene((int)(random.NextUInt64() % 2));
                Vector3D vector = new(random.NextGaussian(), 3, 0);
                sessions[peer].Do((random.NextUInt64() % 5) switch
                {
                    0 => PlayerAction.Grab(body),
                    1 => PlayerAction.HoldKeyframe(body, vector, vector),
                    2 => PlayerAction.Release(body, vector),
                    _ => PlayerAction.Impulse(body, vector),
                });
                steps.Wake(peer);
            }
        }

        private bool IsWhole()
        {
            if (sessions.Any(s => s.State != SessionState.Running || s.LogLength != sessions[0].LogLength))
            {
                return false;
            }

            SimTime time = sessions.Min(s => s.World!.Simulation.SimulatedTo);
            return sessions.Select(s => (s.World!.Simulation.StateHash(time), s.World.Simulation.EventHash(time))).Distinct().Count() == 1
                && sessions.All(s => s.Counters.StatesDiffered + s.Counters.EventsForged + s.Counters.EventsRefused == 0);
        }

        private string State() => string.Join("; ", sessions.Select(
            s => $"{s.State} {s.EndReason} log {s.LogLength}, refused {s.Counters.EventsRefused}, forged {s.Counters.EventsForged}, differed"
                + $" {s.Counters.StatesDiffered}"));
    }
}
