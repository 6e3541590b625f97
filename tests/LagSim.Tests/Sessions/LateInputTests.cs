using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing;
using LagSim.Testing.Links;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>No input is lost to a link that holds it back: the watermark waits for it, and what is later still happens later.</summary>
public sealed class LateInputTests
{
    private const double Hz = 30;

    [Theory]
    [InlineData("wifi-good", 12, false)] // with a fixed history of a second it loses 32 in a row
    [InlineData("wifi-busy", 6, false)]
    [InlineData("awful", 12, false)]
    [InlineData("blackout", 24, false)]
    [InlineData("delay-2000ms", 6, false)]
    [InlineData("modem-64k", 6, false)]
    [InlineData("wifi-good", 12, true)]
    [InlineData("blackout", 24, true)]
    [InlineData("delay-1000ms", 6, true)]
    [InlineData("delay-2000ms", 6, true)]
    public void HeldSticksAndHands_OfAHostAndThreeClients_LoseNothing(string link, double seconds, bool isHand)
    {
        SessionTestResult result = Steer(link, seconds, longest: null, isHand, out int done, out double behind);
        Assert.Equal((done, 0, 0), (result.EventsAccepted, result.EventsRefused, result.EventsMoved));
        Assert.True(result.WorldsAgree, $"{result}");
        Assert.InRange(behind, 1, 3.1);
    }

    [Theory]
    [InlineData("wifi-good", 12)]
    [InlineData("blackout", 24)]
    [InlineData("delay-2000ms", 6)]
    public void Hands_WithAFixedHistory_LoseKeyframes(string link, double seconds)
    {
        SessionTestResult not = Steer(link, seconds, LatencyCompensationWindow.DefaultHistory, isHand: true, out int _, out double _);
        Assert.InRange(not.EventsTooLate, 10, 2000); // the control: a keyframe does not move
    }

    [Fact]
    public void HeldSticks_WithAFixedHistory_AreMovedInstead()
    {
        SessionTestResult waits = Steer("wifi-good", 12, longest: null, isHand: false, out int done, out double _);
        SessionTestResult not = Steer("wifi-good", 12, LatencyCompensationWindow.DefaultHistory, isHand: false, out int doneThen, out double behind);
        Assert.Equal((0, 0, done), (waits.EventsMoved, waits.EventsRefused, waits.EventsAccepted));
        Assert.Equal((0, doneThen), (not.EventsRefused, not.EventsAccepted));
        Assert.InRange(not.EventsMoved, 10, 100); // the control: so many were too late for the second
        Assert.InRange(behind, 1, 1.1);
        Assert.True(not.WorldsAgree, $"{not}");
    }

    [Fact]
    public void ThrustOff_LaterThanAnyBound_ComesAfterThrustOn_OnEveryPeer()
    {
        SessionGroup group = Group(LinkProfiles.PureDelay(20), history: 0.2, longest: 0.6);
        group.Do(1, PlayerAction.SetVelocity(First, V(1)));
        group.Run(0.3);
        group.Cut(1, 0);
        PlayerAction[] late =
        [
            PlayerAction.SetFilter(First, new CollisionFilter(2, 3)), PlayerAction.SetVelocity(First, V(2)), PlayerAction.Teleport(First, V(0, 5)),
            PlayerAction.Impulse(Second, V(0.1)), PlayerAction.SetVelocity(First, V(0)),
        ];
        foreach (PlayerAction action in late)
        {
            group.Do(1, action);
            group.Run(0.02);
        }

        group.Run(1.5);
        group.Restore(1, 0);
        Assert.True(group.Settle(1 + late.Length));
        group.Run(1);
        UpdateEntry[] log = [.. group.Log.Values];
        Assert.Equal([Verdict.Accepted, Verdict.Moved, Verdict.Moved, Verdict.TooLate, Verdict.Moved, Verdict.Moved], log.Select(entry => entry.Verdict));
        SimTime[] moved = [.. log.Where(entry => entry.Verdict == Verdict.Moved).Select(entry => entry.Event.Time)];
        Assert.Equal(moved.Order().Distinct(), moved); // in the order in which they were done, whatever their kinds
        Assert.All(group.Sessions, session =>
        {
            Assert.Equal((5, 1, 4, 0), (session.Counters.EventsAccepted, session.Counters.EventsRefused, session.Counters.EventsMoved, session.Counters.EventsLost));
            Assert.Equal(V(0), Read(session.World!.Simulation, First, moved[^1]).Velocity);
        });
        Assert.Null(group.Difference());
        Assert.NotNull(group.Difference(group.Alone(log.Select(entry => entry.Event)))); // the control: the teleport would have shown
    }

