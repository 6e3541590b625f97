using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>The seed of a match is no part of what a client expects: a host that begins the next match with another takes its clients back.</summary>
public sealed class NewSeedTests
{
    [Theory]
    [InlineData(7, 0.8, true)]
    [InlineData(8, 0.8, true)] // refused while the seed was a part of it
    [InlineData(8, 0.7, false)] // the control: another scene
    public void Restart_WithASeed_TakesFormerClientsBack(ulong seed, double restitution, bool isTaken)
    {
        SessionGroup group = new SessionGroup(Pitch(7, 0.8), 2, LinkProfiles.PureDelay(5)).Connect();
        Scene next = Pitch(seed, restitution);
        group.RestartHost(new HostOptions(), next);
        ClientSession client = group.Client(1);
        Assert.True(group.RunUntil(() => client.Counters.Renewals == 1 || client.State == SessionState.Ended));
        group.Run(2);
        Assert.Equal(isTaken ? SessionState.Running : SessionState.Ended, client.State);
        if (isTaken)
        {
            Assert.Equal((1, seed, next.Hash), (client.Peer, client.Scene!.Seed, client.Scene.Hash));
            SimTime both = SimTime.Min(group.Host.World!.Simulation.SimulatedTo, client.World!.Simulation.SimulatedTo);
            Assert.Equal(group.Host.World.Simulation.StateHash(both), client.World.Simulation.StateHash(both));
        }
        else
        {
            Assert.Equal("The host refused: it has another scene now. A session keeps its scene; start a new one to join that.", client.EndReason);
        }
    }

    [Fact]
    public void Join_WithTheSceneItExpects_TakesTheHostsSeed()
    {
        SessionGroup group = new SessionGroup(Pitch(7, 0.8), 2, LinkProfiles.PureDelay(5), scenes: peer => Pitch(peer == 0 ? 7u : 0, 0.8)).Connect();
        Assert.Equal(7u, group.Client(1).Scene!.Seed);
    }

    [Fact]
    public void Hash_ButSeed_IsThatOfTheSceneWithoutOne()
    {
        Scene none = Pitch(0, 0.8), one = Pitch(1, 0.8);
        Assert.Equal((none.Hash, none.Hash, none.Hash), (none.HashButSeed, one.HashButSeed, Pitch(2, 0.8).HashButSeed));
        Assert.NotEqual(none.Hash, one.Hash);
        Assert.NotEqual(none.HashButSeed, Pitch(0, 0.7).HashButSeed);
    }

    private static Scene Pitch(ulong seed, double restitution) =>
        new SceneBuilder("pitch").AddPlane("floor", Vector3D.Up, V(0), restitution).AddBody("ball", Ball(0.3), V(0, 1)).WithSeed(seed).Build();
}
