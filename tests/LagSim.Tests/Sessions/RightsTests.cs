using System;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing.Links;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>Who may do what, if the scene says so: the host's verdict, and a sentence for who tries it here.</summary>
public sealed class RightsTests
{
    private readonly SessionGroup group = new SessionGroup(Scene(PeerSet.Of(0, 1)), 3, LinkProfiles.PureDelay(5)).Connect();

    [Fact]
    public void Do_WithoutTheRight_ThrowsASentenceAndSendsNothing()
    {
        byte with = 1, without = 2;
        Assert.Equal(with, Session(with).Peer);
        group.Do(Place(with), PlayerAction.SetVelocity(First, V(1)));
        SceneException touch = Assert.Throws<SceneException>(() => group.Do(Place(without), PlayerAction.SetVelocity(First, V(1))));
        Assert.Equal("Peer 2 may not touch body 'guarded'; those who may: 0, 1.", touch.Message);
        SceneException spawn = Assert.Throws<SceneException>(() => group.Do(Place(with), PlayerAction.Spawn(Ball(0.3), V(0, 8))));
        Assert.Equal("Peer 1 may not spawn bodies in scene 'rights'; those who may: 2.", spawn.Message);
        group.Do(Place(without), PlayerAction.SetVelocity(Second, V(1)));
        ExternalEvent spawned = group.Do(Place(without), PlayerAction.Spawn(Ball(0.3), V(0, 8)));
        group.Do(0, PlayerAction.SetVelocity(spawned.Body, V(1))); // what was spawned everyone may touch
        Assert.True(group.Settle(4));
        Assert.Equal((4, 0), (group.Host.Counters.EventsAccepted, group.Host.Counters.EventsRefused));
        Assert.Null(group.Difference());
    }

    [Fact]
    public void Claim_WithoutTheRight_IsRefusedByTheHost()
    {
        RawClient liar = new(group);
        Assert.Equal(3, liar.Peer);
        liar.Claim(
            1,
            ExternalEvent.SetVelocity(group.Host.SharedTime.Now, 3, 1, First, V(0, 5)),
            ExternalEvent.Spawn(group.Host.SharedTime.Now, 3, 2, Ball(0.3), V(0, 8)),
            ExternalEvent.SetVelocity(group.Host.SharedTime.Now, 3, 3, Second, V(0, 5)));
        group.Run(0.1);
        Assert.Equal([Verdict.NoRight, Verdict.NoRight, Verdict.Accepted], [group.Log[1].Verdict, group.Log[2].Verdict, group.Log[3].Verdict]);
        Assert.Null(group.Difference());
    }

    [Fact]
    public void Hash_OfRights_IsAnotherAndThatOfNoneAsItWas()
    {
        Assert.NotEqual(Scene(PeerSet.Of(0, 1)).Hash, Scene(PeerSet.Of(0)).Hash);
        Assert.NotEqual(Scene(PeerSet.Of(0, 1)).Hash, Scene(PeerSet.Everyone).Hash);
        Assert.Equal(
            new SceneBuilder("a").AddBody("b", Ball(), V(0)).Build().Hash,
            new SceneBuilder("a").WithSpawners(PeerSet.Everyone).AddBody("b", Ball(), V(0), default, PeerSet.Everyone).Build().Hash);
    }

    [Fact]
    public void PeerSet_OfNumbers_HasThose()
    {
        PeerSet some = PeerSet.Of(0, 3, 15);
        for (int peer = -1; peer < 300; peer++)
        {
            Assert.Equal(peer is 0 or 3 or 15, some.Contains(peer));
            Assert.False(PeerSet.Nobody.Contains(peer));
            Assert.Equal(peer >= 0, PeerSet.Everyone.Contains(peer));
        }

        Assert.Equal(("0, 3, 15", "nobody", "everyone"), ($"{some}", $"{PeerSet.Of()}", $"{default(PeerSet)}"));
        Assert.Equal(some, PeerSet.FromMask(some.Mask));
        Assert.Equal(PeerSet.Everyone, PeerSet.FromMask(uint.MaxValue));
        Assert.Throws<ArgumentOutOfRangeException>(() => PeerSet.Of(17));
        Assert.Throws<ArgumentOutOfRangeException>(() => PeerSet.Of(-1));
    }

    private static Scene Scene(PeerSet guards) => new SceneBuilder("rights").WithSmallestRadius(0.25).WithSpawners(PeerSet.Of(2))
        .AddPlane("floor", Vector3D.Up, V(0), 0.9)
        .AddBody("guarded", Ball(0.3), V(-2, 4), default, guards)
        .AddBody("free", Ball(0.3), V(2, 4))
        .Build();

    private int Place(byte number) => group.Sessions[1].Peer == number ? 1 : 2;

    private Session Session(byte number) => group.Sessions[Place(number)];
}
