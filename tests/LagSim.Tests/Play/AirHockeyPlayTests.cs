using System;
using System.Collections.Generic;
using System.Linq;
using AirHockey;
using LagSim.Hosting;
using LagSim.Net.Sessions;
using LagSim.Play;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Play;

/// <summary>Air hockey in panes: mallets by keys, pointer and bots; one score and one history of goals in all of them.</summary>
public sealed class AirHockeyPlayTests
{
    private const double Frame = 1 / 60.0;

    public static TheoryData<string> Links => [.. LinkProfiles.Names];

    [Theory]
    [MemberData(nameof(Links))]
    public void Bots_OverEveryLink_HaveOneScoreAndOneHistoryOfGoals(string link)
    {
        Playground playground = Open($"panes=healing,healing&link={link}&seed=3");
        PlayBots(playground, 30);
        AssertAgree(playground);
        List<(double Seconds, Goal Goal)>[] goals = [.. playground.Panes.Select(pane => Goals(playground, pane))];
        Assert.NotEmpty(goals[0]);
        Assert.All(goals, heard => Assert.Equal(goals[0], heard));
        Assert.All(playground.Panes, pane => Assert.Equal(Score(playground.Panes[0]), Score(pane)));
        Assert.Equal((goals[0][^1].Goal.Left, goals[0][^1].Goal.Right), Score(playground.Panes[0]));
    }

    [Theory]
    [InlineData("healing,full-rollback,healing,interpolation")]
    [InlineData("full-rollback,interpolation")]
    public void Bots_OfOtherStrategiesAndMorePlayers_Agree(string panes)
    {
        Playground playground = Open($"panes={panes}&delay=120&jitter=15&loss=3&seed=5");
        PlayBots(playground, 20);
        AssertAgree(playground);
        Assert.All(playground.Panes, pane => Assert.Equal(Goals(playground, playground.Panes[0]), Goals(playground, pane)));
        Assert.Equal(playground.Panes.Count, playground.Panes.Select(pane => pane.Player!.Number).Distinct().Count());
    }

    /// <summary>The control: with a strategy that promises nothing the pane has another match.</summary>
    [Fact]
    public void Bots_WithAStrategyThatPromisesNothing_HaveAnotherMatch()
    {
        Playground playground = Open("panes=healing,none&delay=200");
        PlayBots(playground, 30);
        ulong?[] hashes = Hashes(playground);
        Assert.Equal(hashes[2], hashes[0]);
        Assert.NotEqual(hashes[2], hashes[1]);
        Assert.NotEqual(Goals(playground, playground.Panes[0]), Goals(playground, playground.Panes[1]));
    }

    [Fact]
    public void Goal_OfALateWorld_IsProvisionalThenCertainOrTakenBack()
    {
        Playground playground = Open("panes=healing,healing&delay=500&seed=3");
        HashSet<(string, NoticeKind)> said = [];
        playground.Panes.ToList().ForEach(pane => pane.Player!.IsBot = true);
        Run(playground, 60, () => said.UnionWith(playground.Panes.Select(pane => (pane.Board!.News.Sentence, pane.Board.News.Kind))));
        Assert.Contains(("Play!", NoticeKind.Predicted), said);
        const string goal = "Goal for player 1";
        Assert.Contains((goal, NoticeKind.Predicted), said);
        Assert.Contains((goal, NoticeKind.Confirmed), said);
        Assert.True(playground.Panes[1].Board!.News.GoalsTakenBack > 0);
        Assert.Contains(said, one => one.Item1.StartsWith("Not so: ", StringComparison.Ordinal) && one.Item2 == NoticeKind.Retracted);
        Assert.Contains(said, one => one.Item1.EndsWith(" wins", StringComparison.Ordinal) && one.Item2 == NoticeKind.Confirmed);
    }

    /// <summary>Two people on one keyboard: both mallets move at one speed, at once, in any direction, and stop when the keys are up.</summary>
    [Theory]
    [InlineData(1, 0)]
    [InlineData(0, 1)]
    [InlineData(-1, -1)]
    public void Steer_BothAtOnce_MovesBothAtOneSpeed(double x, double y)
    {
        Playground playground = Open("panes=healing,healing&delay=100");
        Run(playground, 0.5);
        playground.Panes[0].Player!.Steer(x, y);
        playground.Panes[1].Player!.Steer(x, -y);
        (double X, double Y)[] before = [Mallet(playground, 0), Mallet(playground, 1)];
        for (int n = 0; n < 6; n++)
        {
            playground.Advance(Frame, Frame);
            for (int player = 0; player < 2; player++)
            {
                (double X, double Y) now = Mallet(playground, player);
                double length = Math.Sqrt((x * x) + (y * y));
                Assert.Equal(AirHockeyPlayer.KeySpeed * Frame * x / length, now.X - before[player].X, 1e-5);
                Assert.Equal(AirHockeyPlayer.KeySpeed * Frame * (player == 0 ? y : -y) / length, now.Y - before[player].Y, 1e-5);
                before[player] = now;
            }
        }

        playground.Panes[0].Player!.Steer(0, 0);
        playground.Panes[1].Player!.Steer(0, 0);
        Run(playground, 1.2);
        Assert.Equal(before[0], Mallet(playground, 0));
        Assert.Equal(before[0].X, Seen(playground, 1, 0).X, 1e-3); // the other has it there, too
        Assert.Equal(before[0].Y, Seen(playground, 1, 0).Y, 1e-3);
        Run(playground, 3);
        AssertAgree(playground);
    }

