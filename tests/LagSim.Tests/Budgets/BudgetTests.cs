using System;
using System.Linq;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Tests.Sessions;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;

namespace LagSim.Tests.Budgets;

/// <summary>What one player may cost: a player that takes more is disconnected, with what it brought, and the others' worlds go on in real time.</summary>
public sealed class BudgetTests
{
    private const double MicrosecondsASecond = 1e6;

    /// <summary>A machine that is a hundred times as slow.</summary>
    private const double Slow = MicrosecondsASecond / 100;

    /// <summary>A mass in kg whose hand, at 1000 N for each kg, keeps its place against a million blows a second of 1 kg at 999 m/s.</summary>
    private const double Heavy = 1e8;

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Step_AHeavyBallHeldAMillimetreAboveAFastElasticOne_FreezesTheWorldOnlyWithoutABudget(bool hasBudget)
    {
        (double late, SessionGroup group) = Play(hasBudget, Gap);
        Check(hasBudget, late, group);
    }

    /// <summary>What is no harm: the same with a ball of 1 kg, because its hand yields to the first blows.</summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Step_ALightBallHeldAMillimetreAboveAFastElasticOne_HarmsNobody(bool hasBudget)
    {
        (double late, SessionGroup group) = Play(hasBudget, (g, n) => Gap(g, n, 1));
        Assert.Equal((true, 2), (late < 0.25, group.Host.ClientCount));
    }

    /// <summary>
    /// What is no harm: all 64 balls that a player may have dropped at once into one heap, and a push to it once it sleeps.
    /// </summary>
    [Fact]
    public void Step_AHeapOfAllHisBodiesAndAPush_HarmsNobody()
    {
        (double late, SessionGroup group) = Play(hasBudget: true, Heap);
        Assert.Equal((true, 2), (late < 0.25, group.Host.ClientCount));
        Assert.True(group.RunUntil(() => Sleeps(group), 20));
        byte peer = group.Client(1).Peer;
        double before = group.Host.Costs.Single(c => c.Player == peer).Work;
        group.Do(1, PlayerAction.SetVelocity(new BodyId(peer, 10, 0), new Vector3D(0, 3, 1)));
        for (int n = 0; n < 100; n++)
        {
            group.Run(0.01);
            late = Math.Max(late, Late(group));
        }

        PlayerCost cost = group.Host.Costs.Single(c => c.Player == peer);
        Assert.True(cost.Work - before > 1000, $"{cost.Work - before}"); // it woke and moved
        Assert.Equal((true, 2), (late < 0.25, group.Host.ClientCount));
        Assert.InRange(cost.PeakWork, 1000, 0.9 * PlayerBudget.Default.WorkAtOnce);
    }

    /// <summary>The control: on a machine that is far too slow for it a heap does freeze the world.</summary>
    [Theory]
    [InlineData(MicrosecondsASecond, false)]
    [InlineData(Slow, true)]
    public void Step_AHeapOfAllHisBodiesWithoutABudget_FreezesTheWorldOnlyOfASlowMachine(double workPerSecond, bool freezes)
    {
        (double late, SessionGroup group) = Play(hasBudget: false, Heap, workPerSecond);
        Assert.Equal(freezes, late > 0.25);
        Assert.Equal(2, group.Host.ClientCount);
    }

    /// <summary>
    /// A heap that a strong hand shakes is work without end, here a little more than a player may cost: who shakes it is sent away within
    /// two seconds, before any world is late.
    /// </summary>
    [Fact]
    public void Step_AHeapOfAllHisBodiesThatAStrongHandShakes_IsSentAway()
    {
        (double late, SessionGroup group) = Play(hasBudget: true, Shake, seconds: 2);
        Check(hasBudget: true, late, group);
    }

    /// <summary>Both are in every bounce of the one on the other: he who shoots is sent away, not he who holds.</summary>
    [Fact]
    public void Step_AFastBallUnderAHeavyBallThatAnotherHolds_SendsAwayWhoseBallIsFast()
    {
        SessionGroup group = Three();
        byte victim = group.Client(2).Peer;
        BodySpec ball = new(0.25, 1, 1);
        Vector3D above = new(0.9, 0.2505 + 0.501, 0.9);
        string said = "";
        group.Host.PlayerExpelled += e => said += e.Sentence;
        BodyId held = group.Do(2, PlayerAction.Spawn(new BodySpec(0.25, Heavy, 1), above, default)).Body;
        group.Do(2, PlayerAction.Grab(held, default));
        for (int n = 0; n < 60; n++)
        {
            if (n == 10)
            {
                group.Do(1, PlayerAction.Spawn(ball, new Vector3D(0.9, 0.2505, 0.9), new Vector3D(0, 999, 0)));
            }

            Assert.True(group.Sessions[2].State == SessionState.Running, said);
            if (n % 5 == 0)
            {
                group.Do(2, PlayerAction.HoldKeyframe(held, above, default));
            }

            group.Run(0.02);
        }

        Assert.Equal((SessionState.Ended, SessionEnd.Kicked), (group.Sessions[1].State, group.Sessions[1].EndedBy));
        Assert.Equal([victim], group.Host.Links.Select(link => link.Peer));
        Assert.Contains(Bodies(group.Sessions[2]), body => body == held);
    }

