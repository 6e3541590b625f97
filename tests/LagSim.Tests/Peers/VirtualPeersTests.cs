using System.Linq;
using LagSim.Events;
using LagSim.Harness.Experiments.Peers;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Peers;

public sealed class VirtualPeersTests
{
    [Fact]
    public void Connect_LinkThatLosesEverything_FailsWithASentence()
    {
        using VirtualPeers peers = new(BuiltInScenes.Pair(), new PeerGroupOptions(2, new LinkProfile("dead", new LinkLeg(1, lossPercent: 100))));
        PeerGroupException failed = Assert.Throws<PeerGroupException>(peers.Connect);
        Assert.Equal("No answer from the host within 10 s.", failed.Message);
    }

    [Fact]
    public void RunUntil_APeerThatDropsOut_FailsWithASentence()
    {
        using VirtualPeers peers = new(BuiltInScenes.Pair(), new PeerGroupOptions(3, LinkProfiles.Lan, Length: SimDuration.FromSeconds(20)));
        peers.Connect();
        peers.Network.SetLink(2, 0, new LinkLeg(0, lossPercent: 100));
        PeerGroupException failed = Assert.Throws<PeerGroupException>(() => peers.RunUntil(SimDuration.FromSeconds(20), null));
        Assert.Equal("Peer 2 dropped out: The host heard nothing from this peer for too long.", failed.Message);
    }

    [Fact]
    public void RunUntil_AnyTime_StopsWhenTheHostsClockReadsIt()
    {
        using VirtualPeers peers = new(BuiltInScenes.Pair(), new PeerGroupOptions(3, LinkProfiles.Awful, Length: SimDuration.FromSeconds(3)));
        peers.Connect();
        peers.RunUntil(SimDuration.FromSeconds(2.5), null);
        Assert.InRange((peers.Session(0).SharedTime.Now - peers.Start).ToSeconds(), 2.5, 2.5 + 1e-6);
        peers.RunQuietlyUntil(SimDuration.FromSeconds(3), null);
        Assert.All(Enumerable.Range(0, 3), p => Assert.True(peers.Session(p).SharedTime.Now >= peers.Start + SimDuration.FromSeconds(3)));
    }

    [Fact]
    public void Seen_OfPeersWhoseClocksDiffer_IsTheSameAtTheSameSharedTime()
    {
        using VirtualPeers peers = new(BuiltInScenes.Pair(), new PeerGroupOptions(3, LinkProfiles.PureDelay(40), Length: SimDuration.FromSeconds(4)));
        peers.Connect();
        peers.RunUntil(SimDuration.FromSeconds(1), null);
        peers.Do(2, PlayerAction.Impulse(BodyId.OfScene(1), new Vector3D(1, 4, 0)));
        peers.RunQuietlyUntil(SimDuration.FromSeconds(4), null);
        peers.Finish();
        Assert.All(peers.Seen, s => Assert.True(s.IsComplete));
        int lateEvents = peers.Grid.FirstAfter(peers.Start + SimDuration.FromSeconds(1.1));
        for (int n = 0; n < peers.Grid.Count; n++)
        {
            PeerComparison.Distance(peers.Settled, 2, n, out bool settled);
            PeerComparison.Distance(peers.Seen, 2, n, out bool seen);
            Assert.False(settled);
            Assert.True(!seen || (n >= 199 && n < lateEvents), $"sample {n}");
        }

        PeerComparison.Distance(peers.Seen, 2, 202, out bool during);
        Assert.True(during); // before the event had come
    }

    [Fact]
    public void Lose_TheEventForGood_IsSeenInWhatSettles()
    {
        using VirtualPeers peers = new(BuiltInScenes.Pair(), new PeerGroupOptions(2, LinkProfiles.PureDelay(40), Length: SimDuration.FromSeconds(4)));
        peers.Connect();
        peers.RunUntil(SimDuration.FromSeconds(1), null);
        peers.Network.SetLink(1, 0, new LinkLeg(0, lossPercent: 100));
        peers.Do(1, PlayerAction.Impulse(BodyId.OfScene(1), new Vector3D(1, 4, 0)));
        peers.RunQuietlyUntil(SimDuration.FromSeconds(4), null);
        peers.Finish();
        Assert.True(PeerComparison.Distance(peers.Settled, 2, peers.Grid.Count - 1, out bool differs) > 0.1);
        Assert.True(differs);
        Assert.Equal(SessionState.Running, peers.Session(0).State);
    }

    [Fact]
    public void Connect_ProfileWithAClockOffset_SetsClientsClocksThatMuchFurtherAhead()
    {
        double[] plain = Offsets(LinkProfiles.Lan), skewed = Offsets(LinkProfiles.SkewedClock);
        Assert.Equal(plain[0], skewed[0]);
        Assert.All(new[] { 1, 2 }, peer => TestWorlds.Near(-1.24, skewed[peer] - plain[peer], 1e-3));
        Assert.All(new[] { 1, 2 }, peer => Assert.True(System.Math.Abs(plain[peer]) > 10)); // on top of what sets them apart anyway

        // How far the shared time is ahead of each peer's own clock, in seconds.
        static double[] Offsets(LinkProfile link)
        {
            using VirtualPeers peers = new(BuiltInScenes.Pair(), new PeerGroupOptions(3, link));
            peers.Connect();
            return Enumerable.Range(0, 3).Select(p => peers.Session(p).SharedTime.Offset.ToSeconds()).ToArray();
        }
    }
}
