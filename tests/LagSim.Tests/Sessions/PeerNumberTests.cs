using LagSim.Events;
using LagSim.Harness.Links;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>There are 255 numbers for joiners. One that stands in an event is never given again; any other is.</summary>
public sealed class PeerNumberTests
{
    private readonly SessionGroup group = new SessionGroup(Deeds.Box(), 2, LinkProfiles.PureDelay(5)).Connect();

    [Fact]
    public void Join_AfterHundredsWhoDidNothing_IsLetIn()
    {
        for (int i = 0; i < 300; i++)
        {
            RawJoiner joiner = new(group, 100 + i);
            joiner.Claim(1);
            joiner.Leave();
        }

        Assert.Equal(1, group.Host.JoinerCount);
    }

    [Fact]
    public void Join_AfterHundredsOfRestartsAtOneAddress_IsLetIn()
    {
        RawJoiner restless = new(group);
        for (ulong nonce = 1; nonce <= 300; nonce++)
        {
            restless.Join(nonce);
        }

        Assert.NotEqual(restless.Peer, new RawJoiner(group, 100).Peer);
        Assert.Equal(3, group.Host.JoinerCount);
    }

    [Fact]
    public void Join_AfterEveryNumberStandsInAnEvent_IsRefused()
    {
        byte last = group.Sessions[1].Peer;
        RawJoiner joiner = new(group);
        for (ulong nonce = 1; last < byte.MaxValue; nonce++)
        {
            joiner.Join(nonce);
            Assert.Equal(last + 1, joiner.Peer);
            last = joiner.Peer;
            joiner.Claim(1, ExternalEvent.SetVelocity(group.Host.SharedTime.Now, joiner.Peer, 1, First, V(0, 1)));
            joiner.Leave();
        }

        Assert.Equal(byte.MaxValue - 1, group.Host.Counters.EventsAccepted);
        Assert.Equal(DatagramType.Refusal, joiner.Ask(999));
        Assert.Equal(SessionState.Running, group.Sessions[1].State);
    }

    [Fact]
    public void Join_NumberOfOneWhoseEventWasRefused_IsNotGivenAgain()
    {
        RawJoiner liar = new(group);
        liar.Claim(1, ExternalEvent.SetVelocity(group.Host.SharedTime.Now, liar.Peer, 1, First, V(1e300)));
        Assert.Equal(Verdict.Invalid, group.Log[1].Verdict);
        liar.Leave();
        Assert.NotEqual(liar.Peer, new RawJoiner(group, 100).Peer);
    }
}
