using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Testing.Links;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>Who asks to be let in may be somebody else, or nobody: what that costs the host, its clients, and whoever really is at that address.</summary>
public sealed class StrangerTests
{
    private readonly SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5)).Connect();
    private readonly RawClient stranger;

    public StrangerTests() => stranger = new RawClient(group);

    [Fact]
    public void Join_SameNonceAgain_IsTheSameClient()
    {
        RawClient stranger = new(group, 60, sits: false);
        ulong session = stranger.SessionId;
        stranger.AskFor(4711);
        Assert.Equal((session, 2), (stranger.SessionId, group.Host.ClientCount)); // the stranger of all tests is in; this one is not yet
        stranger.Sit();
        (byte, ulong) first = (stranger.Peer, session);
        Assert.Equal((first, 3), ((stranger.Peer, stranger.SessionId), group.Host.ClientCount));

        // And it goes on where it was: what it did already is not taken in twice.
        ExternalEvent external = ExternalEvent.SetVelocity(group.Host.SharedTime.Now, stranger.Peer, 1, First, V(0, 5));
        stranger.Claim(1, external);
        stranger.Received();
        Assert.Null(stranger.Ask(4711)); // it has what a welcome would tell
        stranger.Claim(1, external);
        Assert.Equal((first, 3), ((stranger.Peer, stranger.SessionId), group.Host.ClientCount));
        Assert.Equal([external], group.Accepted);
    }

    [Fact]
    public void Join_WithoutTheCookie_GetsNoAnswerAndPutsNobodyOut()
    {
        // Somebody who only gives that address cannot have what was sent there.
        stranger.Claim(1);
        stranger.Received();
        long ignored = group.Host.Counters.DatagramsIgnored;
        byte[] bytes = new byte[WireFormat.JoinBytes];
        new JoinDatagram(1, default, stranger.Prove(1), group.Scene.Hash, (uint)Simulation.FoldVersion).Encode(bytes);
        stranger.Send(bytes);
        group.Run(0.05);
        Assert.DoesNotContain(stranger.Received(), d => d.Type is DatagramType.Welcome or DatagramType.Refusal);
        Assert.Equal(ignored + 1, group.Host.Counters.DatagramsIgnored);
        stranger.Claim(1, ExternalEvent.SetVelocity(group.Host.SharedTime.Now, stranger.Peer, 1, First, V(0, 5)));
        Assert.Equal((1, 2), (group.Host.Counters.EventsAccepted, group.Host.ClientCount));
    }

    [Fact]
    public void Join_CookieOfAnotherAddressOrTooOld_GetsNoAnswer()
    {
        RawClient another = new(group, 70);
        Token128 cookie = another.Cookie(5);
        Assert.Null(Answer(stranger, 5, cookie)); // another address
        Assert.Null(Answer(another, 6, cookie)); // another nonce
        Assert.Equal(DatagramType.Welcome, Answer(another, 5, cookie));
        cookie = another.Cookie(7);
        group.Run(70);
        Assert.Null(Answer(another, 7, cookie));

        DatagramType? Answer(RawClient client, ulong nonce, Token128 given)
        {
            client.Received();
            byte[] bytes = new byte[WireFormat.JoinBytes];
            new JoinDatagram(nonce, given, JoinCookies.Prove("", nonce, given), group.Scene.Hash, (uint)Simulation.FoldVersion).Encode(bytes);
            client.Send(bytes);
            group.Run(0.01);
            return client.Received() is var all && all.Find(d => d.Type is DatagramType.Welcome or DatagramType.Refusal) is { Length: > 0 } found ? found.Type : null;
        }
    }

    [Fact]
    public void Join_PlayedAgainAfterItsClientLeft_LetsNobodyIn()
    {
        stranger.Leave();
        Assert.Equal(1, group.Host.ClientCount);
        stranger.Received();
        ulong former = stranger.SessionId;
        stranger.AskFor(4711); // the cookie is still good: it is welcome, and takes nobody's place unless it goes on as one who hears the answers
        Assert.NotEqual(former, stranger.SessionId);
        group.Run(6);
        Assert.Equal(1, group.Host.ClientCount);
    }

    [Fact]
    public void ConnectRequest_OfWhoever_IsAnsweredWithNoMoreBytesThanItHasAndLeavesNoTrace()
    {
        _ = stranger.Cookie(1);
        Assert.True(WireFormat.ChallengeBytes <= WireFormat.ConnectRequestBytes && WireFormat.RefusalBytes <= WireFormat.ConnectRequestBytes);
        Assert.Equal(2, group.Host.ClientCount);
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Join_AnotherNonceFromTheSameAddress_TakesItsPlace(bool hadWritten)
    {
        if (hadWritten)
        {
            stranger.Claim(1);
            group.Run(3);
        }

        byte[] former = stranger.Bytes(1, ExternalEvent.SetVelocity(group.Host.SharedTime.Now, stranger.Peer, 1, First, V(0, 9)));
        stranger.Join(1);
        Assert.Equal(2, group.Host.ClientCount);

        // What the former one still had on its way is not taken for the new one's.
        long ignored = group.Host.Counters.DatagramsIgnored;
        stranger.Send(former);
        group.Run(0.01);
        Assert.Equal((ignored + 1, 0), (group.Host.Counters.DatagramsIgnored, group.Host.Counters.EventsAccepted));
        ExternalEvent external = ExternalEvent.SetVelocity(group.Host.SharedTime.Now, stranger.Peer, 1, First, V(0, 5));
        stranger.Claim(1, external);
        Assert.Equal([external], group.Accepted);
    }

    [Fact]
    public void Join_AddressThatNeverWrites_GetsOneSmallAnswerEachTimeAndAGoodbye()
    {
        const int joins = 50;
        RawClient stranger = new(group, 60, sits: false);
        for (int i = 0; i < joins; i++)
        {
            Assert.Equal(DatagramType.Welcome, stranger.Ask(4711));
            group.Do(0, PlayerAction.Impulse(Second, V(0.1, 1))); // an event that a client would get at once
        }

        Assert.Empty(stranger.Received());
        group.Run(30);
        Assert.Equal([(DatagramType.Leave, WireFormat.LeaveBytes)], stranger.Received());
        Assert.True(WireFormat.WelcomeBytes <= WireFormat.JoinBytes && WireFormat.RefusalBytes < WireFormat.JoinBytes);
    }

    [Fact]
    public void Updates_ToAClientThatFellSilent_EndWithItsTimeout()
    {
        stranger.Claim(1);
        group.Do(0, PlayerAction.Impulse(Second, V(0.1, 1)));
        stranger.Received();
        group.Run(30);
        List<(DatagramType Type, int Length)> received = stranger.Received();
        double most = SessionOptions.DefaultTimeout.ToSeconds() / new HostOptions().ResendInterval.ToSeconds();
        Assert.InRange(received.Count(d => d.Type == DatagramType.Update), most / 4, most + 15); // it is new, so it is sent again and again, and a few answers come besides
        Assert.Equal(DatagramType.Leave, received[^1].Type);
        Assert.Equal(1, group.Host.ClientCount);
    }
}
