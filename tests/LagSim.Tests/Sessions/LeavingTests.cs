using System;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

public sealed class LeavingTests
{
    [Fact]
    public void Leave_Host_EndsTheClientsWithASentenceAndLeavesTheWorldReadable()
    {
        SessionGroup group = Three();
        group.Do(0, PlayerAction.Teleport(First, V(0, 4)));
        group.Settle(1);
        group.Host.Leave();
        group.Run(0.2);
        Assert.Equal("This peer left.", group.Host.EndReason);
        Assert.All(group.Sessions, s => Assert.Equal(SessionState.Ended, s.State));
        Assert.All(group.Sessions.Skip(1), s => Assert.Equal("The host ended the session.", s.EndReason));
        Assert.Null(group.Difference());
        Assert.Throws<InvalidOperationException>(() => group.Do(1, PlayerAction.Remove(First)));
    }

    [Fact]
    public void Leave_HostWhoseGoodbyeIsLost_EndsTheClientsWithTheSameSentence()
    {
        SessionGroup group = Three();
        group.Cut(0, 1);
        group.Cut(0, 2);
        group.Host.Leave();
        group.Run(0.05);
        Assert.All(group.Sessions.Skip(1), s => Assert.Equal(SessionState.Running, s.State));
        group.Restore(0, 1);
        group.Restore(0, 2);
        group.Run(5);
        Assert.All(group.Sessions.Skip(1), s => Assert.Equal("The host ended the session.", s.EndReason));
    }

    [Fact]
    public void Leave_HostWhileAnEventIsOnItsWay_TakesNothingInAnyMore()
    {
        SessionGroup group = Three();
        group.Do(1, PlayerAction.Teleport(First, V(0, 4)));
        group.Host.Leave();
        group.Run(1);
        Assert.Equal(0, group.Host.Counters.EventsAccepted);
        Assert.True(group.Host.Counters.DatagramsIgnored > 0);
    }

    [Fact]
    public void Leave_Client_LeavesTheOthersRunning()
    {
        SessionGroup group = Three();
        group.Sessions[1].Leave();
        group.Run(0.2);
        Assert.Equal(1, group.Host.ClientCount);
        GoesOn(group);
    }

    [Fact]
    public void Silence_OfAClient_LeavesTheOthersRunningAndTellsIt()
    {
        SessionGroup group = Three(timeout: 3);
        group.Cut(1, 0);
        group.Run(2.5);
        Assert.Equal(2, group.Host.ClientCount);
        group.Run(1);
        Assert.Equal(1, group.Host.ClientCount);
        Assert.Equal("The host heard nothing from this peer for too long.", group.Sessions[1].EndReason);
        Assert.Equal(SessionEnd.Disconnected, group.Sessions[1].EndedBy);
        GoesOn(group);
    }

    [Fact]
    public void Silence_OfTheHost_EndsTheClientWithASentence()
    {
        SessionGroup group = Three(timeout: 3);
        group.Cut(0, 1);
        group.Run(2.5);
        Assert.Equal(SessionState.Running, group.Sessions[1].State);
        group.Run(1);
        Assert.Equal("The host fell silent for 3 s.", group.Sessions[1].EndReason);
        GoesOn(group);
    }

    [Fact]
    public void Leave_ClientWhoseGoodbyeIsLost_IsHeardInAnswerToTheNextUpdate()
    {
        SessionGroup group = Three();
        group.Cut(1, 0);
        group.Sessions[1].Leave();
        group.Run(0.05);
        Assert.Equal(2, group.Host.ClientCount);
        group.Restore(1, 0);
        group.Do(0, PlayerAction.Impulse(First, V(1))); // else the host would write of itself only once the keep-alive is overdue
        group.Run(0.05);
        Assert.Equal(1, group.Host.ClientCount);
        GoesOn(group);
    }

    [Theory]
    [InlineData(2, true)]
    [InlineData(3, false)] // the control: when all that are sent at once are lost
    public void Leave_SomeGoodbyesLost_IsHeardAtOnce(int lost, bool isHeard)
    {
        SessionGroup group = Three();
        group.Network.Lose((from, _, datagram) => from == 1 && datagram.Span[3] == (byte)DatagramType.Leave && lost-- > 0);
        group.Sessions[1].Leave();
        group.Run(0.05);
        Assert.Equal(isHeard ? 1 : 2, group.Host.ClientCount);
    }

