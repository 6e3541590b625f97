using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Sessions;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Tests.Sessions;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Rules;

/// <summary>A goal that rules tell is confirmed once on every peer, at the same tick, whatever the links do. In virtual time.</summary>
public sealed class GoalsOverLinksTests
{
    private const int Goal = 1;
    private const double History = 3;

    /// <summary>The score is in the state, so what is told of a goal hangs on all that came before it.</summary>
    private static readonly GivenRules Football = new()
    {
        HearsSensor = (_, _) => true,
        Crossed = (w, crossing) =>
        {
            if (crossing.Entered)
            {
                w.Tell(Goal, ++w.State<GivenState>().Count);
            }
        },
    };

    [Theory]
    [InlineData("awful", 1)]
    [InlineData("delay-500ms", 3)]
    [InlineData("4g", 2)]
    public void Goals_OnABadLink_AreConfirmedOnceOnEveryPeerAtTheSameTick(string link, int seed)
    {
        RuleEvents[] told = [.. Enumerable.Range(0, 3).Select(_ => new RuleEvents())];
        SessionGroup group = Group(told, LinkProfiles.Get(link), (ulong)seed);
        new ScriptedActions(seed, maxSpawns: 4).DoIn(group, 24, 0.2);
        group.Run(12);
        List<(EventKey Key, int Place, RuleNotice Notice)> happened = RuleEvents.Of(group.Alone());
        Assert.Equal(Enumerable.Range(1, happened.Count).Select(n => (long)n), happened.Select(goal => goal.Notice.Value));
        foreach ((RuleEvents one, Session session) in told.Zip(group.Sessions))
        {
            Assert.Equal(happened.Take(one.Confirmed.Count), one.Confirmed);
            SimTime settled = session.World!.Simulation.HistoryEdge - SimDuration.FromSeconds(1.5); // the host's world steps once a second at least
            Assert.True(settled > group.Host.World!.Simulation.Start + SimDuration.FromSeconds(5));
            Assert.InRange(one.Confirmed.Count, Math.Max(5, happened.Count(goal => goal.Key.Time < settled)), happened.Count);
            Assert.Equal(one.Predicted - one.Retracted, one.Confirmed.Count + one.Notices.Pending);
        }

        // The controls: goals moved on the way, and without one of the early events others would have been shot.
        Assert.True(told.Sum(one => one.Moved) > 0);
        int least = told.Min(one => one.Confirmed.Count);
        Assert.Contains(
            group.Accepted.ToList(),
            left => !RuleEvents.Of(group.Alone(group.Accepted.Where(e => !e.Equals(left)))).Take(least).SequenceEqual(happened.Take(least)));
    }

    [Fact]
    public void Goals_OfAHostThatConfirmsEarly_AreConfirmedAsSoonAsTheLinksAllow()
    {
        Assert.InRange(LatestConfirmation(early: true, out int told), 0.04, 0.6);
        Assert.InRange(LatestConfirmation(early: false, out int later), History, History + 3); // the control
        Assert.True(told > 20 && later > 20, $"{told} {later}");
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Goals_OfOneWhoJoinsLate_AreTheLaterOnesOnceEach_AndItsScoreIsThatOfAll(bool early)
    {
        RuleEvents[] told = [.. Enumerable.Range(0, 2).Select(_ => new RuleEvents())];
        SessionGroup group = Group(told, LinkProfiles.Get("4g"), 5, early);
        new ScriptedActions(5, maxSpawns: 2).DoIn(group, 20, 0.3);
        group.Run(4);
        RuleEvents late = new();
        ClientSession joined = group.Join(7, 77, new ClientOptions { Rules = [Football], RuleNotices = late.Notices, Window = Window });
        ClientSession without = group.Join(8, 88, new ClientOptions { Window = Window });
        Assert.True(group.RunUntil(() => joined.State == SessionState.Running && without.State == SessionState.Ended), $"{joined.State} {without.State}");
        Assert.Contains("given", without.EndReason, StringComparison.Ordinal); // the control: without the code nobody gets in
        group.DropLast();
        SimTime from = joined.BegunFrom!.Time;
        for (int n = 0; n < 18; n++)
        {
            group.Do(n % 3, PlayerAction.SetVelocity(BodyId.OfScene(n % 4), V(n % 2 == 0 ? 3 : -3, 3)));
            group.Run(0.4);
        }

        group.Run(8);
        List<(EventKey Key, int Place, RuleNotice Notice)> happened = RuleEvents.Of(group.Alone());
        int earlier = happened.Count(goal => goal.Key.Time < from);
        Assert.True(earlier > 2 && late.Confirmed.Count > 5, $"{earlier} {late.Confirmed.Count}");
        Assert.Equal(happened.Skip(earlier).Take(late.Confirmed.Count), late.Confirmed);
        Assert.All(told, one => Assert.Equal(happened.Take(one.Confirmed.Count), one.Confirmed));
        Assert.Null(group.Difference());
        Simulation world = joined.World!.Simulation;
        Assert.True(world.TryReadRules(world.HistoryEdge, out GivenState score));
        int scored = happened.Count(goal => goal.Key.Time <= world.HistoryEdge);
        Assert.Equal(scored, score.Count);
        Assert.NotEqual(scored, happened.Count(goal => goal.Key.Time <= world.HistoryEdge && goal.Key.Time >= from)); // the control: not only of its own time
    }

    private static LatencyCompensationWindow Window => new(SimDuration.FromSeconds(History));

    private static SessionGroup Group(RuleEvents[] told, LinkProfile link, ulong seed, bool early = false)
    {
        Scene box = ScriptedActions.Box();
        Scene field = new(
            box.Name, box.Gravity, box.RestitutionThreshold, box.ContactTolerance, box.PlaneArray, box.SphereArray, box.BodyArray, box.ForceArray, box.SmallestRadius,
            box.Spawners, box.Box, [.. new SceneBuilder("goals").AddSensorPlane("left half", V(1), 0.0).Build().Sensors], Football, box.Seed);
        return new SessionGroup(field, told.Length, link, seed, peer => peer == 0
            ? new HostOptions { Window = Window, RuleNotices = told[0].Notices, ConfirmsEarly = early }
            : new ClientOptions { Window = Window, RuleNotices = told[peer].Notices, Rules = [Football] }).Connect();
    }

    /// <summary>How long after it was shot the last goal was confirmed on any peer.</summary>
    private static double LatestConfirmation(bool early, out int count)
    {
        RuleEvents[] told = [.. Enumerable.Range(0, 3).Select(_ => new RuleEvents())];
        SessionGroup group = Group(told, LinkProfiles.Transatlantic, 1, early);
        double latest = 0;
        count = 0;
        for (int n = 0; n < 1500; n++)
        {
            if (n % 30 == 0)
            {
                group.Do(n / 30 % 3, PlayerAction.SetVelocity(BodyId.OfScene(n / 30 % 4), V(n / 30 % 2 == 0 ? 4 : -4, 3)));
            }

            group.Run(0.01);
            for (int peer = 0; peer < told.Length; peer++)
            {
                while (told[peer].Notices.TryRead(out RuleEvent one))
                {
                    if (one.Kind == NoticeKind.Confirmed)
                    {
                        count++;
                        latest = Math.Max(latest, (group.Sessions[peer].SharedTime.Now - one.Time).ToSeconds());
                    }
                }
            }
        }

        return latest;
    }
}
