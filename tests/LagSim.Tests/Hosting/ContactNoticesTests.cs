using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Sessions;
using LagSim.Net.Strategies;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Tests.Determinism;
using LagSim.Tests.Faults;
using LagSim.Tests.Sessions;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Hosting;

/// <summary>Contacts as a game hears of them: predicted, and then either confirmed or retracted, each once.</summary>
public sealed class ContactNoticesTests
{
    [Theory]
    [InlineData(HealingMode.CausalCone, false)]
    [InlineData(HealingMode.CausalCone, true)]
    [InlineData(HealingMode.FullRollback, false)]
    [InlineData(HealingMode.FullRollback, true)]
    public void Notices_OfRandomWorldsWithLateEvents_ConfirmEachContactOnceInOrderAndNoOther(HealingMode mode, bool inPieces)
    {
        int confirmed = 0, doubted = 0;
        for (int seed = 0; seed < 60; seed++)
        {
            RandomWorld world = new(seed);
            Ledger onTime = new(), late = new();
            Simulation expected = world.OnTime(options: KeepAll.WithObserver(onTime.Notices));
            HashSet<(BodyId, EventKey)> happened = [.. Bodies(expected).SelectMany(body => expected.Timeline(body).Select(entry => (body, entry.Key)))];
            Simulation simulation = world.Shuffled(seed * 7, seed % 2 == 0 ? SimDuration.FromSeconds(0.4) : null, s => s.Healed += _ => late.Notices.Tell(s), mode, inPieces, observer: late.Notices);
            onTime.End(expected);
            late.End(simulation);
            Assert.Equal(onTime.Confirmed.Select(n => n.Key), late.Confirmed.Select(n => n.Key));
            Assert.True(onTime.Confirmed.Zip(late.Confirmed).All(pair => pair.First.IsSameContact(pair.Second)), $"seed {seed}");
            Assert.Equal(late.Predicted - late.Retracted, late.Confirmed.Count + late.Notices.Pending);
            Assert.True(late.Confirmed.All(n => happened.Contains((n.First, n.Key)) && happened.Contains((n.Second, n.Key))), $"seed {seed}");
            confirmed += late.Confirmed.Count;
            doubted += late.Moved + late.Doubted;
        }

        // Else little was shown. In pieces most heals end with the run, so little is told before.
        Assert.True(confirmed > 1000 && doubted > (inPieces ? 0 : 100), $"{confirmed} confirmed, {doubted} moved or in doubt");
    }

    [Fact]
    public void Notices_OfAWorldThatCutsByTime_AreSeenToDiffer()
    {
        int different = 0;
        for (int seed = 0; seed < 40; seed++)
        {
            RandomWorld world = new(seed);
            Ledger onTime = new(), late = new();
            Simulation expected = world.OnTime(options: KeepAll.WithObserver(onTime.Notices));
            Simulation simulation = world.Shuffled(
                seed * 7, mode: HealingMode.FullRollback, observer: late.Notices, parts: new FaultyEngineParts { CutsByTime = true });
            onTime.End(expected);
            late.End(simulation);
            different += onTime.Confirmed.Select(n => n.Key).SequenceEqual(late.Confirmed.Select(n => n.Key)) ? 0 : 1;
        }

        Assert.True(different > 0);
    }

    [Theory]
    [InlineData("awful", 1, "healing", true)]
    [InlineData("loss-20", 6, "healing", true)]
    [InlineData("delay-500ms", 3, "full-rollback", true)]
    [InlineData("delay-500ms", 4, "none", false)]
    public void Notices_OfASessionOnABadLink_AreTheSameOnAllPeers(string link, int seed, string strategy, bool agrees)
    {
        Ledger[] ledgers = [.. Enumerable.Range(0, 3).Select(_ => new Ledger(0.2))];
        LinkProfile profile = link == "loss-20" ? new LinkProfile(link, new LinkLeg(30, 0, 20)) : LinkProfiles.TryGet(link, out LinkProfile? found, out _) ? found : throw new ArgumentException(link);
        SessionGroup group = new SessionGroup(
            ScriptedActions.Box(), 3, profile, (ulong)seed,
            peer => new HostOptions { Window = new(SimDuration.FromSeconds(3)), Strategy = LateEventStrategies.OfName(strategy), Contacts = ledgers[peer].Notices }).Connect();
        new ScriptedActions(seed, maxSpawns: 4).DoIn(group, 24, 0.2);
        group.Run(12);
        int count = ledgers.Min(l => l.Confirmed.Count);
        Assert.True(count > 20, $"{count}");
        bool isSame = ledgers.All(l => l.Confirmed.Take(count).Zip(ledgers[0].Confirmed).All(pair => pair.First.IsSameContact(pair.Second)));
        Assert.Equal(agrees, isSame);
        if (agrees)
        {
            Assert.All(ledgers, l => Assert.Equal(l.Predicted - l.Retracted, l.Confirmed.Count + l.Notices.Pending));
            Assert.True(ledgers.Sum(l => l.Moved) > 0 && ledgers.Sum(l => l.Retracted) > 0);
        }
    }

