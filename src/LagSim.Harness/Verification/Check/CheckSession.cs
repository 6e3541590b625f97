using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Threading;
using LagSim.Events;
using LagSim.Harness.Reports;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Strategies;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing.Invariant;
using LagSim.Testing.Links;
using LagSim.Testing.Running;
using LagSim.Time;

namespace LagSim.Harness.Verification.Check;

/// <summary>Plays one drawn session in virtual time, and holds every peer's world against that of a peer that never had a delay.</summary>
internal sealed class CheckSession
{
    /// <summary>What a clock of a machine reads at least: true time begins this far from its origin.</summary>
    private const double Origin = 10;

    /// <summary>How long peers may take to get in, and the events to get everywhere, in seconds; much longer than on the worst of links.</summary>
    private const double Timeout = 120;

    /// <summary>Clocks of one session are not further apart, but on slow and uneven ways.</summary>
    private static readonly SimDuration LongestWait = SimDuration.FromMilliseconds(50);

    private readonly CheckCase drawn;
    private readonly CheckOptions options;
    private readonly CancellationToken cancellation;
    private readonly VirtualClock clock = new(SimTime.FromSeconds(Origin));
    private readonly VirtualNetwork network;
    private readonly VirtualSteps steps;
    private readonly List<Member> members = []; // by address; clients that come late are added when they ask
    private readonly List<ExternalEvent> accepted = [];
    private readonly List<uint> acceptedEntries = [];
    private readonly BodyId?[] spawned;
    private (double AtSeconds, SimTime Stamp) last = (-1, SimTime.MinValue); // what was done last
    private long tooLate;
    private long refused;

    private CheckSession(CheckCase drawn, CheckOptions options, CancellationToken cancellation)
    {
        this.drawn = drawn;
        this.options = options;
        this.cancellation = cancellation;
        network = new VirtualNetwork(clock, drawn.Seed);
        steps = new VirtualSteps(network);
        spawned = new BodyId?[drawn.ScriptedActions.Count];
    }

    private HostSession Host => (HostSession)members[0].Session;

    /// <summary>Plays the session that the seed draws, or what the options keep of it.</summary>
    /// <exception cref="OperationCanceledException">It was asked to stop before the end: there is no outcome.</exception>
    internal static CheckOutcome Play(ulong seed, CheckOptions options, CancellationToken cancellation)
    {
        CheckCase drawn = new(seed, options, cancellation);
        using CancellationTokenSource stop = CancellationTokenSource.CreateLinkedTokenSource(cancellation); // the token of all sessions would keep these peers
        return new CheckSession(drawn, options, stop.Token).Play();
    }

    private CheckOutcome Play()
    {
        CheckOutcome outcome = new() { Seed = drawn.Seed, Bodies = drawn.BodyIndices, ScriptedActions = drawn.ActionIndices };
        try
        {
            string? failure = Run();
            return failure is null ? Compare(outcome) : outcome with { Failure = failure, Peers = members.Count, TooLateEvents = tooLate };
        }
        catch (Exception thrown) when (thrown is not OperationCanceledException and not OutOfMemoryException)
        {
            return outcome with { Failure = $"{thrown.GetType().Name}: {thrown.Message}", Peers = members.Count, TooLateEvents = tooLate };
        }
    }

    /// <summary>Lets everything happen; a sentence if something came to no end.</summary>
    private string? Run()
    {
        int expectedClients = drawn.Players.Skip(1).Count(p => p.AsksAtSeconds is null);
        for (int peer = 0; peer < drawn.Players.Count; peer++)
        {
            if (peer == 0 || drawn.Players[peer].AsksAtSeconds is null)
            {
                Add(peer, expectedClients);
            }
        }

        if (!RunUntil(() => members.All(m => m.Session.World is not null) && Host.State == SessionState.Running))
        {
            return $"Not all were in after {Timeout} s: {States()}.";
        }

        SimTime start = clock.Now + (Host.World!.Simulation.Start - Host.SharedTime.Now); // true time; the clocks' errors do not matter here
        foreach ((double at, Action action) in Plan())
        {
            SimTime when = SimTime.Max(start + SimDuration.FromSeconds(at), clock.Now);
            while (clock.Now < when)
            {
                Advance(when);
            }

            action();
        }

        if (!RunUntil(IsSettled))
        {
            return $"Not all had heard of everything {Timeout} s later: {States()}.";
        }

        return members.FirstOrDefault(m => m.Session.State != SessionState.Running && !m.HasGone) is Member ended
            ? $"Peer {ended.Peer} is {ended.Session.State}: {ended.Session.EndReason}"
            : null;
    }

