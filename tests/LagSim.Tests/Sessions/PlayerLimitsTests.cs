using System.Linq;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>How fast, and how many: what a host lets one player ask of the world, and a sentence for who asks more here.</summary>
public sealed class PlayerLimitsTests
{
    [Fact]
    public void Claim_FasterThanAPlayerMayGive_IsInvalidWhateverItIs()
    {
        SessionGroup group = Group();
        RawClient fast = new(group);
        SimTime now = group.Host.SharedTime.Now;
        fast.Claim(
            1,
            ExternalEvent.Spawn(now, fast.Peer, 1, Ball(0.3), V(0, 8), V(0, 101)),
            ExternalEvent.Teleport(now, fast.Peer, 2, First, V(0, 8), V(0, 101)),
            ExternalEvent.SetVelocity(now, fast.Peer, 3, First, V(0, 101)),
            ExternalEvent.Impulse(now, fast.Peer, 4, Second, V(0, 210)), // of 2 kg
            ExternalEvent.Impulse(now, fast.Peer, 5, new BodyId(fast.Peer, 6, 0), V(0, 1)), // on what it will spawn, of any mass
            ExternalEvent.Spawn(now, fast.Peer, 6, Ball(0.3, 0.001), V(0, 8), V(0, 99)),
            ExternalEvent.Impulse(now, fast.Peer, 7, new BodyId(fast.Peer, 6, 0), V(0, 0.2)),
            ExternalEvent.Teleport(now, fast.Peer, 8, First, V(0, 8), V(0, 99)),
            ExternalEvent.SetVelocity(now, fast.Peer, 9, First, V(0, 99)),
            ExternalEvent.Impulse(now, fast.Peer, 10, Second, V(0, 150)),
            ExternalEvent.Spawn(now, fast.Peer, 11, Ball(0.5), V(0, 8), V(0, 9), V(0, 0, 202)), // its surface at 101 m/s
            ExternalEvent.Spawn(now, fast.Peer, 12, Ball(0.5), V(0, 8), V(0, 9), V(0, 0, 198)));
        group.Run(0.1);
        Assert.Equal([1, 2, 3, 4, 5, 7, 11], Said(group, Verdict.Invalid));
        Assert.Equal([6, 8, 9, 10, 12], Said(group, Verdict.Accepted));
        Assert.Null(group.Difference());
    }

    [Fact]
    public void Claim_ManySmallImpulses_CountWithTheSpeedThatIsThere()
    {
        SessionGroup group = Group();
        RawClient fast = new(group);
        SimTime now = group.Host.SharedTime.Now;
        for (uint n = 1; n <= 4; n++)
        {
            fast.Claim(n, ExternalEvent.Impulse(now + SimDuration.FromTicks(n), fast.Peer, n, First, V(0, 40)));
        }

        fast.Claim(5, ExternalEvent.Impulse(now + SimDuration.FromTicks(5), fast.Peer, 5, First, V(0, -40))); // slower is always right
        group.Run(0.1);
        Assert.Equal([3, 4], Said(group, Verdict.Invalid));
        Assert.Equal([1, 2, 5], Said(group, Verdict.Accepted));
    }

    [Fact]
    public void Claim_WhereTheHostSetsNoLimit_IsAccepted()
    {
        SessionGroup group = Group(double.PositiveInfinity, 100);
        RawClient fast = new(group);
        SimTime now = group.Host.SharedTime.Now;
        fast.Claim(1, ExternalEvent.SetVelocity(now, fast.Peer, 1, First, V(0, 1e6)), ExternalEvent.Spawn(now, fast.Peer, 2, Ball(0.3), V(0, 8), V(0, 1e6)));
        Assert.Equal([1, 2], Said(group, Verdict.Accepted));
    }

    [Fact]
    public void Claim_MoreBodiesThanAPlayerMaySpawn_IsRefusedUntilSomeAreRemoved()
    {
        SessionGroup group = Group();
        RawClient many = new(group);
        SimTime now = group.Host.SharedTime.Now;
        many.Claim(1, [.. Enumerable.Range(1, 4).Select(n => Spawn(now, many.Peer, (uint)n))]);
        Assert.Equal([4], Said(group, Verdict.NoRight));

        // Removed before it came is not removed, and removed later not yet.
        many.Claim(5, ExternalEvent.Remove(now - SimDuration.OneTick, many.Peer, 5, new BodyId(many.Peer, 1, 0)), Spawn(now, many.Peer, 6));
        many.Claim(7, ExternalEvent.Remove(group.Host.SharedTime.Now + SimDuration.FromSeconds(0.3), many.Peer, 7, new BodyId(many.Peer, 1, 0)), Spawn(now, many.Peer, 8));
        Assert.Equal([4, 6, 8], Said(group, Verdict.NoRight));
        group.Run(0.4);
        now = group.Host.SharedTime.Now;
        many.Claim(9, Spawn(now, many.Peer, 9), Spawn(now, many.Peer, 10));
        Assert.Equal([4, 6, 8, 10], Said(group, Verdict.NoRight));
        Assert.Null(group.Difference());

        // Who gets its number, here the next from its machine, gets its bodies, and anyone may remove them; others have their own.
        many.Leave();
        group.Do(1, PlayerAction.Spawn(Ball(0.25), V(0, 30)));
        many.Join(99);
        Assert.Equal(10u, many.LastSequence);
        group.Do(0, PlayerAction.Remove(new BodyId(many.Peer, 2, 0)));
        many.Claim(11, Spawn(group.Host.SharedTime.Now, many.Peer, 11), Spawn(group.Host.SharedTime.Now, many.Peer, 12));
        Assert.Equal([4, 6, 8, 10, 12], Said(group, Verdict.NoRight));
    }

    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    public void Do_BeyondTheLimits_ThrowsASentenceAndSendsNothing(int peer)
    {
        SessionGroup group = Group();
        SceneException fast = Assert.Throws<SceneException>(() => group.Do(peer, PlayerAction.SetVelocity(First, V(0, 101))));
        Assert.Equal("The SetVelocity gives body 'ball 0' (0.0.0) a speed of 101 m/s; in this session a player may give 100 m/s at most.", fast.Message);
        ExternalEvent first = group.Do(peer, Above(0));
        group.Do(peer, Above(1));
        group.Do(peer, Above(2));
        SceneException many = Assert.Throws<SceneException>(() => group.Do(peer, Above(3)));
        Assert.Equal($"Peer {peer} has spawned 3 bodies that are still there, and no player may have more at a time; some have to be removed first.", many.Message);
        group.Do(peer, PlayerAction.Remove(first.Body));
        group.Run(0.05);
        group.Do(peer, Above(4));
        Assert.True(group.Settle(5));
        Assert.Equal((5, 0), (group.Host.Counters.EventsAccepted, group.Host.Counters.EventsRefused));
        Assert.Null(group.Difference());
    }

