using System;
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
    private const double Dear = 2000;

    /// <summary>
    /// On machines that are half as fast as assumed, a player sends as many commands as it may. So many are refused that no world is late by what a
    /// person sees. Ten a second harm nobody. The controls: without a budget the worlds fall behind for good, and with rules that do not say what a
    /// call takes nobody is charged for it.
    /// </summary>
    [Theory]
    [InlineData(500, Dear, true, true)]
    [InlineData(10, Dear, true, false)]
    [InlineData(500, Dear, false, false)]
    [InlineData(500, 0, true, false)]
    public void Do_CommandsThatAreDear_RefusesWhatIsTooMany(int aSecond, double each, bool hasBudget, bool isRefused)
    {
        GivenRules rules = new() { Command = (world, _, _) => world.Charge(each) };
        Scene scene = new SceneBuilder("told").AddBody("ball", Ball(0.1), V(0, 1)).WithGravity(V(0)).WithRules(rules).Build();
        SessionGroup group = new(
            scene, 3, LinkProfiles.PureDelay(20), 1,
            peer => peer == 0 ? new HostOptions { PlayerBudget = hasBudget ? PlayerBudget.Default : null } : new ClientOptions { Rules = [rules] });
        group.Connect();
        group.Run(1);
        group.Steps.WorkPerSecond = 5e5;
        double late = 0, next = 0;
        for (double at = 0; at < 3 && late < 0.7; at += 0.002)
        {
            if (at >= next && group.Client(1).State == SessionState.Running)
            {
                group.Do(1, PlayerAction.Command(new GameCommand(1)));
                next += 1.0 / aSecond;
            }

            group.Run(0.002);
            late = Math.Max(late, (group.Host.SharedTime.Now - group.Host.World!.RenderedTo).ToSeconds());
            late = Math.Max(late, (group.Sessions[2].SharedTime.Now - group.Sessions[2].World!.RenderedTo).ToSeconds());
        }

        Assert.Equal(hasBudget, late < 0.25);
        Assert.Equal((isRefused, SessionState.Running), (group.Host.Counters.EventsRefused > 1000, group.Client(2).State));
    }
}