    /// <summary>All that is to happen from the start on, in order.</summary>
    private List<(double At, Action Action)> Plan()
    {
        List<(double At, Action Action)> plan = [];
        for (int peer = 1; peer < drawn.Players.Count; peer++)
        {
            int address = peer;
            CheckPlayer player = drawn.Players[peer];
            if (player.AsksAtSeconds is double asks)
            {
                plan.Add((asks, () => Add(address, 0)));
            }

            if (player.LeavesAtSeconds is double leaves)
            {
                plan.Add((leaves, () => Go(address, player.IsKilled)));
            }
        }

        for (int peer = 0; peer < drawn.Players.Count; peer++)
        {
            int address = peer;
            if (drawn.Players[peer].Stop is (double at, double seconds))
            {
                plan.Add((at, () => Stop(address)));
                plan.Add((at + seconds, () => GoOn(address)));
            }
        }

        foreach (int index in drawn.ActionIndices)
        {
            plan.Add((drawn.ScriptedActions[index].AtSeconds, () => Do(index)));
        }

        plan.Add((CheckCase.Length, () => { }));
        return [.. plan.OrderBy(p => p.At)]; // stable: scripted actions of one instant in the order in which they were drawn
    }

    private void Add(int address, int expectedClients)
    {
        CheckPlayer player = drawn.Players[address];
        if (address > 0)
        {
            network.Connect(address, 0, player.Link);
        }

        IDatagramPort port = network.CreatePort(address);
        SkewedClock own = new(clock, player.ClockPartsPerMillion, SimDuration.FromSeconds(player.ClockOffsetSeconds));
        HostOptions hostOptions = new()
        {
            MaxGivenSpeed = double.PositiveInfinity, // a light ball among heavy ones gets faster than any player may make it
            PlayerBudget = null, // it is about bits, however dear
            Window = new(drawn.History, drawn.LookAhead),
            ExtraHistory = drawn.ExtraHistory,
            RenderedPast = SimDuration.Zero,
            Strategy = LateEventStrategies.OfName(options.Strategy),
            ExpectedClients = expectedClients,
            Timeout = SimDuration.FromSeconds(20), // several times the slowest round trip
            Cancellation = cancellation,
        };
        Session session = address == 0
            ? new HostSession(drawn.Scene, port, own, hostOptions, drawn.Seed)
            : new ClientSession(
                null, port, own, ClientOptions.From(hostOptions) with { Accelerations = drawn.Accelerations }, PeerAddress.Virtual(0),
                drawn.Seed + (ulong)address);
        options.PrepareSession?.Invoke(address, session);
        Member member = new(address, session, steps.Add(session, port));
        members.Add(member);
        void Watch()
        {
            Simulation simulation = session.World!.Simulation;
            if (player.IndexAbove is int bodies)
            {
                simulation.Engine.UseListsAbove(bodies);
            }

            member.Heals.Add(new HealImpacts(simulation, report => report.From < session.SharedTime.Now));
        }
        session.Begun += Watch;
        session.Renewed += _ => Watch();
        session.StateCommitted += member.Committed.Add;
        if (session is ClientSession client)
        {
            member.Coverage = new LogCoverage(_ => acceptedEntries);
            member.Coverage.Follow(client);
            client.Interrupted += _ =>
            {
                // What is repaired still counts: the world as it was is held against the one that never had a delay.
                if (client.Counters.StatesDiffered > 0)
                {
                    member.Wrong.Add(client.World!.Simulation);
                }
            };
        }

        if (address == 0)
        {
            session.Logged += Log;
        }
    }

    private void Log(LogEntry entry)
    {
        switch (entry.Verdict)
        {
            case Verdict.Accepted:
                accepted.Add(entry.Event);
                acceptedEntries.Add(entry.Index);
                break;
            case Verdict.TooLate:
                tooLate++;
                break;
            default:
                refused++;
                break;
        }
    }

