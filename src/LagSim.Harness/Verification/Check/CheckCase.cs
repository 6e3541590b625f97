using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Verification.Check;

/// <summary>One seeded session: scene, players, links, clocks, when players join and leave, and their actions.</summary>
/// <remarks>Depends only on the seed and on the peers and profile in the options. Leaving a part out changes nothing else.</remarks>
internal sealed class CheckCase
{
    /// <summary>How long players act, in seconds of shared time.</summary>
    internal const double Length = 10;

    private const int FewestActions = 27;
    private const int MaxSpawns = 6;
    private const int MaxRemovals = 3;

    /// <summary>The round trip above which a player is usually in from the start, since joining takes several.</summary>
    private const double SlowMilliseconds = 500;

    private const double HeapPercent = 7;
    private const double BoxPercent = 4;
    private const double OrbitPercent = 6;
    private const double PitPercent = 27; // a third, counting heaps on an open floor

    /// <summary>The most peers of a scene with heaps, where every step is an event in every world.</summary>
    private const int MaxPeersOfHeap = 3;

    private const double FullLinkPercent = 25;
    private const double SensorPercent = 30;

    /// <summary>
    /// The lowest rate of links, in bit/s. The traffic of a seeded session fits into 64 kbit/s with all repeats. A fifth of that shows a
    /// controller that never backs off: of 900 sessions at 12 to 64 kbit/s, one made so keeps a player out or loses one in 12. No other
    /// session should.
    /// </summary>
    private const double LowestRate = 12e3;
    private const double HighestRate = 10e6;
    private const double StopPercent = 15;
    private const double LongestEntry = 30; // seconds from the first request to the world: six round trips of 4 s, and losses

    /// <summary>
    /// The percentage of peers with neighbour lists, most of them from the first body on, the others once spawns were added.
    /// </summary>
    private const double IndexPercent = 50;
    private const double FromTheFirstPercent = 70;
    private const int LatestIndex = 24;

    private const ulong SortStream = 3;
    private const ulong TroubleStream = 4;
    private const ulong IndexStream = 5;
    private const ulong SensorStream = 15;
    private const ulong RuleStream = 8;
    private const ulong FilterStream = 29;
    private const ulong MeetingStream = 272;
    private const ulong VisitStream = 34;
    private const ulong FirstRoom = 100;
    private const ulong FirstHands = 1000;
    private const ulong MaxAttempts = 20;

    /// <summary>
    /// The usual budget of a scene, in events that it takes alone. Persistent contact takes some thousand a second, so a few heaps would
    /// take most of the time. A scene over budget is drawn again, and contacts last a second or two in all except in a few sessions.
    /// </summary>
    private const long UsualEvents = 1_500;
    private const long HeavyEvents = 6_000;
    private const double HeavyPercent = 1;

    private readonly bool isHeap;
    private readonly CheckScene room;
    private readonly CheckFilters filters;
    private readonly CheckRules rules;
    private readonly List<CheckPlayer> players = [];
    private readonly List<CheckAction> actions = [];

