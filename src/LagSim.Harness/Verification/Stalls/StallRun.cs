using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Threading;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Strategies;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Testing.Running;
using LagSim.Time;

namespace LagSim.Harness.Verification.Stalls;

/// <summary>Plays one session with stalls in virtual time, and checks every peer's states and events.</summary>
internal sealed class StallRun
{
    /// <summary>The number of datagrams that a port holds while its process stalls, about as many as a socket of Linux.</summary>
    private const int PortRoom = 256;

    /// <summary>How long peers may take to join at first, and to be up to date after the last stall, in seconds.</summary>
    private const double Timeout = 180;

    /// <summary>How long play continues after the last recovery.</summary>
    private const double PlayOn = 10;

    private readonly StallCase drawn;
    private readonly StallOptions options;
    private readonly CancellationToken cancellation;
    private readonly SeededRandom random;
    private readonly VirtualClock clock = new(SimTime.FromSeconds(10));
    private readonly VirtualNetwork network;
    private readonly VirtualSteps steps;
    private readonly StallHostLog hostLog = new();
    private readonly IDatagramPort[] ports;
    private readonly SkewedClock[] clocks;
    private readonly List<StallClient> clients = [];
    private readonly HashSet<int> dead = []; // killed, and not restarted yet
    private readonly List<double> recoveries = [];
    private readonly List<string> failures = [];
    private ulong sessions; // the number opened so far, for their numbers
    private int addresses = 1000; // the next new one

    internal StallRun(StallCase drawn, StallOptions options, CancellationToken cancellation)
    {
        this.drawn = drawn;
        this.options = options;
        this.cancellation = cancellation;
        random = new SeededRandom(drawn.Seed).Fork(0xD0);
        network = new VirtualNetwork(clock, drawn.Seed, drawn.Link) { PortRoom = PortRoom };
        steps = new VirtualSteps(network);
        clocks = [.. Enumerable.Range(0, drawn.Clients + 1).Select(_ => new SkewedClock(
            clock, random.NextDouble(-30, 30), SimDuration.FromSeconds(random.NextDouble(0, 3600))))];
        ports = [.. Enumerable.Range(0, drawn.Clients + 1).Select(network.CreatePort)];
        steps.Add(NewHost(drawn.Clients), ports[0]);
        for (int number = 1; number <= drawn.Clients; number++)
        {
            StallClient client = new(number, hostLog, options.Overlooked);
            clients.Add(client);
            steps.Add(NewClient(client), ports[number]);
        }
    }

    private HostSession Host => (HostSession)steps.Sessions[0];

    internal StallOutcome Play()
    {
        if (RunUntil(() => Host.State == SessionState.Running && clients.All(c => c.Session.State == SessionState.Running), Timeout))
        {
            foreach (StallClient client in clients)
            {
                client.Number = client.Session.Peer;
            }

            PlayStalls();
            Settle();
        }
        else
        {
            failures.Add($"Not all were in after {Timeout} s: {States()}.");
        }

        foreach (StallClient client in clients)
        {
            Validate(client);
        }

        return new StallOutcome
        {
            Case = drawn,
            Compared = clients.Sum(c => c.Compared),
            Differed = clients.Sum(c => c.Differed),
            Lost = clients.Sum(c => c.Lost),
            Expected = clients.Sum(c => c.Expected),
            Accepted = hostLog.AcceptedInAll,
            Refused = hostLog.RefusedInAll,
            RefusedTooLate = hostLog.TooLateInAll,
            Copies = clients.Sum(c => c.Copies),
            Regained = clients.Sum(c => c.Regained),
            RecoverySeconds = recoveries,
            Failures = failures,
        };
    }

