using System;
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

/// <summary>Hands over a network: whose the body is, on every peer, whatever became of the events and of who holds it.</summary>
public sealed class HoldTests
{
    [Fact]
    public void Grab_ByTwoAtOnce_IsTheFirstsOnEveryPeerAndTheOthersActionsHaveNoEffect()
    {
        SessionGroup group = Group(3);
        ExternalEvent mine = group.Do(1, PlayerAction.Grab(First));
        group.Run(0.02);
        group.Do(2, PlayerAction.Grab(First, V(0, 0.1))); // has not heard of it
        group.Do(2, PlayerAction.HoldKeyframe(First, V(2, 4), V(1)));
        Assert.Equal((1, 2), (Holder(group, 1), Holder(group, 2))); // each sees its own hand
        group.Run(0.15);
        Assert.All(group.Sessions, (_, peer) => Assert.Equal(1, Holder(group, peer)));
        group.Do(1, PlayerAction.HoldKeyframe(First, V(-1, 4), V(0)));
        group.Do(2, PlayerAction.HoldKeyframe(First, V(2, 4), V(1)));
        group.Do(2, PlayerAction.Release(First, V(9)));
        group.Run(0.5);
        Assert.All(group.Sessions, s => Near(V(-1, 4), Read(s.World!.Simulation, First, s.SharedTime.Now).Position, 1e-9));
        Assert.True(group.Settle(6));
        Assert.Equal(6, group.Host.Counters.EventsAccepted); // accepted all: who holds is the world's to say
        Assert.Null(group.Difference());

        // The control: without the first grab the other's is the one.
        Assert.NotNull(group.Difference(group.Alone(group.Accepted.Where(e => !e.Equals(mine)))));
    }

    [Fact]
    public void Hold_WhoseRightIsLostByALateEvent_IsTakenFromWhoHadItForAWhile()
    {
        SessionGroup group = Group(3);
        group.Network.SetLink(1, 0, new LinkLeg(400)); // events of peer 1 arrive late
        group.Do(1, PlayerAction.Grab(First));
        group.Run(0.1);
        group.Do(2, PlayerAction.Grab(First));
        for (int i = 0; i < 8; i++)
        {
            group.Do(2, PlayerAction.HoldKeyframe(First, V(0.2 * i, 5), V(2)));
            group.Run(0.03);
        }

        Assert.Equal((2, 1, 2), (Holder(group, 0), Holder(group, 1), Holder(group, 2)));
        Vector3D before = Read(group.Host.World!.Simulation, First, group.Host.SharedTime.Now).Position;
        group.Run(0.5);
        Assert.All(group.Sessions, (_, peer) => Assert.Equal(1, Holder(group, peer)));
        Assert.True((before - Read(group.Host.World!.Simulation, First, group.Host.SharedTime.Now).Position).Length > 0.5);
        Assert.True(group.Settle(10));
        Assert.Null(group.Difference());
    }

    [Fact]
    public void Holder_LostInTheMiddleOfAMove_LetsGoASecondAfterItsLastKeyframeOnAllOthersAlike()
    {
        SessionGroup group = Group(3);
        group.Do(1, PlayerAction.Grab(First));
        ExternalEvent last = default;
        for (int i = 0; i < 10; i++)
        {
            last = group.Do(1, PlayerAction.HoldKeyframe(First, V(0.1 * i, 4), V(1)));
            group.Run(0.1);
        }

        group.Cut(1, 0);
        group.Cut(0, 1);
        SimTime end = last.Time + SimDuration.FromSeconds(1);
        group.Run(2);
        foreach (Session session in group.Sessions)
        {
            Simulation world = session.World!.Simulation;
            Assert.True(world.TryReadHold(First, end - SimDuration.OneTick, out Hold hold));
            Assert.Equal((1, last.Time), (hold.Peer, hold.KeyframeTime));
            Assert.False(world.TryReadHold(First, end, out _));
            Near(V(1.05, 4), Read(world, First, end).Position, 1e-9); // 0.9 m, and half of 0.3 s of its speed
        }

        Assert.Null(group.Difference());

        // Whoever comes next may take it; and the number is given again, without a hand.
        group.Do(2, PlayerAction.Grab(First));
        group.Run(0.3);
        Assert.Equal((2, 2), (Holder(group, 0), Holder(group, 2)));
    }

