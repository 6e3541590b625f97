using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Docs;

/// <summary>The rules of docs/RULES.md that hear commands and players do what the page says.</summary>
public sealed class VoteSnippetTests
{
    [Fact]
    public void OnCommand_OfThePage_CountsVotesAndNothingElse()
    {
        Simulation world = new(new SceneBuilder("votes").AddBody("ball", new BodySpec(0.25, 1, 0.8), Vector3D.Zero).WithRules(new VoteRules()).Build());
        GameCommand[] commands = [GameCommand.Of(1, new Vote { Map = 1 }), GameCommand.Of(1, new Vote { Map = 3 }), new GameCommand(1), GameCommand.Of(2, new Vote())];
        for (int n = 0; n < commands.Length; n++)
        {
            world.Submit(PlayerAction.Command(commands[n]).Stamp(SimTime.FromSeconds(1 + n), 1, (uint)(n + 1)));
        }

        world.AdvanceTo(SimTime.FromSeconds(9));
        Assert.True(world.TryReadRules(SimTime.FromSeconds(9), out Votes votes));
        Assert.Equal((0, 1), (votes.Day, votes.Night));
    }

    /// <summary>A spectator is told of like a player; the page's lobby does not count it. The control: a bot is counted.</summary>
    [Theory]
    [InlineData(PeerRole.Spectator, 1)]
    [InlineData(PeerRole.Bot, 2)]
    public void OnPlayer_OfThePage_CountsWhoPlays(PeerRole role, int playing)
    {
        Simulation world = new(new SceneBuilder("lobby").AddBody("ball", new BodySpec(0.25, 1, 0.8), Vector3D.Zero).WithRules(new LobbyRules()).Build());
        world.Submit(new PlayerEvent(PlayerEventKind.Joined, 17, 5, "Sue", role).Stamp(SimTime.FromSeconds(1), 1));
        world.Submit(new PlayerEvent(PlayerEventKind.Joined, 1, 7, "Ann").Stamp(SimTime.FromSeconds(2), 2));
        world.AdvanceTo(SimTime.FromSeconds(3));
        Assert.True(world.TryReadRules(SimTime.FromSeconds(3), out Lobby lobby));
        Assert.Equal((playing, playing == 1 ? 7UL : 5UL), (lobby.Playing, lobby.Leader));
    }
}
