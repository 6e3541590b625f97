using System;
using LagSim;
using LagSim.Hosting;
using LagSim.Net.Sessions;
using LagSim.Rules;
using LagSim.Time;

namespace AirHockey;

/// <summary>The terminal: shows pictures one over the other, and the words for what the rules tell.</summary>
public sealed class Screen : IDisposable
{
    private readonly bool isShown = !Console.IsOutputRedirected;
    private string? word;
    private long shown; // of which notice the word is
    private double until; // seconds, as the clock of the one who shows

    public Screen() => Write("\x1b[?1049h\x1b[?25l"); // another page, no cursor

    /// <summary>The word in the middle, for a moment.</summary>
    public string? BannerAt(double seconds) => seconds < until ? word : null;

    /// <summary>Takes what the rules told: the picture shows what is predicted, once, and a log what is confirmed.</summary>
    public void Take(RuleEvent told, SimTime now, double seconds)
    {
        if (told.Kind == NoticeKind.Predicted)
        {
            (word, until, shown) = (WordFor(told.Notice), seconds + 1.2, told.Id);
        }
        else if (told.Kind == NoticeKind.Moved && told.Id == shown)
        {
            (word, until) = (WordFor(told.Notice), Math.Max(until, seconds + 0.4)); // the word goes on: its event has only moved
        }
        else if (told.Kind == NoticeKind.InDoubt && told.Id == shown)
        {
            until = seconds; // a late event changed it
        }
        else if (told.Kind == NoticeKind.Confirmed && !isShown)
        {
            Console.WriteLine($"{seconds - (now - told.Time).ToSeconds(),8:0.000} s  {WordFor(told.Notice)}");
        }
    }

    public void Show(Picture picture) => Write("\x1b[H" + (isShown ? picture.ToText(withColours: true).Replace("\n", "\x1b[K\n") : ""));

    public void Dispose() => Write("\x1b[?25h\x1b[?1049l");

    public static string Winner(in Match match) => match.Left > match.Right ? "LEFT WINS" : "RIGHT WINS";

    private static string WordFor(RuleNotice notice)
    {
        switch ((Told)notice.Code)
        {
            case Told.Begins:
                return "GO";
            case Told.Goal:
                Goal goal = Goal.From(notice.Value);
                return $"GOAL {goal.Left}:{goal.Right}" + (goal.Player < 0 ? ", an own goal" : $" by {goal.Player}");
            case Told.Prize:
                string what = (PrizeKind)(notice.Value & 15) switch
                {
                    PrizeKind.SecondPuck => "a second puck",
                    PrizeKind.FastPuck => "a fast puck",
                    _ => "a shield",
                };
                return $"{what} for {notice.Value >> 4}";
            default:
                return notice.Value == 0 ? "LEFT WINS" : "RIGHT WINS";
        }
    }

    private void Write(string codes)
    {
        if (isShown)
        {
            Console.Write(codes);
        }
    }
}
