using System;
using System.Runtime.InteropServices.JavaScript;
using System.Runtime.Versioning;
using AirHockey;
using LagSim.Hosting;

namespace LagSim.Play.Browser;

/// <summary>What the page calls where the scene is air hockey: the players of the panes.</summary>
/// <remarks>Everything is on the page's one thread. Points are those of the view, in metres.</remarks>
[SupportedOSPlatform("browser")]
internal static partial class AirHockeyExports
{
    /// <summary>Whose players the panes have: those of the playground, or those of this page in a host's session; null for who only looks
    /// on, so that what it does is nothing.</summary>
    internal static Func<int, AirHockeyPlayer?> PlayerOf { get; set; } = pane => PlaygroundExports.Panes[pane].Player;

    /// <summary>What the panes see of the match.</summary>
    internal static Func<int, AirHockeyBoard> BoardOf { get; set; } = pane => PlaygroundExports.Panes[pane].Board!;

    /// <summary>The measures of the table, in metres: half its length and width, the radius of a corner and of a post, half a goal's
    /// mouth, the radius of a puck; how many goals win, how many play, and the number of a pane's player, -1 for who only looks on.</summary>
    [JSExport]
    internal static double[] Measures(int pane) =>
    [
        Table.HalfLength, Table.HalfWidth, Table.CornerRadius, Table.PostRadius, Table.HalfMouth, Table.PuckRadius, Match.GoalsToWin,
        BoardOf(pane).Players, PlayerOf(pane)?.Number ?? -1,
    ];

    /// <summary>What each player calls itself; empty where that is not known.</summary>
    [JSExport]
    internal static string[] Names(int pane)
    {
        string[] names = new string[BoardOf(pane).Players];
        for (int player = 0; player < names.Length; player++)
        {
            names[player] = BoardOf(pane).NameOf(player) ?? "";
        }

        return names;
    }

    /// <summary>Whether each player is there, as a <see cref="PlayerPresence"/>.</summary>
    [JSExport]
    internal static int[] Presences(int pane)
    {
        int[] presences = new int[BoardOf(pane).Players];
        for (int player = 0; player < presences.Length; player++)
        {
            presences[player] = (int)BoardOf(pane).PresenceOf(player);
        }

        return presences;
    }

    /// <summary>Keys of a pane's player are down.</summary>
    [JSExport]
    internal static void Steer(int pane, double x, double y) => PlayerOf(pane)?.Steer(x, y);

    /// <summary>A pointer is down in a pane.</summary>
    [JSExport]
    internal static void Aim(int pane, double x, double y) => PlayerOf(pane)?.Aim(x, y);

    /// <summary>The pointer is up.</summary>
    [JSExport]
    internal static void EndAim(int pane) => PlayerOf(pane)?.EndAim();

    /// <summary>A bot plays in a pane, or no more.</summary>
    [JSExport]
    internal static void SetBot(int pane, bool isBot) => PlayerOf(pane)?.IsBot = isBot;

    /// <summary>The player of a pane asks for another match.</summary>
    [JSExport]
    internal static void PlayAgain(int pane) => PlayerOf(pane)?.PlayAgain();

    /// <summary>What a pane shows beside its bodies: both scores, the phase, the count-down, the seconds left, the side whose goal is
    /// closed (-1 for none), whether a bot plays; then for each other thing what it is (-1 for a puck) and where.</summary>
    [JSExport]
    internal static double[] Look(int pane)
    {
        AirHockeyBoard board = BoardOf(pane);
        ref readonly Match match = ref board.Match;
        double[] numbers = new double[7 + (3 * board.Things.Count)];
        (numbers[0], numbers[1], numbers[2], numbers[3]) = (match.Left, match.Right, (double)match.Phase, match.Count);
        (numbers[4], numbers[5], numbers[6]) = (board.SecondsLeft, match.Shielded - 1, PlayerOf(pane)?.IsBot == true ? 1 : 0);
        for (int n = 0; n < board.Things.Count; n++)
        {
            AirHockeyThing thing = board.Things[n];
            (numbers[7 + (3 * n)], numbers[8 + (3 * n)], numbers[9 + (3 * n)]) = (thing.Prize is PrizeKind prize ? (double)prize : -1, thing.X, thing.Y);
        }

        return numbers;
    }

    /// <summary>What the rules have told in a pane, and whether it is provisional, certain or taken back; empty for
    /// nothing.</summary>
    [JSExport]
    internal static string[] News(int pane)
    {
        AirHockeyNews news = BoardOf(pane).News;
        return news.Sentence.Length == 0 ? [] : [news.Sentence, news.Kind switch
        {
            NoticeKind.Predicted => "provisional",
            NoticeKind.Confirmed => "certain",
            NoticeKind.Retracted => "taken-back",
            _ => throw new InvalidOperationException($"A notice is {news.Kind}."),
        }];
    }
}
