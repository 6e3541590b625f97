using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using LagSim.Events;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Testing.Running;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Sweep;

/// <summary>Plays one cell of the sweep in virtual time: 120 s of events and 60 s of rest.</summary>
internal sealed class SweepRun
{
    private const double IdleSeconds = 10;
    private const double LookSeconds = 0.1;

    private readonly SweepCell cell;
    private readonly SweepOptions options;
    private readonly CancellationToken cancellation;
    private readonly SeededRandom random;
    private readonly VirtualClock clock = new(SimTime.FromSeconds(10));
    private readonly VirtualNetwork network;
    private readonly VirtualSteps steps;
    private readonly List<Client> clients = [];
    private readonly HashSet<uint> accepted = [];
    private readonly List<SimTime> committed = [];
    private readonly HostSession host;
    private readonly UpdateDatagram measured = new();
    private readonly LinkQueue? down; // shared by all clients
    private double needed; // bytes of entries, for all clients

    internal SweepRun(SweepCell cell, SweepOptions options, CancellationToken cancellation)
    {
        ulong seed = options.Seed;
        this.cell = cell;
        this.options = options;
        this.cancellation = cancellation;
        random = new SeededRandom(seed);
        network = new VirtualNetwork(clock, seed, cell.Link);
        steps = new VirtualSteps(network);
        host = (HostSession)Add(0, seed);
        host.Logged += entry =>
        {
            if (entry.IsAccepted)
            {
                accepted.Add(entry.Index);
            }

            foreach (Client client in clients)
            {
                needed += Length(entry, client.Session.Peer);
            }
        };
        host.StateCommitted += state => committed.Add(state.Time);
        LinkProfile link = cell.Link;
        LinkQueue? up = cell.IsShared ? new LinkQueue(link.ToHost.Bottleneck!, random.Fork(1)) : null;
        down = cell.IsShared ? new LinkQueue(link.FromHost.Bottleneck!, random.Fork(2)) : null;
        for (int n = 1; n <= cell.Clients; n++)
        {
            network.Connect(n, 0, link, up, down);
            ClientSession session = (ClientSession)Add(n, seed);
            LogCoverage coverage = new(_ => accepted);
            coverage.Follow(session);
            Client client = new(session, n, coverage);
            clients.Add(client);
            session.Logged += entry => client.Bytes += Length(entry, session.Peer);
        }
    }

    internal SweepOutcome Play()
    {
        SweepOutcome outcome = new() { Cell = cell };
        if (!RunUntil(() => host.State == SessionState.Running && clients.All(c => c.Session.State == SessionState.Running), 60))
        {
            return outcome with { Failure = $"Not all were in after 60 s: {States()}." };
        }

        // The round trip of an idle session.
        List<double> idle = [];
        For(IdleSeconds, _ => Look(idle));
        double idleTrip = Percentiles.Of(idle).P50;
        double playSeconds = options.PlaySeconds;
        long[] before = Sent();
        double neededBefore = needed;
        double[] heardBefore = [.. clients.Select(c => c.Bytes)];
        List<double> trips = [];
        double[] next = [.. clients.Select(_ => cell.EventsPerSecond > 0 ? random.NextDouble() / cell.EventsPerSecond : double.MaxValue)];
        SimTime start = clock.Now;
        double nextLook = 0;
        while (true)
        {
            double at = Math.Min(nextLook, next.Min());
            if (at >= playSeconds)
            {
                break;
            }

            RunTo(start + SimDuration.FromSeconds(at));
            if (at == nextLook)
            {
                nextLook += LookSeconds;
                Look(trips);
                LookAtQueues();
                foreach (Client client in clients)
                {
                    client.Course.Add(new RoundTripLook(clock.Now.ToSeconds(), RoundTrip(client), (down ?? network.Queue(0, client.Number)!).IsInDip(clock.Now)));
                }

                continue;
            }

            int who = Array.IndexOf(next, at);
            next[who] += 1 / cell.EventsPerSecond * (0.5 + random.NextDouble());
            Do(clients[who]);
        }

        RunTo(start + SimDuration.FromSeconds(playSeconds));
        long[] after = Sent();
        double neededAfter = needed;
        double[] heardAfter = [.. clients.Select(c => c.Bytes)];
        RunTo(start + SimDuration.FromSeconds(playSeconds + options.RestSeconds));
        Percentiles trip = trips.Count > 0 ? Percentiles.Of(trips) : default;
        return Compare(outcome with
        {
            OfferedBytesPerSecond = (neededAfter - neededBefore) / cell.Clients / playSeconds,
            DeliveredBytesPerSecond = heardAfter.Zip(heardBefore, (a, b) => a - b).Sum() / cell.Clients / playSeconds,
            SentBytesPerSecond = (after[0] - before[0]) / (double)cell.Clients / playSeconds,
            SentUpBytesPerSecond = after.Zip(before, (a, b) => a - b).Skip(1).Sum() / (double)cell.Clients / playSeconds,
            IdleRoundTripMs = idleTrip,
            RoundTripP50Ms = trip.P50,
            RoundTripP99Ms = trip.P99,
            RecoverySeconds = clients.Max(c => RoundTripLook.Recovery(c.Course, 2 * idleTrip)),
            QueuedSeconds = clients.Sum(c => c.QueuedSeconds),
            SentPerNeededByteWhileQueued = clients.Sum(c => c.SentQueued) / Math.Max(1, clients.Sum(c => c.CameQueued)),
            LoadShare = LoadShare(),
        });
    }

