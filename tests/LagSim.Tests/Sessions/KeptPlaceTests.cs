using System;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Sessions.Hosts;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>Who leaves in good order says whether it may come back: then its number is kept, as for one who fell silent.</summary>
public sealed class KeptPlaceTests
{
    [Theory]
    [InlineData(true)]
    [InlineData(false)] // the control: it gives up who it was
    public void Leave_WithThePlaceKept_ComesBackAsWhoItWas(bool keepsPlace)
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5)).Connect();
        ClientSession before = group.Client(1);
        PlayerPass pass = before.Pass!.Value;
        group.Do(1, PlayerAction.Impulse(First, V(0, 1)));
        group.Run(0.5);
        before.KeepsPlace = keepsPlace;
        before.Leave();
        group.Run(0.2);
        Assert.Equal((0, SessionEnd.Left), (group.Host.ClientCount, before.EndedBy));
        Assert.Single(group.Host.Roster); // gone for the others either way

        ClientSession stranger = Running(group, 7, default);
        Assert.Equal(2, stranger.Peer); // another number is free
        ClientSession after = Running(group, 8, pass);
        Assert.Equal(keepsPlace, after.Peer == 1);
        Assert.Equal(keepsPlace, after.Pass == pass);
        if (keepsPlace)
        {
            Assert.Equal(2u, after.Do(PlayerAction.Impulse(First, V(0, 1))).Sequence);
        }
    }

    /// <summary>
    /// A number that is kept counts for its machine: one that has as many as it may gets one of its own, else it could have all numbers kept for
    /// itself. Another machine, and one that may have more, gets the lowest that nobody has had.
    /// </summary>
    [Theory]
    [InlineData(1, 1)]
    [InlineData(2, 2)]
    public void Free_ForAMachineWhoseNumberIsKept_MindsHowManyItMayHave(int most, int expected)
    {
        PlayerPlaces places = new(new HostOptions { MaxClientsPerAddress = most }, SimTime.Zero);
        PeerAddress machine = PeerAddress.Virtual(7);
        places[1].Take(isSamePlayer: false, machine);
        places[1].Leave(isKept: true, 5, LeaveReason.Left, SimTime.FromSeconds(1));
        Assert.Equal(expected, places.Free(SimTime.FromSeconds(2), 0, machine));
        Assert.Equal(2, places.Free(SimTime.FromSeconds(2), 0, PeerAddress.Virtual(8)));
        Assert.Equal(2, places.Free(SimTime.FromSeconds(300), 0, machine)); // it is kept no longer
    }

    /// <summary>It did not choose to go, so it may come back.</summary>
    [Fact]
    public void Leave_ByAFailure_KeepsThePlace()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 2, LinkProfiles.PureDelay(5)).Connect();
        ClientSession before = group.Client(1);
        before.Fail(new InvalidOperationException("A test."));
        group.Run(0.2);
        Assert.Equal((0, SessionEnd.Failed), (group.Host.ClientCount, before.EndedBy));
        Assert.Equal((1, before.Pass), (Running(group, 7, before.Pass!.Value).Peer, before.Pass));
    }

    /// <summary>A seat that somebody gave up is there to be taken; any other number goes to a newcomer after those that nobody had.</summary>
    [Theory]
    [InlineData(true, 1)]
    [InlineData(false, 3)]
    public void Leave_ForGood_GivesTheSeatToTheNextButNoOtherNumber(bool isSeat, int expected)
    {
        Scene scene = new SceneBuilder("mallets").AddPlane("floor", Vector3D.Up, V(0), 0.9)
            .AddBody("own", Ball(0.3), V(0, 1), players: isSeat ? PeerSet.Of(1) : PeerSet.Everyone).AddBody("other", Ball(0.3), V(3, 1)).Build();
        SessionGroup group = new SessionGroup(scene, 3, LinkProfiles.PureDelay(5)).Connect();
        group.Sessions.Skip(1).Single(s => s.Peer == 1).Leave();
        group.Run(0.2);
        Assert.Equal(expected, Running(group, 7, default).Peer);
    }

    [Fact]
    public void Leave_OfAll_GivesTheNumberThatWasGivenUpFirst()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 1, LinkProfiles.PureDelay(5)).Connect();
        ClientSession[] all = [.. Enumerable.Range(0, SessionOptions.MaxClients).Select(n => Running(group, 20 + n, default))];
        Assert.Equal(Enumerable.Range(1, SessionOptions.MaxClients), all.Select(s => (int)s.Peer));
        foreach (int number in new[] { 5, 2 })
        {
            all[number - 1].Leave();
            group.Run(0.2);
        }

        Assert.Equal([5, 2], new[] { 60, 61 }.Select(node => (int)Running(group, node, default).Peer));
    }

    private static ClientSession Running(SessionGroup group, int node, PlayerPass pass)
    {
        ClientSession session = group.Join(node, (ulong)node, new ClientOptions { Pass = pass });
        Assert.True(group.RunUntil(() => session.State == SessionState.Running, 2), session.WhyNotRunning);
        return session;
    }
}
