using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Threading;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Testing.Running;
using LagSim.Time;

namespace LagSim.Harness.Verification.Harm;

/// <summary>
/// Plays one attack in virtual time, on machines that take as long as their work, and measures how late the other players' worlds are.
/// </summary>
internal sealed class HarmRun
{
    /// <summary>The lag behind real time above which a world is harmed.</summary>
    internal const double MaxLate = 0.25;

    /// <summary>How long an attacker may stay after the first harm, and how long the recovery may take then, in seconds.</summary>
    internal const double MaxSeconds = 2;

    /// <summary>The lag behind real time below which a world has recovered.</summary>
    private const double Back = 0.05;

    private const double LookSeconds = 0.01;
    private const double HonestMilliseconds = 30;
    private const int Attacker = 3;

    private readonly HarmCase drawn;
    private readonly HarmOptions options;
    private readonly CancellationToken cancellation;
    private readonly SeededRandom random;
    private readonly VirtualClock clock = new(SimTime.FromSeconds(10));
    private readonly VirtualSteps steps;
    private readonly List<string> failures = [];
    private readonly List<BodyId> spawned = [];
    private readonly Session[] others;
    private string sentence = "";
    private double late;

    internal HarmRun(HarmCase drawn, HarmOptions options, CancellationToken cancellation)
    {
        this.drawn = drawn;
        this.options = options;
        this.cancellation = cancellation;
        random = new SeededRandom(drawn.Seed).Fork(0xD0);
        VirtualNetwork network = new(clock, drawn.Seed, LinkProfiles.PureDelay(HonestMilliseconds));
        network.SetLink(Attacker, 0, new LinkLeg(drawn.LinkMilliseconds));
        network.SetLink(0, Attacker, new LinkLeg(drawn.LinkMilliseconds));
        steps = new VirtualSteps(network);
        for (int peer = 0; peer <= Attacker; peer++)
        {
            IDatagramPort port = network.CreatePort(peer);
            SkewedClock own = new(clock, random.NextDouble(-30, 30), SimDuration.FromSeconds(random.NextDouble(0, 3600)));
            HostOptions chosen = new() { Cancellation = cancellation, ExpectedClients = Attacker, PlayerBudget = options.Budget };
            steps.Add(
                peer == 0
                    ? new HostSession(drawn.Scene, port, own, chosen, drawn.Seed)
                    : new ClientSession(
                        drawn.Scene.Rules is null ? null : drawn.Scene, // rules are code, which a host does not send
                        port, own, ClientOptions.From(chosen), PeerAddress.Virtual(0), (drawn.Seed * 8) + (ulong)peer),
                port);
        }

        others = [.. steps.Sessions.Take(Attacker)];
        Host.PlayerExpelled += e => sentence += (sentence.Length > 0 ? " " : "") + e.Sentence;
    }

    private HostSession Host => (HostSession)steps.Sessions[0];