    [Fact]
    public void Update_OfOneWhoWasLetGoAndDidNotHear_IsAnsweredAtOnce()
    {
        SessionGroup group = Three(timeout: 3);
        bool isLost = true;
        group.Network.Lose((_, to, datagram) => isLost && to == 1 && datagram.Span[3] == (byte)DatagramType.Leave);
        group.Cut(1, 0);
        Assert.True(group.RunUntil(() => group.Host.ClientCount == 1, 4));
        group.Run(0.1);
        Assert.Equal(SessionState.Running, group.Sessions[1].State);
        isLost = false;
        group.Restore(1, 0);
        group.Run(0.1);
        Assert.Equal("The host heard nothing from this peer for too long.", group.Sessions[1].EndReason); // the reason is said again
        Assert.Equal(SessionEnd.Disconnected, group.Sessions[1].EndedBy);
        GoesOn(group);
    }

    [Fact]
    public void Update_OfAFormerSessionOrInAnothersNumber_PutsNobodyOut()
    {
        // From a client's own address, as somebody may send who gives that address: what it is told is not about the session that it has.
        SessionGroup group = Three();
        ulong own = 0;
        bool isOwn = true;
        group.Network.Lose((from, _, datagram) =>
        {
            own = isOwn && from == 1 && datagram.Span[3] == (byte)DatagramType.Update ? BitConverter.ToUInt64(datagram.Span[4..]) : own;
            return false;
        });
        Assert.True(group.RunUntil(() => own != 0, 5));
        isOwn = false;
        int answers = 0, longest = 0;
        group.Network.Lose((from, to, datagram) =>
        {
            if (from == 0 && to == 1 && datagram.Span[3] == (byte)DatagramType.Leave)
            {
                answers++;
                longest = Math.Max(longest, datagram.Length);
                Assert.NotEqual(own, BitConverter.ToUInt64(datagram.Span[4..]));
            }

            return false;
        });
        byte[] bytes = new byte[WireFormat.EmptyUpdateBytes];
        byte peer = group.Sessions[1].Peer;
        foreach ((ulong session, byte number) in new[] { (own + 100, peer), (own, (byte)(peer + 1)), (own - 100, (byte)0) })
        {
            new UpdateDatagram { SessionId = session, Peer = number, Number = uint.MaxValue }.Encode(bytes);
            group.Ports[1].Send(bytes, PeerAddress.Virtual(0));
        }

        group.Run(0.2);
        Assert.Equal((2, WireFormat.LeaveBytes), (answers, longest)); // no more than what came, and nothing about the session it has
        Assert.True(WireFormat.LeaveBytes < WireFormat.EmptyUpdateBytes);
        Assert.All(group.Sessions, s => Assert.Equal(SessionState.Running, s.State));
    }

    [Fact]
    public void Silence_ShorterThanTheTimeout_EndsNothing()
    {
        SessionGroup group = Three(timeout: 3);
        group.Cut(1, 0);
        group.Cut(0, 1);
        group.Run(2);
        group.Restore(1, 0);
        group.Restore(0, 1);
        group.Run(10);
        Assert.All(group.Sessions, s => Assert.Equal(SessionState.Running, s.State));
    }

    [Fact]
    public void KeepAlive_LossInBurstsAndNothingToSay_IsNotTakenForSilence()
    {
        // Bursts are counted in datagrams: at one keep-alive in two seconds a burst of five would last as long as the timeout.
        for (ulong seed = 1; seed <= 20; seed++)
        {
            SessionGroup group = new SessionGroup(ScriptedActions.Box(), 3, LinkProfiles.Awful, seed).Connect();
            group.Run(120);
            Assert.All(group.Sessions, s => Assert.Equal(SessionState.Running, s.State));
        }
    }

    [Fact]
    public void KeepAlive_NothingToSayOnAGoodLink_CostsADatagramInTwoSeconds()
    {
        SessionGroup group = Three();
        group.Run(5);
        long before = group.Sessions[1].Counters.DatagramsSent;
        group.Run(60);
        Assert.InRange(group.Sessions[1].Counters.DatagramsSent - before, 28, 32);
    }

