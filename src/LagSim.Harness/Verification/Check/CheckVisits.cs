using System.Collections.Generic;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Verification.Check;

/// <summary>Whether the rules of a seeded session hear of its players, and who of these leaves and comes back then.</summary>
/// <remarks>
/// Drawn from a stream of its own, and in some of the sessions with rules only, so that all others stay the same. In these some more players
/// leave, most of them keep their places, and most come back: with their pass as who they were, without it as strangers.
/// </remarks>
internal sealed class CheckVisits
{
    private const double Percent = 50; // of the sessions with rules
    private const double LeavePercent = 30;
    private const double KeepPercent = 70;
    private const double ReturnPercent = 70;
    private const double PassPercent = 75;
    private const double BotPercent = 20;
    private const double SoonPercent = 50;

    /// <summary>The time within which a player leaves that would not otherwise, in seconds from the session's start.</summary>
    private const double FirstLeave = 1;
    private const double LastLeave = 8;

    /// <summary>How long a player is away before it asks again, in seconds: it may be too long for its place.</summary>
    private const double ShortestAway = 0.02;
    private const double LongestAway = 5;

    /// <summary>The round trip above which nobody comes back, since joining takes several.</summary>
    private const double SlowMilliseconds = 500;
    private const string Letters = "Annéß-北";

    private static readonly SimDuration Patience = SimDuration.FromSeconds(20); // several times the slowest round trip
    private static readonly SimDuration Soon = SimDuration.FromSeconds(6); // a silence of half of it is heard of

    private readonly SeededRandom random;

    internal CheckVisits(SeededRandom random, bool mayExist)
    {
        this.random = random;
        Exist = random.Fork(0).IsLucky(Percent) && mayExist;
    }

    /// <summary>Whether rules hear of players.</summary>
    internal bool Exist { get; }

    /// <summary>How long a peer may be silent.</summary>
    internal SimDuration Timeout { get; private set; } = Patience;

    /// <summary>How long the host keeps the number of a player that is away.</summary>
    internal SimDuration RejoinTime { get; private set; } = UsualRejoinTime;

    /// <summary>The same where nothing else is drawn.</summary>
    internal static SimDuration UsualRejoinTime { get; } = new HostOptions().RejoinTime;

    /// <summary>Has players leave, and adds those who come back.</summary>
    internal void AddTo(List<CheckPlayer> players)
    {
        if (!Exist)
        {
            return;
        }

        // Neither a slow link nor a host that stands still is to be taken for a player who has gone.
        bool isQuick = players[0].Stop is null && players.TrueForAll(p => p.Link.RoundTripMilliseconds <= SlowMilliseconds && p.Link.ToHost.Bottleneck is null);
        Timeout = random.IsLucky(SoonPercent) && isQuick ? Soon : Patience;
        RejoinTime = SimDuration.FromSeconds(random.NextDouble(ShortestAway, LongestAway));
        players[0] = players[0] with { Name = DrawName() };
        int drawn = players.Count;
        for (int peer = 1; peer < drawn; peer++)
        {
            double later = random.NextDouble(FirstLeave, LastLeave);
            double? leaves = players[peer].LeavesAtSeconds ?? (random.IsLucky(LeavePercent) ? later : null);
            CheckPlayer player = players[peer] with
            {
                LeavesAtSeconds = leaves,
                KeepsPlace = random.IsLucky(KeepPercent),
                Name = DrawName(),
                Role = random.IsLucky(BotPercent) ? PeerRole.Bot : PeerRole.Player,
            };
            players[peer] = player;
            double away = random.NextDouble(ShortestAway, LongestAway) * random.NextDouble();
            bool comesBack = random.IsLucky(ReturnPercent), hasPass = random.IsLucky(PassPercent);
            string name = random.IsLucky(KeepPercent) ? player.Name : DrawName();
            if (leaves is double at && comesBack && player.Link.RoundTripMilliseconds <= SlowMilliseconds)
            {
                players.Add(player with
                {
                    AsksAtSeconds = CheckCase.AskOf(at + ShortestAway + away, players[0]),
                    LeavesAtSeconds = null,
                    Stop = null,
                    Returns = peer,
                    HasPass = hasPass,
                    Name = name,
                });
            }
        }
    }

    private string DrawName() => Letters[..random.NextInt(Letters.Length + 1)];
}