    [Fact]
    public void Moved_IsTold_WithTheTimeAtWhichItHappened()
    {
        SessionGroup group = Group(LinkProfiles.PureDelay(20), history: 0.2, longest: 0.2);
        List<LogEntry> told = [];
        group.Sessions[1].Logged += told.Add;
        group.Cut(1, 0);
        ExternalEvent done = group.Do(1, PlayerAction.Impulse(First, V(1)));
        group.Run(0.5);
        group.Restore(1, 0);
        Assert.True(group.Settle(1));
        LogEntry entry = Assert.Single(told);
        Assert.True(entry is { Verdict: Verdict.Moved, IsAccepted: true } && entry.Event.Time > done.Time);
        Assert.Equal(done.At(entry.Event.Time), entry.Event);
        Assert.Null(group.Difference());
    }

    [Fact]
    public void Release_ThatIsTooLate_OpensTheHand()
    {
        foreach (bool isReleased in new[] { true, false })
        {
            SessionGroup group = Group(LinkProfiles.PureDelay(20), history: 0.1, longest: 0.2);
            group.Do(1, PlayerAction.Grab(First));
            group.Run(0.3);
            group.Cut(1, 0);
            if (isReleased)
            {
                group.Do(1, PlayerAction.Release(First, V(0, 2)));
            }

            group.Run(0.4);
            group.Restore(1, 0);
            Assert.True(group.Settle(isReleased ? 2 : 1));
            group.Run(0.1);
            SimTime now = group.Host.SharedTime.Now;
            Assert.All(group.Sessions, session => Assert.Equal(!isReleased, session.World!.Simulation.TryReadHold(First, now, out _))); // held otherwise: the control
            Assert.Null(group.Difference());
        }
    }

    [Fact]
    public void Late_AfterALaterOneOfItsKindThatWasScheduled_IsRefused()
    {
        foreach ((BodyId later, Verdict verdict) in new[] { (First, Verdict.TooLate), (Second, Verdict.Moved) })
        {
            SessionGroup group = Group(LinkProfiles.PureDelay(20), history: 0.4, longest: 0.4);
            group.Sessions[1].Do(PlayerAction.SetVelocity(later, V(0)), group.Sessions[1].SharedTime.Now + SimDuration.FromSeconds(0.15));
            group.Run(0.06);
            group.Cut(1, 0);
            group.Do(1, PlayerAction.SetVelocity(First, V(2)));
            group.Run(0.6);
            group.Restore(1, 0);
            Assert.True(group.Settle(2));
            Assert.Equal([Verdict.Accepted, verdict], group.Log.Values.Select(entry => entry.Verdict));
            group.Run(1);
            Assert.Null(group.Difference());
        }
    }

    [Fact]
    public void DrawnSessions_WithMovedInputs_AgreeBitForBit()
    {
        long moved = 0, refused = 0;
        string[] links = ["wifi-good", "wifi-busy", "awful", "3g", "satellite", "delay-200ms"];
        for (int seed = 1; seed <= 18; seed++)
        {
            double history = 0.05 + (0.05 * (seed % 4));
            SessionGroup group = Group(LinkProfiles.Get(links[seed % links.Length]), history, history * (1 + (seed % 3)), (ulong)seed);
            List<ExternalEvent> done = new ScriptedActions(seed, maxSpawns: 8) { HasHands = seed % 2 == 0 }.DoIn(group, 60, 0.06);
            Assert.True(group.Settle(done.Count), $"seed {seed}");
            Assert.All(group.Sessions, session => Assert.Equal(0, session.Counters.EventsLost));
            Assert.All(group.Sessions, session => Assert.Equal(group.Host.Counters.EventsMoved, session.Counters.EventsMoved));
            group.Run(1);
            Assert.True(group.Difference() is null, $"seed {seed}: {group.Difference()}");
            moved += group.Host.Counters.EventsMoved;
            refused += group.Host.Counters.EventsRefused;
        }

        Assert.True(moved > 80 && refused > 80, $"{moved} moved, {refused} refused");
    }

    [Fact]
    public void Watermark_WhileOneThatActsIsSilent_WaitsNoLongerThanTheBound()
    {
        SessionGroup group = new SessionGroup(
            ScriptedActions.Box(), 3, LinkProfiles.PureDelay(20), 1,
            _ => new HostOptions { LongestHistory = SimDuration.FromSeconds(2), Timeout = SimDuration.FromSeconds(20) }).Connect();
        group.Run(2);
        Assert.InRange(Behind(group), 0.99, 1.3);
        group.Do(1, PlayerAction.Impulse(First, V(0.1)));
        group.Run(1);
        group.Cut(1, 0);
        int steps = 0;
        group.BeforeStep = peer => steps += peer == 0 ? 1 : 0;
        group.Run(0.7);
        int before = steps;
        group.Run(0.7);
        Assert.InRange(Behind(group), 1.3, 1.9); // since it was heard last
        Assert.InRange(steps - before, 0, 2 * before); // a host that waits does not turn round and round
        group.Run(3.1);
        Assert.InRange(Behind(group), 1.99, 2.3);
        group.Run(6);
        Assert.InRange(Behind(group), 0.99, 1.3); // it has not acted for ten seconds
        Assert.Equal(2, group.Host.ClientCount);
    }