    private void PlayStalls()
    {
        SimTime start = clock.Now;
        List<(double At, Action What)> plan = [];
        foreach (Stall stall in drawn.Stalls)
        {
            plan.Add((stall.AtSeconds, () => Begin(stall)));
            double from = stall.Kind == StallKind.PortChanges ? stall.AtSeconds + Stall.ChangeSeconds : double.MaxValue;
            for (double at = from; at < stall.EndSeconds; at += Stall.ChangeSeconds)
            {
                plan.Add((at, () => ChangeAddress(stall.Player)));
            }

            plan.Add((stall.EndSeconds, () => End(stall)));
        }

        double[] next = [.. clients.Select(_ => random.NextDouble() / drawn.EventsPerSecond)];
        double end = double.MaxValue;
        foreach ((double at, Action what) in plan.OrderBy(p => p.At).Append((drawn.EndSeconds + Timeout, Look)))
        {
            while (true)
            {
                double now = Math.Min(at, next.Min());
                RunTo(start + SimDuration.FromSeconds(Math.Min(now, end)));
                if (now >= end)
                {
                    return;
                }

                if (end == double.MaxValue && now > drawn.EndSeconds && clients.All(c => c.Since is null))
                {
                    end = now + PlayOn; // all are up to date again
                }

                if (now == at)
                {
                    break;
                }

                int who = Array.IndexOf(next, now);
                next[who] += (0.5 + random.NextDouble()) / drawn.EventsPerSecond;
                Do(clients[who]);
            }

            what();
        }
    }

    /// <summary>Waits until all peers have received all events, and the last one is committed.</summary>
    private void Settle()
    {
        if (!RunUntil(
            () => clients.All(c => c.Session is { State: SessionState.Running, UnconfirmedEvents: 0 } && c.Session.LogLength == Host.LogLength), Timeout))
        {
            failures.Add($"Not all was heard and judged {Timeout} s after the last action: {States()}.");
        }

        RunUntil(() => false, 4);
    }

    private void Validate(StallClient client)
    {
        ClientSession session = client.Session;
        bool isTouched = drawn.Stalls.Any(s => s.Touches(client.Address));
        if (session.State != SessionState.Running)
        {
            failures.Add($"Client {client.Address} is not back: {session.State}. {session.EndReason}");
        }
        else if (client.Since is SimTime since)
        {
            failures.Add(string.Create(
                CultureInfo.InvariantCulture,
                $"Client {client.Address} was not up to date {(clock.Now - since).ToSeconds():0} s after the last stall."));
        }
        else if (session.LogLength != Host.LogLength)
        {
            failures.Add($"Client {client.Address} has {session.LogLength} of {Host.LogLength} lines of the log at the end.");
        }

        if (session.State == SessionState.Running && session.Peer != client.Number)
        {
            failures.Add($"Client {client.Address} was player {client.Number}, and came back as player {session.Peer}.");
        }

        if (!isTouched && client.Interruptions.Count > 0)
        {
            failures.Add($"Client {client.Address}, to whom nothing happened, was interrupted: {client.Interruptions[0]}");
        }

        client.Compare();
    }

    private void Begin(Stall stall)
    {
        foreach (StallClient client in clients.Where(c => stall.Kind != StallKind.PortChanges && stall.Touches(c.Address)))
        {
            client.Stalls++;
            client.Since = null;
        }

        switch (stall.Kind)
        {
            case StallKind.HostFrozen or StallKind.ClientFrozen:
                steps.Freeze(stall.Player);
                break;
            case StallKind.HostKilled or StallKind.ClientKilled:
                steps.Freeze(stall.Player);
                ports[stall.Player].Dispose();
                dead.Add(stall.Player);
                break;
            default:
                ChangeAddress(stall.Player);
                break;
        }
    }

    private void End(Stall stall)
    {
        switch (stall.Kind)
        {
            case StallKind.HostFrozen or StallKind.ClientFrozen:
                steps.Thaw(stall.Player);
                break;
            case StallKind.HostKilled:
                ports[0] = network.CreatePort(0);
                dead.Remove(stall.Player);
                steps.Replace(0, NewHost(expected: 0), ports[0]);
                break;
            case StallKind.ClientKilled:
                ports[stall.Player] = network.CreatePort(stall.Player);
                network.Move(stall.Player, addresses++);
                dead.Remove(stall.Player);
                steps.Replace(stall.Player, NewClient(clients[stall.Player - 1]), ports[stall.Player]);
                break;
            default:
                return; // each change of the address was instantaneous
        }

        foreach (StallClient client in clients.Where(c => stall.Touches(c.Address)))
        {
            client.Stalls--;
            Await(client);
        }
    }