    [Theory]
    [InlineData(1, 0)]
    [InlineData(0, 2)]
    public void LastKeyframe_OfWhichManyDatagramsInARowAreLost_IsThereWithinTwoSeconds(int from, int to)
    {
        SessionGroup group = new SessionGroup(Scene(PeerSet.Everyone), 3, LinkProfiles.PureDelay(200), 1, _ => new HostOptions { Window = new(SimDuration.FromSeconds(3)) }).Connect();
        int left = 0;
        group.Network.Lose((sender, receiver, _) => sender == from && receiver == to && left-- > 0);
        group.Do(1, PlayerAction.Grab(First));
        group.Run(2);
        Assert.Equal(1u, group.Sessions[to].LogLength);

        left = 8; // were each only sent again when its answer is overdue, after 0.5 s here, this would take 4 s
        group.Do(1, PlayerAction.HoldKeyframe(First, V(0, 4), V(0)));
        Assert.True(group.RunUntil(() => group.Sessions[to].LogLength == 2, seconds: 2), $"{left} are still to be lost");
        Assert.True(left <= 0, "not all were lost");
    }

    [Fact]
    public void Leave_OfWhoHolds_EndsTheHoldInTheSameWay()
    {
        SessionGroup group = Group(3);
        group.Do(1, PlayerAction.Grab(First));
        group.Run(0.1);
        group.Sessions[1].Leave();
        group.Run(0.5);
        Assert.Equal((1, 1), (Holder(group, 0), Holder(group, 2)));
        group.Run(0.5);
        Assert.Equal((-1, -1), (Holder(group, 0), Holder(group, 2)));
    }

    [Fact]
    public void Claim_OfAHandThatIsNone_ChangesNothingOrIsRefused()
    {
        SessionGroup group = new SessionGroup(Scene(PeerSet.Of(0, 1, 2)), 3, LinkProfiles.PureDelay(20), 3, _ => Long()).Connect();
        group.Do(1, PlayerAction.Grab(First));
        group.Run(0.1);
        RawClient liar = new(group);
        SimTime now = group.Host.SharedTime.Now;
        liar.Claim(
            1,
            ExternalEvent.HoldKeyframe(now, liar.Peer, 1, Second, V(9, 9), V(9)),
            ExternalEvent.Release(now, liar.Peer, 2, Second, V(9)),
            ExternalEvent.HoldKeyframe(now, liar.Peer, 3, First, V(9, 9), V(9)),
            ExternalEvent.Release(now, liar.Peer, 4, Second, V(2_000)),
            ExternalEvent.Grab(now + SimDuration.OneTick, liar.Peer, 5, Second),
            ExternalEvent.HoldKeyframe(now + (SimDuration.OneTick * 2), liar.Peer, 6, Second, V(1e3, 9), V(0)),
            ExternalEvent.HoldKeyframe(now, 1, 7, First, V(9, 9), V(0)));
        group.Run(0.2);
        Verdict[] verdicts = group.Log.Values.Where(e => e.Event.Peer == liar.Peer).Select(e => e.Verdict).ToArray();
        Assert.Equal([Verdict.Accepted, Verdict.Accepted, Verdict.NoRight, Verdict.Invalid, Verdict.Accepted, Verdict.Invalid], verdicts);
        Assert.Equal(1, group.Host.Counters.EventsForged); // the last, in another's name
        Assert.Equal(1, Holder(group, 0));
        Near(V(-2, 4), Read(group.Host.World!.Simulation, First, group.Host.SharedTime.Now).Position, 0.1);
        Assert.Null(group.Difference());
        SceneException guarded = Assert.Throws<SceneException>(() => new SessionGroup(Scene(PeerSet.Of(0)), 2, LinkProfiles.Lan).Connect().Do(1, PlayerAction.Grab(First)));
        Assert.Contains("may not touch body 'guarded'", guarded.Message, StringComparison.Ordinal);
        group.Do(1, PlayerAction.Grab(Second));
    }