    private void Go(int address, bool isKilled)
    {
        Member? member = members.Find(m => m.Peer == address);
        if (member is null || member.Session.State != SessionState.Running)
        {
            return; // it had not come in yet; so it stays
        }

        if (isKilled)
        {
            // Nothing gets through any more: the host finds out by its silence.
            network.SetLink(address, 0, new LinkLeg(0, lossPercent: 100));
            network.SetLink(0, address, new LinkLeg(0, lossPercent: 100));
        }

        member.HasGone = true;
        member.Session.Leave();
        steps.Wake(member.Number);
    }

    private void Stop(int address)
    {
        if (members.Find(m => m.Peer == address) is { HasGone: false } member)
        {
            member.IsStopped = true;
            steps.Freeze(member.Number);
        }
    }

    private void GoOn(int address)
    {
        if (members.Find(m => m.Peer == address) is { IsStopped: true } member)
        {
            member.IsStopped = false;
            steps.Thaw(member.Number);
        }
    }

    private void Do(int index)
    {
        CheckAction scripted = drawn.ScriptedActions[index];
        BodyId? body = scripted.Kind == EventKind.Spawn ? default(BodyId) : scripted.Spawn >= 0 ? spawned[scripted.Spawn] : drawn.BodyDrawnAs(scripted.Body);
        if (body is not BodyId target)
        {
            return; // to a body that was left out
        }

        Member actor = members.Find(m => m.Peer == scripted.Peer && m.Session.State == SessionState.Running && !m.IsStopped) ?? members[0];
        if (actor.IsStopped)
        {
            return; // nobody is there to do it
        }

        if (scripted.Kind == EventKind.Impulse && actor.Session.World!.Simulation.SpecOf(target).Mass != scripted.Spec.Mass)
        {
            return; // it has not heard of the body, or of another of that name: who spawned it went before anybody heard of it
        }

        if (scripted.AtSeconds == last.AtSeconds)
        {
            WaitFor(actor, last.Stamp);
        }

        ExternalEvent external = actor.Session.Do(scripted.On(target));
        last = (scripted.AtSeconds, external.Time);
        steps.Wake(actor.Number);
        spawned[index] = scripted.Kind == EventKind.Spawn ? external.Body : null;
    }

    /// <summary>Lets time pass until a peer's clock reads that, to the tick; not if that is far off, or past.</summary>
    private void WaitFor(Member actor, SimTime reading)
    {
        SimDuration left = reading - actor.Session.SharedTime.Now;
        while (left > SimDuration.Zero && left < LongestWait && actor.Session.State == SessionState.Running)
        {
            // By less than what is left: the clock may run fast.
            SimTime next = clock.Now + (left - (left / 16) > SimDuration.OneTick ? left - (left / 16) : SimDuration.OneTick);
            while (clock.Now < next)
            {
                Advance(next);
            }

            left = reading - actor.Session.SharedTime.Now;
        }
    }

    private bool IsSettled()
    {
        foreach (Member member in members)
        {
            bool isOut = member.HasGone || member.Session.State == SessionState.Ended;
            if (!isOut && (member.Session.State != SessionState.Running || member.Session.LogLength != Host.LogLength
                || member.Session is ClientSession { UnconfirmedEvents: > 0 }))
            {
                return false;
            }
        }

        return true;
    }

    private bool RunUntil(Func<bool> isSo)
    {
        SimTime deadline = clock.Now + SimDuration.FromSeconds(Timeout);
        while (!isSo())
        {
            if (clock.Now >= deadline || Host.State == SessionState.Ended)
            {
                return false;
            }

            Advance(deadline);
        }

        return true;
    }

    private void Advance(SimTime limit)
    {
        cancellation.ThrowIfCancellationRequested();
        steps.Advance(limit);
    }

