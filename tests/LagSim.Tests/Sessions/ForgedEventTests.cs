using System;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>A client that lies is refused and counted, and nobody else notices.</summary>
public sealed class ForgedEventTests
{
    private readonly SessionGroup group = new SessionGroup(ScriptedActions.Box(), 3, LinkProfiles.PureDelay(5)).Connect();
    private readonly RawClient liar;

    public ForgedEventTests() => liar = new RawClient(group);

    private SimTime Now => group.Host.SharedTime.Now;

    [Fact]
    public void Claim_ProperEvent_IsAccepted()
    {
        // The control of all others: this is how it is done.
        liar.Claim(1, ExternalEvent.SetVelocity(Now, liar.Peer, 1, First, V(0, 5)));
        AssertGoesOn(accepted: 1, refused: 0);
    }

    [Fact]
    public void Claim_InAnothersName_IsRefusedAndTakesNothingFromThatOne()
    {
        ExternalEvent own = group.Do(1, PlayerAction.SetVelocity(First, V(1, 5)));
        Assert.True(group.Settle(1));
        liar.Claim(1, ExternalEvent.SetVelocity(Now, own.Peer, own.Sequence, First, V(0, 9)));
        liar.Claim(2, ExternalEvent.SetVelocity(Now, 0, 1, First, V(0, 9)));
        group.Run(0.5);
        Assert.True(group.Difference() is null, group.Difference()); // as a refusal in the log it would have had peer 1 take its own event back
        Assert.Equal([own], group.Accepted);
        AssertGoesOn(accepted: 1, refused: 2);
    }

    [Theory]
    [InlineData(1, 2u)] // a number that is not its turn
    [InlineData(1, uint.MaxValue)]
    public void Claim_OtherSequenceThanItsPlace_IsRefused(uint place, uint sequence)
    {
        liar.Claim(place, ExternalEvent.SetVelocity(Now, liar.Peer, sequence, First, V(0, 9)));
        AssertGoesOn(accepted: 0, refused: 1);
    }

    [Fact]
    public void Claim_GapBefore_WaitsForWhatIsMissing()
    {
        ExternalEvent[] events = Enumerable.Range(1, 3).Select(n => ExternalEvent.SetVelocity(Now, liar.Peer, (uint)n, First, V(0, n))).ToArray();
        liar.Claim(3, events[2]);
        liar.Claim(2, events[1]);
        Assert.Equal(0u, group.Host.LogLength);
        liar.Claim(1, events[0]);
        Assert.Equal(events, group.Accepted);
        AssertGoesOn(accepted: 3, refused: 0);
    }

    [Theory]
    [InlineData(4096u, 0)]
    [InlineData(4097u, 1)]
    [InlineData(uint.MaxValue, 1)]
    public void Claim_FurtherAheadThanMayBeUnderWay_IsNotKeptButCounted(uint place, int counted)
    {
        long ignored = group.Host.Counters.DatagramsIgnored;
        liar.Claim(place, ExternalEvent.SetVelocity(Now, liar.Peer, place, First, V(0, 9)));
        Assert.Equal(ignored + counted, group.Host.Counters.DatagramsIgnored);
        AssertGoesOn(accepted: 0, refused: 0);
    }

    [Fact]
    public void Claim_SameAgain_IsTakenInOnce()
    {
        ExternalEvent external = ExternalEvent.SetVelocity(Now, liar.Peer, 1, First, V(0, 5));
        liar.Claim(1, external);
        liar.Claim(1, external);
        liar.Claim(1, ExternalEvent.SetVelocity(Now, liar.Peer, 1, First, V(0, 7))); // nor something else under the same number
        AssertGoesOn(accepted: 1, refused: 0);
    }

    [Fact]
    public void Claim_WhatMayNotEnterThisWorld_IsRefused()
    {
        liar.Claim(
            1,
            ExternalEvent.Teleport(Now, liar.Peer, 1, BodyId.OfScene(4), V(0, 4)), // the scene has four
            ExternalEvent.Remove(Now, liar.Peer, 2, BodyId.FromPacked(ulong.MaxValue)),
            ExternalEvent.Teleport(Now, liar.Peer, 3, First, V(0, 2e12)), // beyond the world
            ExternalEvent.SetVelocity(Now, liar.Peer, 4, First, V(1e300)),
            ExternalEvent.Spawn(Now, liar.Peer, 5, Ball(0.1), V(0, 4)), // below what the scene promises
            ExternalEvent.Spawn(Now, liar.Peer, 6, new BodySpec(0.3, 1, 1, MotionLaw.RungeKutta4, default, ForceSet.Of(9)), V(0, 4)));
        AssertGoesOn(accepted: 0, refused: 6);
    }

