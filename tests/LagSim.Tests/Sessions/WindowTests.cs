using System;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>The window: its limits, what a local lag saves, and what happens when what is in it is too much.</summary>
public sealed class WindowTests
{
    [Theory]
    [InlineData(0.049, 0.03, "history")]
    [InlineData(5.1, 0.03, "history")]
    [InlineData(1, 0, "lookAhead")]
    [InlineData(1, 1.1, "lookAhead")]
    public void Window_OutOfRange_IsRefusedWithWhatIsAllowed(double history, double lookAhead, string named)
    {
        ArgumentOutOfRangeException refused = Assert.Throws<ArgumentOutOfRangeException>(
            () => new LatencyCompensationWindow(SimDuration.FromSeconds(history), SimDuration.FromSeconds(lookAhead)));
        Assert.Equal(named, refused.ParamName);
        Assert.Contains(named == "history" ? "0.05" : "1s", refused.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void LocalLag_LongerThanWhatIsSimulatedOrKept_IsRefused()
    {
        LatencyCompensationWindow window = new(SimDuration.FromSeconds(0.1), SimDuration.FromSeconds(0.2));
        Assert.Throws<ArgumentOutOfRangeException>(() => window.WithLocalLag(EventKind.Impulse, SimDuration.FromSeconds(0.06)));
        Assert.Throws<ArgumentOutOfRangeException>(() => window.WithLocalLag(EventKind.Impulse, -SimDuration.OneTick));
        Assert.Throws<ArgumentOutOfRangeException>(() => window.WithLocalLag(EventKind.Impact, SimDuration.Zero));
        LatencyCompensationWindow lagging = window.WithLocalLag(EventKind.Impulse, SimDuration.FromSeconds(0.05));
        Assert.Equal((SimDuration.FromSeconds(0.05), SimDuration.Zero), (lagging.LocalLag(EventKind.Impulse), lagging.LocalLag(EventKind.Grab)));
        Assert.Equal(SimDuration.Zero, window.LocalLag(EventKind.Impulse)); // another window
        Assert.Throws<ArgumentOutOfRangeException>(() => lagging.WithLookAhead(SimDuration.FromSeconds(0.04)));
        Assert.Throws<ArgumentOutOfRangeException>(() => lagging.WithHistory(SimDuration.FromSeconds(0.08)));
        Assert.Equal(SimDuration.FromSeconds(0.05), lagging.WithHistory(SimDuration.FromSeconds(2)).LocalLag(EventKind.Impulse));
    }

    [Theory]
    [InlineData(1, 0.9, 0.9)] // few: the largest
    [InlineData(999, 0.9, 0.9)]
    [InlineData(1000, 0.9, 0.4)] // one in a thousand may be later
    [InlineData(10, 0.01, 0.4)]
    [InlineData(1, 0.01, 0.25)]
    [InlineData(10, 7, 5)]
    public void HistoryFor_Measured_IsTheirPercentileBetweenTheLimits(int count, double latest, double history)
    {
        SimDuration[] lateness = [.. Enumerable.Repeat(SimDuration.FromSeconds(0.4), count)];
        lateness[count / 2] = SimDuration.FromSeconds(latest);
        Assert.Equal(SimDuration.FromSeconds(history), LatencyCompensationWindow.HistoryFor(lateness));
        Assert.Throws<ArgumentException>(() => LatencyCompensationWindow.HistoryFor([]));
    }

    [Theory]
    [InlineData(60, 0)] // above the delay: nobody has to heal
    [InlineData(0, 20)]
    public void LocalLag_AboveTheDelay_NobodyHeals(double milliseconds, long heals)
    {
        LatencyCompensationWindow window = new LatencyCompensationWindow(lookAhead: SimDuration.FromSeconds(0.2))
            .WithLocalLag(EventKind.Impulse, SimDuration.FromMilliseconds(milliseconds));
        SessionGroup group = new SessionGroup(BuiltInScenes.Billiards(), 2, LinkProfiles.PureDelay(40), 1, _ => new HostOptions { Window = window }).Connect();
        group.Run(1);
        for (int i = 0; i < 20; i++)
        {
            group.Do(i % 2, PlayerAction.Impulse(BodyId.OfScene(i % 5), V(0.1 * (i % 3), 0, 0.05)));
            group.Run(0.1);
        }

        group.Run(6);
        Assert.Equal(heals, group.Sessions.Sum(s => s.Counters.Heals));
        Assert.All(group.Sessions, s => Assert.Equal((0, true), (s.Counters.StatesDiffered, s == group.Host || s.Counters.StatesAgreed > 0)));
    }

    [Fact]
    public void Client_WithoutRoomForWhatMayStillChange_SaysSoLeavesAndCanJoinAgain() // once fresh copies were of no use either
    {
        SessionGroup group = new SessionGroup(
            BuiltInScenes.Billiards(), 3, LinkProfiles.PureDelay(20), 1, peer => new ClientOptions { MaxSegments = peer == 1 ? 60 : SimulationOptions.DefaultMaxSegments }).Connect();
        group.Run(0.5);
        for (int i = 0; i < 1000 && group.Sessions[1].State != SessionState.Ended; i++)
        {
            group.Do(0, PlayerAction.Impulse(BodyId.OfScene(i % 10), V(0.2, 0, 0.1)));
            group.Run(0.01);
        }

        Assert.Equal((SessionState.Ended, SessionEnd.TimelinesFull), (group.Sessions[1].State, group.Sessions[1].EndedBy));
        Assert.Contains("60 segments", group.Sessions[1].EndReason, StringComparison.Ordinal);
        Assert.Contains("3 fresh copies in a row were of no use", group.Sessions[1].EndReason, StringComparison.Ordinal);
        Assert.Equal(3, group.Sessions[1].Counters.Renewals);
        group.Run(1);
        Assert.Equal(1, group.Host.ClientCount); // the others go on
        Assert.Equal(SessionState.Running, group.Sessions[2].State);

        ClientSession again = group.Join(7, 77);
        Assert.True(group.RunUntil(() => again.State == SessionState.Running, 10));
        group.Run(8);
        Assert.True(again.Counters.StatesAgreed > 0);
        Assert.All(group.Sessions, s => Assert.Equal(0, s.Counters.StatesDiffered));
    }
}
