using System;
using System.Collections.Generic;
using System.Linq;
using LagSim;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Sessions;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Testing;
using LagSim.Testing.Links;
using LagSim.Time;
using LagSim.Timelines;

namespace AirHockey;

/// <summary>A match of bots in virtual time: real sessions over a simulated link, and a comparison of what peers heard and have.</summary>
public sealed class BotMatch
{
    public const int FramesPerSecond = 60;
    private const double Quiet = 12; // seconds at the end without an act, in which all is confirmed

    private readonly List<string> differences = [];

    private BotMatch(LinkProfile link, int players) => (Link, Players) = (link, players);

    public LinkProfile Link { get; }

    public int Players { get; }

    /// <summary>The peers' histories, the host's first.</summary>
    public IReadOnlyList<PeerLog> Peers { get; private set; } = [];

    /// <summary>The match as it stands at the end, in the world that had every event on time.</summary>
    public Match End { get; private set; }

    /// <summary>A hash of the host's history of the score.</summary>
    public ulong HistoryHash { get; private set; }

    /// <summary>A hash of the whole world at the end.</summary>
    public ulong StateHash { get; private set; }

    /// <summary>How many states, events and hashes were compared, and how many differ.</summary>
    public long Compared { get; private set; }

    public long Differing { get; private set; }

    /// <summary>What went wrong, in sentences; empty if nothing did.</summary>
    public IReadOnlyList<string> Differences => differences;

    /// <summary>Plays a match.</summary>
    /// <param name="link">The link of every client to the host.</param>
    /// <param name="players">How many play, 2 to 4.</param>
    /// <param name="seed">Of the network, the bots and the scene.</param>
    /// <param name="seconds">How long.</param>
    /// <param name="rules">Makes each peer's own object of rules.</param>
    /// <param name="watch">Called once a frame with the last player, or null.</param>
    public static BotMatch Play(
        LinkProfile link, int players, int seed, double seconds, Func<GameRules> rules, Action<TestPlayer, PeerLog>? watch = null)
    {
        BotMatch match = new(link, players);
        PeerLog[] logs = [.. Enumerable.Range(0, players).Select(_ => new PeerLog())];
        LatencyCompensationWindow window = new(SimDuration.FromSeconds(5)); // also the slowest link is in time
        Scene scene = Table.Build(players, rules(), (ulong)seed);
        SessionTest test = new SessionTest(scene)
            .WithSeed((ulong)seed)
            .WithOptions(player => player == 0
                ? new HostOptions { Window = window, ConfirmsEarly = true, RuleNotices = logs[0].Notices }
                : new ClientOptions { Window = window, RuleNotices = logs[player].Notices, Rules = [rules()] })
            .WithClients(players - 1, link);
        for (int player = 0; player < players; player++)
        {
            PeerLog log = logs[player];
            Bot bot = new(player, players, seed);
            Hand hand = new(player, players, (byte)player);
            test.Every(1.0 / FramesPerSecond, player, me =>
            {
                log.Session = me.Session;
                if (me.Seconds < seconds - Quiet)
                {
                    Act(me, bot, hand);
                }
            });
        }

        if (watch is not null)
        {
            test.Every(1.0 / FramesPerSecond, players - 1, me => watch(me, logs[players - 1]));
        }

        match.Peers = logs;
        try
        {
            match.Compare(test.RunUnchecked(seconds));
        }
        catch (SessionTestException failed)
        {
            match.differences.Add(failed.Message);
        }

        return match;
    }

    private static void Act(TestPlayer me, Bot bot, Hand hand)
    {
        RenderSnapshot snapshot = me.Session.World!.RenderSnapshots.Latest();
        SimTime now = me.Session.SharedTime.Now;
        (Vector3D place, double speed) = bot.Think(snapshot, now, hand.At);
        hand.Move(snapshot, now, place, speed, action => me.Do(action));
        if (me.Number == 0 && (int)(me.Seconds * FramesPerSecond) == 4 * FramesPerSecond)
        {
            me.Do(PlayerAction.Command(new GameCommand(AirHockeyRules.Chat, "good luck"u8)));
        }
    }

    private void Compare(SessionTestResult result)
    {
        SimTime start = result.World.Start;
        SimTime end = start + SimDuration.FromSeconds(result.Seconds);
        (Compared, Differing, StateHash, HistoryHash) = (result.Compared, result.Differing, result.StateHash, Peers[0].Hash(start));
        if (!result.WorldsAgree)
        {
            differences.Add(result.ToString().Split('\n')[0]);
        }

        result.World.TryReadRules(end, out Match last);
        End = last;
        if (result.World.Crossings(start, end).Any(crossing => HasLeft(crossing, result.World)))
        {
            differences.Add("Something left the table.");
        }

        for (int peer = 0; peer < Peers.Count; peer++)
        {
            if (!Peers[peer].IsSameAs(Peers[0]))
            {
                differences.Add($"Peer {peer} was told another history of the score than the host.");
            }

            if (!Peers[peer].IsEachOnce)
            {
                differences.Add($"Peer {peer} was told something twice as confirmed.");
            }

            if (Peers[peer].Open != 0)
            {
                differences.Add($"Peer {peer} has {Peers[peer].Open} predictions that were neither confirmed nor taken back.");
            }

            CompareGoals(result.World, peer);
        }
    }

    /// <summary>Whether something leaves the table and is there all the same: what is removed leaves, too.</summary>
    private static bool HasLeft(Crossing crossing, Simulation world) =>
        crossing.Sensor == Table.Inside && !crossing.Entered && world.TryRead(crossing.Body, crossing.Time, out _);

    /// <summary>Every confirmed goal is in the world that had every event on time, at its tick and not before; and no others are.</summary>
    private void CompareGoals(Simulation world, int peer)
    {
        int goals = 0;
        foreach (RuleEvent told in Peers[peer].Goals)
        {
            Goal goal = Goal.From(told.Notice.Value);
            goals++;
            if (!world.TryReadRules(told.Time, out Match at) || !world.TryReadRules(told.Time - SimDuration.OneTick, out Match before)
                || (at.Left, at.Right) != (goal.Left, goal.Right) || before.Left + before.Right != goals - 1
                || !world.TryRead(told.Key.Body, told.Time - SimDuration.OneTick, out BodyState puck)
                || Math.Abs(puck.Position.Z) >= Table.HalfMouth)
            {
                differences.Add($"Peer {peer} was told a goal at {(told.Time - world.Start).ToSeconds():0.000} s that did not happen.");
                return;
            }
        }

        if (goals != End.Left + End.Right)
        {
            differences.Add($"Peer {peer} was told {goals} goals, of {End.Left + End.Right}.");
        }
    }
}