    [Fact]
    public void Claim_OfAStrongerHandThanAPlayersMayBe_IsInvalid()
    {
        SessionGroup usual = Group(), weak = Group(force: 150, power: 3_000);
        Assert.Equal("1:Accepted 2:Accepted 3:Invalid 4:Accepted 5:Invalid 6:Accepted 7:Invalid", Verdicts(usual)); // what it has by default, on 2 kg
        Assert.Equal("1:Invalid 2:Accepted 3:Invalid 4:Accepted 5:Invalid 6:Invalid 7:Accepted", Verdicts(weak));
        SceneException strong = Assert.Throws<SceneException>(() => usual.Do(1, PlayerAction.Grab(Second, maxForce: 3_001)));
        Assert.Equal("The Grab takes body 'ball 1' (0.0.1) with a greatest force of 3001 N; in this session a player's hand has 3000 N there at most.", strong.Message);
        Assert.Throws<SceneException>(() => usual.Do(1, PlayerAction.Grab(Second, maxForce: -1)));

        static string Verdicts(SessionGroup group)
        {
            RawClient hands = new(group);
            SimTime now = group.Host.SharedTime.Now;
            hands.Claim(
                1,
                ExternalEvent.Grab(now, hands.Peer, 1, Second),
                ExternalEvent.Grab(now, hands.Peer, 2, Second, maxForce: 150, maxPower: 3_000),
                ExternalEvent.Grab(now, hands.Peer, 3, Second, maxForce: 3_001, maxPower: 10),
                ExternalEvent.Grab(now, hands.Peer, 4, Second, maxForce: 10),
                ExternalEvent.Grab(now, hands.Peer, 5, Second, maxForce: 150, maxPower: 150_001),
                ExternalEvent.Grab(now, hands.Peer, 6, new BodyId(hands.Peer, 8, 0)), // what it spawns later, of any mass
                ExternalEvent.Grab(now, hands.Peer, 7, new BodyId(hands.Peer, 8, 0), maxForce: 1, maxPower: 1));
            group.Run(0.1);
            return string.Join(' ', group.Log.Values.Where(e => e.Event.Peer > 1).Select(e => $"{e.Event.Sequence}:{e.Verdict}"));
        }
    }

    [Fact]
    public void Do_WithinOnesOwnLimitsButNotTheHosts_IsTakenBack()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5), 1, peer => Options(peer == 0 ? 100 : 1_000, 3)).Connect();
        group.Do(1, PlayerAction.SetVelocity(First, V(0, 500)));
        Assert.True(group.Settle(1));
        Assert.Equal(1, group.Sessions[1].Counters.EventsRefused);
        Assert.Null(group.Difference());
    }

    [Theory]
    [InlineData(0, 64)]
    [InlineData(double.NaN, 64)]
    [InlineData(1, -1)]
    [InlineData(1, 1_000_001)]
    public void Options_OutOfRange_AreRefused(double speed, int bodies) =>
        Assert.Throws<System.ArgumentOutOfRangeException>(() => new SessionGroup(ScriptedActions.Box(), 1, LinkProfiles.Lan, 1, _ => Options(speed, bodies)));

    private static SessionGroup Group(double speed = 100, int bodies = 3, double force = 0, double power = 0) =>
        new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5), 1, _ => Options(speed, bodies, force, power)).Connect();

    private static HostOptions Options(double speed, int bodies, double force = 0, double power = 0) =>
        new() { MaxGivenSpeed = speed, MaxSpawned = bodies, MaxHandForce = force, MaxHandPower = power, ExtraHistory = SimDuration.FromSeconds(60), MaxClientsPerAddress = 1 };

    private static PlayerAction Above(int place) => PlayerAction.Spawn(Ball(0.25), V(0, 10 + place));

    private static ExternalEvent Spawn(SimTime time, byte peer, uint sequence) => ExternalEvent.Spawn(time, peer, sequence, Ball(0.25), V(0, 10 + sequence));

    private static int[] Said(SessionGroup group, Verdict verdict) =>
        [.. group.Log.Values.Where(e => e.Verdict == verdict && e.Event.Peer > 1).Select(e => (int)e.Event.Sequence)];
}