    [Fact]
    public void Step_WorldThatCannotGoOn_EndsEverySessionWithASentenceAndDoesNotThrow()
    {
        SessionGroup group = Three(scene: Poisoned());
        RawClient other = new(group);
        other.Claim(1, ExternalEvent.Spawn(group.Host.SharedTime.Now, other.Peer, 1, Ball(flight: MotionLaw.RungeKutta4, force: 1), V(-20, 5)));
        group.Run(0.1);
        Assert.All(group.Sessions, s => Assert.Equal(SessionState.Running, s.State)); // the control: it is the place that ends it
        other.Claim(2, ExternalEvent.Spawn(group.Host.SharedTime.Now, other.Peer, 2, Ball(flight: MotionLaw.RungeKutta4, force: 1), V(20, 5)));
        group.Run(1);
        Assert.All(group.Sessions, s => Assert.Equal(SessionState.Ended, s.State));
        Assert.StartsWith("The world cannot be simulated any further. In the step from ", group.Host.EndReason, System.StringComparison.Ordinal);
    }

    [Fact]
    public void Do_WorldThatCannotGoOnWithIt_ThrowsAndEndsTheSession()
    {
        SessionGroup group = Three(scene: Poisoned());
        Assert.Throws<SimulationException>(() => group.Do(1, PlayerAction.Spawn(Ball(flight: MotionLaw.RungeKutta4, force: 1), V(20, 5))));
        Assert.Equal(SessionState.Ended, group.Sessions[1].State);
        group.Run(1);
        Assert.Equal(1, group.Host.ClientCount);
        GoesOn(group);
    }

    [Fact]
    public void Step_BodiesThatMeetAtTheGreatestSpeed_EndsNothing()
    {
        // The light one would leave the impact faster than a state means something.
        SessionGroup group = Three(most: double.PositiveInfinity);
        double limit = 0.1 * group.Scene.SmallestRadius * SimDuration.TicksPerSecond;
        RawClient other = new(group);
        SimTime now = group.Host.SharedTime.Now;
        other.Claim(
            1,
            ExternalEvent.Spawn(now, other.Peer, 1, Ball(mass: 1e9, e: 1), V(0, 1e6), V(0, limit)),
            ExternalEvent.Spawn(now, other.Peer, 2, Ball(e: 1), V(0, 1e6 + 2), V(0, -limit)));
        group.Run(1);
        Assert.All(group.Sessions, s => Assert.Equal(SessionState.Running, s.State));
        Assert.Equal(2, group.Host.Counters.EventsAccepted);
        Simulation world = group.Host.World!.Simulation;
        Assert.Equal(1.5 * limit, Read(world, new BodyId(other.Peer, 2, 0), world.SimulatedTo).Velocity.Length, limit * 1e-9);
        Assert.Null(group.Difference());
    }

    /// <summary>A box with a force that gives no number right of it.</summary>
    private static Scene Poisoned() => new SceneBuilder("poisoned").WithSmallestRadius(0.25).AddForce(Force.Supplied(new FunctionForce((_, x, _) => V(x.X > 10 ? double.NaN : 0))))
        .AddPlane("floor", Vector3D.Up, V(0), 0.9).AddBody("a", Ball(0.3), V(0, 1)).AddBody("b", Ball(0.3), V(2, 1)).Build();

    private static SessionGroup Three(double timeout = 10, Scene? scene = null, double most = 1_000) => new SessionGroup(scene ?? ScriptedActions.Box(), 3, LinkProfiles.PureDelay(5), 2, _ => new HostOptions
    {
        Timeout = SimDuration.FromSeconds(timeout),
        RejoinTime = SimDuration.Zero, // what is asked for after an end is RejoinTests' part
        MaxGivenSpeed = most,
        KeepAlive = SimDuration.FromSeconds(timeout / 5),
    }).Connect();

    private static void GoesOn(SessionGroup group)
    {
        Session[] running = group.Sessions.Where(s => s.State == SessionState.Running).ToArray();
        Assert.Contains(group.Host, running);
        Assert.Equal(2, running.Length);
        long[] before = running.Select(s => s.Counters.EventsAccepted).ToArray();
        group.Do(2, PlayerAction.SetVelocity(First, V(0, 3)));
        group.Do(0, PlayerAction.SetVelocity(Second, V(0, 4)));
        group.Run(0.5);
        Assert.Equal(before.Select(n => n + 2), running.Select(s => s.Counters.EventsAccepted));
        SimTime now = running.Min(s => s.World!.Simulation.SimulatedTo);
        Assert.Equal(running[0].World!.Simulation.StateHash(now), running[1].World!.Simulation.StateHash(now));
    }
}
