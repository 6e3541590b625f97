using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Strategies;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Testing.Running;
using LagSim.Time;

namespace LagSim.Harness.Verification.Check;

/// <summary>Plays a seeded session in virtual time and records what is compared.</summary>
internal sealed class CheckPlay
{
    /// <summary>True time begins this far from its origin, so that no machine's clock reads below zero.</summary>
    private const double Origin = 10;

    /// <summary>The timeout for clients to join and for events to arrive, in seconds. Far longer than the worst link needs.</summary>
    private const double Timeout = 120;

    /// <summary>The longest wait for another peer's clock. Clocks in one session differ by less, except on slow and uneven links.</summary>
    private static readonly SimDuration LongestWait = SimDuration.FromMilliseconds(50);

    private readonly CheckCase drawn;
    private readonly CheckOptions options;
    private readonly CancellationToken cancellation;
    private readonly VirtualRun run;
    private readonly List<CheckMember> members = []; // by address; clients that join late are added when they ask
    private readonly Dictionary<int, PlayerPass> passes = []; // of those who have left
    private readonly BodyId?[] spawned;
    private (double AtSeconds, SimTime Stamp) last = (-1, SimTime.MinValue); // the last action

    internal CheckPlay(CheckCase drawn, CheckOptions options, CancellationToken cancellation)
    {
        this.drawn = drawn;
        this.options = options;
        this.cancellation = cancellation;
        run = new VirtualRun(Origin, drawn.Seed, cancellation);
        run.Steps.BeforeStep = _ => ThrowIfTooMany();
        run.Steps.BetweenSteps = ThrowIfTooMany;
        spawned = new BodyId?[drawn.Actions.Count];
    }

    /// <summary>The peers that have started or asked to join so far, the host first.</summary>
    internal IReadOnlyList<CheckMember> Members => members;

    /// <summary>The host's verdicts on every event.</summary>
    internal HostLog Log { get; } = new();

    private HostSession Host => (HostSession)members[0].Session;

    /// <summary>Plays everything. Returns a sentence if something did not finish.</summary>
    /// <exception cref="TooManyEventsException">It would take more events than it may.</exception>
    internal string? Run(IReadOnlyList<CheckStep> plan)
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

        // In true time, where clock errors do not matter.
        SimTime start = run.Clock.Now + (Host.World!.Simulation.Start - Host.SharedTime.Now);
        foreach (CheckStep step in plan)
        {
            run.AdvanceTo(SimTime.Max(start + SimDuration.FromSeconds(step.AtSeconds), run.Clock.Now));
            Take(step);
        }

        if (!RunUntil(IsSettled))
        {
            return $"Not all had heard of everything {Timeout} s later: {States()}.";
        }