    [Fact]
    public void Step_AFastBallOfTheScene_IsStoppedWithWhoMovedIt()
    {
        SessionGroup group = Three(new SceneBuilder("gap").WithGravity(Vector3D.Zero)
            .AddPlane("west", new Vector3D(1, 0, 0), new Vector3D(-0.501, 0, 0), 1).AddPlane("east", new Vector3D(-1, 0, 0), new Vector3D(0.501, 0, 0), 1)
            .AddBody("rattler", new BodySpec(0.5, 1, 1), Vector3D.Zero).AddBody("other", new BodySpec(0.5, 1, 1), new Vector3D(0, 5, 0)).Build());
        PlayerExpulsion? said = null;
        group.Host.PlayerExpelled += e => said = said is null ? e : throw new InvalidOperationException(e.Sentence);
        group.Do(1, PlayerAction.SetVelocity(BodyId.OfScene(0), new Vector3D(999, 0, 0)));
        group.Run(1);
        Assert.NotNull(said);
        Assert.Equal((0, 1, true), (said.BodiesRemoved, said.BodiesStopped, said.WasThere));
        Assert.StartsWith($"Player {said.Player} is disconnected: what it did took 1", said.Sentence, StringComparison.Ordinal);
        group.Run(2.5);
        foreach (Session session in new[] { group.Sessions[0], group.Sessions[2] })
        {
            Assert.True(session.World!.Simulation.TryRead(BodyId.OfScene(0), session.World.Simulation.SimulatedTo, out BodyState state));
            Assert.Equal((Vector3D.Zero, 0L), (state.Velocity, session.Counters.StatesDiffered));
        }

        Assert.True(group.Sessions[2].Counters.StatesAgreed > 0);
    }

