using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing;
using LagSim.Testing.Links;
using LagSim.Tests.Faults;
using LagSim.Tests.Sessions;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Hosting;

/// <summary>Lost bodies as a game hears of them: each loss is predicted, moved by late events, and then confirmed or retracted, once.</summary>
public sealed class LossNoticesTests
{
    private const double End = 3.5; // of drawn worlds, in s

    private static readonly Vector3D[] axes = [V(1), V(-1), V(0, 1), V(0, -1), V(0, 0, 1), V(0, 0, -1)];

    private static readonly CollisionFilter ghost = new(1, 0);

    [Theory]
    [InlineData(LossReason.TooStiff)]
    [InlineData(LossReason.TooFast)]
    [InlineData(LossReason.NotFinite)]
    public void Loss_InALiveWorld_IsToldWithItsReason_AndConfirmedOnce(LossReason reason)
    {
        LossNotices losses = new(16);
        Scene scene = reason == LossReason.TooFast ? Slope() : Planet(1);
        LiveWorld world = new(scene, new SimulationOptions(history: SimDuration.FromSeconds(1)), losses: losses);
        Assert.Same(losses, world.Losses);
        if (reason != LossReason.TooFast)
        {
            world.Submit(PlayerAction.SetFilter(First, ghost).Stamp(At(0.1), 1, 1));
        }

        if (reason == LossReason.NotFinite)
        {
            world.Submit(PlayerAction.Teleport(First, V(1e-170)).Stamp(At(0.2), 1, 2));
        }

        SimTime due = At(0);
        for (int steps = 0; due != SimTime.MaxValue; steps++)
        {
            Assert.True(steps < 5000);
            due = world.Step(due);
        }

        LostBody lost = Assert.Single(world.Simulation.LostBodies());
        Assert.True(losses.TryRead(out LossNotice predicted));
        Assert.True(losses.TryRead(out LossNotice confirmed));
        Assert.False(losses.TryRead(out _));
        Assert.Equal((NoticeKind.Predicted, NoticeKind.Confirmed), (predicted.Kind, confirmed.Kind));
        Assert.Equal((1, 2, 1), (predicted.Number, confirmed.Number, confirmed.Id));
        Assert.True(predicted.IsSameLoss(confirmed) && predicted != confirmed);
        Assert.Equal(
            (First, reason, lost.Time, lost.Position, lost.Velocity),
            (confirmed.Body, confirmed.Reason, confirmed.Time, confirmed.Position, confirmed.Velocity));
        Assert.Equal((lost.Reason, 0, 0L), (reason, losses.Pending, losses.Lost));
        Assert.StartsWith($"Confirmed: body 0.0.0 is lost, {reason}, at ", confirmed.ToString(), StringComparison.Ordinal);
        Assert.Throws<InvalidOperationException>(() => new LiveWorld(scene, new SimulationOptions(), losses: losses));
        Assert.Throws<ArgumentOutOfRangeException>(() => new LossNotices(3));
    }

    /// <summary>A stone falls into the centre of a pull at 0.7 s; at 0.9 s it is heard what was done to it at 0.2 s.</summary>
    [Theory]
    [InlineData("a push", new[] { NoticeKind.Predicted, NoticeKind.Moved, NoticeKind.Confirmed })]
    [InlineData("rescue", new[] { NoticeKind.Predicted, NoticeKind.InDoubt, NoticeKind.Retracted })]
    [InlineData("rescue that is taken back", new[] { NoticeKind.Predicted, NoticeKind.InDoubt, NoticeKind.Moved, NoticeKind.Confirmed })]
    [InlineData("what changes nothing", new[] { NoticeKind.Predicted, NoticeKind.Confirmed })]
    [InlineData("what has no effect", new[] { NoticeKind.Predicted, NoticeKind.Confirmed })]
    public void Loss_ThatALateEventChanges_StaysTheSame(string late, NoticeKind[] expected)
    {
        LossNotices losses = new();
        LiveWorld world = new(Planet(1), new SimulationOptions(history: SimDuration.FromSeconds(2)), losses: losses);
        world.Submit(PlayerAction.SetFilter(First, ghost).Stamp(At(0.1), 1, 1));
        ExternalEvent rescue = PlayerAction.SetVelocity(First, V(0, 2)).Stamp(At(0.2), 2, 1); // it misses the centre
        List<LossNotice> heard = [];
        for (int frame = 0; frame <= 4 * 40; frame++)
        {
            if (frame == 36)
            {
                world.Submit(late switch
                {
                    "a push" => PlayerAction.Impulse(First, V(0.5)).Stamp(At(0.2), 2, 1),
                    "what has no effect" => PlayerAction.Release(First, V(0)).Stamp(At(0.2), 2, 1), // nobody holds it: what was cut is put back
                    "what changes nothing" => PlayerAction.SetFilter(First, ghost).Stamp(At(0.2), 2, 1),
                    _ => rescue,
                });
            }

            if (frame == 40 && late == "rescue that is taken back")
            {
                world.Retract(rescue);
            }

            world.Step(At(frame / 40.0));
            while (losses.TryRead(out LossNotice loss))
            {
                heard.Add(loss);
            }
        }

        Assert.Equal(expected, heard.Select(loss => loss.Kind));
        Assert.All(heard, loss => Assert.Equal((heard[0].Id, First, LossReason.TooStiff), (loss.Id, loss.Body, loss.Reason)));
        Assert.All(heard.Zip(heard.Skip(1)), pair => Assert.Equal(pair.First.Time, pair.Second.MovedFrom));
        Assert.Equal(late == "a push", heard[^1].Time > heard[0].Time);
        Assert.Equal(late == "rescue" ? 0 : 1, world.Simulation.LostBodies().Count);
        Assert.Equal(0, losses.Pending);
    }