        return members.Find(m => m.Session.State != SessionState.Running && !m.HasGone) is CheckMember ended
            ? $"Peer {ended.Peer} is {ended.Session.State}: {ended.Session.EndReason}"
            : null;
    }

    private void ThrowIfTooMany()
    {
        long events = 0;
        foreach (CheckMember member in members)
        {
            events += member.Session.World?.Simulation.EventsProcessed ?? 0;
        }

        if (events > options.MaxEvents)
        {
            throw new TooManyEventsException();
        }
    }

    private void Take(CheckStep step)
    {
        switch (step.Kind)
        {
            case CheckStepKind.Ask when drawn.Players[step.Index].Returns is not int former || passes.ContainsKey(former):
                Add(step.Index, 0);
                break;
            case CheckStepKind.Leave:
                Leave(step.Index, drawn.Players[step.Index].IsKilled);
                break;
            case CheckStepKind.Stop:
                Stop(step.Index);
                break;
            case CheckStepKind.GoOn:
                GoOn(step.Index);
                break;
            case CheckStepKind.Act:
                Do(step.Index);
                break;
            default:
                break; // the end of the session is reached
        }
    }

    private void Add(int address, int expectedClients)
    {
        CheckPlayer player = drawn.Players[address];
        HostOptions hostOptions = new()
        {
            MaxGivenSpeed = double.PositiveInfinity, // a light ball among heavy ones gets faster than any player may make it
            PlayerBudget = null, // this test is about exactness, at any cost
            Window = new(drawn.History, drawn.LookAhead),
            ExtraHistory = drawn.ExtraHistory,
            RenderedPast = SimDuration.Zero,
            Strategy = LateEventStrategies.OfName(options.Strategy),
            ExpectedClients = expectedClients,
            Timeout = drawn.Visits.Timeout,
            RejoinTime = drawn.Visits.RejoinTime,
            Name = player.Name,
            Cancellation = cancellation,
        };
        (Session session, int number) = run.Open(
            address,
            address == 0 ? null : player.Link,
            player.ClockPartsPerMillion,
            SimDuration.FromSeconds(player.ClockOffsetSeconds),
            (port, clock) => Make(address, port, clock, hostOptions));
        members.Add(new CheckMember(address, player, session, number, Log));
    }

    private Session Make(int address, IDatagramPort port, SkewedClock clock, HostOptions hostOptions)
    {
        Session session = address == 0
            ? new HostSession(drawn.Scene, port, clock, hostOptions, drawn.Seed)
            : new ClientSession(
                null, port, clock,
                ClientOptions.From(hostOptions) with
                {
                    Accelerations = drawn.Accelerations,
                    Rules = drawn.Scene.Rules is SceneRules rules ? [rules] : null,
                    RejoinTime = CheckVisits.UsualRejoinTime, // how long it asks again, not how long the host keeps its place
                    Role = drawn.Players[address].Role,
                    Pass = drawn.Players[address] is { Returns: int former, HasPass: true } ? passes[former] : default,
                },
                VirtualRun.HostAddress, drawn.Seed + (ulong)address);
        options.PrepareSession?.Invoke(address, session);
        return session;
    }

    private void Leave(int address, bool isKilled)
    {
        CheckMember? member = members.Find(m => m.Peer == address);
        if (member is null || member.Session.State != SessionState.Running)
        {
            return; // it had not joined yet, so it stays
        }

        if (isKilled)
        {
            // All datagrams are lost from here on: the host notices by the silence.
            run.Network.SetLink(address, 0, new LinkLeg(0, lossPercent: 100));
            run.Network.SetLink(0, address, new LinkLeg(0, lossPercent: 100));
        }

        member.HasGone = true;
        ClientSession client = (ClientSession)member.Session;
        passes[address] = client.Pass ?? default;
        client.KeepsPlace = drawn.Players[address].KeepsPlace;
        client.Leave();
        run.Steps.Wake(member.Number);
    }

    private void Stop(int address)
    {
        if (members.Find(m => m.Peer == address) is { HasGone: false } member)
        {
            member.IsStopped = true;
            run.Steps.Freeze(member.Number);
        }
    }

    private void GoOn(int address)
    {
        if (members.Find(m => m.Peer == address) is { IsStopped: true } member)
        {
            member.IsStopped = false;
            run.Steps.Thaw(member.Number);
        }
    }

    private void Do(int index)
    {
        CheckAction action = drawn.Actions[index];
        BodyId? body = action.Kind is EventKind.Spawn or EventKind.Command ? default(BodyId)
            : action.Spawn >= 0 ? spawned[action.Spawn]
            : drawn.BodyDrawnAs(action.Body);
        if (body is not BodyId target)
        {
            return; // its body was left out
        }

        CheckMember actor = members.Find(m => drawn.Players[m.Peer].Person(m.Peer) == action.Peer && m.Session.State == SessionState.Running && !m.IsStopped)
            ?? members[0];
        if (actor.IsStopped)
        {
            return; // the player is not in the session
        }

        if (action.Kind == EventKind.Impulse && actor.Session.World!.Simulation.SpecOf(target).Mass != action.Spec.Mass)
        {
            return; // the body is unknown here, or another one has its name: its spawner left before the spawn reached any peer
        }

        if (action.AtSeconds == last.AtSeconds)
        {
            WaitFor(actor, last.Stamp);
        }

        ExternalEvent external = actor.Session.Do(action.On(target));
        last = (action.AtSeconds, external.Time);
        run.Steps.Wake(actor.Number);
        spawned[index] = action.Kind == EventKind.Spawn ? external.Body : null;
    }

    /// <summary>Advances until a peer's clock reads a given time, to the tick. Does nothing if that is far off or past.</summary>
    private void WaitFor(CheckMember actor, SimTime reading)
    {
        SimDuration left = reading - actor.Session.SharedTime.Now;
        while (left > SimDuration.Zero && left < LongestWait && actor.Session.State == SessionState.Running)
        {
            // By less than the remaining time, since the clock may run fast.
            run.AdvanceTo(run.Clock.Now + (left - (left / 16) > SimDuration.OneTick ? left - (left / 16) : SimDuration.OneTick));
            left = reading - actor.Session.SharedTime.Now;
        }
    }

    private bool IsSettled() => members.All(m => m.HasGone || m.Session.State == SessionState.Ended || Log.IsSettled(m.Session));

    private bool RunUntil(Func<bool> isMet) => run.RunUntil(isMet, () => Host.State == SessionState.Ended, Timeout) == WaitEnd.Met;

    private string States() =>
        string.Join("; ", members.Select(m => $"peer {m.Peer} {m.Session.State} {m.Session.EndReason} log {m.Session.LogLength}"));
}
