using System;
using System.Linq;
using LagSim.Net.Sessions;
using LagSim.Net.Strategies;
using LagSim.Play;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Play;

/// <summary>Peers side by side: what a person does in one pane comes to all, and their hashes say who agrees.</summary>
public sealed class PlaygroundTests
{
    private const double Frame = 1 / 60.0;

    public static TheoryData<string> Scenes => [.. PlayScene.Names.Where(name => name != AirHockeyGame.Name)];

    public static TheoryData<string> Links => [.. LinkProfiles.Names];

    [Theory]
    [MemberData(nameof(Scenes))]
    public void Throw_InAClientsPane_ComesToAllAndAllAgree(string scene)
    {
        Playground playground = new(PlaySetup.Parse($"scene={scene}&panes=healing,full-rollback,healing&delay=200&jitter=20"));
        string before = Hash(playground, 2);
        Throw(playground, 2);
        Assert.True(playground.Panes[1].Heals > 0);
        Run(playground, 2);
        AssertAgree(playground);
        Assert.NotEqual(before, Hash(playground, 2));
        Assert.All(playground.Panes, pane => Assert.Equal(0, pane.Error, 1e-3)); // what was drawn beside it has glided there
    }

    [Theory]
    [MemberData(nameof(Links))]
    public void Throw_OverEveryLink_ComesToAllAndAllAgree(string link)
    {
        Playground playground = new(PlaySetup.Parse($"panes=healing,healing&link={link}"));
        Throw(playground, 1);
        Run(playground, 12); // some links are out for seconds, and a history is three
        AssertAgree(playground);
    }

    /// <summary>Whatever the links lose, the pane of a player is that player's: who is let in first has the first number.</summary>
    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    public void Panes_OverAnAwfulLink_AreThoseOfThePlayersInOrder(int seed)
    {
        Playground playground = new(PlaySetup.Parse($"scene=air-hockey&panes=healing,none,healing,interpolation&link=awful&seed={seed}"));
        Assert.Equal([0, 1, 2, 3], playground.Panes.Select(pane => (int)pane.Session.Peer));
    }

    /// <summary>The control: a strategy that promises no agreement leaves its pane with another world.</summary>
    [Theory]
    [InlineData(LateEventStrategy.ApplyOnArrival)]
    [InlineData(LateEventStrategy.LatencyForward)]
    public void Throw_WithAStrategyThatPromisesNothing_DiffersForGood(LateEventStrategy strategy)
    {
        Playground playground = new(PlaySetup.Parse($"scene=billiards&panes=healing,{PlaySetup.NameOf(strategy)}&delay=200"));
        Throw(playground, 0);
        Run(playground, 3);
        ulong?[] hashes = new ulong?[3];
        playground.ReadHashes(hashes);
        Assert.Equal(hashes[2], hashes[0]);
        Assert.NotEqual(hashes[2], hashes[1]);
        Assert.True(playground.Panes[1].Error > 0.001);
    }

    [Fact]
    public void Advance_TheSameDeedsTwice_IsTheSameToTheBit()
    {
        Assert.Equal(Played(1), Played(1));
        Assert.NotEqual(Played(1), Played(2)); // another seed, other jitter, so the hand comes to other ticks

        static string Played(int seed)
        {
            Playground playground = new(PlaySetup.Parse($"panes=healing,healing,healing&delay=80&jitter=30&loss=5&seed={seed}"));
            Throw(playground, 1);
            Run(playground, 1);
            return string.Join(' ', playground.Panes.Select(p => $"{p.Heals} {p.EventsRerun} {p.Error:R} {playground.BytesSent(p.Number)}")) + Hash(playground, 1);
        }
    }

