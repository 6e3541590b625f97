using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using LagSim.Hosting;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Invariant;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Testing.Running;

/// <summary>
/// One run of a <see cref="SessionTest"/>: plays it, then compares every player's worlds with the one that had all accepted events on time.
/// </summary>
internal sealed class SessionRun
{
    /// <summary>The offset of two machines' clocks: up to an hour, and up to 20 millionths fast or slow.</summary>
    private const double ClockSpreadSeconds = 3600;
    private const double ClockDriftPartsPerMillion = 20;

    /// <summary>
    /// How long a client may take to get in, and the last events to reach every player, in seconds; much longer than on the worst of links.
    /// </summary>
    private const double Timeout = 120;

    /// <summary>How long an action may wait for a player whose clock is behind the host's.</summary>
    private static readonly SimDuration ClockTimeout = SimDuration.FromSeconds(1);

    /// <summary>The history to keep: the whole of most tests, and the most that a session keeps.</summary>
    private static readonly SimDuration WholeTimelines = SimDuration.FromSeconds(60);

    private readonly Scene scene;
    private readonly IReadOnlyList<PlannedClient> clients;
    private readonly IReadOnlyList<PlannedAct> acts;
    private readonly ulong seed;
    private readonly Func<int, SessionOptions> options;
    private readonly Action<int, Session>? prepareSession;
    private readonly CancellationToken cancellation;
    private readonly VirtualRun run;
    private readonly SeededRandom clockLuck;
    private readonly Member?[] members; // by number; null for one that has not asked yet
    private readonly HostLog log = new();

    internal SessionRun(
        Scene scene,
        IReadOnlyList<PlannedClient> clients,
        IReadOnlyList<PlannedAct> acts,
        ulong seed,
        Func<int, SessionOptions> options,
        Action<int, Session>? prepareSession,
        CancellationToken cancellation)
    {
        this.scene = scene;
        this.clients = clients;
        this.acts = acts;
        this.seed = seed;
        this.options = options;
        this.prepareSession = prepareSession;
        this.cancellation = cancellation;
        run = new VirtualRun(2 * ClockSpreadSeconds, seed, cancellation);
        clockLuck = new SeededRandom(seed).Fork(0xC10C);
        members = new Member?[clients.Count + 1];
    }

    private HostSession Host => (HostSession)members[0]!.Session;

    private IEnumerable<Member> Members => members.OfType<Member>();

    internal SessionTestResult Play(double seconds)
    {
        SessionTestException? failure = null;
        try
        {
            Connect();
            Act(seconds);
            Settle();
        }
        catch (SessionTestException thrown) when (members[0] is not null && Members.All(member => member.Session.World is not null))
        {
            failure = EndOfAWorld() ?? thrown; // a world that differs explains most other failures, so it is reported first
        }

        SessionTestResult result;
        try
        {
            result = Compare(seconds);
        }
        catch (SessionTestException) when (failure?.InnerException is SimulationException)
        {
            throw failure; // no world gets beyond that
        }

        return failure is not null && result.WorldsAgree ? throw failure : result;
    }

    /// <summary>Which world could not be simulated any further, from where on, and why; of several the host's. Null if none ended so.</summary>
    private SessionTestException? EndOfAWorld()
    {
        if (Members.FirstOrDefault(member => member.Session.Failure is not null) is not Member first)
        {
            return null;
        }

        string who = first.Link is null ? "the host" : $"over '{first.Link.Name}'";
        string when = FormattableString.Invariant($"{(first.Session.World!.Simulation.SimulatedTo - Host.World!.Simulation.Start).ToSeconds():0.###} s");
        string what = $"The world of player {first.Player.Number}, {who}, ended at {when}. {first.Session.EndReason}";
        return new SessionTestException(what, first.Session.Failure!);
    }

    /// <summary>Lets the initial clients in one by one, so that each gets its number, and waits until the world begins.</summary>
    private void Connect()
    {
        int expected = clients.Count(client => client.AsksAtSeconds is null);
        Add(0, expected);
        int joined = 0;
        for (int n = 1; n < members.Length; n++)
        {
            if (clients[n - 1].AsksAtSeconds is null)
            {
                Add(n, 0);
                joined++;
                string what = $"Player {n} was not let in";
                RunUntil(() => Host.ClientCount >= joined, what);
            }
        }

        RunUntil(() => Host.State == SessionState.Running && Members.All(m => m.Session.World is not null), "The world did not begin");
        run.BeginFrames(CountFrame);
    }