    /// <summary>Before it is disconnected a player has its acts refused, and only with a budget.</summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Do_WithLessThanHalfOfTheBudgetLeft_IsRefusedAndThePlayerStays(bool hasBudget)
    {
        SessionGroup group = new(Room(), 2, LinkProfiles.PureDelay(20), 1, _ => new HostOptions { PlayerBudget = hasBudget ? new PlayerBudget(1, 2000) : null });
        group.Connect();
        group.Run(1);
        for (int n = 0; n < 400 && group.Sessions[1].Counters.EventsRefused == 0; n++)
        {
            group.Do(1, PlayerAction.SetVelocity(BodyId.OfScene(0), new Vector3D(0, 0, 0.001 * n)));
            group.Run(0.05);
        }

        Assert.Equal(SessionState.Running, group.Sessions[1].State);
        Assert.Equal(hasBudget, group.Sessions[1].Counters.EventsRefused > 0);
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Step_WhoWasSentAway_IsLetInAgainAfterAMinuteOrWhenTheHostSaysSo(bool hostSaysSo)
    {
        SessionGroup group = Three();
        PlayerPass pass = group.Client(1).Pass!.Value;
        Attack(group);
        Assert.Equal(SessionEnd.Refused, Again(group, 70, pass).EndedBy);
        group.Run(hostSaysSo ? 0 : 60);
        Assert.Equal(hostSaysSo, hostSaysSo && group.Host.Unban(PeerAddress.Virtual(1)));
        Assert.False(group.Host.Unban(PeerAddress.Virtual(1))); // it is shut out no longer
        Assert.Equal(SessionState.Running, Again(group, 71, pass).State);
    }

    /// <summary>Others at its address get in; it may come among them without its pass, and its second attack shuts them all out.</summary>
    [Fact]
    public void Step_OneWasSentAway_OthersOfItsMachineAreLetInUntilAnotherIs()
    {
        SessionGroup group = Three();
        Attack(group);
        Assert.Equal(SessionState.Running, Again(group, 70).State);
        Attack(group);
        Assert.Equal(SessionEnd.Refused, Again(group, 71).EndedBy);
    }

    /// <summary>Who is sent away for its cost hears what it was, by the count and by the clock.</summary>
    [Fact]
    public void Step_WhoIsSentAway_HearsWhy()
    {
        SessionGroup group = Three();
        Attack(group);
        Assert.Matches(
            @"^The host sent this player away\. What it did took 1\d\d ms of work as it is counted, 0 ms by the clock, within 0\.\d+ s, more than one player may cost\.$",
            group.Sessions[1].EndReason);
    }

    /// <summary>A spawn that is stamped later than now, as by one whose clock is ahead, is removed as it happens.</summary>
    [Fact]
    public void RemoveBodiesOf_ASpawnThatIsStillToCome_RemovesItAsItComes()
    {
        SessionGroup group = new(Room(), 2, LinkProfiles.PureDelay(20), 1, peer => peer == 0 ? new HostOptions() : new ClientOptions
        {
            Window = new LatencyCompensationWindow(lookAhead: SimDuration.FromMilliseconds(400)).WithLocalLag(EventKind.Spawn, SimDuration.FromMilliseconds(250)),
        });
        group.Connect();
        group.Run(1);
        BodyId body = group.Do(1, PlayerAction.Spawn(new BodySpec(0.25, 1, 0.5), new Vector3D(0.5, 2, 0.5), default)).Body;
        group.Run(0.06);
        Assert.DoesNotContain(body, Bodies(group.Host));
        Assert.Equal(1, group.Host.RemoveBodiesOf(group.Client(1).Peer));
        Assert.Equal(0, group.Host.RemoveBodiesOf(group.Client(1).Peer));
        group.Run(1);
        Assert.All(group.Sessions, s => Assert.DoesNotContain(body, Bodies(s)));
        Assert.Null(group.Difference());
    }

    [Theory]
    [InlineData(0, 1)]
    [InlineData(double.NaN, 1)]
    [InlineData(1, 2e9)]
    public void PlayerBudget_OutOfRange_IsRefusedWithTheRange(double perSecond, double atOnce) =>
        Assert.Contains("1 to 1e9", Assert.Throws<ArgumentOutOfRangeException>(() => new PlayerBudget(perSecond, atOnce)).Message, StringComparison.Ordinal);

    /// <summary>Counting is looking on: with a ledger, in whatever pieces, a world is the same to the bit.</summary>
    [Fact]
    public void Work_OfAWorldThatIsWatched_ChangesNoBit()
    {
        LiveWorld watched = new(Room(), new SimulationOptions()) { Work = new WorkLedger { MaxWorkPerStep = 50 } };
        Simulation alone = new(Room());
        for (uint n = 1; n <= 20; n++)
        {
            ExternalEvent spawn = ExternalEvent.Spawn(SimTime.FromSeconds(0.01 * n), 1, n, new BodySpec(0.25, n, 0.3, friction: 0.3), new Vector3D(-0.9 + (0.01 * n), 0.6 * n, 0));
            watched.Submit(spawn);
            alone.Submit(spawn);
        }

        SimTime end = SimTime.FromSeconds(1.5);
        int steps = 0;
        do
        {
            watched.Step(end);
            steps++;
        }
        while (watched.IsBehind);
        alone.AdvanceTo(end);
        Assert.True(steps > 20);
        Assert.Equal(alone.StateHash(end), watched.Simulation.StateHash(end));
        Assert.True(watched.Work!.ChargedTo(1) > 1000 && watched.Work.ChargedTo(2) == 0);
    }

    private static void Attack(SessionGroup group)
    {
        for (int n = 0; n < 40 && group.Sessions[1].State == SessionState.Running; n++)
        {
            Gap(group, n);
            group.Run(0.01);
        }

        Assert.Equal(SessionEnd.Kicked, group.Sessions[1].EndedBy);
        group.Steps.WorkPerSecond = 0;
    }

    private static ClientSession Again(SessionGroup group, ulong nonce, PlayerPass pass = default)
    {
        ClientSession session = new(null, group.Ports[1], new SkewedClock(group.Clock, 0, default), new ClientOptions { Pass = pass }, PeerAddress.Virtual(0), nonce);
        group.Steps.Replace(1, session, group.Ports[1]);
        group.Run(3);
        return session;
    }

    private static BodyId[] Bodies(Session session)
    {
        Simulation world = session.World!.Simulation;
        return [.. Enumerable.Range(0, world.BodyCount).Select(world.BodyAt).Where(body => world.TryRead(body, world.SimulatedTo, out _))];
    }

    private static SessionGroup Three(Scene? scene = null, bool hasBudget = true)
    {
        SessionGroup group = new(scene ?? Room(), 3, LinkProfiles.PureDelay(20), 1, _ => new HostOptions { PlayerBudget = hasBudget ? PlayerBudget.Default : null });
        group.Connect();
        group.Run(1);
        group.Steps.WorkPerSecond = MicrosecondsASecond;
        return group;
    }

    private static void Check(bool hasBudget, double late, SessionGroup group)
    {
        if (!hasBudget)
        {
            Assert.True(late > 0.6, $"{late} s");
            return;
        }

        Assert.True(late < 0.25, $"{late} s");
        Assert.Equal(1, group.Host.ClientCount);
        byte gone = group.Sessions[1].Peer;
        group.Run(2);
        Assert.True(Late(group) < 0.25, $"{Late(group)} s");
        group.Run(0.5);
        foreach (Session session in new[] { group.Sessions[0], group.Sessions[2] })
        {
            Assert.Equal((SessionState.Running, 0L, session != group.Host), (session.State, session.Counters.StatesDiffered, session.Counters.StatesAgreed > 1));
            Assert.DoesNotContain(Bodies(session), body => body.Peer == gone);
        }
    }

    /// <summary>Client 1 does harm for some seconds.</summary>
    /// <returns>How late the world of any other was at most, in s, and the group.</returns>
    private static (double Late, SessionGroup Group) Play(bool hasBudget, Action<SessionGroup, int> act, double workPerSecond = MicrosecondsASecond, double seconds = 1.5)
    {
        SessionGroup group = Three(null, hasBudget);
        group.Steps.WorkPerSecond = workPerSecond;
        double late = 0;
        for (int n = 0; n < seconds * 100 && late < 0.7; n++) // later, it is frozen
        {
            if (group.Sessions[1].State == SessionState.Running)
            {
                act(group, n);
            }

            group.Run(0.01);
            late = Math.Max(late, Late(group));
        }

        return (late, group);
    }

    /// <summary>How far behind the shared time the worlds of the others are, in seconds.</summary>
    private static double Late(SessionGroup group) =>
        new[] { group.Sessions[0], group.Sessions[2] }.Max(s => (s.SharedTime.Now - s.World!.Simulation.Horizon).ToSeconds());

    private static void Gap(SessionGroup group, int n) => Gap(group, n, Heavy);

    private static void Gap(SessionGroup group, int n, double mass)
    {
        BodySpec ball = new(0.25, 1, 1);
        byte peer = group.Client(1).Peer;
        if (n == 0)
        {
            BodyId held = group.Do(1, PlayerAction.Spawn(new BodySpec(0.25, mass, 1), new Vector3D(0.9, 0.2505 + 0.501, 0.9), default)).Body;
            group.Do(1, PlayerAction.Grab(held, default));
            group.Do(1, PlayerAction.Spawn(ball, new Vector3D(0.9, 0.2505, 0.9), new Vector3D(0, 999, 0)));
        }
        else if (n % 10 == 0)
        {
            group.Do(1, PlayerAction.HoldKeyframe(new BodyId(peer, 1, 0), new Vector3D(0.9, 0.2505 + 0.501, 0.9), default));
        }
    }

    private static void Heap(SessionGroup group, int n) => Heap(group, n, 1);

    private static void Heap(SessionGroup group, int n, double massOfOne)
    {
        if (n == 0)
        {
            for (int i = 0; i < 64; i++)
            {
                Vector3D place = new(-0.9 + (0.55 * (i % 4)) + (0.003 * (i % 5)), 1.4 + (0.55 * (i / 16)), -0.9 + (0.55 * (i / 4 % 4)) + (0.002 * (i % 7)));
                group.Do(1, PlayerAction.Spawn(new BodySpec(0.25, i == 21 ? massOfOne : 1 + (i % 7), 0.2, friction: 0.3), place, default));
            }
        }
    }

    /// <summary>The heap, and a hand that has a heavy ball of it go to and fro in it as often as it may.</summary>
    private static void Shake(SessionGroup group, int n)
    {
        Heap(group, n, Heavy);
        BodyId body = new(group.Client(1).Peer, 22, 0);
        if (n == 5)
        {
            group.Do(1, PlayerAction.Grab(body, default));
        }
        else if (n > 5)
        {
            group.Do(1, PlayerAction.HoldKeyframe(body, new Vector3D(0, 0.8 + (0.5 * (n % 2)), 0), default));
        }
    }

    private static bool Sleeps(SessionGroup group)
    {
        Simulation world = group.Host.World!.Simulation;
        return Bodies(group.Host).Where(body => body.Sequence > 0)
            .All(body => world.TryRead(body, world.SimulatedTo, out BodyState state) && state.Velocity == Vector3D.Zero);
    }

    private static Scene Room() => new SceneBuilder("room").WithSmallestRadius(0.1)
        .AddPlane("floor", Vector3D.Up, new Vector3D(0, 0, 0), 1, friction: 0.3)
        .AddPlane("east", new Vector3D(-1, 0, 0), new Vector3D(1.2, 0, 0), 1).AddPlane("south", new Vector3D(0, 0, -1), new Vector3D(0, 0, 1.2), 1)
        .AddPlane("west", new Vector3D(1, 0, 0), new Vector3D(-1.2, 0, 0), 1).AddPlane("north", new Vector3D(0, 0, 1), new Vector3D(0, 0, -1.2), 1)
        .AddBody("ball", new BodySpec(0.1, 1, 0.8), new Vector3D(0, 0.5, 0)).Build();
}
