using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Tests.Rules;
using LagSim.Tests.Sessions;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Budgets;

/// <summary>Commands for which a game's rules take two milliseconds each: of hundreds a second most are refused, if the rules say what they take.</summary>
public sealed class DearCommandTests
{
    private const double Dear = 2000, Seconds = 3;

    /// <summary>
    /// A player sends as many commands as it may, and so many are refused that the rest stays within its budget. Ten a second harm nobody. The
    /// controls: without a budget they take a core, and of rules that do not say what a call takes nothing is refused.
    /// </summary>
    [Theory]
    [InlineData(500, Dear, true, true, 60_000, 420_000)]
    [InlineData(10, Dear, true, false, 55_000, 65_000)]
    [InlineData(500, Dear, false, false, 2_800_000, 3_500_000)]
    [InlineData(500, 0, true, false, 5000, 60_000)]
    public void Do_CommandsThatAreDear_RefusesWhatIsTooMany(int aSecond, double each, bool hasBudget, bool isRefused, double least, double most)
    {
        GivenRules rules = new() { Command = (world, _, _) => world.Charge(each) };
        Scene scene = new SceneBuilder("told").AddBody("ball", Ball(0.1), V(0, 1)).WithGravity(V(0)).WithRules(rules).Build();
        SessionGroup group = new SessionGroup(
            scene, 2, LinkProfiles.PureDelay(20), 1,
            peer => peer == 0 ? new HostOptions { PlayerBudget = hasBudget ? PlayerBudget.Default : null } : new ClientOptions { Rules = [rules] }).Connect();
        group.Run(1);
        double next = 0;
        for (double at = 0; at < Seconds; at += 0.002)
        {
            if (at >= next)
            {
                group.Do(1, PlayerAction.Command(new GameCommand(1)));
                next += 1.0 / aSecond;
            }

            group.Run(0.002);
        }

        group.Run(1);
        Assert.Equal((isRefused, SessionState.Running), (group.Host.Counters.EventsRefused > 1000, group.Client(1).State));
        Assert.InRange(group.Host.World!.Work!.ChargedTo(group.Client(1).Peer), least, most);
    }
}