    private CheckOutcome Compare(CheckOutcome outcome)
    {
        List<Member> there = members.FindAll(m => !m.HasGone);
        SimTime end = members.Where(m => m.Session.World is not null).Max(m => m.Session.World!.Simulation.SimulatedTo);
        SimTime start = Host.World!.Simulation.Start;
        SimulationOptions usual = new(start, SimDuration.MaxValue, cancellation: cancellation, threads: 1);
        Simulation alone = new(drawn.Scene, options.PrepareAlone(usual)); // no step of it is taken ahead; peers may
        foreach (ExternalEvent external in accepted)
        {
            alone.Submit(external);
        }

        alone.AdvanceTo(end);
        Comparison comparison = new(alone);
        foreach (Member member in members)
        {
            member.Committed.ForEach(state => comparison.Take(member.Peer, state));
        }

        foreach (Member member in members)
        {
            member.Wrong.ForEach(world => comparison.Take(member.Peer, world));
        }

        foreach (Member member in there)
        {
            comparison.Take(member.Peer, member.Session.World!.Simulation);
        }

        long lost = members.Sum(m => m.Coverage?.Count().Lost ?? m.Session.Counters.EventsLost);
        bool mayBeRefused = drawn.HasFullLinks || drawn.HasStops; // who could not be heard in time is refused, and knows it
        string? failure = comparison.Differing > 0 ? string.Create(CultureInfo.InvariantCulture, $"{comparison.Differing} of {comparison.Compared} compared"
            + $" states and events differ. {comparison.FirstHash}").TrimEnd()
            : lost > 0 ? $"{NumberText.Count(lost, "accepted event was", many: "accepted events were")} lost."
            : tooLate > 0 && !mayBeRefused ? $"{NumberText.Count(tooLate, "event was", many: "events were")} too late."
            : members.Sum(m => m.Session.Counters.StatesDiffered) > 0 ? "A client's committed state was not what the host said."
            : null;
        return outcome with
        {
            Peers = members.Count,
            Events = members.Sum(m => m.Session.World?.Simulation.EventsProcessed ?? 0),
            ExternalEvents = accepted.Count,
            TiedEvents = Tied(),
            LateEvents = members.Sum(m => m.Session.Counters.Lateness.Count(late => late > SimDuration.Zero)),
            Heals = members.Sum(m => m.Heals.Sum(h => h.Heals)),
            HealsThatChangedAnImpact = members.Sum(m => m.Heals.Sum(h => h.Changed)),
            EventsRerun = members.Sum(m => m.Heals.Sum(h => h.Events)),
            Impacts = alone.ImpactsProcessed,
            Met = SceneFeatures.Of(alone, accepted, drawn.StepsAhead),
            TooLateEvents = tooLate + lost,
            LostEvents = lost,
            RefusedEvents = refused,
            HasFullLinks = drawn.HasFullLinks,
            HasStops = drawn.HasStops,
            Copies = members.Sum(m => m.Session.Counters.Renewals),
            LateClients = members.Count(m => drawn.Players[m.Peer].AsksAtSeconds is not null && m.Session.World is not null),
            Leavers = members.Count(m => m.HasGone),
            Compared = comparison.Compared,
            DifferingBits = comparison.Differing,
            Failure = failure,
            Difference = comparison.First,
        };
    }

    /// <summary>How many accepted events have the stamp of another.</summary>
    private int Tied() => accepted.GroupBy(e => e.Time).Where(g => g.Skip(1).Any()).Sum(g => g.Count());

    private string States() => string.Join("; ", members.Select(m => $"peer {m.Peer} {m.Session.State} {m.Session.EndReason} log {m.Session.LogLength}"));

    /// <summary>One peer of the session as it goes on.</summary>
    private sealed class Member(int peer, Session session, int number)
    {
        /// <summary>Its address, and its index among the players that were drawn.</summary>
        internal int Peer { get; } = peer;

        internal Session Session { get; } = session;

        /// <summary>Its number among those that are stepped.</summary>
        internal int Number { get; } = number;

        /// <summary>What healing did in each of its worlds.</summary>
        internal List<HealImpacts> Heals { get; } = [];

        /// <summary>What of the host's log came to it; null for the host.</summary>
        internal LogCoverage? Coverage { get; set; }

        internal List<CommittedState> Committed { get; } = [];

        /// <summary>Its worlds that turned out to differ, and were replaced.</summary>
        internal List<Simulation> Wrong { get; } = [];

        internal bool HasGone { get; set; }

        /// <summary>Whether its process stands still.</summary>
        internal bool IsStopped { get; set; }
    }
}