    /// <exception cref="OperationCanceledException">The run was cancelled.</exception>
    internal CheckCase(ulong seed, CheckOptions options, CancellationToken cancellation = default)
    {
        Seed = seed;
        SeededRandom random = new(seed);
        double sort = random.Fork(SortStream).NextDouble() * 100; // a stream of its own, so that all other sessions stay the same
        bool isPit = sort >= 100 - PitPercent;
        isHeap = sort < HeapPercent || isPit;
        DrawPlayers(random.Fork(1), options);
        DrawTrouble(random.Fork(TroubleStream), options);
        DrawIndexes(random.Fork(IndexStream));
        bool isOrbit = !isHeap && sort >= HeapPercent + BoxPercent && sort < HeapPercent + BoxPercent + OrbitPercent;
        filters = new CheckFilters(random.Fork(FilterStream), mayExist: !isOrbit); // what passes through a sphere that pulls ends in its centre
        rules = new CheckRules(random.Fork(RuleStream), random.Fork(VisitStream), seed, options.Rules);
        SeededRandom rest = random.Fork(2);
        long budget = rest.IsLucky(HeavyPercent) ? HeavyEvents : UsualEvents;
        for (ulong attempt = 0; ; attempt++)
        {
            SeededRandom things = random.Fork(FirstRoom + (2 * attempt));
            room = isPit ? new PitScene(things)
                : sort < HeapPercent ? new HeapScene(things)
                : sort < HeapPercent + BoxPercent ? new BoxScene(things)
                : sort < HeapPercent + BoxPercent + OrbitPercent ? new OrbitScene(things)
                : new RoomScene(things);
            DrawActions(random.Fork(FirstRoom + (2 * attempt) + 1));
            CheckHands.AddTo(actions, room, players.Count, random.Fork(FirstHands + attempt));
            filters.AddTo(actions, room, players.Count, attempt);
            rules.AddTo(actions, room, players.Count, attempt);
            CheckMeetings.AddTo(actions, room, players.Count, random.Fork(MeetingStream), attempt);
            if (attempt == MaxAttempts || IsWithin(room.MaxEvents ?? budget, cancellation))
            {
                break;
            }
        }

        SeededRandom sensed = random.Fork(SensorStream);
        if (room is not BoxScene && sensed.IsLucky(SensorPercent))
        {
            room.Sensors = new CheckSensors(sensed, room.BodyCount); // after its events are counted, so that all else that is drawn stays the same
        }

        Visits.AddTo(players); // after their actions, which a player that comes back goes on with
        LookAhead = SimDuration.FromMilliseconds(rest.Pick(1000.0 / 30, 100, 250));

        // Compares everything since the start, or only what a session keeps by default.
        ExtraHistory = rest.IsLucky(50) ? SimDuration.FromSeconds(60) : SimDuration.Zero;
        BodyIndices = options.Bodies ?? Enumerable.Range(0, room.BodyCount).ToArray();
        ActionIndices = options.Events ?? Enumerable.Range(0, actions.Count).ToArray();
        Throw(BodyIndices, room.BodyCount, "bodies", seed);
        Throw(ActionIndices, actions.Count, "events", seed);
        Scene = rules.On(filters.On(room.Build(BodyIndices), BodyIndices));
        Accelerations = CheckScene.Accelerations;
        double worst = players.Max(p => WorstMilliseconds(p.Link.ToHost));

        // The delay, what a burst of losses adds to it, and the clock error on a slow or uneven link.
        History = options.History ?? SimDuration.FromMilliseconds(Math.Min(5000, 1000 + (2 * worst)));
    }

    internal ulong Seed { get; }

    internal Scene Scene { get; }

    internal IReadOnlyList<IAcceleration> Accelerations { get; }

    /// <summary>The host, and the clients in the order of their addresses.</summary>
    internal IReadOnlyList<CheckPlayer> Players => players;

    /// <summary>Who of them is heard of by rules, leaves and comes back.</summary>
    internal CheckVisits Visits => rules.Visits;

    /// <summary>Whether any link has a rate, so that events may wait in its queue or be dropped.</summary>
    internal bool HasFullLinks => players.Exists(p => p.Link.ToHost.Bottleneck is not null || p.Link.FromHost.Bottleneck is not null);

    /// <summary>Whether any process stalls.</summary>
    internal bool HasStops => players.Exists(p => p.Stop is not null);

    /// <summary>All drawn actions, in order of time.</summary>
    internal IReadOnlyList<CheckAction> Actions => actions;

    /// <summary>The indices of the scene's bodies that are played.</summary>
    internal IReadOnlyList<int> BodyIndices { get; }

    /// <summary>The indices of the actions that are played.</summary>
    internal IReadOnlyList<int> ActionIndices { get; }

    internal SimDuration History { get; }

    internal SimDuration ExtraHistory { get; }

    internal SimDuration LookAhead { get; }

    /// <summary>The number of contact steps that the session takes with all actions; the same on any machine.</summary>
    internal long ContactSteps { get; private set; }

    /// <summary>Finds the body that had an index when it was drawn; null if it is left out.</summary>
    internal BodyId? BodyDrawnAs(int index)
    {
        for (int i = 0; i < BodyIndices.Count; i++)
        {
            if (BodyIndices[i] == index)
            {
                return BodyId.OfScene(i);
            }
        }

        return null;
    }

    private static double WorstMilliseconds(LinkLeg leg) =>
        leg.DelayMilliseconds + (leg.Bottleneck?.QueueMilliseconds ?? 0) + (4 * leg.JitterMilliseconds)
        + (leg.Tail is null ? 0 : LongTail.MaxMilliseconds) + ((leg.Outage?.Length.ToMilliseconds() ?? 0) * 1.1);

    private static void Throw(IReadOnlyList<int> indices, int count, string what, ulong seed)
    {
        for (int i = 0; i < indices.Count; i++)
        {
            if (indices[i] < 0 || indices[i] >= count || (i > 0 && indices[i] <= indices[i - 1]))
            {
                throw new ArgumentException(
                    $"The {what} '{string.Join(',', indices)}' must be ascending numbers from 0 to {count - 1}: session {seed} has {count}.");
            }
        }
    }