    [Fact]
    public void Client_ThatPromisesNothing_HoldsAllUpByTheBoundAlone()
    {
        SessionGroup group = Group(LinkProfiles.Lan, history: 0.5, longest: 1.5);
        RawClient liar = new(group);
        group.Run(1);
        liar.Claim(1, ExternalEvent.Impulse(group.Host.SharedTime.Now, liar.Peer, 1, First, V(0.1)));
        group.Run(1);
        Assert.InRange(Behind(group), 1.4, 1.51);
        group.Run(2);
        Assert.InRange(Behind(group), 1.4, 1.51);
    }

    [Theory]
    [InlineData(0.9, 1)]
    [InlineData(5.1, 1)]
    [InlineData(0, 0.2)]
    public void Options_LongestHistoryOutOfRange_SayWhatIsAllowed(double longest, double history)
    {
        HostOptions options = new()
        {
            Window = new(SimDuration.FromSeconds(history)),
            LongestHistory = SimDuration.FromSeconds(longest),
        };
        ArgumentOutOfRangeException why = Assert.Throws<ArgumentOutOfRangeException>(() => new SessionGroup(ScriptedActions.Box(), 1, LinkProfiles.Lan, 1, _ => options));
        Assert.Contains("must lie between the window's of", why.Message, StringComparison.Ordinal);
        Assert.Equal("LongestHistory", why.ParamName);
    }

    [Theory]
    [InlineData(1, 3)]
    [InlineData(0.2, 0.6)]
    [InlineData(5, 5)]
    public void LongestHistory_ByDefault_IsThriceTheHistory(double history, double longest) =>
        Assert.Equal(longest, new HostOptions { Window = new(SimDuration.FromSeconds(history)) }.LongestHistory.ToSeconds(), 9);

    private static SessionGroup Group(LinkProfile link, double history, double longest, ulong seed = 1) => new SessionGroup(
        ScriptedActions.Box(), 3, link, seed,
        _ => new HostOptions
        {
            Window = new(SimDuration.FromSeconds(history)),
            LongestHistory = SimDuration.FromSeconds(longest),
            ExtraHistory = SimDuration.FromSeconds(3),
        }).Connect();

    private static double Behind(SessionGroup group) => (group.Host.SharedTime.Now - group.Host.Watermark).ToSeconds();

    /// <summary>A host and three clients who push their marbles to and fro, or hold and wave them, each an act a thirtieth of a second.</summary>
    /// <param name="link">Over which profile.</param>
    /// <param name="seconds">For how long.</param>
    /// <param name="longest">The longest history; null for the default.</param>
    /// <param name="isHand">Whether they hold them.</param>
    /// <param name="done">How many acts there were.</param>
    /// <param name="behind">The most by which the watermark was behind after the first two seconds.</param>
    private static SessionTestResult Steer(string link, double seconds, SimDuration? longest, bool isHand, out int done, out double behind)
    {
        SceneBuilder marbles = new SceneBuilder("marbles").AddPlane("floor", Vector3D.Up, Vector3D.Zero);
        for (int n = 0; n <= 3; n++)
        {
            marbles.AddBody($"m{n}", new BodySpec(0.3, 1, 0.6, friction: 0.5, rollingResistance: 0.02), new Vector3D(n * 2.5, 0.3, 0));
        }

        Scene scene = marbles.Build();
        int pushes = 0;
        double worst = 0;
        SessionTest test = new SessionTest(scene).WithClients(3, link).WithSeed(1);
        test = longest is SimDuration most ? test.WithOptions(player => player == 0 ? new HostOptions { LongestHistory = most } : new ClientOptions()) : test;
        for (int player = 0; player <= 3; player++)
        {
            BodyId body = scene.BodyNamed($"m{player}");
            double x = player * 2.5;
            int n = 0;
            test = test.Every(1 / Hz, player, me =>
            {
                me.Do(!isHand ? PlayerAction.Impulse(body, V(n % 20 < 10 ? 0.1 : -0.1))
                    : n == 0 ? PlayerAction.Grab(body)
                    : PlayerAction.HoldKeyframe(body, new Vector3D(x + (0.2 * Math.Sin(0.1 * n)), 0.6, 0), new Vector3D(0.6 * Math.Cos(0.1 * n), 0, 0)));
                n++;
                pushes++;
                if (me.Session is HostSession host && n > 2 * Hz)
                {
                    worst = Math.Max(worst, (host.SharedTime.Now - host.Watermark).ToSeconds());
                }
            });
        }

        SessionTestResult result = test.RunUnchecked(seconds);
        (done, behind) = (pushes, worst);
        return result;
    }
}
