using System;
using System.Collections.Generic;
using System.Linq;
using AirHockey;
using LagSim.Hosting;
using LagSim.Rules;
using LagSim.Time;

namespace LagSim.Play;

/// <summary>What the rules of air hockey told one peer, in sentences: at first provisional, then certain, or taken back.</summary>
/// <remarks>Not thread-safe.</remarks>
/// <param name="notices">Those of the peer.</param>
/// <param name="players">How many play: with more than two a side has no player's name.</param>
/// <param name="nameOf">What a player, from 0, is called; null for its number.</param>
internal sealed class AirHockeyNews(RuleNotices notices, int players, Func<int, string?> nameOf)
{
    // Seconds of the world: a sentence is shown at least so long, and stays until it is certain, and for so long after that.
    private const double LeastSeconds = 2.4;
    private const double AfterSeconds = 1.2;
    private const int MostKept = 64;

    private readonly List<Line> told = [];
    private readonly List<RuleEvent> confirmed = [];

    /// <summary>What is shown now; empty for nothing.</summary>
    internal string Sentence { get; private set; } = "";

    /// <summary>What is known of <see cref="Sentence"/>: predicted, confirmed or retracted. What is in doubt is not shown.</summary>
    internal NoticeKind Kind { get; private set; }

    /// <summary>The last 64 that are certain, in order: the same at every peer.</summary>
    internal IReadOnlyList<RuleEvent> Confirmed => confirmed;

    /// <summary>How many are neither certain nor taken back.</summary>
    internal int Pending => told.Count(one => one.IsOpen);

    /// <summary>How many goals were shown and taken back, since a late event came before them.</summary>
    internal long GoalsTakenBack { get; private set; }

    /// <summary>A frame: takes what the rules have told, and finds what is shown at a time.</summary>
    internal void Take(SimTime shown)
    {
        while (notices.TryRead(out RuleEvent next))
        {
            Note(next, shown);
        }

        told.RemoveAll(one => shown > one.Until);
        (Sentence, Kind) = ("", NoticeKind.Predicted);
        int best = 0;
        int shownNow = -1;
        for (int n = 0; n < told.Count; n++)
        {
            Line one = told[n];
            if (one.Event.Time <= shown && one.Rank >= best && one.Kind != NoticeKind.InDoubt)
            {
                (best, shownNow) = (one.Rank, n);
            }
        }

        if (shownNow >= 0)
        {
            Line one = told[shownNow];
            told[shownNow] = one with { WasShown = true };
            (Sentence, Kind) = one.Kind switch
            {
                NoticeKind.Retracted => ($"Not so: {one.Sentence}", NoticeKind.Retracted),
                NoticeKind.Confirmed => (one.Sentence, NoticeKind.Confirmed),
                _ => (one.Sentence, NoticeKind.Predicted),
            };
        }
    }

    /// <summary>What a notice says, as a sentence without its full stop.</summary>
    private string SentenceOf(in RuleNotice notice)
    {
        switch ((Told)notice.Code)
        {
            case Told.Begins:
                return "Play!";
            case Told.Goal:
                Goal goal = Goal.From(notice.Value);
                return $"Goal for {Side(goal.Side)}{(players > 2 && goal.Player >= 0 ? $", by {Player(goal.Player, "player")}" : "")}";
            case Told.Prize:
                string what = (PrizeKind)(notice.Value & 15) switch
                {
                    PrizeKind.SecondPuck => "a second puck",
                    PrizeKind.FastPuck => "a faster puck",
                    _ => "a shield",
                };
                return $"{Player((int)(notice.Value >> 4), "Player")} takes {what}";
            case Told.Won:
                int winner = (int)notice.Value;
                return $"{(players > 2 ? winner == 0 ? "The left side" : "The right side" : Player(winner, "Player"))} wins";
            default:
                throw new ArgumentOutOfRangeException(nameof(notice), $"The rules tell {notice.Code}, which this page does not know.");
        }

        string Side(int side) => players > 2 ? side == 0 ? "the left side" : "the right side" : Player(side, "player");

        string Player(int player, string what) => nameOf(player) ?? $"{what} {player + 1}";
    }

    private void Note(in RuleEvent next, SimTime shown)
    {
        if (next.Kind == NoticeKind.Confirmed)
        {
            confirmed.Add(next);
            confirmed.RemoveRange(0, Math.Max(0, confirmed.Count - MostKept));
        }

        long id = next.Id;
        int at = told.FindIndex(one => one.Event.Id == id);
        Line line = new(next, SentenceOf(next.Notice), next.Kind, at >= 0 && told[at].WasShown, SimTime.MaxValue);
        if (next.Kind == NoticeKind.Confirmed)
        {
            SimTime least = next.Time + SimDuration.FromSeconds(LeastSeconds);
            line = line with { Until = SimTime.Max(least, shown + SimDuration.FromSeconds(AfterSeconds)) };
        }
        else if (next.Kind == NoticeKind.Retracted)
        {
            GoalsTakenBack += line.WasShown && next.Notice.Code == (int)Told.Goal ? 1 : 0;
            line = line with { Until = shown + SimDuration.FromSeconds(AfterSeconds) };
        }

        if (at >= 0)
        {
            told.RemoveAt(at);
        }

        if (next.Kind == NoticeKind.Unresolved)
        {
            return; // the score says what happened
        }

        if (next.Kind != NoticeKind.Retracted || line.WasShown)
        {
            told.Add(line); // what nobody has seen is not taken back before them
        }
    }

    /// <summary>A sentence, what is known of it, whether it has been shown, and until when it is.</summary>
    private readonly record struct Line(RuleEvent Event, string Sentence, NoticeKind Kind, bool WasShown, SimTime Until)
    {
        /// <summary>Whether it is neither certain nor taken back.</summary>
        internal bool IsOpen => Kind is NoticeKind.Predicted or NoticeKind.Moved or NoticeKind.InDoubt;

        /// <summary>What stands is shown rather than what does not, a goal rather than a prize; of equals the last.</summary>
        internal int Rank => Kind == NoticeKind.Retracted ? 1 : Event.Notice.Code is (int)Told.Goal or (int)Told.Won ? 3 : 2;
    }
}
