using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Scenes;
using LagSim.Tests.Determinism;
using LagSim.Tests.Faults;
using LagSim.Tests.Rules;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Hosting;

/// <summary>A notice keeps its identity when a heal moves its instant, and only what does not happen is retracted.</summary>
public sealed class MovedNoticesTests
{
    /// <summary>How many worlds are drawn; set LAGSIM_NOTICE_WORLDS for more.</summary>
    private static readonly int worlds = int.Parse(Environment.GetEnvironmentVariable("LAGSIM_NOTICE_WORLDS") ?? "150", CultureInfo.InvariantCulture);

    [Fact]
    public void Notices_OfDrawnWorldsWithLateEvents_ArePredictedOnceAndRetractedOnlyIfTheyDoNotHappen()
    {
        int confirmed = 0, moved = 0, doubted = 0, retracted = 0, ended = 0;
        for (int seed = 0; seed < worlds; seed++)
        {
            Heard onTime = new(), late = new();
            try
            {
                Play(seed, onTime, isLate: false);
                Play(seed, late, isLate: true);
            }
            catch (SimulationException)
            {
                ended++; // as a few drawn worlds do
                continue;
            }

            Assert.True(late.Broken is null, $"seed {seed}: {late.Broken}");
            Assert.True(onTime.Broken is null && onTime.Contacts.Moved + onTime.Crossings.Moved + onTime.Told.Moved == 0, $"seed {seed}: {onTime.Broken}");
            AssertSame(onTime.Contacts, late.Contacts, seed);
            AssertSame(onTime.Crossings, late.Crossings, seed);
            AssertSame(onTime.Told, late.Told, seed);
            confirmed += late.Contacts.Confirmed.Count + late.Crossings.Confirmed.Count + late.Told.Confirmed.Count;
            moved += late.Contacts.Moved + late.Crossings.Moved + late.Told.Moved;
            doubted += late.Contacts.Doubted + late.Crossings.Doubted + late.Told.Doubted;
            retracted += late.Contacts.Retracted + late.Crossings.Retracted + late.Told.Retracted;
        }

        string seen = $"{worlds} worlds: {confirmed} confirmed, {moved} moved, {doubted} in doubt, {retracted} retracted; {ended} ended by themselves";
        TestContext.Current.TestOutputHelper?.WriteLine(seen);
        Assert.True(ended <= worlds / 100 && confirmed > 20 * worlds && moved > worlds && doubted > worlds && retracted > worlds / 2, seen);
    }

    [Fact]
    public void Notices_OfALedgerThatTakesBackAndPredictsAgain_AreSeenToBreakTheRule()
    {
        int contacts = 0, crossings = 0, told = 0;
        for (int seed = 0; seed < 30; seed++)
        {
            Heard late = new(isForgetful: true);
            Play(seed, late, isLate: true);
            contacts += late.Contacts.Broken is null ? 0 : 1;
            crossings += late.Crossings.Broken is null ? 0 : 1;
            told += late.Told.Broken is null ? 0 : 1;
        }

        Assert.True(contacts > 10 && crossings > 5 && told > 5, $"{contacts} {crossings} {told}");
    }