    [Fact]
    public void Notices_OfOneWhoJoinsLater_AreThoseOfTheOthersFromThereOn()
    {
        Ledger early = new(), late = new();
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 1, LinkProfiles.PureDelay(20), 5, _ => new HostOptions { Contacts = early.Notices }).Connect();
        new ScriptedActions(1, maxSpawns: 2).DoIn(group, 10, 0.2);
        group.Run(3);
        ClientSession client = group.Join(7, 77, new ClientOptions { Contacts = late.Notices });
        Assert.True(group.RunUntil(() => client.State == SessionState.Running), client.EndReason);
        new ScriptedActions(2, maxSpawns: 2).DoIn(group, 20, 0.2);
        group.Run(5);
        Assert.NotNull(client.BegunFrom);
        Assert.True(late.Confirmed.Count > 10 && late.Confirmed.Count < early.Confirmed.Count, $"{late.Confirmed.Count} of {early.Confirmed.Count}");
        ContactNotice[] since = [.. early.Confirmed.SkipWhile(n => n.Key < late.Confirmed[0].Key)];
        Assert.All(since.Zip(late.Confirmed), pair => Assert.True(pair.First.IsSameContact(pair.Second)));
    }

    [Fact]
    public void Notices_ImpactCutAndMadeAgainJustSo_AreNotTold()
    {
        // Everything is rolled back for a ball far away; what the other one does is cut and made again.
        Ledger ledger = new();
        Scene scene = new SceneBuilder("apart").AddPlane("floor", Vector3D.Up, V(0)).AddBody("near", Ball(0.5), V(0, 2.5)).AddBody("far", Ball(0.5), V(100, 2.5)).Build();
        LiveWorld world = new(scene, new SimulationOptions(default, SimDuration.FromSeconds(2), healing: HealingMode.FullRollback), contacts: ledger.Notices);
        Advance(world, 1);
        Assert.Equal((2, 0), (ledger.Predicted, ledger.Doubted));
        world.Submit(ExternalEvent.Teleport(At(0.3), 1, 1, Second, V(100, 50)));
        world.Step(At(1));
        Assert.Equal(2, world.Simulation.SegmentsCut);
        Assert.Equal((2, 0, 1), (ledger.Predicted, ledger.Moved, ledger.Doubted));
    }

    [Fact]
    public void Step_WorldComeToRest_IsDueUntilAllIsConfirmed()
    {
        Ledger ledger = new();
        LiveWorld world = new(Drop(1, 0.5), new SimulationOptions(default, SimDuration.FromSeconds(2)), contacts: ledger.Notices);
        SimTime due = At(0), last = At(0);
        for (int steps = 0; due != SimTime.MaxValue; steps++)
        {
            Assert.True(steps < 1000);
            last = due;
            due = world.Step(due);
            Assert.True(due > last);
        }

        Assert.Equal((0, 0), (ledger.Notices.Pending, ledger.Retracted));
        Assert.InRange(ledger.Confirmed.Count, 3, 20);
        Assert.True(last > At(2));
        Assert.All(ledger.Confirmed, n => Assert.Equal(("floor", 0), (n.SurfaceName(world.Simulation.Scene), n.Surface)));
        Near(V(0, 0), ledger.Confirmed[0].Position, 1e-9);
        Near(Math.Sqrt(2 * Gravity), ledger.Confirmed[0].ClosingSpeed, 1e-9);
    }

    [Theory]
    [InlineData(0, 20, 100)]
    [InlineData(ContactNotices.DefaultMinClosingSpeed, 1, 19)]
    public void MinClosingSpeed_BodyThatLiesOnAnother_KeepsItsLeastBouncesAway(double least, int fewest, int most)
    {
        Scene scene = new SceneBuilder("lying").AddStaticSphere("dome", V(0), 5, 0.8).AddBody("ball", Ball(0.5, e: 0.8), V(0, 5.6)).Build();
        Ledger ledger = new(least);
        LiveWorld world = new(scene, new SimulationOptions(default, SimDuration.FromSeconds(0.5)), contacts: ledger.Notices);
        Advance(world, 2);
        Assert.InRange(ledger.Confirmed.Count, fewest, most);
        Assert.Equal("dome", ledger.Confirmed[0].SurfaceName(scene));
    }

    [Fact]
    public void TryRead_QueueThatNobodyReads_LosesNothingSilently()
    {
        ContactNotices notices = new(0, 16);
        Scene scene = new SceneBuilder("box").WithGravity(Floating).AddPlane("west", V(1), V(-1)).AddPlane("east", V(-1), V(1)).AddBody("ball", Ball(0.5), V(0), V(20)).Build();
        List<ContactNotice> told = [];
        notices.Noticed += told.Add;
        LiveWorld world = new(scene, new SimulationOptions(default, SimDuration.FromSeconds(0.2)), contacts: notices);
        Advance(world, 5);
        List<ContactNotice> read = ReadAll(notices);
        Assert.True(notices.Lost > 50);
        Assert.Equal(told.Count, read.Count + notices.Lost);
        Assert.Equal(told.Take(8), read.Take(8)); // predictions leave half of the room to what is certain
        Assert.Equal(16, read.Count);
        Assert.All(read.Skip(8), n => Assert.Equal(NoticeKind.Confirmed, n.Kind));
        Assert.Equal(Enumerable.Range(1, told.Count).Select(n => (long)n), told.Select(n => n.Number));

        // Once there is room again it goes on, and the gap shows.
        Advance(world, 6, 5);
        Assert.True(ReadAll(notices)[0].Number > read[^1].Number + 1);
    }

    [Fact]
    public void TryRead_OnAnotherThread_GetsEveryNoticeOnceInOrder()
    {
        ContactNotices notices = new(0, 64);
        Scene scene = new SceneBuilder("box").WithGravity(Floating).AddPlane("west", V(1), V(-1)).AddPlane("east", V(-1), V(1)).AddBody("ball", Ball(0.5), V(0), V(200)).Build();
        long told = 0;
        bool isDone = false;
        notices.Noticed += _ => told++;
        Thread thread = new(() =>
        {
            LiveWorld world = new(scene, new SimulationOptions(default, SimDuration.FromSeconds(0.2)), contacts: notices);
            Advance(world, 20);
            Volatile.Write(ref isDone, true);
        });
        thread.Start();
        long read = 0, newest = 0;
        bool ended;
        do
        {
            ended = Volatile.Read(ref isDone);
            while (notices.TryRead(out ContactNotice notice))
            {
                Assert.True(notice.Number > newest);
                newest = notice.Number;
                read++;
            }
        }
        while (!ended);
        thread.Join();
        Assert.True(read > 0);
        Assert.Equal(told, read + notices.Lost);
    }

    [Fact]
    public void Constructor_BadValues_AreRefusedByName()
    {
        Assert.Contains("-1", Assert.Throws<ArgumentOutOfRangeException>(() => new ContactNotices(-1)).Message, StringComparison.Ordinal);
        Assert.Throws<ArgumentOutOfRangeException>(() => new ContactNotices(double.NaN));
        Assert.Contains("16 to", Assert.Throws<ArgumentOutOfRangeException>(() => new ContactNotices(0, 15)).Message, StringComparison.Ordinal);
        ContactNotices used = new();
        _ = new LiveWorld(Drop(1, 0.5), new SimulationOptions(), contacts: used);
        Assert.Throws<InvalidOperationException>(() => new LiveWorld(Drop(1, 0.5), new SimulationOptions(), contacts: used));
    }

    [Fact]
    public void SimulationHost_GivenContactNotices_IsReadAsTheReadmeShows()
    {
        Scene scene = Drop(1, 0.5);
        List<ContactNotice> sounds = [], scores = [];
        ContactNotices contacts = new(minClosingSpeed: 0.2);
        using SimulationHost host = new(scene, new VirtualClock(), contacts: contacts);
        Assert.Same(contacts, host.Contacts);
        while (contacts.TryRead(out ContactNotice contact))
        {
            switch (contact.Kind)
            {
                case NoticeKind.Predicted:
                    sounds.Add(contact);
                    break;
                case NoticeKind.Moved or NoticeKind.InDoubt or NoticeKind.Retracted:
                    sounds.RemoveAll(sound => sound.Id == contact.Id);
                    break;
                case NoticeKind.Confirmed:
                    scores.Add(contact);
                    break;
            }
        }

        Assert.Equal((0, 0), (sounds.Count, scores.Count)); // its thread has not been started
    }

    private static void Advance(LiveWorld world, double to, double from = 0)
    {
        for (int n = 0; n <= (to - from) * 50; n++)
        {
            while (world.Step(At(from + (n / 50.0))) == At(from + (n / 50.0)) && world.IsBehind)
            {
            }
        }
    }

    private static List<ContactNotice> ReadAll(ContactNotices notices)
    {
        List<ContactNotice> all = [];
        while (notices.TryRead(out ContactNotice notice))
        {
            all.Add(notice);
        }

        return all;
    }

    /// <summary>Keeps account of notices, and holds them to their rules as they come.</summary>
    private sealed class Ledger
    {
        private readonly NoticeCourses<ContactNotice> courses = new(n => new NoticeStamp(n.Kind, n.Number, n.Id, n.MovedFrom));

        internal Ledger(double least = 0)
        {
            Notices = new ContactNotices(least);
            Notices.Noticed += notice =>
            {
                courses.Take(notice);
                Assert.Null(courses.Broken);
            };
        }

        internal ContactNotices Notices { get; }

        internal List<ContactNotice> Confirmed => courses.Confirmed;

        internal int Predicted => courses.Predicted;

        internal int Moved => courses.Moved;

        internal int Doubted => courses.Doubted;

        internal int Retracted => courses.Retracted;

        /// <summary>The last word: what lies before the end is committed.</summary>
        internal void End(Simulation simulation)
        {
            simulation.DropHistoryBefore(simulation.SimulatedTo);
            Notices.Tell(simulation);
        }
    }
}