    /// <summary>Performs everything that is planned, until the end of the run.</summary>
    private void Act(double seconds)
    {
        SimTime start = run.Clock.Now + (Host.World!.Simulation.Start - Host.SharedTime.Now); // true time
        foreach ((double at, Action act) in Plan(seconds))
        {
            run.AdvanceTo(SimTime.Max(start + SimDuration.FromSeconds(at), run.Clock.Now));
            act();
        }
    }

    /// <summary>Returns everything planned from the start on, in order of time and then of planning.</summary>
    private List<(double At, Action Act)> Plan(double seconds)
    {
        List<(double At, Action Act)> plan = [];
        for (int n = 1; n < members.Length; n++)
        {
            if (clients[n - 1].AsksAtSeconds is double asks)
            {
                int number = n;
                plan.Add((asks, () => Add(number, 0)));
            }
        }

        foreach (PlannedAct act in acts)
        {
            if (act.EverySeconds is not double every)
            {
                plan.Add((act.AtSeconds, () => ActOnce(act)));
                continue;
            }

            for (int n = 0; n * every <= seconds; n++)
            {
                plan.Add((n * every, () => ActIfIn(act)));
            }
        }

        plan.Add((seconds, () => { }));
        return [.. plan.OrderBy(p => p.At)];
    }

    private void ActOnce(PlannedAct act)
    {
        if (members[act.Player] is Member waiting && !waiting.HasEnded)
        {
            SimTime deadline = run.Clock.Now + ClockTimeout;
            while (!waiting.IsRunning && !waiting.HasEnded && run.Clock.Now < deadline)
            {
                run.Advance(deadline);
            }
        }

        if (members[act.Player] is not { IsRunning: true } member)
        {
            string when = FormattableString.Invariant($"at {act.AtSeconds:0.######} s");
            string why = members[act.Player] is not Member there ? "has not asked to join yet"
                : there.Player.HasLeft ? "has left"
                : $"is {there.State}";
            throw new SessionTestException($"Player {act.Player} cannot act {when}: it {why}.");
        }

        act.Act(member.Player);
    }

    private void ActIfIn(PlannedAct act)
    {
        if (members[act.Player] is { IsRunning: true } member)
        {
            act.Act(member.Player);
        }
    }

    private void Settle()
    {
        run.EndFrames(); // the watched session has ended
        RunUntil(() => Members.All(m => m.Player.HasLeft || log.IsSettled(m.Session)), "Not every player had heard of everything");
    }

    private void Add(int number, int expectedClients)
    {
        PlannedClient? client = number == 0 ? null : clients[number - 1];
        SessionOptions chosen = options(number)
            ?? throw new SessionTestException($"There are no session options for player {number}: what WithOptions got returned null.");
        chosen = chosen with
        {
            Cancellation = cancellation,
            ExtraHistory = chosen is { Contacts: null, Crossings: null, Losses: null, RuleNotices: null } ? WholeTimelines : chosen.ExtraHistory,
        };
        SeededRandom luck = clockLuck.Fork((ulong)number);
        double drift = luck.NextDouble(-ClockDriftPartsPerMillion, ClockDriftPartsPerMillion);
        SimDuration apart = SimDuration.FromSeconds(luck.NextDouble(-ClockSpreadSeconds, ClockSpreadSeconds));
        (Session session, int place) = run.Open(
            number,
            client?.Link,
            drift,
            apart + (client?.Link.ReceiverClockOffset ?? SimDuration.Zero),
            (port, own) => number == 0
                ? new HostSession(scene, port, own, HostsOf(chosen, expectedClients), seed)
                : new ClientSession(null, port, own, ClientsOf(chosen), VirtualRun.HostAddress, seed + (ulong)number));
        prepareSession?.Invoke(number, session);
        members[number] = new Member(client?.Link, session, new TestPlayer(number, session, () => run.Steps.Wake(place)), log);
    }

    private HostOptions HostsOf(SessionOptions chosen, int expectedClients)
    {
        HostOptions options = HostOptions.From(chosen);
        SimDuration least = StartLead();
        return options with { ExpectedClients = expectedClients, StartLead = options.StartLead < least ? least : options.StartLead };
    }

    private ClientOptions ClientsOf(SessionOptions chosen)
    {
        ClientOptions options = ClientOptions.From(chosen);
        return options with
        {
            Accelerations = options.Accelerations ?? scene.Accelerations,
            Rules = options.Rules ?? (scene.Rules is SceneRules rules ? new[] { rules } : null),
        };
    }

    /// <summary>A lead long enough for every initial client to receive the start in time, unless much is lost.</summary>
    private SimDuration StartLead()
    {
        double worst = clients.Select(client => OneWay(client.Link.FromHost)).DefaultIfEmpty(0).Max();
        return SimDuration.FromMilliseconds(Math.Min(60_000, 500 + (2 * worst)));
    }

