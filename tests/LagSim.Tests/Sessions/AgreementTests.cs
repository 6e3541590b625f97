using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Net.Strategies;
using LagSim.Net.Wire;
using LagSim.Testing.Links;
using LagSim.Tests.Faults;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>The invariant over a network: whatever becomes of the datagrams, all worlds are that of one who had every accepted event at once.</summary>
public sealed class AgreementTests
{
    private const int Count = 24;

    public static TheoryData<string, int> Links => new()
    {
        { "loopback", 2 }, { "lan", 3 }, { "delay-100ms", 5 }, { "awful", 2 }, { "awful", 3 }, { "awful", 5 },
        { "loss-10", 3 }, { "loss-20", 2 }, { "loss-30", 4 }, { "doubled", 3 }, { "shuffled", 3 },
    };

    [Theory]
    [MemberData(nameof(Links))]
    public void Worlds_WhateverTheLink_AreThatOfOneWhoHadAllAcceptedEventsAtOnce(string link, int peers)
    {
        long heals = 0, lost = 0;
        for (ulong seed = 1; seed <= 6; seed++)
        {
            SessionGroup group = Play(link, peers, seed, LongHistory);
            string? difference = group.Difference();
            Assert.True(difference is null, $"{link}, {peers} peers, seed {seed}: {difference}");
            Assert.All(group.Sessions, s => Assert.Equal((0, Count), (s.Counters.EventsLost, s.Counters.EventsAccepted)));
            heals += group.Sessions.Sum(s => s.Counters.Heals);
            lost += group.Network.DatagramsLost;
        }

        // Else nothing was shown.
        Assert.True(heals > 30, $"{heals} heals");
        Assert.Equal(link is "awful" or "loss-10" or "loss-20" or "loss-30", lost > 0);
    }

    [Fact]
    public void SyncTest_OfASession_FindsNothingAndNamesTheFirstDifferenceWhereHealingIsWrong()
    {
        static SessionGroup Group(HealingFault fault, string strategy)
        {
            SessionGroup group = new(ScriptedActions.Box(), 3, LinkProfiles.PureDelay(150), 2, _ => new HostOptions { SyncTest = true, Strategy = LateEventStrategies.OfName(strategy) });
            group.Sessions[1].Put(new FaultyEngineParts { Healing = fault });
            group.Connect();
            try
            {
                new ScriptedActions(7).DoIn(group, Count);
            }
            catch (InvalidOperationException) when (group.Sessions[1].State == SessionState.Ended)
            {
                // Nothing can be done there any more.
            }

            group.Run(2);
            return group;
        }

        foreach (string strategy in new[] { "healing", "interpolation" })
        {
            SessionGroup right = Group(HealingFault.None, strategy);
            Assert.All(right.Sessions, s => Assert.Equal(SessionState.Running, s.State));
            Assert.True(right.Sessions.Sum(s => s.Counters.Heals) > 10);
        }

        SessionGroup wrong = Group(HealingFault.CutsByTime, "healing");
        Assert.Equal(SessionEnd.Failed, wrong.Sessions[1].EndedBy);
        Assert.Contains("The sync test failed", wrong.Sessions[1].EndReason, StringComparison.Ordinal);
        Assert.Equal((SessionState.Running, SessionState.Running), (wrong.Sessions[0].State, wrong.Sessions[2].State));

        foreach (string strategy in new[] { "none", "latency-forward", "full-rollback" })
        {
            ArgumentException refused = Assert.Throws<ArgumentException>(() => Group(HealingFault.None, strategy));
            Assert.Contains($"'{strategy}'", refused.Message, StringComparison.Ordinal);
        }
    }

    [Theory]
    [InlineData("awful", 3)]
    [InlineData("loss-20", 4)]
    public void Commit_OnABadLinkWithHistoryForgotten_DropsNothingThatAnAcceptedEventStillNeeds(string link, int peers)
    {
        int forgotten = 0;
        for (ulong seed = 1; seed <= 8; seed++)
        {
            SessionGroup group = Play(link, peers, seed, _ => new HostOptions { Window = new(SimDuration.FromSeconds(1)) });
            group.Run(5);
            Assert.True(group.Difference() is null, $"seed {seed}: {group.Difference()}");
            Assert.All(group.Sessions, s => Assert.Equal(0, s.Counters.EventsLost));
            forgotten += group.Sessions.Count(s => s.World!.Simulation.HistoryEdge > s.World.Simulation.Start);
        }

        Assert.Equal(8 * peers, forgotten);
    }

    [Fact]
    public void Check_StrategyNone_IsSeenToFail()
    {
        int differences = 0;
        for (ulong seed = 1; seed <= 10; seed++)
        {
            SessionGroup group = Play("delay-100ms", 3, seed, _ => new HostOptions { Strategy = LateEventStrategy.ApplyOnArrival, ExtraHistory = SimDuration.FromSeconds(60) });
            differences += group.Difference() is null ? 0 : 1;
        }

        Assert.Equal(10, differences);
    }