    internal HarmOutcome Play()
    {
        SimTime deadline = clock.Now + SimDuration.FromSeconds(60);
        while (steps.Sessions.Any(s => s.State != SessionState.Running) && clock.Now < deadline)
        {
            steps.Advance(deadline);
        }

        if (steps.Sessions.Any(s => s.State != SessionState.Running))
        {
            return new HarmOutcome { Case = drawn, Failures = [$"Not all were in: {string.Join("; ", steps.Sessions.Select(s => $"{s.State} {s.EndReason}"))}"] };
        }

        byte number = steps.Sessions[Attacker].Peer;
        byte[] honest = [.. others.Skip(1).Select(s => s.Peer)];
        steps.WorkPerSecond = options.WorkPerSecond;
        double? isLate = null, isOut = null, isBack = null;
        bool hasGone = false;
        double[] next = [.. others.Select(_ => random.NextDouble())];
        int done = 0;
        SimTime from = clock.Now;
        for (double now = 0; now < HarmCase.Seconds + 1 || (isLate is not null && now < isLate + (2 * MaxSeconds) + 1); now += LookSeconds)
        {
            cancellation.ThrowIfCancellationRequested();
            for (; done < drawn.Actions.Count && drawn.Actions[done].AtSeconds <= now; done++)
            {
                Do(drawn.Actions[done]);
            }

            for (int peer = 0; peer < others.Length; peer++)
            {
                if (next[peer] <= now)
                {
                    next[peer] += random.NextDouble(0.2, 0.8);
                    Try(peer, PlayerAction.SetVelocity(
                        BodyId.OfScene(random.NextInt(drawn.Scene.Bodies.Count)), new Vector3D(random.NextDouble(-1, 1), random.NextDouble(0, 2), random.NextDouble(-1, 1))));
                }
            }

            while (clock.Now < from + SimDuration.FromSeconds(now + LookSeconds))
            {
                steps.Advance(from + SimDuration.FromSeconds(now + LookSeconds));
            }

            double worst = others.Max(Late);
            late = Math.Max(late, worst);
            isLate ??= worst > MaxLate ? now : null;
            hasGone |= Host.Links.All(link => link.Peer != number);
            isOut ??= hasGone ? now : null;
            isBack = worst > Back ? null : isBack ?? now;
        }

        double? outAfter = isLate is double begun && isOut is double end ? Math.Max(0, end - begun) : null;
        double? backAfter = isLate is not null && isOut is double gone && isBack is double back ? Math.Max(0, back - gone) : null;
        foreach (Session ended in others.Where(s => s.State != SessionState.Running))
        {
            failures.Add($"Peer {ended.Peer} is no longer there: {ended.EndReason}");
        }

        if (isLate is not null && !(outAfter <= MaxSeconds))
        {
            failures.Add(outAfter is null ? "The player stayed." : string.Create(CultureInfo.InvariantCulture, $"The player was out {outAfter:0.0} s after worlds were late."));
        }
        else if (isLate is not null && !(backAfter <= MaxSeconds))
        {
            failures.Add(string.Create(CultureInfo.InvariantCulture, $"Worlds were still {others.Max(Late):0.00} s late after the player was out."));
        }

        Settle(number, hasGone && sentence.Length > 0);
        return new HarmOutcome
        {
            Case = drawn,
            LateSeconds = late,
            OutSeconds = outAfter,
            BackSeconds = backAfter,
            IsExpelled = hasGone,
            Sentence = sentence,
            HonestPart = Host.Costs.Where(c => honest.Contains(c.Player))
                .Select(c => c.PeakWork / (options.Budget?.WorkAtOnce ?? double.PositiveInfinity)).DefaultIfEmpty(0).Max(),
            Failures = failures,
        };
    }

    /// <summary>Checks that the worlds agree, that the honest players are still in, and that nothing of the attacker is left.</summary>
    private void Settle(byte attacker, bool isExpelled)
    {
        if (failures.Count > 0)
        {
            return;
        }

        steps.WorkPerSecond = isExpelled ? options.WorkPerSecond : 0;
        steps.RunFor(SimDuration.FromSeconds(2.2)); // the history, and a committed state after it
        foreach (Session session in others)
        {
            if (session.State != SessionState.Running)
            {
                failures.Add($"Peer {session.Peer} is no longer there: {session.EndReason}");
                continue;
            }

            if (session.Counters.StatesDiffered > 0 || session.Counters.EventsLost > 0 || (session.Peer > 0 && session.Counters.StatesAgreed == 0))
            {
                failures.Add($"Of peer {session.Peer}'s states {session.Counters.StatesDiffered} differ, {session.Counters.StatesAgreed} agree, and {session.Counters.EventsLost} events are lost.");
            }

            Simulation world = session.World!.Simulation;
            int left = isExpelled ? Enumerable.Range(0, world.BodyCount).Select(world.BodyAt).Count(b => b.Peer == attacker && world.TryRead(b, world.SimulatedTo, out _)) : 0;
            if (left > 0)
            {
                failures.Add($"In peer {session.Peer}'s world {left} bodies of the player are left.");
            }
        }
    }

    /// <summary>Returns how far behind real time a peer's latest view is, in seconds.</summary>
    private static double Late(Session session) =>
        session.World is null || session.World.RenderedTo >= session.SharedTime.Now ? 0 : (session.SharedTime.Now - session.World.RenderedTo).ToSeconds();

    private void Do(HarmAction action)
    {
        if (action.Spawn >= spawned.Count)
        {
            return;
        }

        ExternalEvent? external = Try(Attacker, action.In(drawn.Scene, n => spawned[n]));
        if (action.Kind == EventKind.Spawn)
        {
            spawned.Add(external?.Body ?? BodyId.OfScene(0));
        }
    }

    private ExternalEvent? Try(int peer, PlayerAction action)
    {
        if (steps.Sessions[peer].State != SessionState.Running)
        {
            return null;
        }

        try
        {
            ExternalEvent external = steps.Sessions[peer].Do(action);
            steps.Wake(peer);
            return external;
        }
        catch (Exception why) when (why is SceneException or InvalidOperationException or SimulationException)
        {
            return null; // not allowed, or not now
        }
    }
}