    /// <summary>Returns the fraction of the link's bytes that events and their updates need at least.</summary>
    private double LoadShare()
    {
        const double own = WireFormat.EmptyUpdateBytes + WireFormat.StateHashBytes + Bottleneck.OverheadBytes;
        const int entry = 47, ownEntry = 5; // of a velocity, and of the number of a peer's own event
        double down = cell.EventsPerSecond * (((cell.Clients - 1) * (entry + (own / 3))) + ownEntry + (own / 3));
        double dip = cell.HasDips ? 0.2 : 1;
        return down * (cell.IsShared ? cell.Clients : 1) / (cell.RateBitsPerSecond / 8.0 * dip);
    }

    /// <summary>Returns the bytes of a log entry on its way to a peer. The author of an event gets only its number.</summary>
    private int Length(in LogEntry entry, byte peer)
    {
        measured.ClearEntries();
        bool fits = entry.Event.Peer == peer ? measured.TryAddOwn(entry.Verdict, entry.Event.Sequence) : measured.TryAdd(entry.Verdict, entry.Event);
        return fits ? measured.EncodedLength - WireFormat.EmptyUpdateBytes : throw new InvalidOperationException($"'{entry}' does not fit into a datagram.");
    }

    private void Do(Client client)
    {
        if (client.Session.State != SessionState.Running)
        {
            return;
        }

        BodyId body = BodyId.OfScene((int)(random.NextUInt64() % (ulong)host.Scene!.Bodies.Count));
        client.Session.Do(PlayerAction.SetVelocity(body, new Vector3D(random.NextDouble(-1, 1), 0, random.NextDouble(-1, 1))));
        client.Done++;
        steps.Wake(client.Number);
    }

    private SweepOutcome Compare(SweepOutcome outcome)
    {
        long lost = 0;
        double share = 1;
        foreach (Client client in clients)
        {
            lost += client.Coverage.Count().Lost;
            if (client.Session.State == SessionState.Ended)
            {
                continue; // the client had left, so it needs no more events
            }

            lost += client.Session.LogLength < host.LogLength ? host.LogLength - client.Session.LogLength : 0;
            share = Math.Min(share, committed.Count == 0 ? 0 : client.Session.Counters.StatesAgreed / (double)committed.Count);
        }

        Client[] ended = [.. clients.Where(c => c.Session.State == SessionState.Ended && c.Session.EndedBy != SessionEnd.LinkTooSlow)];
        return outcome with
        {
            Done = clients.Sum(c => c.Done),
            Refused = host.Counters.EventsRefused,
            Unanswered = clients.Sum(c => c.Session.Counters.EventsUnanswered),
            Lost = lost,
            Differed = clients.Sum(c => c.Session.Counters.StatesDiffered),
            ComparedShare = share,
            Copies = clients.Sum(c => c.Session.Counters.Renewals),
            TooSlow = clients.Count(c => c.Session.EndedBy == SessionEnd.LinkTooSlow),
            Failure = host.State == SessionState.Ended ? host.EndReason : ended.Length > 0 ? ended[0].Session.EndReason : null,
        };
    }