    [Fact]
    public void Check_OneEventLostForGood_IsSeenToFail()
    {
        // Everything that carries one certain entry of the log is lost on its way to one client, for ever.
        int seen = 0;
        for (ulong seed = 1; seed <= 10; seed++)
        {
            SessionGroup group = Connected("delay-100ms", 3, seed, LongHistory);
            UpdateDatagram read = new();
            group.Network.Lose((from, to, datagram) => from == 0 && to == 2 && read.TryDecode(datagram.Span, out _)
                && read.FirstIndex <= 12 && read.FirstIndex + read.Entries.Length > 12);
            new ScriptedActions((int)seed).DoIn(group, Count);
            Assert.False(group.Settle(Count, 5));
            Assert.InRange(group.Sessions[2].Counters.EventsAccepted, 0, 11);
            Assert.Equal(Count, group.Sessions[1].Counters.EventsAccepted);
            seen += group.Difference() is string difference && difference.StartsWith("peer 2", StringComparison.Ordinal) ? 1 : 0;
        }

        Assert.Equal(10, seen);
    }

    [Fact]
    public void Check_LoneWorldWithoutOneEvent_IsSeenToDiffer()
    {
        // Of every event that a timeline shows; one that met no body is rightly not missed.
        int left = 0, seen = 0;
        for (ulong seed = 1; seed <= 4; seed++)
        {
            SessionGroup group = Play("lan", 2, seed, LongHistory);
            Simulation whole = group.Alone();
            HashSet<EventKey> effective = TestWorlds.Bodies(whole).SelectMany(whole.Timeline).Select(entry => entry.Key).ToHashSet();
            foreach (ExternalEvent external in group.Accepted.Where(e => effective.Contains(e.Key)))
            {
                left++;
                seen += group.Difference(group.Alone(group.Accepted.Where(e => !e.Equals(external)))) is null ? 0 : 1;
            }
        }

        Assert.True(left > 50, $"{left}");
        Assert.Equal(left, seen);
    }

    [Fact]
    public void Run_SameSeedTwice_IsTheSameToTheBitAndTheDatagram()
    {
        (string, long)[] twice = Enumerable.Range(0, 2).Select(_ => Trace(5)).ToArray();
        Assert.Equal(twice[0], twice[1]);
        Assert.NotEqual(twice[0], Trace(6));

        static (string, long) Trace(ulong seed)
        {
            SessionGroup group = Play("awful", 3, seed, LongHistory);
            Simulation world = group.Sessions[2].World!.Simulation;
            return ($"{world.StateHash(world.SimulatedTo):x16} {world.EventHash(world.SimulatedTo):x16}", group.Sessions.Sum(s => s.Counters.DatagramsSent));
        }
    }

    [Fact]
    public void Joining_LongAfterTheStart_ComesToTheSameWorld()
    {
        // The second client is there all the time, but the host hears nothing of it for two seconds.
        SessionGroup group = new(ScriptedActions.Box(), 3, LinkProfiles.PureDelay(20), 4, LongHistory, expected: 1);
        group.Cut(2, 0);
        Assert.True(group.RunUntil(() => group.Host.State == SessionState.Running && group.Sessions[1].State == SessionState.Running));
        group.Do(0, PlayerAction.Teleport(TestWorlds.First, TestWorlds.V(0, 4)));
        group.Run(2);
        group.Do(1, PlayerAction.Impulse(TestWorlds.Second, TestWorlds.V(1, 5)));
        Assert.Equal(SessionState.Joining, group.Sessions[2].State);

        group.Restore(2, 0, 20);
        Assert.True(group.RunUntil(() => group.Sessions[2].State == SessionState.Running));
        group.Do(2, PlayerAction.SetVelocity(TestWorlds.Third, TestWorlds.V(-2, 3)));
        Assert.True(group.Settle(3));
        Assert.Null(group.Difference());
        Assert.Equal(2, group.Host.ClientCount);
    }

    internal static SessionGroup Play(string link, int peers, ulong seed, Func<int, SessionOptions> options)
    {
        SessionGroup group = Connected(link, peers, seed, options);
        List<ExternalEvent> done = new ScriptedActions((int)seed).DoIn(group, Count);
        Assert.True(group.Settle(Count), $"{link}, {peers} peers, seed {seed}: {string.Join("; ", group.Sessions.Select(s => $"{s.State} {s.EndReason} {s.Counters.EventsAccepted}"))}");
        Assert.Equal(done.OrderBy(e => e.Key), group.Log.Values.Select(e => e.Event).OrderBy(e => e.Key));
        return group;
    }

    private static HostOptions LongHistory(int peer) => new() { Window = new(SimDuration.FromSeconds(5)) };

    private static SessionGroup Connected(string link, int peers, ulong seed, Func<int, SessionOptions> options) =>
        new SessionGroup(ScriptedActions.Box(), peers, Link(link), seed, options).Connect();

    internal static LinkProfile Link(string name) => name switch
    {
        "loss-10" => new LinkProfile(name, new LinkLeg(40, 10, lossPercent: 10, meanBurstLength: 2)),
        "loss-20" => new LinkProfile(name, new LinkLeg(30, 5, lossPercent: 20, meanBurstLength: 2)),
        "loss-30" => new LinkProfile(name, new LinkLeg(20, 5, lossPercent: 30, meanBurstLength: 3)),
        "doubled" => new LinkProfile(name, new LinkLeg(50, 20, duplicatePercent: 100)),
        "shuffled" => new LinkProfile(name, new LinkLeg(50, 20, reorderPercent: 50, duplicatePercent: 20)),
        _ => LinkProfiles.TryGet(name, out LinkProfile? known, out string? error) ? known : throw new ArgumentException(error),
    };
}
