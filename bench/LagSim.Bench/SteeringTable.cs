using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Testing.Running;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>What players who steer all the time cost on each link, and how late the others hear of it, in virtual time.</summary>
internal static class SteeringTable
{
    /// <summary>An entry with an impulse, and one with the number of a peer's own event, without a datagram around them.</summary>
    private const int Entry = 47, OwnEntry = 5;

    /// <summary>The headers that an event needs at least, as in the sweep: those of a third of a datagram, UDP and IP included.</summary>
    private const double Headers = (59 + 16 + 28) / 3.0;

    private static readonly (int Clients, double Rate)[] Sessions = [(3, 5), (3, 30), (15, 5), (15, 30)];

    internal static void Print(bool isBrief)
    {
        Console.WriteLine("A host and clients that all act on bodies of their own, so many times a second each; bytes with UDP and IPv4 headers");
        Console.WriteLine("| clients | events/s each | link | loss, % | host sends, B/s | needed | ratio | a client sends, B/s | needed | ratio | datagrams/s down | up | copies late: p50, ms | p99 | max | refused |");
        Console.WriteLine("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
        foreach ((int clients, double rate) in Sessions)
        {
            foreach ((LinkProfile link, double loss) in Links(isBrief))
            {
                Console.WriteLine(Row(clients, rate, link, loss, isBrief || clients > 3 ? 15 : 60));
            }
        }
    }

    /// <summary>Clean and lossy pure delays, then the profiles that have a name.</summary>
    internal static IEnumerable<(LinkProfile Link, double Loss)> Links(bool isBrief)
    {
        foreach (double delay in isBrief ? new[] { 5.0, 100 } : [5, 50, 100, 250])
        {
            foreach (double loss in isBrief ? new[] { 0.0, 2 } : [0, 1, 2])
            {
                yield return (new LinkProfile(string.Create(CultureInfo.InvariantCulture, $"{delay} ms"), new LinkLeg(delay, lossPercent: loss, meanBurstLength: 1 / (1 - (loss / 100)))), loss);
            }
        }

        foreach (LinkProfile named in isBrief ? [] : LinkProfiles.All.Except(LinkProfiles.Ladder))
        {
            yield return (named, named.FromHost.LossPercent);
        }
    }

    internal static string Row(int clients, double rate, LinkProfile link, double loss, double seconds, ulong seed = 1)
    {
        VirtualClock clock = new(SimTime.FromSeconds(100));
        VirtualNetwork network = new(clock, seed, link);
        SceneBuilder builder = new SceneBuilder("steering").WithGravity(Vector3D.Zero);
        for (int peer = 0; peer <= clients; peer++)
        {
            builder.AddBody(FormattableString.Invariant($"ship {peer}"), new BodySpec(0.1, 1, 0.5), new Vector3D(0, 100 * peer, 0));
        }

        Scene scene = builder.Build();
        VirtualSteps steps = new(network);
        List<double> late = [];
        bool isMeasured = false;
        for (int peer = 0; peer <= clients; peer++)
        {
            IDatagramPort port = network.CreatePort(peer);
            HostOptions options = new() { ExpectedClients = clients, PlayerBudget = null, Window = new(SimDuration.FromSeconds(5)) };
            Session session = peer == 0
                ? new HostSession(scene, port, clock, options, 1)
                : new ClientSession(null, port, clock, ClientOptions.From(options), PeerAddress.Virtual(0), (ulong)peer);
            steps.Add(session, port);
            if (peer > 0)
            {
                session.Logged += entry =>
                {
                    if (isMeasured && entry.Event.Peer != session.Peer)
                    {
                        late.Add((session.SharedTime.Now - entry.Event.Time).ToMilliseconds());
                    }
                };
            }
        }

        SimTime deadline = clock.Now + SimDuration.FromSeconds(60);
        while (steps.Sessions.Any(s => s.State != SessionState.Running) && clock.Now < deadline)
        {
            steps.Advance(deadline);
        }

        SeededRandom random = new(seed);
        SimTime start = clock.Now;
        SimTime[] next = [.. steps.Sessions.Select(_ => start + SimDuration.FromSeconds(random.NextDouble() / rate))];
        const double before = 5; // until the links know their loss
        PortTraffic[] from = [], to;
        SimTime end = start + SimDuration.FromSeconds(before + seconds);
        while (true)
        {
            SimTime at = next.Min();
            if (!isMeasured && at >= start + SimDuration.FromSeconds(before))
            {
                isMeasured = true;
                from = Traffic();
            }

            if (at >= end)
            {
                break;
            }

            while (clock.Now < at)
            {
                steps.Advance(at);
            }

            int who = Array.IndexOf(next, at);
            next[who] += SimDuration.FromSeconds((0.9 + (0.2 * random.NextDouble())) / rate);
            if (steps.Sessions[who] is { State: SessionState.Running } actor)
            {
                // Back and forth, so that nobody comes far.
                actor.Do(PlayerAction.Impulse(BodyId.OfScene(who), new Vector3D(random.NextDouble(-0.1, 0.1), 0, random.NextDouble(-0.1, 0.1))));
                steps.Wake(who);
            }
        }

        to = Traffic();
        double others = clients * rate; // the host acts too
        double neededDown = clients * ((others * (Entry + Headers)) + (rate * (OwnEntry + Headers)));
        double neededUp = rate * (Entry + Headers);
        double down = (to[0].BytesSent - from[0].BytesSent) / seconds;
        double up = Enumerable.Range(1, clients).Average(n => to[n].BytesSent - from[n].BytesSent) / seconds;
        double downs = (to[0].DatagramsSent - from[0].DatagramsSent) / seconds / clients;
        double ups = Enumerable.Range(1, clients).Average(n => to[n].DatagramsSent - from[n].DatagramsSent) / seconds;
        Percentiles lateness = Percentiles.Of(late);
        return string.Create(
            CultureInfo.InvariantCulture,
            $"| {clients} | {rate:0} | {link.Name} | {loss:0.#} | {down:0} | {neededDown:0} | {down / neededDown:0.00} | {up:0} | {neededUp:0} | {up / neededUp:0.00} | {downs:0.0} | {ups:0.0} | {lateness.P50:0.0} | {lateness.P99:0} | {lateness.Max:0} | {steps.Sessions[0].Counters.EventsRefused} |");

        PortTraffic[] Traffic() => [.. Enumerable.Range(0, clients + 1).Select(network.Traffic)];
    }
}
