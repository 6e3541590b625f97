using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Sessions;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Testing;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Tests.Docs;

public struct Score
{
    public int Left;
    public int Right;
    public int IsOver;
}

public sealed class Football : GameRules
{
    private const int Whistle = 1;
    private const int Goal = 1;
    private static readonly BodyId Ball = BodyId.OfScene(0);

    public Football()
        : base("football", version: 1) => WithWorldState<Score>();

    public override bool HearsCrossing(BodyId body, int sensor) => body == Ball;

    public override void OnStart(RuleWorld world) => world.SetTimer(Whistle, SimDuration.FromSeconds(90));

    public override void OnCrossing(RuleWorld world, in Crossing crossing)
    {
        ref Score score = ref world.State<Score>();
        if (!crossing.Entered || score.IsOver == 1)
        {
            return;
        }

        score.Left += crossing.Sensor == 1 ? 1 : 0;
        score.Right += crossing.Sensor == 0 ? 1 : 0;
        world.Tell(Goal, crossing.Sensor);
        world.Teleport(Ball, new Vector3D(0, 0.5, 0)); // to the middle, at rest, at the very tick of the goal
    }

    public override void OnTimer(RuleWorld world, int timer) => world.State<Score>().IsOver = 1;
}

public struct Vote
{
    public long Map;
}

public struct Votes
{
    public long Day;
    public long Night;
}

public sealed class VoteRules : GameRules
{
    private const int Cast = 1;

    public VoteRules()
        : base("votes", version: 1) => WithWorldState<Votes>();

    public override void OnCommand(RuleWorld world, byte player, GameCommand command)
    {
        if (command.Number == Cast && command.TryRead(out Vote vote) && vote.Map is 0 or 1)
        {
            ref Votes votes = ref world.State<Votes>();
            votes.Day += vote.Map == 0 ? 1 : 0;
            votes.Night += vote.Map == 1 ? 1 : 0;
            world.Tell(code: Cast, value: vote.Map, key: player);
        }
    }
}

public struct Lobby
{
    public ulong Leader; // by identity, 0 for nobody
    public ulong Away; // a bit for each number
    public long Playing;
}

public sealed class LobbyRules : GameRules
{
    public LobbyRules()
        : base("lobby", version: 1) => WithWorldState<Lobby>();

    public override bool HearsPlayers => true;

    public override void OnPlayer(RuleWorld world, PlayerEvent player)
    {
        if (player.Role == PeerRole.Spectator)
        {
            return; // spectators are told of like players
        }

        ref Lobby lobby = ref world.State<Lobby>();
        bool isOut = player.Kind == PlayerEventKind.Left;
        lobby.Playing += isOut ? -1 : player.Kind == PlayerEventKind.Joined ? 1 : 0;
        lobby.Away &= ~(1UL << player.Number);
        lobby.Away |= player.Kind == PlayerEventKind.Away ? 1UL << player.Number : 0;
        lobby.Leader = isOut && lobby.Leader == player.Identity ? 0 : lobby.Leader == 0 && !isOut ? player.Identity : lobby.Leader;
    }
}

/// <summary>The code of docs/RULES.md: <see cref="SnippetTests"/> holds the page to it and runs it.</summary>
internal static class RuleSnippets
{
    internal static int Goals()
    {
        RuleNotices notices = new();
        int goals = 0;
        while (notices.TryRead(out RuleEvent told))
        {
            goals += told.Kind == NoticeKind.Confirmed && told.Notice.Code == 1 ? 1 : 0;
        }

        return goals;
    }

    internal static string? WhyACommandFailed(RuleNotices notices)
    {
        string? why = null;
        while (notices.TryRead(out RuleEvent told))
        {
            why = told.Notice.Code == RuleNotice.CommandFailed ? told.Notice.Sentence : why;
        }

        return why;
    }

    internal static (Scene Pitch, HostOptions Host, ClientOptions Client) Give()
    {
        Scene pitch = new SceneBuilder("pitch").AddBody("ball", new BodySpec(0.25, 1, 0.8), new Vector3D(0, 2, 0)).WithRules(new Football()).WithSeed(7).Build();
        HostOptions host = new() { RuleNotices = new RuleNotices() };
        ClientOptions client = new() { Rules = [new Football()], RuleNotices = new RuleNotices() };
        return (pitch, host, client);
    }

    internal static Score AfterAKick(Scene pitch)
    {
        BodyId ball = pitch.BodyNamed("ball");
        Score score = new SessionTest(pitch)
            .WithClients(2, "4g")
            .At(1, player: 1, PlayerAction.SetVelocity(ball, new Vector3D(12, 4, 0)))
            .Run(seconds: 4)
            .StateOfRules<Score>();
        return score;
    }
}