    private void ChangeAddress(int player)
    {
        if (!dead.Contains(player))
        {
            network.Move(player, addresses++);
            Await(clients[player - 1]);
        }
    }

    /// <summary>Starts to wait until a client is up to date again.</summary>
    private void Await(StallClient client)
    {
        if (client.Stalls == 0)
        {
            client.Since = clock.Now;
            client.Log = (Host, Host.LogLength);
            client.Received = network.Traffic(client.Address).DatagramsReceived;
        }
    }

    private void Do(StallClient client)
    {
        if (client.Session.State == SessionState.Running && !steps.IsFrozen(client.Address))
        {
            BodyId body = BodyId.OfScene((int)(random.NextUInt64() % (ulong)Host.Scene!.Bodies.Count));
            client.Session.Do(PlayerAction.SetVelocity(body, new Vector3D(random.NextDouble(-1, 1), 0, random.NextDouble(-1, 1))));
            steps.Wake(client.Address);
        }
    }

    private HostSession NewHost(int expected)
    {
        HostOptions chosen = Options() with { ExpectedClients = expected };
        HostSession session = new(BuiltInScenes.Billiards(), ports[0], clocks[0], chosen, drawn.Seed + (1000 * ++sessions));
        hostLog.Follow(session);
        return session;
    }

    private ClientSession NewClient(StallClient client)
    {
        ClientOptions chosen = ClientOptions.From(Options()) with { Pass = options.KeepsPasses ? client.Pass : default };
        ClientSession session = new(
            null, ports[client.Address], clocks[client.Address], chosen, PeerAddress.Virtual(0), drawn.Seed + (1000 * ++sessions));
        options.PrepareClient?.Invoke(session);
        client.Follow(session);
        return session;
    }

    private HostOptions Options() => new()
    {
        Cancellation = cancellation,
        PlayerBudget = null, // peers here leave by stalls, kills and new addresses, never by a budget
        Strategy = LateEventStrategies.OfName(options.Strategy),
        RejoinTime = SimDuration.FromSeconds(options.RejoinSeconds),
    };

    /// <summary>
    /// Records which clients are up to date again: joined, at the present, and with everything in the host's log at the end of the stall.
    /// </summary>
    private void Look()
    {
        foreach (StallClient client in clients)
        {
            if (client.Since is SimTime since && client.Stalls == 0 && client.Session is { State: SessionState.Running, World.IsBehind: false }
                && client.Session.LogLength >= client.Log.Length && client.Log.Host == Host
                && network.Traffic(client.Address).DatagramsReceived > client.Received
                && Host.Links.Any(link => link.Peer == client.Session.Peer && link.Address == ports[client.Address].LocalAddress))
            {
                recoveries.Add((clock.Now - since).ToSeconds());
                client.Since = null;
            }
        }
    }

    private bool RunUntil(Func<bool> isSo, double seconds)
    {
        SimTime deadline = clock.Now + SimDuration.FromSeconds(seconds);
        while (!isSo() && clock.Now < deadline)
        {
            cancellation.ThrowIfCancellationRequested();
            steps.Advance(deadline);
            Look();
        }

        return isSo();
    }

    private void RunTo(SimTime time)
    {
        while (clock.Now < time)
        {
            cancellation.ThrowIfCancellationRequested();
            steps.Advance(time);
            Look();
        }
    }

    private string States() => string.Join("; ", clients.Select(c => $"client {c.Address} {c.Session.State} {c.Session.EndReason} log {c.Session.LogLength}, {c.Session.UnconfirmedEvents} unjudged"));
}