    /// <summary>A ball on its way to a wall, two metres a second fast and two seconds off, is pushed three times, late.</summary>
    [Fact]
    public void Bounce_ThatLateEventsMove_IsOneSound()
    {
        ContactNotices contacts = new();
        LiveWorld world = new(Rolling(), new SimulationOptions(history: SimDuration.FromSeconds(0.5)), contacts: contacts);
        HashSet<long> sounds = [];
        List<(NoticeKind Kind, double From, double To)> heard = [];
        uint pushes = 0;
        for (int frame = 0; frame <= 180; frame++)
        {
            SimTime now = At(frame / 60.0);
            if (frame is 121 or 122 or 123)
            {
                world.Submit(PlayerAction.Impulse(First, V(0.1)).Stamp(At(1.95 + (0.01 * pushes)), 1, ++pushes));
            }

            world.Step(now);
            while (contacts.TryRead(out ContactNotice contact))
            {
                heard.Add((contact.Kind, contact.MovedFrom.ToSeconds(), contact.Time.ToSeconds()));
                _ = contact.Time <= now && sounds.Add(contact.Id);
            }
        }

        Assert.Equal(
            [NoticeKind.Predicted, NoticeKind.Moved, NoticeKind.Moved, NoticeKind.Moved, NoticeKind.Confirmed], heard.Select(one => one.Kind));
        Assert.All(heard.Zip(heard.Skip(1)), pair => Assert.Equal(pair.First.To, pair.Second.From));
        Assert.Equal(2, heard[0].To, 9);
        Assert.Equal(1.97 + ((0.1 - 0.021 - 0.022) / 2.3), heard[^1].To, 9);
        Assert.Single(sounds);
    }

    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Bounce_ThatALateEventPrevents_IsInDoubtUntilNothingCanBringItBack(bool comesBack)
    {
        ContactNotices contacts = new();
        LiveWorld world = new(Rolling(), new SimulationOptions(history: SimDuration.FromSeconds(0.5)), contacts: contacts);
        List<(NoticeKind Kind, int Frame, long Id)> heard = [];
        for (int frame = 0; frame <= 240; frame++)
        {
            if (frame is 123)
            {
                world.Submit(PlayerAction.SetVelocity(First, V(-1)).Stamp(At(1.9), 1, 1)); // it turns round before the wall
            }

            if (frame is 130 && comesBack)
            {
                world.Submit(PlayerAction.SetVelocity(First, V(3)).Stamp(At(1.91), 2, 1)); // or rather, it does not
            }

            world.Step(At(frame / 60.0));
            while (contacts.TryRead(out ContactNotice contact))
            {
                heard.Add((contact.Kind, frame, contact.Id));
            }
        }

        Assert.Equal(
            comesBack ? [NoticeKind.Predicted, NoticeKind.InDoubt, NoticeKind.Moved, NoticeKind.Confirmed]
                : [NoticeKind.Predicted, NoticeKind.InDoubt, NoticeKind.Retracted],
            heard.Select(one => one.Kind));
        Assert.All(heard, one => Assert.Equal(heard[0].Id, one.Id));
        Assert.Equal(123, heard[1].Frame);
        Assert.InRange(heard[^1].Frame, comesBack ? 143 : 175, comesBack ? 150 : 185); // a history later; to be retracted half a second more
        Assert.Equal(0, contacts.Pending);
    }

    /// <summary>Two bodies cross a line in turn; late pushes make the second one the first.</summary>
    [Theory]
    [InlineData(true, new[] { 1L, 2L })]
    [InlineData(false, new[] { 2L, 1L })]
    public void Told_WithKeysOfTheGame_MovesTheOneOfItsKey(bool hasKeys, long[] valuesByIds)
    {
        GivenRules rules = new()
        {
            HearsSensor = (_, _) => true,
            Crossed = (w, crossing) => w.Tell(5, crossing.Body.Index + 1, hasKeys ? crossing.Body.Index : 0),
        };
        Scene scene = new SceneBuilder("two").WithGravity(Floating).WithSmallestRadius(0.5)
            .AddBody("ahead", Ball(0.5), V(0.2, 0, 0), V(2)).AddBody("behind", Ball(0.5), V(0, 5, 0), V(2))
            .AddSensorPlane("goal", V(-1), V(4)).WithRules(rules).Build();
        RuleNotices notices = new();
        LiveWorld world = new(scene, new SimulationOptions(history: SimDuration.FromSeconds(0.5)), notices: notices);
        Dictionary<long, long> values = [];
        List<NoticeKind> kinds = [];
        for (int frame = 0; frame <= 180; frame++)
        {
            if (frame == 124)
            {
                world.Submit(PlayerAction.Impulse(Second, V(8)).Stamp(At(1.7), 1, 1));
                world.Submit(PlayerAction.Impulse(First, V(0.1)).Stamp(At(1.7), 1, 2));
            }

            world.Step(At(frame / 60.0));
            while (notices.TryRead(out RuleEvent told))
            {
                values[told.Id] = told.Notice.Value;
                kinds.Add(told.Kind);
            }
        }

        Assert.Equal(valuesByIds, values.OrderBy(one => one.Key).Select(one => one.Value));
        Assert.DoesNotContain(NoticeKind.Retracted, kinds);
        Assert.Contains(NoticeKind.Moved, kinds);
    }