    [Fact]
    public void Losses_OfDrawnWorldsWithLateEvents_AreConfirmedOnceInOrderAndNoOther()
    {
        int confirmed = 0, moved = 0, retracted = 0;
        for (int seed = 0; seed < 12; seed++)
        {
            Course late = new();
            Assert.True(IsRight(seed, late, late.Notices), $"seed {seed}: {late.Courses.Broken}");
            confirmed += late.Courses.Confirmed.Count;
            moved += late.Courses.Moved;
            retracted += late.Courses.Retracted;
        }

        string seen = $"{confirmed} confirmed, {moved} moved, {retracted} retracted";
        TestContext.Current.TestOutputHelper?.WriteLine(seen);
        Assert.True(confirmed > 25 && moved > 8 && retracted > 5, seen);
    }

    [Fact]
    public void Losses_OfAPairingThatForgets_AreSeenToBreakTheRule()
    {
        Course[] courses = [.. Enumerable.Range(0, 8).Select(_ => new Course(new ForgetfulPairing<LossNotice>()))];
        Assert.InRange(courses.Select((course, seed) => IsRight(seed, course, course.Notices)).Count(isRight => !isRight), 4, 8);
    }

    [Fact]
    public void Losses_OfAnObserverThatDoesNotHearOfCuts_AreSeenToBreakTheRule()
    {
        Course[] courses = [.. Enumerable.Range(0, 8).Select(_ => new Course())];
        Assert.InRange(courses.Select((course, seed) => IsRight(seed, course, new DeafToCutLosses(course.Notices))).Count(isRight => !isRight), 4, 8);
    }

    [Theory]
    [InlineData("awful", 1)]
    [InlineData("delay-500ms", 3)]
    public void Losses_OfASessionOnABadLink_AreTheSameOnAllPeers(string link, int seed)
    {
        Assert.True(LinkProfiles.TryGet(link, out LinkProfile? profile, out _));
        Course[] peers = [.. Enumerable.Range(0, 3).Select(_ => new Course())];
        SessionGroup group = new SessionGroup(
            Planet(6), 3, profile, (ulong)seed, peer => new HostOptions { Window = new(SimDuration.FromSeconds(3)), Losses = peers[peer].Notices }).Connect();
        group.Run(1.5); // the stones lie on the planet
        for (int n = 0; n < 6; n++)
        {
            // One player lets it fall to the centre, another pushes it on its way, or past the centre.
            group.Do(1, PlayerAction.SetFilter(BodyId.OfScene(n), ghost));
            group.Run(0.05);
            group.Do(2, n % 3 == 0 ? PlayerAction.SetVelocity(BodyId.OfScene(n), axes[(n + 2) % 6] * 20) : PlayerAction.Impulse(BodyId.OfScene(n), axes[n]));
            group.Run(0.3);
        }

        group.Run(7);
        Assert.All(peers, peer => Assert.Null(peer.Courses.Broken));
        Assert.All(peers, peer => Assert.Equal(4, peer.Courses.Confirmed.Count));
        Assert.All(peers, peer => Assert.True(peer.Courses.Confirmed.Zip(peers[0].Courses.Confirmed).All(pair => pair.First.IsSameLoss(pair.Second))));
        Assert.All(peers, peer => Assert.Equal(0, peer.Notices.Pending));
        Assert.True(peers.Sum(peer => peer.Courses.Moved) > 0 && peers.Sum(peer => peer.Courses.Retracted) > 0);
    }

    [Fact]
    public void Losses_OfASessionTest_AreConfirmed()
    {
        LossNotices[] notices = [new(), new()];
        List<NoticeKind>[] heard = [[], []];
        SessionTest test = new SessionTest(Planet(1)).WithClients(1, "3g").WithOptions(player => new HostOptions { Losses = notices[player] })
            .At(0.1, 1, PlayerAction.SetFilter(First, ghost));
        for (int number = 0; number < 2; number++)
        {
            test.Every(0.05, number, player =>
            {
                while (notices[player.Number].TryRead(out LossNotice notice))
                {
                    heard[player.Number].Add(notice.Kind);
                }
            });
        }

        test.Run(6, TestContext.Current.CancellationToken);
        Assert.All(heard, kinds => Assert.Equal(NoticeKind.Confirmed, kinds[^1]));
    }

