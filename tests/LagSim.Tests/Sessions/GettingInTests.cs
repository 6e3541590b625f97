using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>What who asks to be let in can have of a host: no more than it asks for honestly, and nothing of another's.</summary>
public sealed class GettingInTests
{
    [Fact]
    public void SessionId_OfAClient_TellsNothingOfAnothers()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 1, LinkProfiles.PureDelay(1)).Connect();
        ulong[] ids = Enumerable.Range(100, SessionOptions.MaxClients).Select(address => new RawClient(group, address).SessionId).ToArray();
        Assert.Equal(SessionOptions.MaxClients, ids.Distinct().Count());
        Assert.DoesNotContain(ids, id => ids.Any(other => id != other && (id ^ other) <= uint.MaxValue));

        // Who says goodbye in another's name has to know his id.
        byte[] bytes = new byte[WireFormat.LeaveBytes];
        IDatagramPort spoofed = group.Network.CreatePort(99);
        new LeaveDatagram(ids[0] + 1, 1, LeaveReason.Left).Encode(bytes);
        spoofed.Send(bytes, PeerAddress.Virtual(0));
        group.Run(0.1);
        Assert.Equal(SessionOptions.MaxClients, group.Host.ClientCount);
    }

    [Fact]
    public void SnapshotRequest_AgainAndAgain_GetsTheCopyAFewTimesAndNoMore()
    {
        SessionGroup group = new SessionGroup(BuiltInScenes.Crowd(400), 2, LinkProfiles.PureDelay(5)).Connect();
        RawClient greedy = new(group, sits: false);
        long most = (8 * ((greedy.CopyLength / SnapshotChunkDatagram.MaxData) + SnapshotRequestDatagram.MaxChunks)) + 64;
        byte[] bytes = new byte[WireFormat.SnapshotRequestBytes];
        long got = 0;
        for (uint second = 0; second < 8; second++)
        {
            long inThisSecond = 0;
            for (uint n = 1; n <= 100; n++)
            {
                new SnapshotRequestDatagram(greedy.SessionId, 0, (second * 100) + n, 0, ulong.MaxValue).Encode(bytes);
                greedy.Send(bytes);
                group.Run(0.01);
                inThisSecond += greedy.Received().Count(d => d.Type == DatagramType.SnapshotChunk);
            }

            Assert.InRange(inThisSecond, 0, 2000 + (4 * SnapshotRequestDatagram.MaxChunks)); // of the 6,400 it asked for
            got += inThisSecond;
        }

        Assert.InRange(got, SnapshotRequestDatagram.MaxChunks, most);
    }

    [Fact]
    public void Join_ManyTimesFromOneAddress_TakesNobodysPlace()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 1, LinkProfiles.PureDelay(1)).Connect();
        RawClient restless = new(group);
        DatagramType?[] answers = Enumerable.Range(0, 1200).Select(n => restless.Ask((ulong)n + 1)).ToArray();
        Assert.All(answers, answer => Assert.Equal(DatagramType.Welcome, answer));
        Assert.Equal(0, group.Host.ClientCount);
        ClientSession honest = group.Join(7, 99);
        Assert.True(group.RunUntil(() => honest.State == SessionState.Running, 2));
    }

    [Fact]
    public void Join_HalfOpenOnesOfAThousandAddresses_IsLetInAtOnce()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 1, LinkProfiles.PureDelay(1)).Connect();
        RawClient[] halfOpen = Enumerable.Range(1000, 1000).Select(address => new RawClient(group, address, sits: false)).ToArray();
        Assert.Equal((1000, 0), (halfOpen.Select(s => s.SessionId).Distinct().Count(), group.Host.ClientCount));
        for (int i = 0; i < 20; i++)
        {
            ClientSession honest = group.Join(7 + i, 99 + (ulong)i);
            Assert.True(group.RunUntil(() => honest.State == SessionState.Running, 2), $"{i}");
            honest.Leave();
            group.Run(0.1);
            group.DropLast();
        }
    }

    [Fact]
    public void Join_WhereSilentOnesHaveAllPlaces_IsLetInOnceTheyAreGivenUp()
    {
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 1, LinkProfiles.PureDelay(1)).Connect();
        RawClient[] silent = Enumerable.Range(100, SessionOptions.MaxClients).Select(address => new RawClient(group, address)).ToArray();
        Assert.Equal(SessionOptions.MaxClients, silent.Select(s => s.Peer).Distinct().Count());
        ClientSession early = group.Join(7, 99);
        Assert.True(group.RunUntil(() => early.State == SessionState.Ended, 1));
        Assert.Equal("The host refused: the session is full.", early.EndReason);
        group.DropLast();
        group.Run(11); // their numbers are kept for them, but not from who needs one
        ClientSession later = group.Join(8, 98);
        Assert.True(group.RunUntil(() => later.State == SessionState.Running, 1));
    }

    [Fact]
    public void Events_OfOneWhoComesAgain_AreNotMoreThanAllowed()
    {
        SessionGroup group = new SessionGroup(
            ScriptedActions.Box(), 1, LinkProfiles.PureDelay(1), options: _ => new HostOptions { MaxEventsPerSecond = 10 }).Connect();
        RawClient client = new(group);
        SimTime began = group.Clock.Now;
        for (ulong n = 1; n <= 10; n++)
        {
            client.Claim(
                client.LastSequence + 1,
                Enumerable.Range(1, 10).Select(k => ExternalEvent.Impulse(group.Host.SharedTime.Now, client.Peer, client.LastSequence + (uint)k, First, V(0.01))).ToArray());
            client.Leave();
            client.Join(n);
        }

        double seconds = (group.Clock.Now - began).ToSeconds();
        Assert.True(seconds < 2);
        Assert.InRange(group.Host.Counters.EventsAccepted, 10, 10 + (10 * seconds));
    }

    [Fact]
    public void PlayerKey_GivesItsNumberToNobodyElseAndTakesItOver()
    {
        Dictionary<byte, string> keys = new() { [1] = "alice", [3] = "carol" };
        Scene scene = new SceneBuilder("own").AddPlane("floor", Vector3D.Up, V(0)).AddBody("hers", Ball(), V(0, 2), default, PeerSet.Of(3)).Build();
        SessionGroup group = new SessionGroup(scene, 1, LinkProfiles.PureDelay(1), options: _ => new HostOptions { PlayerKeys = keys }).Connect();
        Session stranger = Run(10, ""), carol = Run(11, "carol"), alice = Run(12, "alice"), other = Run(13, "");
        Assert.Equal((2, 3, 1, 4), (stranger.Peer, carol.Peer, alice.Peer, other.Peer));
        carol.Do(PlayerAction.Impulse(First, V(0, 1)));
        Assert.Throws<SceneException>(() => stranger.Do(PlayerAction.Impulse(First, V(0, 1))));

        // Her old program is still there when she comes from elsewhere, and an unknown key is none.
        Session again = Run(14, "carol");
        group.Run(0.1);
        Assert.Equal((3, SessionState.Running), (again.Peer, again.State));
        Assert.Equal("This player came in from elsewhere; the host let this peer go.", carol.EndReason);
        ClientSession nobody = group.Join(15, 15, new ClientOptions { ConnectKey = "dave" });
        Assert.True(group.RunUntil(() => nobody.State == SessionState.Ended, 1));
        Assert.Equal("The host refused: the key is wrong.", nobody.EndReason);

        Session Run(int address, string key)
        {
            ClientSession session = group.Join(address, (ulong)address, new ClientOptions { ConnectKey = key });
            Assert.True(group.RunUntil(() => session.State == SessionState.Running, 5));
            return session;
        }
    }

    [Theory]
    [InlineData(17, "x")]
    [InlineData(0, "x")]
    [InlineData(1, "")]
    [InlineData(1, "the connect key")]
    public void PlayerKeys_ThatCannotBe_AreRefused(byte number, string key)
    {
        using IDatagramPort port = new VirtualNetwork(new VirtualClock(), 1).CreatePort(0);
        HostOptions options = new() { ConnectKey = "the connect key", PlayerKeys = new Dictionary<byte, string> { [number] = key } };
        ArgumentException refused = Assert.ThrowsAny<ArgumentException>(() => new HostSession(ScriptedActions.Box(), port, new VirtualClock(), options, 1));
        Assert.Equal("PlayerKeys", refused.ParamName);
    }

    /// <summary>A machine so slow that much time passes between two looks at its clock while it makes the copy.</summary>
    [Theory]
    [InlineData(1, 0.001)]
    [InlineData(1, 0.1)]
    [InlineData(0.05, 0.1)]
    public void Join_HostWhoseClockRunsOnWhileItAnswers_GetsAllThatWasAccepted(double history, double perReading)
    {
        bool sawScene = false, sawState = false;
        for (int t = 0; t < 60; t++)
        {
            SlowClock clock = new();
            AnsweringPort port = new();
            HostOptions options = new() { ExpectedClients = 0, Window = new(SimDuration.FromSeconds(history)), StartLead = SimDuration.Zero };
            HostSession host = new(ScriptedActions.Box(), port, clock, options, 1);
            host.Step();
            clock.Time += SimDuration.OneTick;
            ExternalEvent first = host.Do(PlayerAction.Impulse(First, V(1, 1)));
            for (int i = 0; i < (int)(history * 100) - 1; i++)
            {
                clock.Time += SimDuration.FromSeconds(0.01);
                host.Step();
            }

            clock.PerReading = SimDuration.FromSeconds(perReading);
            clock.Time += SimDuration.FromSeconds(0.0002 * t);
            WelcomeDatagram welcome = port.Join(host);
            bool hasState = welcome.CopyLength != SessionSnapshot.Encode(host.Scene!, null).Length;
            Assert.True(hasState || welcome.LogIndex == 0, $"{first} is neither in the copy nor in what follows of the log");
            (sawScene, sawState) = (sawScene || !hasState, sawState || hasState);
        }

        Assert.True(sawState || sawScene);
    }

    [Fact]
    public void Join_CookieThatWasOfNoUseForLong_IsUsedAgainOnceTheHostGivesItAgain()
    {
        // Every join is lost for so long that the cookie is asked for anew; in its half minute the host gives the same one.
        SessionGroup group = new SessionGroup(ScriptedActions.Box(), 1, LinkProfiles.PureDelay(1)).Connect();
        group.Run(30.001 - (group.Clock.Now.ToSeconds() % 30)); // a half minute begins
        bool isLost = true;
        group.Network.Lose((from, _, datagram) => isLost && from == 7 && datagram.Span[3] == (byte)DatagramType.Join);
        ClientSession client = group.Join(7, 99, new ClientOptions { Timeout = SimDuration.FromSeconds(60) });
        group.Run(20.5);
        Assert.Equal(SessionState.Joining, client.State);
        isLost = false;
        Assert.True(group.RunUntil(() => client.State == SessionState.Running, 1), client.EndReason);
    }

    [Fact]
    public void Join_HostUpTooLong_IsAnErrorAndEndsWithASentence()
    {
        using IDatagramPort port = new VirtualNetwork(new VirtualClock(), 1).CreatePort(0);
        Assert.Contains("The clock reads 2000001 s; a session takes one that reads less than 2000000 s", Assert.Throws<ArgumentException>(
            () => new HostSession(ScriptedActions.Box(), port, new VirtualClock(SimTime.FromSeconds(2_000_001)), new HostOptions(), 1)).Message, StringComparison.Ordinal);

        VirtualClock clock = new(SimTime.FromSeconds(1_999_999));
        HostSession host = new(ScriptedActions.Box(), port, clock, new HostOptions { ExpectedClients = 0 }, 1);
        host.Step();
        Assert.NotEqual(SessionState.Ended, host.State);
        clock.Now += SimDuration.FromSeconds(2);
        host.Step();
        Assert.Equal((SessionState.Ended, "The session has lasted 2000000 s, the longest there is; host a new one."), (host.State, host.EndReason));
    }

    [Fact]
    public void Copy_OfATimeThatCannotTravel_IsRefusedWithASentence()
    {
        byte[] scene = SceneFormat.Encode(ScriptedActions.Box());
        foreach ((long start, long time, bool isGood) in new[] { (-(3L << 61), 3L << 61, false), (-(3L << 61), 10L << 40, false), (5L << 40, 10L << 40, true) })
        {
            byte[] state = SnapshotFormat.Encode(new WorldSnapshot(SimTime.FromTicks(start), SimTime.FromTicks(time), 0, []));
            byte[] copy = [.. BitConverter.GetBytes((uint)scene.Length), .. scene, .. state];
            Assert.Equal(isGood, SessionSnapshot.TryDecode(copy, default, null, out _, out string? error));
            Assert.Equal(!isGood, error?.Contains("within 48 days of the origin", StringComparison.Ordinal) ?? false);
        }
    }

    private sealed class SlowClock : IClock
    {
        internal SimTime Time { get; set; } = SimTime.FromSeconds(10);

        internal SimDuration PerReading { get; set; }

        public SimTime Now => Time += PerReading;
    }

    /// <summary>A port at which one client asks to connect and joins.</summary>
    private sealed class AnsweringPort : IDatagramPort
    {
        private readonly Queue<byte[]> waiting = [];
        private readonly List<byte[]> sent = [];

        public event Action? Arrived
        {
            add { }
            remove { }
        }

        public PeerAddress LocalAddress => PeerAddress.Virtual(0);

        public void Send(ReadOnlySpan<byte> datagram, PeerAddress to) => sent.Add(datagram.ToArray());

        public bool TryReceive(Span<byte> buffer, out int length, out PeerAddress from)
        {
            from = PeerAddress.Virtual(9);
            length = waiting.TryDequeue(out byte[]? datagram) ? datagram.Length : 0;
            datagram?.CopyTo(buffer);
            return length > 0;
        }

        public void Dispose()
        {
        }

        internal WelcomeDatagram Join(HostSession host)
        {
            byte[] bytes = new byte[WireFormat.ConnectRequestBytes];
            new ConnectRequestDatagram(1).Encode(bytes);
            waiting.Enqueue(bytes);
            host.Step();
            ChallengeDatagram challenge = default;
            Assert.Contains(sent, d => ChallengeDatagram.TryDecode(d, out challenge, out _));
            bytes = new byte[WireFormat.JoinBytes];
            new JoinDatagram(1, challenge.Cookie, JoinCookies.Prove("", 1, challenge.Cookie), 0, (uint)Simulation.FoldVersion).Encode(bytes);
            waiting.Enqueue(bytes);
            host.Step();
            WelcomeDatagram welcome = default;
            Assert.Contains(sent, d => WelcomeDatagram.TryDecode(d, out welcome, out _));
            return welcome;
        }
    }
}
