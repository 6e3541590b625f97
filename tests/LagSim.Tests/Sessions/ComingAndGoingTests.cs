using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Sessions;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>A host tells of each client that comes and goes, once, whatever the reason.</summary>
public sealed class ComingAndGoingTests
{
    [Fact]
    public void Events_ClientsThatComeLeaveFallSilentAndComeAnew_AreToldOnceEachInOrder()
    {
        SessionGroup group = new(ScriptedActions.Box(), 3, LinkProfiles.PureDelay(5), 2, _ => new HostOptions
        {
            Timeout = SimDuration.FromSeconds(3),
            KeepAlive = SimDuration.FromSeconds(0.5),
        });
        List<string> told = Listen(group.Host);
        group.Connect();
        Assert.Equal(["1 came", "2 came"], told.Order());

        told.Clear();
        group.Sessions[1].Leave();
        group.Cut(2, 0);
        group.Run(1);
        Assert.Equal([$"{group.Sessions[1].Peer} gone"], told);
        group.Run(5);
        Assert.Equal([$"{group.Sessions[1].Peer} gone", $"{group.Sessions[2].Peer} gone"], told);
        Assert.Equal(0, group.Host.ClientCount);
    }

    [Fact]
    public void Events_SameAddressUnderANewNonce_TellsThatTheFormerIsGoneFirst()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5)).Connect();
        List<string> told = Listen(group.Host);
        group.DropLast(); // it crashed, and nobody was told
        group.Join(1, 4242);
        group.Run(1);
        Assert.Equal(["1 gone", "2 came"], told); // the number is kept for the former, who may come back from elsewhere
        Assert.Equal(1, group.Host.ClientCount);
    }

    /// <summary>Routers give a port to another machine when the former one has been silent: the player who had it is still somebody.</summary>
    [Fact]
    public void Pass_OfOneWhosePortAnotherGot_GivesItsNumberBack()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5)).Connect();
        PlayerPass pass = group.Client(1).Pass!.Value;
        group.DropLast();
        ClientSession other = group.Join(1, 4242);
        group.Run(1);
        ClientSession former = group.Join(2, 77, new ClientOptions { Pass = pass });
        group.Run(1);
        Assert.Equal((2, 1), (other.Peer, former.Peer));
        Assert.Equal(2, group.Host.ClientCount);
    }

    [Fact]
    public void ClientGone_AtItsEnd_TellsAllThatWentOverTheLink()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5)).Connect();
        LinkTraffic? gone = null;
        group.Host.ClientGone += link => gone = link;
        group.Run(3);
        LinkTraffic last = group.Host.Links.Single();
        group.Sessions[1].Leave();
        group.Run(0.1);
        Assert.Equal((last.Peer, last.Address), (gone!.Peer, gone.Address));
        Assert.True(gone.BytesSent >= last.BytesSent && gone.BytesReceived >= last.BytesReceived && last.BytesSent > 0);
    }

    [Fact]
    public void Events_ConnectRequestsAndWrongKeys_AreNobodyComing()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5)).Connect();
        List<string> told = Listen(group.Host);
        ClientSession wrong = group.Join(100, 77, new ClientOptions { ConnectKey = "wrong" });
        group.Run(1);
        Assert.Equal(SessionEnd.Refused, wrong.EndedBy);
        Assert.Empty(told);
    }

    private static List<string> Listen(HostSession host)
    {
        List<string> told = [];
        host.ClientCame += link => told.Add($"{link.Peer} came");
        host.ClientGone += link => told.Add($"{link.Peer} gone");
        return told;
    }
}