    private void DrawPlayers(SeededRandom random, CheckOptions options)
    {
        int most = isHeap ? Math.Clamp(MaxPeersOfHeap, options.FromPeers, options.ToPeers) : options.ToPeers;
        int peers = options.FromPeers + random.NextInt(most - options.FromPeers + 1);
        players.Add(Player(random, LinkProfiles.PureDelay(0), null, null, false));
        for (int peer = 1; peer < peers; peer++)
        {
            LinkProfile link = DrawLink(random, options);
            double slowest = link.RoundTripMilliseconds;
            bool isLate = random.IsLucky(slowest > SlowMilliseconds ? 10 : 35);
            double? asks = isLate ? random.NextDouble() * (slowest > SlowMilliseconds ? 1 : 6) : null;
            double? leaves = random.IsLucky(15) ? random.NextDouble(Math.Min(9, 2 + (asks ?? 0)), 9.5) : null;
            players.Add(Player(random, link, asks, leaves, random.IsLucky(40)));
        }

        // A player that leaves in order frees its number, which another player may get.
        if (players.FirstOrDefault(p => p.LeavesAtSeconds is not null && !p.IsKilled) is CheckPlayer left)
        {
            LinkProfile link = DrawLink(random, options);
            if (link.RoundTripMilliseconds <= SlowMilliseconds)
            {
                players.Add(Player(random, link, left.LeavesAtSeconds + random.NextDouble(), null, false));
            }
        }
    }

    /// <summary>
    /// Gives links rates and queues and stalls a process, in some sessions. Drawn from a stream of its own, so that all others stay the
    /// same.
    /// </summary>
    private void DrawTrouble(SeededRandom random, CheckOptions options)
    {
        SeededRandom ofLinks = random.Fork(1);
        if (ofLinks.IsLucky(FullLinkPercent) && options.Profile is null)
        {
            for (int peer = 1; peer < players.Count; peer++)
            {
                players[peer] = ofLinks.IsLucky(60) ? players[peer] with { Link = DrawFullLink(ofLinks) } : players[peer];
            }
        }

        SeededRandom ofStops = random.Fork(2);
        if (ofStops.IsLucky(StopPercent))
        {
            int who = ofStops.IsLucky(30) ? 0 : ofStops.NextInt(players.Count);
            double at = ofStops.NextDouble(0.5, 8), seconds = LogUniform(ofStops, 0.1, 40);
            players[who] = players[who] with { Stop = (at, seconds) };
            for (int peer = 1; peer < players.Count && who == 0; peer++)
            {
                players[peer] = players[peer].AsksAtSeconds is double asks ? players[peer] with { AsksAtSeconds = AskOf(asks, players[0]) } : players[peer];
            }
        }
    }

    /// <summary>When a player asks to join that would at a given time: after a stall of the host, since one that is joining then gives up, and is right to.</summary>
    internal static double AskOf(double atSeconds, CheckPlayer host) =>
        host.Stop is (double at, double seconds) && atSeconds > at - LongestEntry && atSeconds < at + seconds ? at + seconds : atSeconds;

    private void DrawIndexes(SeededRandom random)
    {
        for (int peer = 0; peer < players.Count; peer++)
        {
            bool isUsed = random.IsLucky(IndexPercent), fromTheFirst = random.IsLucky(FromTheFirstPercent);
            int above = random.NextInt(LatestIndex);
            players[peer] = players[peer] with { IndexAbove = isUsed ? fromTheFirst ? 0 : above : null };
        }
    }

    private static LinkProfile DrawFullLink(SeededRandom random)
    {
        double delay = LogUniform(random, 1, 200);
        double jitter = random.Pick(0, delay / 20, delay / 5);
        double loss = random.Pick(0, 0, 0, 1);
        long rate = (long)LogUniform(random, LowestRate, HighestRate);
        double queue = LogUniform(random, 50, 2000);
        bool hasDips = random.IsLucky(30);
        PeriodicDip? dip = hasDips ? new PeriodicDip(random.NextDouble(6, 30), 5, rate / 5) : null;
        QueueDiscipline discipline = random.IsLucky(20) ? QueueDiscipline.CoDel : QueueDiscipline.DropTail;
        return new LinkProfile("full", new LinkLeg(delay, jitter, loss) { Bottleneck = new Bottleneck(rate, queue, discipline) { Dip = dip } });
    }

    private static double LogUniform(SeededRandom random, double low, double high) => low * SeededRandom.Exp(random.NextDouble() * Math.Log(high / low));