    private Session Add(int number, ulong seed)
    {
        IDatagramPort port = network.CreatePort(number);
        SkewedClock own = new(clock, random.NextDouble(-30, 30), SimDuration.FromSeconds(random.NextDouble(0, 3600)));
        HostOptions its = new() { ExpectedClients = cell.Clients, PlayerBudget = null, Cancellation = cancellation };
        Session session = number == 0
            ? new HostSession(BuiltInScenes.Billiards(), port, own, its, seed)
            : new ClientSession(null, port, own, ClientOptions.From(its), PeerAddress.Virtual(0), seed + (ulong)number);
        options.Prepare?.Invoke(number, session);
        steps.Add(session, port);
        return session;
    }

    /// <summary>The bytes that each end sent so far with UDP and IP headers, the host first.</summary>
    private long[] Sent() => [.. Enumerable.Range(0, clients.Count + 1).Select(n => network.Traffic(n).BytesSent)];

    private void Look(List<double> trips)
    {
        foreach (Client client in clients)
        {
            if (RoundTrip(client) is > 0 and double trip)
            {
                trips.Add(trip);
            }
        }
    }

    /// <summary>The newest round trip, in milliseconds; 0 where there is none.</summary>
    private static double RoundTrip(Client client) =>
        client.Session.State == SessionState.Running && client.Session.Links is [LinkTraffic link] ? link.RoundTrip.ToMilliseconds() : 0;

    /// <summary>Counts the bytes sent to clients and received there since the last sample, where a queue was present throughout.</summary>
    private void LookAtQueues()
    {
        foreach (LinkTraffic link in host.Links)
        {
            if (clients.Find(c => c.Session.Peer == link.Peer) is not Client client)
            {
                continue;
            }

            bool isQueued = link.Queueing > SimDuration.Zero;
            if (isQueued && client.WasQueued && link.BytesSent >= client.Sent) // else it is a new link, of a client that joined again
            {
                client.QueuedSeconds += LookSeconds;
                client.SentQueued += link.BytesSent - client.Sent;
                client.CameQueued += client.Bytes - client.Came;
            }

            (client.WasQueued, client.Sent, client.Came) = (isQueued, link.BytesSent, client.Bytes);
        }
    }

    private void For(double seconds, Action<double> look)
    {
        for (double at = 0; at < seconds; at += LookSeconds)
        {
            RunTo(clock.Now + SimDuration.FromSeconds(LookSeconds));
            look(at);
        }
    }

    private bool RunUntil(Func<bool> isSo, double seconds)
    {
        SimTime deadline = clock.Now + SimDuration.FromSeconds(seconds);
        while (!isSo() && clock.Now < deadline)
        {
            cancellation.ThrowIfCancellationRequested();
            steps.Advance(deadline);
        }

        return isSo();
    }

    private void RunTo(SimTime time)
    {
        while (clock.Now < time)
        {
            cancellation.ThrowIfCancellationRequested();
            steps.Advance(time);
        }
    }

    private string States() => string.Join("; ", clients.Select(c => $"client {c.Number} {c.Session.State} {c.Session.EndReason}"));

    private sealed class Client(ClientSession session, int number, LogCoverage coverage)
    {
        internal ClientSession Session { get; } = session;

        internal int Number { get; } = number;

        internal LogCoverage Coverage { get; } = coverage;

        internal double Bytes { get; set; }

        /// <summary>The round trips over time.</summary>
        internal List<RoundTripLook> Course { get; } = [];

        /// <summary>The last sample, as are the next two: whether there was a queue, the bytes sent, and the bytes received.</summary>
        internal bool WasQueued { get; set; }

        internal long Sent { get; set; }

        internal double Came { get; set; }

        internal double QueuedSeconds { get; set; }

        internal double SentQueued { get; set; }

        internal double CameQueued { get; set; }

        internal long Done { get; set; }
    }
}