    private static double OneWay(LinkLeg leg) => leg.DelayMilliseconds
        + (4 * leg.JitterMilliseconds)
        + (leg.Tail is null ? 0 : LongTail.MaxMilliseconds)
        + (leg.Bottleneck?.QueueMilliseconds ?? 0)
        + (leg.Outage?.Length.ToMilliseconds() ?? 0);

    private void RunUntil(Func<bool> isMet, string what)
    {
        WaitEnd end = run.RunUntil(isMet, () => Members.Any(m => m.HasEnded && !m.Player.HasLeft), Timeout);
        if (end != WaitEnd.Met)
        {
            string after = end == WaitEnd.TimedOut ? FormattableString.Invariant($" within {Timeout} s of virtual time") : "";
            string states = string.Join("; ", Members.Select(m => $"player {m.Player.Number} is {m.State}"));
            throw new SessionTestException($"{what}{after}: {states}.");
        }
    }

    private void CountFrame()
    {
        foreach (Member member in Members)
        {
            member.CountFrame();
        }
    }

    private SessionTestResult Compare(double seconds)
    {
        // As far as any world has got, and as long as requested.
        SimTime start = Host.World!.Simulation.Start;
        SimTime end = start + SimDuration.FromSeconds(seconds);
        foreach (Member member in Members)
        {
            end = member.Session.World is null ? end : SimTime.Max(end, member.Session.World.Simulation.SimulatedTo);
            end = member.Trace.Wrong.Aggregate(end, (latest, world) => SimTime.Max(latest, world.SimulatedTo));
        }

        Simulation alone;
        try
        {
            alone = log.Replay(scene, new SimulationOptions(start, SimDuration.MaxValue, cancellation: cancellation), end);
        }
        catch (SimulationException thrown)
        {
            throw new SessionTestException(
                $"The session cannot be checked: its world, played once more without delay and with all of it as history, ended. {thrown.Message}", thrown);
        }

        bool hasFailed = Members.Any(member => member.Session.Failure is not null); // then worlds hold what the host has not judged, as that of who is out does
        Comparison comparison = new(alone);
        foreach (Member member in Members)
        {
            int number = member.Player.Number;
            member.Trace.CompareCommitted(number, comparison);
            member.Trace.CompareWrong(number, comparison);
            if (!member.Player.HasLeft && !member.HasEnded && !hasFailed && member.Session.World is LiveWorld world)
            {
                comparison.Take(number, world.Simulation);
            }
        }

        PlayerResult[] players = [.. Members.Select(m => m.ToResult(run.Network.Traffic(m.Player.Number)))];
        return new SessionTestResult(alone, seed, seconds, comparison, players, NoPromise())
        {
            EventsAccepted = log.Accepted.Count,
            EventsRefused = log.Refused,
            EventsTooLate = log.TooLate,
            EventsMoved = log.Moved,
        };
    }

    /// <summary>A sentence if a strategy promises no agreement; otherwise null.</summary>
    private string? NoPromise() => Members.FirstOrDefault(m => !m.Session.PromisesAgreement) is Member without
        ? $"Not every player promises agreement: player {without.Player.Number} has a strategy that leaves late events as they are."
        : null;

    /// <summary>The state of one player during the run.</summary>
    private sealed class Member
    {
        internal Member(LinkProfile? link, Session session, TestPlayer player, HostLog log)
        {
            Link = link;
            Session = session;
            Player = player;
            Trace = new SessionTrace(session, log);
        }

        internal LinkProfile? Link { get; }

        internal Session Session { get; }

        internal TestPlayer Player { get; }

        /// <summary>The recorded states and worlds.</summary>
        internal SessionTrace Trace { get; }

        internal long Frames { get; private set; }

        internal long StalledFrames { get; private set; }

        internal bool IsRunning => Session.State == SessionState.Running && !Player.HasLeft;

        internal bool HasEnded => Session.State == SessionState.Ended;

        internal string State => HasEnded ? $"out: {Session.EndReason?.TrimEnd('.')}" : Session.State.ToString().ToLowerInvariant();

        internal PlayerResult ToResult(PortTraffic traffic) =>
            new(Player.Number, Link, Session, traffic, Frames, StalledFrames, Session is ClientSession ? Trace.Lost : 0);

        internal void CountFrame()
        {
            if (Session.World is null || Player.HasLeft || Session.SharedTime.Now < Session.World.Simulation.Start)
            {
                return; // nothing to be seen yet, or no viewer
            }

            Frames++;
            StalledFrames += Session.World.RenderSnapshots.Latest().Covers(Session.DisplayTime) ? 0 : 1;
        }
    }
}