    [Fact]
    public void Loss_BeforeASnapshot_IsNotToldAgain()
    {
        Simulation world = Run(Planet(2), 3, [ExternalEvent.SetFilter(At(0.1), 1, 1, First, ghost)]);
        Assert.Single(world.LostBodies());
        LossNotices losses = new();
        LiveWorld joined = new(world.Scene, world.Snapshot(At(3)), new SimulationOptions(history: SimDuration.FromSeconds(1)), losses: losses);
        joined.Submit(PlayerAction.SetFilter(Second, ghost).Stamp(At(3.1), 1, 2));
        List<BodyId> heard = [];
        for (int frame = 3 * 40; frame <= 6 * 40; frame++)
        {
            joined.Step(At(frame / 40.0));
            while (losses.TryRead(out LossNotice loss))
            {
                heard.Add(loss.Body);
            }
        }

        Assert.Equal([Second, Second], heard); // predicted and confirmed
    }

    private static Scene Slope() => new SceneBuilder("slope").WithSmallestRadius(1e-9).AddPlane("slope", V(1, 1), V(0), 0)
        .AddBody("ball", new BodySpec(0.5, 1, 0), V(0.5 * Math.Sqrt(2), 0)).Build();

    /// <summary>Stones above a planet with a pull in its middle, each on an axis of its own, which they do not leave by themselves.</summary>
    private static Scene Planet(int stones)
    {
        SceneBuilder builder = new SceneBuilder("planet").WithGravity(Vector3D.Zero).AddForce(Force.Central("pull", Vector3D.Zero, 20), out ForceSet pull)
            .AddStaticSphere("planet", Vector3D.Zero, 0.5);
        for (int n = 0; n < stones; n++)
        {
            builder.AddBody($"stone {n}", new BodySpec(0.1, 1, 0.5, forces: pull), axes[n] * 2);
        }

        return builder.Build();
    }

    /// <summary>Plays a drawn world with late events; whether the notices keep the rules, and confirm what is lost and nothing else.</summary>
    private static bool IsRight(int seed, Course course, ILossObserver observer)
    {
        Random random = new(seed);
        Scene scene = Planet(6);
        List<ExternalEvent> events = [];
        for (uint n = 1; n <= 18; n++)
        {
            int stone = (int)n % 6;
            BodyId body = BodyId.OfScene(stone);
            events.Add((n <= 6 ? PlayerAction.SetFilter(body, ghost) : random.Next(4) switch
            {
                0 => PlayerAction.SetFilter(body, default),
                1 => PlayerAction.SetVelocity(body, axes[(stone + 2) % 6] * 20), // away, past the centre
                _ => PlayerAction.Impulse(body, axes[stone] * (random.NextDouble() - 0.3)),
            }).Stamp(At(random.NextDouble()), 1, n));
        }

        HealingMode mode = seed % 2 == 0 ? HealingMode.CausalCone : HealingMode.FullRollback;
        Simulation world = new(scene, new SimulationOptions(history: SimDuration.FromSeconds(1.1), healing: mode).WithLossObserver(observer));
        List<(double At, ExternalEvent Event)> coming = [.. events.Select(e => (e.Time.ToSeconds() + random.NextDouble(), e)).OrderBy(e => e.Item1)];
        int next = 0;
        for (int frame = 0; frame <= End * 40; frame++)
        {
            for (; next < coming.Count && coming[next].At * 40 <= frame; next++)
            {
                Assert.NotEqual(SubmitResult.TooOld, world.Submit(coming[next].Event));
            }

            world.AdvanceTo(At((frame + 1) / 40.0));
            course.Notices.Tell(world);
            course.Courses.EndReport();
        }

        IEnumerable<(SimTime, BodyId, LossReason)> lost = Run(scene, End, events).LostBodies()
            .Where(body => body.Time < world.HistoryEdge).Select(body => (body.Time, body.Body, body.Reason)).OrderBy(body => body);
        return course.Courses.Broken is null
            && lost.SequenceEqual(course.Courses.Confirmed.Select(loss => (loss.Time, loss.Body, loss.Reason)).OrderBy(loss => loss));
    }

    /// <summary>The notices of one world and what is heard of them.</summary>
    private sealed class Course
    {
        internal Course(NoticePairing<LossNotice>? pairing = null)
        {
            Notices = new(16, pairing ?? new NoticePairing<LossNotice>());
            Notices.Noticed += Courses.Take;
        }

        internal LossNotices Notices { get; }

        internal NoticeCourses<LossNotice> Courses { get; } = new(n => new NoticeStamp(n.Kind, n.Number, n.Id, n.MovedFrom));
    }
}