    [Fact]
    public void Steer_AgainstWallAndLine_SlidesAlong()
    {
        Playground playground = Open("panes=healing,healing&delay=50");
        playground.Panes[0].Player!.Steer(1, 1);
        Run(playground, 3);
        (double x, double y) = Mallet(playground, 0);
        Assert.True(x < -Table.MalletRadius && x > -0.2, $"x is {x}"); // at the line, in its half
        Assert.True(y < Table.HalfWidth - Table.MalletRadius && y > 0.4, $"y is {y}");
    }

    [Fact]
    public void Aim_FarAway_FollowsWithinTheHalf()
    {
        Playground playground = Open("panes=healing,healing&delay=50");
        Run(playground, 0.2);
        playground.Panes[1].Player!.Aim(0.7, 0.3);
        Run(playground, 1);
        (double x, double y) = Mallet(playground, 1);
        Assert.Equal((0.7, 0.3), (Math.Round(x, 3), Math.Round(y, 3)));
        playground.Panes[1].Player!.Aim(-1, 0.3);
        Run(playground, 1);
        Assert.True(Mallet(playground, 1).X > Table.MalletRadius);
        playground.Panes[1].Player!.EndAim();
        (double X, double Y) stays = Mallet(playground, 1);
        Run(playground, 0.5);
        Assert.Equal(stays, Mallet(playground, 1));
    }

    [Fact]
    public void PlayAgain_OnceTheMatchIsOver_BeginsAnother()
    {
        Playground playground = Open("panes=healing,healing&delay=80");
        playground.Panes[1].Player!.PlayAgain(); // in the middle of a match it does nothing
        playground.Panes.ToList().ForEach(pane => pane.Player!.IsBot = true);
        for (int n = 0; n < 120 && playground.Panes[1].Board!.Match.Phase != Phase.Over; n++)
        {
            Run(playground, 1);
        }

        Assert.Equal(Phase.Over, playground.Panes[1].Board!.Match.Phase);
        playground.Panes[1].Player!.PlayAgain();
        Run(playground, 1);
        Assert.All(playground.Panes, pane => Assert.Equal((0, 0, Phase.CountDown), (pane.Board!.Match.Left, pane.Board.Match.Right, pane.Board.Match.Phase)));
        AssertAgree(playground);
    }

    [Fact]
    public void Deeds_ThatCannotBe_AreNamed()
    {
        AirHockeyPlayer player = Open("").Panes[0].Player!;
        Assert.StartsWith("The way (2, 0) must have parts from -1 to 1.", Assert.Throws<ArgumentOutOfRangeException>(() => player.Steer(2, 0)).Message, StringComparison.Ordinal);
        Assert.StartsWith("The point (NaN, 0) must be finite.", Assert.Throws<ArgumentOutOfRangeException>(() => player.Aim(double.NaN, 0)).Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Grab_OfAMalletBesideItsPlayer_TakesNothing()
    {
        Playground playground = Open("");
        (double x, double y) = Mallet(playground, 0);
        Assert.False(playground.Grab(0, x, y, 0.1));
    }

    private static Playground Open(string query) => new(PlaySetup.Parse($"scene={AirHockeyGame.Name}&{query}"));

    /// <summary>Bots play for so long; then all hands are still until all is certain.</summary>
    private static void PlayBots(Playground playground, double seconds)
    {
        playground.Panes.ToList().ForEach(pane => pane.Player!.IsBot = true);
        Run(playground, seconds);
        playground.Panes.ToList().ForEach(pane => pane.Player!.IsBot = false);
        Run(playground, 12);
        for (int n = 0; n < 60 && playground.Panes.Any(pane => pane.Board!.News.Pending > 0); n++)
        {
            Run(playground, 0.5); // the puck still moves, and a goal of just now is not certain
        }
    }

    private static (int Left, int Right) Score(Pane pane) => (pane.Board!.Match.Left, pane.Board.Match.Right);

    private static void Run(Playground playground, double seconds, Action? each = null)
    {
        for (int n = 0; n < seconds * 60; n++)
        {
            playground.Advance(Frame, Frame);
            each?.Invoke();
        }
    }

    private static (double X, double Y) Mallet(Playground playground, int player) => Seen(playground, player, player);

    private static (double X, double Y) Seen(Playground playground, int pane, int player) => playground.Panes[pane].Places[1 + player].Drawn;

    private static List<(double Seconds, Goal Goal)> Goals(Playground playground, Pane pane)
    {
        SimTime start = playground.Panes[0].Session.World!.Simulation.Start;
        return [.. pane.Board!.News.Confirmed.Where(told => told.Notice.Code == (int)Told.Goal)
            .Select(told => ((told.Time - start).ToSeconds(), Goal.From(told.Notice.Value)))];
    }

    private static ulong?[] Hashes(Playground playground)
    {
        ulong?[] hashes = new ulong?[playground.Panes.Count + 1];
        playground.ReadHashes(hashes);
        return hashes;
    }

    private static void AssertAgree(Playground playground)
    {
        Assert.All(playground.Panes, pane => Assert.True(pane.Session.State == SessionState.Running, pane.Session.EndReason));
        ulong?[] hashes = Hashes(playground);
        Assert.NotNull(hashes[0]);
        Assert.All(hashes, hash => Assert.Equal(hashes[0], hash));
    }
}
