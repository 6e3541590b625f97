using System;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing;
using LagSim.Testing.Links;
using LagSim.Tests.Rules;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>Who is left behind by a host that failed hears that, with its sentence; and so does a test under lag.</summary>
public sealed class HostFailureTests
{
    private const int Fails = 13;

    /// <summary>Of the host, or of all.</summary>
    private static readonly GivenRules rules = new()
    {
        Command = (_, _, command) =>
        {
            if (command.Number == Fails)
            {
                throw new TimeoutException("the game's own\nwords");
            }
        },
    };

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Clients_OfAHostWhoseWorldEnds_HearThatAndItsSentence(bool losesGoodbyes)
    {
        SessionGroup group = Open();
        group.Do(1, PlayerAction.Teleport(First, V(0, 4)));
        group.Settle(1);
        group.Do(0, PlayerAction.Command(new GameCommand(Fails)));
        if (losesGoodbyes)
        {
            group.Cut(0, 1);
            group.Cut(0, 2);
        }

        Assert.True(group.RunUntil(() => group.Host.State == SessionState.Ended));
        group.Restore(0, 1);
        group.Restore(0, 2);
        group.Run(5);
        Assert.Equal(SessionEnd.Failed, group.Host.EndedBy);
        string sentence = losesGoodbyes ? "" : $" {group.Host.EndReason!.Replace('\n', ' ')}";
        Assert.Contains("the game's own", group.Host.EndReason, StringComparison.Ordinal);
        Assert.All(group.Sessions.Skip(1), client =>
        {
            Assert.Equal("The host failed, and the session is over." + sentence, client.EndReason);
            Assert.Equal(SessionEnd.HostFailed, client.EndedBy);
        });
    }

    /// <summary>The control: a host that leaves ends the session properly, and says nothing else.</summary>
    [Fact]
    public void Clients_OfAHostThatLeaves_HearThat()
    {
        SessionGroup group = Open();
        group.Host.Leave();
        group.Run(1);
        Assert.All(group.Sessions.Skip(1), client => Assert.Equal((SessionEnd.HostEnded, "The host ended the session."), (client.EndedBy, client.EndReason)));
    }

    [Theory]
    [InlineData("awful", true)]
    [InlineData("4g", true)]
    [InlineData("4g", false)]
    public void SessionTest_WhoseWorldEnds_SaysWhatWhereAndWhy(string link, bool whileOthersAct)
    {
        SessionTest test = new SessionTest(Scene()).WithClients(3, link).WithOptions(_ => new ClientOptions { Window = new(LagSim.Time.SimDuration.FromSeconds(2)) })
            .At(1, player: 0, PlayerAction.Command(new GameCommand(Fails)));
        for (int n = 1; n <= 3 && whileOthersAct; n++)
        {
            int player = n; // what is on its way, and nobody has judged, is in the worlds of those who did it
            test.Every(0.05, n, me => me.Do(PlayerAction.SetVelocity(BodyId.OfScene(player % 2), V(player, 2))));
        }

        SessionTestException failure = Assert.Throws<SessionTestException>(() => test.Run(4, TestContext.Current.CancellationToken));
        Assert.Matches(
            "^The world of player 0, the host, ended at (0.9[0-9]*|1) s. The world cannot be simulated any further. The rules 'given 1' failed at ", failure.Message);
        Assert.Matches("in OnCommand for command [0-9]+ of peer 0: .*the game's own", failure.Message);
        Assert.IsType<TimeoutException>(Assert.IsAssignableFrom<SimulationException>(failure.InnerException).InnerException);
    }

    /// <summary>What ends only the world that the session is compared with is told as that, not as a fault of what players did.</summary>
    [Fact]
    public void SessionTest_WhoseCheckEnds_SaysSo()
    {
        bool isOver = false;
        GivenRules onceMore = new()
        {
            Start = _ =>
            {
                if (isOver)
                {
                    throw new TimeoutException("once more");
                }
            },
        };
        SessionTest test = new SessionTest(With(onceMore)).At(0.9, player: 0, _ => isOver = true);
        Assert.Matches(
            "^The session cannot be checked: its world, played once more without delay and with all of it as history, ended\\. .*The rules .given 1. failed at .*: once more",
            Assert.Throws<SessionTestException>(() => test.Run(1, TestContext.Current.CancellationToken)).Message);
    }

    private static Scene Scene() => With(rules);

    private static Scene With(GivenRules rules) => new SceneBuilder("failing").AddPlane("floor", Vector3D.Up, V(0)).AddBody("one", Ball(0.5), V(0, 3)).AddBody("two", Ball(0.5), V(3, 3))
        .WithRules(rules).Build();

    /// <summary>Rules that fail in the host's world alone.</summary>
    private static SessionGroup Open() => new SessionGroup(
        Scene(), 3, LinkProfiles.PureDelay(20), 5, scenes: peer => peer == 0 ? Scene() : With(new GivenRules { Command = (_, _, _) => { } })).Connect();
}
