using System.Linq;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Testing.Links;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>There are as many numbers as clients. Who gets one that others had goes on where their events ended, so no two are ever the same.</summary>
public sealed class PeerNumberTests
{
    // With a place for one of each machine, who joins again from one gets the number that it had.
    private readonly SessionGroup group = new SessionGroup(
        ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5), options: _ => new HostOptions { MaxClientsPerAddress = 1 }).Connect();

    [Fact]
    public void Join_AfterHundredsWhoDidNothing_IsLetIn()
    {
        for (int i = 0; i < 300; i++)
        {
            RawClient client = new(group, 100 + i);
            client.Claim(1);
            client.Leave();
        }

        Assert.Equal(1, group.Host.ClientCount);
    }

    [Fact]
    public void Join_AfterHundredsOfRestartsAtOneAddress_IsLetIn()
    {
        RawClient restless = new(group);
        for (ulong nonce = 1; nonce <= 300; nonce++)
        {
            group.Run(2); // more than some thirty a minute are not let in
            restless.Join(nonce);
        }

        Assert.NotEqual(restless.Peer, new RawClient(group, 100).Peer);
        Assert.Equal(3, group.Host.ClientCount);
    }

    [Fact]
    public void Join_NumberThatStandsInEvents_GoesOnWithTheNextSequence()
    {
        RawClient client = new(group);
        for (uint n = 1; n <= 300; n++)
        {
            Assert.Equal((2, n - 1), (client.Peer, client.LastSequence));
            client.Claim(n, ExternalEvent.SetVelocity(group.Host.SharedTime.Now, client.Peer, n, First, V(0, 1)));
            client.Leave();
            group.Run(2); // more than some thirty a minute are not let in
            client.Join(n);
        }

        Assert.Equal(300, group.Host.Counters.EventsAccepted);
        Assert.Equal(300, group.Accepted.Select(e => (e.Peer, e.Sequence)).Distinct().Count());
        Assert.Equal(SessionState.Running, group.Sessions[1].State);
    }

    [Fact]
    public void Join_NumberOfOneWhoseEventWasRefused_GoesOnToo()
    {
        RawClient liar = new(group);
        liar.Claim(1, ExternalEvent.SetVelocity(group.Host.SharedTime.Now, liar.Peer, 1, First, V(1e300)));
        Assert.Equal(Verdict.Invalid, group.Log[1].Verdict);
        byte number = liar.Peer;
        liar.Leave();
        liar.Join(2);
        Assert.Equal((number, 1u), (liar.Peer, liar.LastSequence));
    }
}