    private static Scene Rolling() => new SceneBuilder("rolling").WithGravity(Floating).AddPlane("wall", V(-1), V(4.5))
        .AddBody("ball", Ball(0.5), V(0), V(2)).Build();

    private static void AssertSame<T>(NoticeCourses<T> onTime, NoticeCourses<T> late, int seed)
        where T : struct, INotice<T>
    {
        Assert.Equal(onTime.Confirmed.Count, late.Confirmed.Count);
        Assert.True(onTime.Confirmed.Zip(late.Confirmed).All(pair => pair.First.IsSameAs(pair.Second)), $"seed {seed}");
    }

    /// <summary>A world steps as a game's does; events come on time, or up to a second late.</summary>
    private static void Play(int seed, Heard heard, bool isLate)
    {
        RandomWorld drawn = new(seed, sensors: true, rules: seed % 2 == 0);
        HealingMode mode = seed % 3 == 0 ? HealingMode.FullRollback : HealingMode.CausalCone;
        LiveWorld world = new(
            drawn.Scene, new SimulationOptions(history: SimDuration.FromSeconds(1.1), healing: mode), contacts: heard.ContactNotices, crossings: heard.CrossingNotices,
            notices: heard.RuleNotices);
        Random arrivals = new(seed);
        List<(double At, ExternalEvent Event)> coming = [.. drawn.Events
            .Select(e => (isLate ? e.Time.ToSeconds() + arrivals.NextDouble() : 0, e)).OrderBy(e => e.Item1)];
        int next = 0;
        for (int frame = 0; frame <= 4 * 40; frame++)
        {
            for (; next < coming.Count && coming[next].At * 40 <= frame; next++)
            {
                Assert.NotEqual(SubmitResult.TooOld, world.Submit(coming[next].Event));
            }

            SimTime now = At(frame / 40.0);
            do
            {
                world.Step(now);
                heard.EndReport();
            }
            while (world.IsBehind);
        }
    }

    /// <summary>All that is heard of one world.</summary>
    private sealed class Heard
    {
        internal Heard(bool isForgetful = false)
        {
            ContactNotices = new(0.05, 16, isForgetful ? new ForgetfulPairing<ContactNotice>() : new NoticePairing<ContactNotice>());
            CrossingNotices = new(16, isForgetful ? new ForgetfulPairing<CrossingNotice>() : new NoticePairing<CrossingNotice>());
            RuleNotices = new(16, isForgetful ? new ForgetfulPairing<RuleEvent>() : new NoticePairing<RuleEvent>());
            ContactNotices.Noticed += Contacts.Take;
            CrossingNotices.Noticed += Crossings.Take;
            RuleNotices.Noticed += Told.Take;
        }

        internal ContactNotices ContactNotices { get; }

        internal CrossingNotices CrossingNotices { get; }

        internal RuleNotices RuleNotices { get; }

        internal NoticeCourses<ContactNotice> Contacts { get; } = new(n => new NoticeStamp(n.Kind, n.Number, n.Id, n.MovedFrom));

        internal NoticeCourses<CrossingNotice> Crossings { get; } = new(n => new NoticeStamp(n.Kind, n.Number, n.Id, n.MovedFrom));

        internal NoticeCourses<RuleEvent> Told { get; } = new(n => new NoticeStamp(n.Kind, n.Number, n.Id, n.MovedFrom));

        internal string? Broken => Contacts.Broken ?? Crossings.Broken ?? Told.Broken;

        internal void EndReport()
        {
            Contacts.EndReport();
            Crossings.EndReport();
            Told.EndReport();
        }
    }
}