    [Fact]
    public void Claim_StampOutsideTheWindow_IsRefused()
    {
        SimDuration history = LatencyCompensationWindow.DefaultHistory, little = SimDuration.FromMilliseconds(20);
        group.Run(2);
        liar.Claim(
            1,
            ExternalEvent.Teleport(Now - history, liar.Peer, 1, First, V(0, 5)), // it takes a millisecond to arrive
            ExternalEvent.SetVelocity(Now + history + little, liar.Peer, 2, First, V(0, 5)),
            ExternalEvent.Teleport(SimTime.FromTicks(-WireFormat.MaxTimeTicks), liar.Peer, 3, First, V(0, 5)),
            ExternalEvent.SetVelocity(SimTime.FromTicks(WireFormat.MaxTimeTicks), liar.Peer, 4, First, V(0, 5)));
        Assert.Equal(
            [Verdict.TooLate, Verdict.TooEarly, Verdict.TooLate, Verdict.TooEarly],
            group.Log.Values.Select(e => e.Verdict));
        AssertGoesOn(accepted: 0, refused: 4);
    }

    [Fact]
    public void Claim_StampJustInsideTheWindow_IsAccepted()
    {
        SimDuration history = LatencyCompensationWindow.DefaultHistory, little = SimDuration.FromMilliseconds(20);
        group.Run(2);
        liar.Claim(
            1,
            ExternalEvent.SetVelocity(Now - history + little, liar.Peer, 1, First, V(0, 5)),
            ExternalEvent.SetVelocity(Now + history, liar.Peer, 2, First, V(0, 5)));
        AssertGoesOn(accepted: 2, refused: 0);
    }

    [Fact]
    public void Claim_BeforeTheStart_IsRefused()
    {
        liar.Claim(1, ExternalEvent.Teleport(group.Host.World!.Simulation.Start - SimDuration.OneTick, liar.Peer, 1, First, V(0, 5)));
        AssertGoesOn(accepted: 0, refused: 1);
    }

    [Theory]
    [InlineData(double.NaN)]
    [InlineData(double.PositiveInfinity)]
    public void Claim_NotANumber_CannotBeDecoded(double value)
    {
        byte[] bytes = liar.Bytes(1, ExternalEvent.SetVelocity(Now, liar.Peer, 1, First, V(1.5)));
        int at = bytes.AsSpan().IndexOf(BitConverter.GetBytes(1.5));
        BitConverter.GetBytes(value).CopyTo(bytes, at);
        long malformed = group.Host.Counters.DatagramsMalformed;
        liar.Send(bytes);
        group.Run(0.01);
        Assert.Equal(malformed + 1, group.Host.Counters.DatagramsMalformed);
        AssertGoesOn(accepted: 0, refused: 0);
    }

    [Fact]
    public void Claim_AnothersPeerNumberOrSession_IsIgnored()
    {
        long ignored = group.Host.Counters.DatagramsIgnored;
        byte[] another = liar.Bytes(1, ExternalEvent.SetVelocity(Now, 1, 1, First, V(0, 9)));
        another[12] = 1; // the peer
        byte[] session = liar.Bytes(1, ExternalEvent.SetVelocity(Now, liar.Peer, 1, First, V(0, 9)));
        session[4] ^= 1; // the session
        liar.Send(another);
        liar.Send(session);
        group.Run(0.01);
        Assert.Equal(ignored + 2, group.Host.Counters.DatagramsIgnored);
        AssertGoesOn(accepted: 0, refused: 0);
    }

    [Fact]
    public void Claim_AcknowledgesWhatWasNeverSent_IsIgnored()
    {
        UpdateDatagram update = new() { SessionId = liar.SessionId, Peer = liar.Peer, Number = 1, EventsReceived = 1000 };
        byte[] bytes = new byte[update.EncodedLength];
        update.Encode(bytes);
        liar.Send(bytes);
        AssertGoesOn(accepted: 0, refused: 0);
    }

    [Fact]
    public void Claim_HundredsOfEventsForBodiesThatNobodySpawned_DoNothing()
    {
        for (uint i = 1; i <= 200; i++)
        {
            liar.Claim(i, ExternalEvent.SetVelocity(Now, liar.Peer, i, new BodyId(liar.Peer, 1_000_000 + i, 0), V(0, 5)));
        }

        AssertGoesOn(accepted: 200, refused: 0);
    }

    /// <summary>The host counted that, the honest peers agree with each other and with a world of what was accepted, and what they do still works.</summary>
    private void AssertGoesOn(int accepted, int refused)
    {
        Assert.Equal((accepted, refused), (group.Host.Counters.EventsAccepted, group.Host.Counters.EventsRefused));
        group.Do(0, PlayerAction.Impulse(Second, V(1, 3)));
        group.Do(1, PlayerAction.Impulse(Third, V(-1, 3)));
        group.Do(2, PlayerAction.SetVelocity(First, V(0, 3)));
        group.Run(1);
        Assert.All(group.Sessions, s => Assert.Equal((SessionState.Running, accepted + 3), (s.State, s.Counters.EventsAccepted)));
        Assert.Equal(accepted + 3, group.Accepted.Count());
        Assert.True(group.Difference() is null, group.Difference());
    }
}
