using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.Experiments.Peers;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Strategies;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Tests.Sessions;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Strategies;

/// <summary>Drawing the past: what it gains, and what it costs.</summary>
public sealed class InterpolationTests
{
    private static readonly BodyId Heavy = BodyId.OfScene(1);

    [Theory]
    [InlineData(-0.001)]
    [InlineData(5.001)]
    public void Delay_OutOfRange_IsRefusedByNameAndRange(double seconds)
    {
        SimDuration delay = SimDuration.FromSeconds(seconds);
        ArgumentOutOfRangeException refused = Assert.Throws<ArgumentOutOfRangeException>(() => new Interpolation(delay));
        Assert.Contains("0 s to", refused.Message, StringComparison.Ordinal);
        Assert.Throws<ArgumentOutOfRangeException>(() => LateEventStrategies.Create("interpolation", delay));

        using IDatagramPort port = new VirtualNetwork(new VirtualClock(), 1).CreatePort(0);
        refused = Assert.Throws<ArgumentOutOfRangeException>(
            () => new HostSession(ScriptedActions.Box(), port, new VirtualClock(), new HostOptions { DisplayDelay = delay }, 1));
        Assert.Equal("DisplayDelay", refused.ParamName);
        Assert.Contains("must lie between 0 s and 5 s", refused.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Create_OfEveryName_ShowsThePresentButForInterpolation()
    {
        SimDuration given = SimDuration.FromMilliseconds(250);
        foreach (string name in LateEventStrategies.Names)
        {
            ILateEventStrategy strategy = LateEventStrategies.Create(name, given);
            Assert.Equal(name, strategy.Name);
            Assert.Equal(name == "interpolation" ? given : SimDuration.Zero, strategy.DisplayDelay);
        }

        Assert.Equal(SimDuration.FromMilliseconds(100), LateEventStrategies.Create("interpolation").DisplayDelay);
    }

    [Theory]
    [InlineData("interpolation", 0.1)]
    [InlineData("interpolation", 5)]
    [InlineData("interpolation", 0)]
    [InlineData("healing", 0.1)]
    public void DisplayTime_AtAnyTime_IsCoveredByThePictureAndBehindByTheDelay(string strategy, double delay)
    {
        // The shortest history, and no more of the past than is displayed: what is shown must be kept all the same.
        SimDuration expected = strategy == "interpolation" ? SimDuration.FromSeconds(delay) : SimDuration.Zero;
        SessionGroup group = Group(strategy, delay, past: 0);
        SimTime start = group.Host.World!.Simulation.Start;
        for (int n = 0; n < 400; n++)
        {
            group.Run(0.02);
            foreach (Session session in group.Sessions)
            {
                SimTime shared = session.SharedTime.Now, shown = session.DisplayTime;
                Assert.Equal(SimTime.Max(start, shared - expected), shown); // until it can move, the world stands at its start
                Assert.True(session.World!.RenderSnapshots.Latest().Covers(shown), $"{(shared - start).ToSeconds()} s");
                Assert.Equal(expected, session.DisplayDelay);
            }
        }
    }

    [Fact]
    public void Picture_WithoutTheDelay_DoesNotGoBackThatFar()
    {
        // The control: it is the strategy that makes render snapshots cover the past.
        SessionGroup group = Group("healing", 0.1, past: 0);
        group.Run(3);
        Session session = group.Host;
        Assert.False(session.World!.RenderSnapshots.Latest().Covers(session.SharedTime.Now - SimDuration.FromSeconds(0.1)));
    }

    [Fact]
    public void DisplayTime_OfOneWhoCameLater_BeginsWhereItsWorldDoes()
    {
        SessionGroup group = Group("interpolation", 2, past: 0);
        group.Run(6);
        ClientSession late = group.Join(7, 99, ClientOptions.From(Options("interpolation", 2, 0)));
        Assert.True(group.RunUntil(() => late.World is not null));
        SimTime began = late.BegunFrom!.Time;
        List<SimTime> shown = [];
        for (int n = 0; n < 300; n++)
        {
            group.Run(0.02);
            shown.Add(late.DisplayTime);
            Assert.True(late.World!.RenderSnapshots.Latest().Covers(late.DisplayTime));
        }

        Assert.Equal(shown, shown.Order());
        Assert.True(shown[0] >= began);
        Near(2, (late.SharedTime.Now - shown[^1]).ToSeconds(), 1e-6);
    }

    [Fact]
    public void Settled_OfPeersThatDrawThePast_IsTheWorldThatHadAllOnTime()
    {
        SessionGroup group = Group("interpolation", 0.3, past: 0, link: LinkProfiles.Awful, history: 5);
        int done = new ScriptedActions(4).DoIn(group, 40).Count;
        Assert.True(group.Settle(done));
        Assert.Null(group.Difference());
    }

    [Theory]
    [InlineData(0.1, 0.0)] // 80 ms are two hops; within the delay nothing is seen of them
    [InlineData(0.05, 0.5)] // the control: a delay that is too short
    [InlineData(0, 0.5)]
    public void Seen_LateEventWithinTheDelay_DiffersNowhere(double delay, double atLeast)
    {
        VirtualPeers peers = Play("interpolation", delay);
        double[] errors = Distances(peers, peers.Seen);
        Assert.True(atLeast == 0 ? errors.Max() == 0 : errors.Max() > atLeast, $"{errors.Max()}");
        Assert.Equal(0, Distances(peers, peers.Settled).Max());
    }

    [Theory]
    [InlineData("healing", 0.1, 1.0)]
    [InlineData("interpolation", 0.1, 1.1)]
    [InlineData("interpolation", 0.25, 1.25)]
    public void Seen_OfOnesOwnAction_ComesLaterByTheDelay(string strategy, double delay, double expected)
    {
        // The heavy ball flies on at 3 m/s to the left, until it is seen to fly to the right.
        VirtualPeers peers = Play(strategy, delay);
        int body = Array.IndexOf(peers.Bodies, Heavy);
        int first = Enumerable.Range(0, peers.Grid.Count).First(n => peers.Seen[2].State(n, body).Velocity.X > 0);
        Assert.InRange((peers.Grid.At(first) - peers.Start).ToSeconds(), expected, expected + 0.0051);
    }

    [Fact]
    public void Seen_AtAnyInstant_IsWhatSettledThatMuchEarlier()
    {
        VirtualPeers peers = Play("interpolation", 0.1);
        int behind = (int)(SimDuration.FromMilliseconds(100).Ticks / PeerGroupOptions.SampleInterval.Ticks);
        for (int n = behind; n < peers.Grid.Count; n++)
        {
            for (int body = 0; body < peers.Bodies.Length; body++)
            {
                SimTime shown = peers.Grid.At(n) - SimDuration.FromMilliseconds(100);
                SameBits(Read(peers.Session(0).World!.Simulation, peers.Bodies[body], shown), peers.Seen[1].State(n, body));
            }
        }

        Assert.True(Enumerable.Range(0, behind).All(n => peers.Seen[1].IsShown(n))); // the start of the scene is shown meanwhile
    }

    private static SessionGroup Group(string strategy, double delay, double past, LinkProfile? link = null, double history = 0.05) =>
        new SessionGroup(ScriptedActions.Box(), 3, link ?? LinkProfiles.Lan, options: _ => Options(strategy, delay, past, history)).Connect();

    private static HostOptions Options(string strategy, double delay, double past, double history = 0.05) => new()
    {
        Strategy = LateEventStrategies.OfName(strategy),
        DisplayDelay = SimDuration.FromSeconds(delay),
        RenderedPast = SimDuration.FromSeconds(past),
        Window = new(SimDuration.FromSeconds(history)),
    };

    /// <summary>Three peers, 40 ms a hop; a client turns a ball round after a second.</summary>
    private static VirtualPeers Play(string strategy, double delay)
    {
        PeerGroupOptions options = new(3, LinkProfiles.PureDelay(40), strategy, Length: SimDuration.FromSeconds(4)) { DisplayDelay = SimDuration.FromSeconds(delay) };
        VirtualPeers peers = new(BuiltInScenes.Pair(), options);
        peers.Connect();
        peers.RunUntil(SimDuration.FromSeconds(1), null);
        peers.Do(2, PlayerAction.SetVelocity(Heavy, new Vector3D(20, 0, 0)));
        peers.RunQuietlyUntil(SimDuration.FromSeconds(4), null);
        peers.Finish();
        return peers;
    }

    private static double[] Distances(VirtualPeers peers, IReadOnlyList<PeerSamples> samples) =>
        Enumerable.Range(0, peers.Grid.Count).Select(n => PeerComparison.Distance(samples, peers.Bodies.Length, n, out _)).ToArray();
}