    private static CheckPlayer Player(SeededRandom random, LinkProfile link, double? asks, double? leaves, bool isKilled) =>
        new(link, random.NextDouble(-30, 30), random.NextDouble(0, 3600) + link.ReceiverClockOffset.ToSeconds(), asks, leaves, isKilled);

    private static LinkProfile DrawLink(SeededRandom random, CheckOptions options)
    {
        // Short pure delays are more frequent: three quarters are below a second.
        double delay = Math.Round(2000 * random.NextDouble() * Math.Sqrt(random.NextDouble()));
        LinkProfile drawn = random.IsLucky(30) ? LinkProfiles.PureDelay(delay) : random.Pick([.. LinkProfiles.All]);
        return options.Profile ?? drawn;
    }

    /// <summary>
    /// Whether the scene with all actions stays within a budget of events and ends, which squeezed elastic bodies may never do.
    /// </summary>
    private bool IsWithin(long budget, CancellationToken cancellation)
    {
        try
        {
            return TakesNoMoreThan(budget, cancellation);
        }
        catch (SimulationException)
        {
            return false;
        }
    }

    private bool TakesNoMoreThan(long budget, CancellationToken cancellation)
    {
        int[] all = [.. Enumerable.Range(0, room.BodyCount)];
        Scene scene = rules.On(filters.On(room.Build(all), all));
        Simulation alone = new(scene, new SimulationOptions(cancellation: cancellation));
        BodyId[] bodies = new BodyId[actions.Count];
        for (int i = 0; i < actions.Count; i++)
        {
            CheckAction action = actions[i];
            SimTime time = SimTime.FromSeconds(action.AtSeconds);
            if (!alone.TryAdvanceTo(SimTime.Max(time - SimDuration.OneTick, alone.SimulatedTo), ref budget))
            {
                return false;
            }

            ContactSteps = alone.Engine.Stepper.StepsTaken;
            BodyId body = action.Spawn >= 0 ? bodies[action.Spawn] : BodyId.OfScene(Math.Max(0, action.Body));
            ExternalEvent external = action.On(body).Stamp(time, (byte)action.Peer, (uint)i + 1);
            bodies[i] = external.Body;
            alone.Submit(external);
        }

        return alone.TryAdvanceTo(SimTime.FromSeconds(Length), ref budget);
    }

    private void DrawActions(SeededRandom random)
    {
        actions.Clear();
        int count = FewestActions + random.NextInt(17);
        List<int> spawns = [];
        double[] times = Enumerable.Range(0, count).Select(_ => random.NextDouble() * room.BusySeconds).Order().ToArray();
        int removals = 0;
        for (int i = 0; i < count; i++)
        {
            // In the same instant as the one before, by the same player or another, and often on the same body.
            bool isTogether = i > 0 && random.IsLucky(25);
            double at = isTogether ? actions[i - 1].AtSeconds : times[i];
            int peer = isTogether && random.IsLucky(60) ? actions[i - 1].Peer : random.NextInt(players.Count);
            int spawn = spawns.Count > 0 && random.IsLucky(20) ? spawns[random.NextInt(spawns.Count)] : -1;
            int body = spawn >= 0 ? -1 : room.DrawBody(random);
            if (isTogether && actions[i - 1].Kind != EventKind.Spawn && random.IsLucky(50))
            {
                (body, spawn) = (actions[i - 1].Body, actions[i - 1].Spawn);
            }

            EventKind kind = random.Pick(
                EventKind.SetVelocity, EventKind.SetVelocity, EventKind.SetVelocity, EventKind.Impulse, EventKind.Impulse,
                EventKind.Teleport, EventKind.Teleport, EventKind.Spawn, EventKind.Remove);
            if ((kind == EventKind.Spawn && spawns.Count == MaxSpawns) || (kind == EventKind.Remove && removals == MaxRemovals))
            {
                kind = EventKind.SetVelocity;
            }

            BodySpec spec = kind == EventKind.Spawn ? room.DrawSpec() : spawn >= 0 ? actions[spawn].Spec : room.SpecOf(body);
            actions.Add(new CheckAction(
                at, peer, kind, kind == EventKind.Spawn ? -1 : body, kind == EventKind.Spawn ? -1 : spawn, room.DrawPosition(), room.DrawVelocity(6), spec,
                kind == EventKind.Spawn ? room.DrawSpin(spec) : default));
            removals += kind == EventKind.Remove ? 1 : 0;
            if (kind == EventKind.Spawn)
            {
                spawns.Add(i);
            }
        }
    }
}