    [Fact]
    public void Do_AKeyframeFartherThanTheLimitOfSpeed_ThrowsASentence()
    {
        SessionGroup group = Group(2);
        group.Do(1, PlayerAction.Grab(First));
        Assert.Contains("HoldKeyframe", Assert.Throws<SceneException>(() => group.Do(1, PlayerAction.HoldKeyframe(First, V(0, 100), V(0)))).Message, StringComparison.Ordinal);
        group.Do(1, PlayerAction.HoldKeyframe(First, V(0, 40), V(0)));
    }

    [Fact]
    public void Join_WhileSomebodyHolds_HasTheHoldWithTheState()
    {
        SessionGroup group = new SessionGroup(Scene(PeerSet.Everyone), 2, LinkProfiles.PureDelay(20), 5, _ => Long(), expected: 1).Connect();
        group.Do(1, PlayerAction.Grab(First));
        for (int i = 0; i < 30; i++)
        {
            group.Do(1, PlayerAction.HoldKeyframe(First, V(0.05 * i, 4), V(0.5)));
            group.Run(0.2);
        }

        ClientSession late = group.Join(7, 77, ClientOptions.From(Long()));
        Assert.True(group.RunUntil(() => late.State == SessionState.Running));
        Assert.NotNull(late.BegunFrom);
        Assert.Equal(MotionLaw.Held, late.BegunFrom.Bodies[0].Law);
        group.Do(1, PlayerAction.HoldKeyframe(First, V(1, 4), V(0)));
        group.Run(0.3);
        Assert.All(group.Sessions, (_, peer) => Assert.Equal(1, Holder(group, peer)));
        Assert.Null(group.Difference());
    }

    [Theory]
    [InlineData("delay-100ms", 4)]
    [InlineData("awful", 3)]
    [InlineData("loss-20", 3)]
    public void Worlds_WithHands_AreThatOfOneWhoHadAllAcceptedEventsAtOnce(string link, int peers)
    {
        int holds = 0;
        for (ulong seed = 1; seed <= 5; seed++)
        {
            SessionGroup group = new SessionGroup(ScriptedActions.Box(), peers, AgreementTests.Link(link), seed, _ => Long()).Connect();
            new ScriptedActions((int)seed) { HasHands = true }.DoIn(group, 60);
            Assert.True(group.Settle(60), $"{link} {seed}");
            string? difference = group.Difference();
            Assert.True(difference is null, $"{link}, seed {seed}: {difference}");
            holds += Bodies(group.Alone()).Sum(body => group.Alone().Timeline(body).Count(e => e.Key.Kind is EventKind.HoldKeyframe));
        }

        Assert.True(holds > 2, $"{holds} knots that had an effect");
    }

    private static HostOptions Long() => new() { Window = new(SimDuration.FromSeconds(5)), ExtraHistory = SimDuration.FromSeconds(60) };

    private static SessionGroup Group(int peers) => new SessionGroup(Scene(PeerSet.Everyone), peers, LinkProfiles.PureDelay(50), 3, _ => Long()).Connect();

    private static Scene Scene(PeerSet guards) => new SceneBuilder("hands").WithSmallestRadius(0.25).AddPlane("floor", Vector3D.Up, V(0), 0.9)
        .AddBody("guarded", Ball(0.3), V(-2, 4), default, guards).AddBody("free", Ball(0.3), V(2, 4)).Build();

    /// <summary>Who holds the first body now, as that peer sees it; -1 for nobody.</summary>
    private static int Holder(SessionGroup group, int peer)
    {
        Session session = group.Sessions[peer];
        return session.World!.Simulation.TryReadHold(First, session.SharedTime.Now, out Hold hold) ? hold.Peer : -1;
    }
}