    /// <summary>A person sees the body in its hand where the hand is, on every frame, however late others are.</summary>
    [Fact]
    public void MoveHand_InTheHoldersPane_IsDrawnWhereTheHandIs()
    {
        Playground playground = new(PlaySetup.Parse("panes=healing,healing&delay=500"));
        Run(playground, 1);
        DrawnPlace ball = playground.Panes[1].Places[5];
        Assert.True(playground.Grab(1, ball.Drawn.X, ball.Drawn.Y, 0.01));
        for (int n = 1; n <= 40; n++)
        {
            double x = ball.Drawn.X + (0.01 * n);
            playground.MoveHand(1, x, ball.Drawn.Y, 0.6, 0);
            playground.Advance(Frame, Frame);
            DrawnPlace shown = playground.Panes[1].Places[5];
            Assert.True(shown.IsInHand);
            Assert.Equal((x, ball.Drawn.Y), shown.Drawn);
        }

        Assert.False(playground.Panes[0].Places[5].IsInHand);
        Assert.False(playground.Grab(1, ball.Drawn.X, ball.Drawn.Y, 0.01)); // one hand holds one body
    }

    [Fact]
    public void Grab_OfNothing_TakesNothing()
    {
        Playground playground = new(PlaySetup.Parse(""));
        Assert.False(playground.Grab(0, 100, 100, 0.1));
        playground.MoveHand(0, 1, 1, 0, 0);
        playground.Release(0, 1, 1);
        Run(playground, 1.5);
        AssertAgree(playground);
    }

    [Fact]
    public void SetLink_InTheMiddle_CountsFromThenOn()
    {
        Playground playground = new(PlaySetup.Parse("scene=billiards&panes=healing,healing&delay=0"));
        Throw(playground, 0);
        long heals = playground.Panes[1].Heals;
        playground.SetLink(new LinkSettings { DelayMilliseconds = 400 });
        Throw(playground, 0);
        Assert.Equal(400, playground.Setup.Link.DelayMilliseconds);
        Assert.True(playground.Panes[1].Heals > heals);
        Run(playground, 2);
        AssertAgree(playground);
    }

    [Fact]
    public void Advance_WhilePaused_ChangesNothing()
    {
        Playground playground = new(PlaySetup.Parse(""));
        (SimTime now, string hash) = (playground.Now, Hash(playground, 0));
        playground.Advance(0, 1);
        Assert.Equal((now, hash), (playground.Now, Hash(playground, 0)));
    }

    /// <summary>Takes the first ball of a pane, moves it for half a second, and throws it.</summary>
    private static void Throw(Playground playground, int pane)
    {
        Run(playground, 0.2);
        DrawnPlace ball = playground.Panes[pane].Places[0];
        Assert.True(playground.Grab(pane, ball.Drawn.X, ball.Drawn.Y, 0.05));
        double step = playground.Scene.Right / 400;
        for (int n = 1; n <= 30; n++)
        {
            playground.MoveHand(pane, ball.Drawn.X + (n * step), ball.Drawn.Y + (n * step), step * 60, step * 60);
            playground.Advance(Frame, Frame);
        }

        playground.Release(pane, step * 120, step * 60);
        Run(playground, 1);
    }

    private static void Run(Playground playground, double seconds)
    {
        for (int n = 0; n < seconds * 60; n++)
        {
            playground.Advance(Frame, Frame);
        }
    }

    private static string Hash(Playground playground, int pane)
    {
        ulong?[] hashes = new ulong?[playground.Panes.Count + 1];
        playground.ReadHashes(hashes);
        return FormattableString.Invariant($"{hashes[pane]:x16}");
    }

    private static void AssertAgree(Playground playground)
    {
        ulong?[] hashes = new ulong?[playground.Panes.Count + 1];
        double at = playground.ReadHashes(hashes);
        Assert.All(playground.Panes, pane => Assert.True(pane.Session.State == SessionState.Running, pane.Session.EndReason));
        Assert.NotNull(hashes[0]);
        Assert.All(hashes, hash => Assert.Equal(hashes[0], hash));
        Assert.True(at > 1);
    }
}
