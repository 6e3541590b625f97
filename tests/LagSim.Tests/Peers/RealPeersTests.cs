using System.Linq;
using LagSim.Cli.Commands;
using LagSim.Events;
using LagSim.Harness.Experiments.Peers;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Peers;

/// <summary>Over real sockets and threads: that it works, not how fast.</summary>
[Trait("Time", "real")]
public sealed class RealPeersTests
{
    [Theory(Timeout = 60_000)]
    [InlineData("udp")]
    [InlineData("litenetlib")]
    public async System.Threading.Tasks.Task Run_ThreePeersOverLoopback_AgreeToTheBit(string carrier)
    {
        await System.Threading.Tasks.Task.Run(
            () =>
            {
                SimDuration length = SimDuration.FromSeconds(1.2);
                PeerGroupOptions options = new(3, LinkProfiles.PureDelay(5), Length: length) { Carrier = CarrierChoice.Of(carrier) };
                using RealPeers peers = new(BuiltInScenes.Drop(2, 0.8), options);
                peers.Connect();
                peers.RunUntil(SimDuration.FromSeconds(0.1), null);
                ExternalEvent lifted = peers.Do(1, PlayerAction.Teleport(BodyId.OfScene(0), new Vector3D(0, 3, 0)));
                ExternalEvent pushed = peers.Do(0, PlayerAction.Impulse(BodyId.OfScene(0), new Vector3D(1, 2, 0)));
                PeerGroupException refused = Assert.Throws<PeerGroupException>(() => peers.Do(1, PlayerAction.Impulse(BodyId.OfScene(0), new Vector3D(double.NaN, 0, 0))));
                Assert.Contains("Peer 1 could not", refused.Message, System.StringComparison.Ordinal);
                peers.RunQuietlyUntil(length, null);
                peers.Finish();

                Assert.True(lifted.Time > peers.Start && pushed.Sequence == 1);
                SimTime end = peers.Grid.At(peers.Grid.Count - 1);
                Assert.Single(Enumerable.Range(0, 3).Select(p => peers.Session(p).World!.Simulation.StateHash(end)).Distinct());
                Assert.Single(Enumerable.Range(0, 3).Select(p => peers.Session(p).World!.Simulation.EventHash(end)).Distinct());
                Assert.All(Enumerable.Range(0, 3), p => Assert.Equal((SessionState.Running, 2L), (peers.Session(p).State, peers.Session(p).Counters.EventsAccepted)));
                Assert.Equal(0, PeerComparison.Errors(peers.Settled, peers.Grid, 1, 0, peers.Grid.Count, null, end).Before.ToStatistics().DifferingBits);
                Assert.True(peers.Settled.All(s => s.IsShown(0) && s.IsShown(peers.Grid.Count - 1)));
                Assert.True(peers.Traffic(2).BytesSent > 0);
            },
            TestContext.Current.CancellationToken);
    }

    [Fact(Timeout = 60_000)]
    public async System.Threading.Tasks.Task Connect_ProfileWithAClockOffset_SetsTheClientsClockThatMuchFurtherAhead()
    {
        await System.Threading.Tasks.Task.Run(
            () =>
            {
                // Clock exchanges over loopback are right to half a round trip, on a busy machine some milliseconds.
                TestWorlds.Near(-1.24, Offset(LinkProfiles.SkewedClock) - Offset(LinkProfiles.Lan), 0.5);
            },
            TestContext.Current.CancellationToken);

        static double Offset(LinkProfile link)
        {
            using RealPeers peers = new(BuiltInScenes.Drop(2, 0.8), new PeerGroupOptions(2, link));
            peers.Connect();
            return peers.Session(1).SharedTime.Offset.ToSeconds();
        }
    }
}
