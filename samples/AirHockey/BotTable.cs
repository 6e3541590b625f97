using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Threading.Tasks;
using LagSim.Hosting;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Testing;
using LagSim.Testing.Links;
using LagSim.Time;

namespace AirHockey;

/// <summary>Matches of bots on every link profile, and a table of what came of them.</summary>
public static class BotTable
{
    private const double Seconds = 84;

    /// <summary>Plays them all, as many at a time as there are cores.</summary>
    /// <param name="rules">Makes each peer's own object of rules.</param>
    /// <returns>0 if every peer of every match has the same history of the score and the same world, bit for bit; otherwise 1.</returns>
    public static int Print(Func<GameRules> rules)
    {
        Console.WriteLine($"Bots play {LinkProfiles.All.Count} matches in virtual time, each over another link.");
        Console.WriteLine();
        const string Head = "link           players  score  goals     goals  confirmed after, ms  ";
        const string Below = "                               told  taken back   median      worst  ";
        Console.WriteLine(Head + "history of        world at         states     that");
        Console.WriteLine(Below + "the score         the end          compared  differ");
        string? picture = null;
        BotMatch?[] matches = new BotMatch?[LinkProfiles.All.Count];
        int printed = 0;
        Parallel.For(0, matches.Length, new ParallelOptions { MaxDegreeOfParallelism = Environment.ProcessorCount }, n =>
        {
            LinkProfile link = LinkProfiles.All[n];
            int players = Table.MinPlayers + (n % (Table.MaxPlayers - Table.MinPlayers + 1));
            Action<TestPlayer, PeerLog>? watch = link == LinkProfiles.Awful ? (me, log) => picture ??= EndOf(me, log) : null;
            BotMatch match = BotMatch.Play(link, players, seed: n + 1, Seconds, rules, watch);
            lock (matches)
            {
                matches[n] = match;
                for (; printed < matches.Length && matches[printed] is BotMatch next; printed++)
                {
                    Console.WriteLine(Row(next));
                }
            }
        });

        int failed = matches.Count(match => match!.Differences.Count > 0);
        int apart = matches.Count(match => match!.Peers.Any(peer => !peer.IsSameAs(match.Peers[0])));
        int goals = matches.Sum(match => match!.Peers[0].Goals.Count());
        Console.WriteLine();
        Console.WriteLine(picture);
        Console.WriteLine();
        Console.WriteLine(failed == 0
            ? $"{goals} goals. Every peer was told each of them once as confirmed, at the same tick, and has the same world to the bit."
            : $"{failed} of {matches.Length} matches failed; in {apart} of them peers were told different histories of the score.");
        return failed == 0 ? 0 : 1;
    }

    private static string Row(BotMatch match)
    {
        List<double> latencies = [.. match.Peers.SelectMany(peer => peer.Latencies).Order()];
        string median = latencies.Count == 0 ? "-" : Text(latencies[latencies.Count / 2]);
        string worst = latencies.Count == 0 ? "-" : Text(latencies[^1]);
        string row = $"{match.Link.Name,-14} {match.Players,7} {match.End.Left,3}:{match.End.Right,-3} {match.Peers[0].Goals.Count(),4}"
            + $" {match.Peers.Sum(peer => peer.GoalsTakenBack),11} {median,8} {worst,10}  {match.HistoryHash:x16}  {match.StateHash:x16}"
            + $" {match.Compared,8} {match.Differing,7}";
        return match.Differences.Count == 0 ? row : $"{row}\n    {string.Join("\n    ", match.Differences)}";
    }

    private static string Text(double milliseconds) => milliseconds.ToString("0", CultureInfo.InvariantCulture);

    /// <summary>The picture of a match that is over, as its last player sees it; null before.</summary>
    private static string? EndOf(TestPlayer me, PeerLog log)
    {
        bool isOver = log.Confirmed.Any(told => told.Notice.Code == (int)Told.Won);
        SimTime now = me.Session.DisplayTime;
        RenderSnapshot snapshot = me.Session.World!.RenderSnapshots.Latest();
        if (!isOver || !snapshot.TryReadRules(now, out Match match))
        {
            return null;
        }

        Picture picture = new();
        string status = $"the end, as player {me.Number} sees it over a link that loses a tenth";
        picture.Draw(snapshot, now, match, me.Seconds, Screen.Winner(match), status);
        return picture.ToText(!Console.IsOutputRedirected);
    }
}
