using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>Every peer knows who is in, whatever is lost; names of the gone do not stay; spectators take nobody's place and do nothing.</summary>
public sealed class RosterTests
{
    private static readonly SimDuration Timeout = SimDuration.FromSeconds(4);

    [Fact]
    public void Roster_OfThree_IsTheSameOnEveryPeer()
    {
        SessionGroup group = Named(LinkProfiles.PureDelay(30), "Hedy", "Ann", "Zoë");
        group.Run(1);
        Assert.Equal("0 player Hedy, 1 player Ann, 2 player Zoë", Text(group.Host));
        AssertSame(group);
    }

    [Theory]
    [InlineData(5)]
    [InlineData(50)]
    [InlineData(90)]
    public void Roster_WhateverIsLost_ReachesEveryPeer(double lossPercent)
    {
        // Only what carries the roster is lost: a session itself would end with so much.
        Random luck = new(7);
        int lost = 0;
        SessionGroup group = Named(
            LinkProfiles.PureDelay(20),
            datagram =>
            {
                bool isLost = (DatagramType)datagram.Span[3] is DatagramType.Roster or DatagramType.RosterReceived
                    && luck.NextDouble() * 100 < lossPercent;
                lost += isLost ? 1 : 0;
                return isLost;
            },
            "Hedy", "Ann", "Bob", "Cleo");
        group.Join(10, 99, new ClientOptions { Name = "late", Role = PeerRole.Spectator });
        Assert.True(group.RunUntil(() => group.Sessions.All(s => s.Roster.Count == 5), 120));
        group.Client(1).Leave();
        Assert.True(group.RunUntil(() => group.Sessions.Where(s => s.State != SessionState.Ended).All(s => s.Roster.Count == 4), 120));
        Assert.Equal("0 player Hedy, 2 player Bob, 3 player Cleo, 17 spectator late", Text(group.Client(2)));
        AssertSame(group);
        Assert.True(lost > 0, "nothing was lost");
    }

    [Fact]
    public void Roster_WhenNothingOfItArrives_StaysEmpty() // the control: it has no other way
    {
        SessionGroup group = Named(LinkProfiles.PureDelay(5), datagram => (DatagramType)datagram.Span[3] == DatagramType.Roster, "Hedy", "Ann");
        group.Run(10);
        Assert.Empty(group.Client(1).Roster);
        Assert.Equal(2, group.Host.Roster.Count);
    }

    [Fact]
    public void Roster_OfAllPlaces_TakesSeveralDatagramsAndIsWhole()
    {
        string name = new('ä', SessionOptions.MaxNameBytes / 2);
        SessionGroup group = new(ScriptedActions.Box(), 1, LinkProfiles.PureDelay(5), options: _ => Host(name));
        group.Connect();
        int count = SessionOptions.MaxClients + SessionOptions.MaxSpectators;
        for (int n = 1; n <= count; n++)
        {
            PeerRole role = n <= SessionOptions.MaxClients ? PeerRole.Bot : PeerRole.Spectator;
            group.Join(n, (ulong)(1000 + n), new ClientOptions { Name = name, Role = role, Timeout = Timeout });
        }

        Assert.True(group.RunUntil(() => group.Sessions.All(s => s.Roster.Count == count + 1), 60));
        Assert.Equal(Enumerable.Range(0, count + 1), group.Client(40).Roster.Select(m => (int)m.Number));
        Assert.All(group.Client(40).Roster, m => Assert.Equal(name, m.Name));
        AssertSame(group);
        Assert.Equal(SessionState.Ended, EndOf(group, 60, PeerRole.Player));
        Assert.Equal(SessionState.Ended, EndOf(group, 61, PeerRole.Spectator));
    }

    [Fact]
    public void RosterChanged_OfThoseWhoComeAndGo_TellsEachOnce()
    {
        SessionGroup group = Named(LinkProfiles.PureDelay(10), "Hedy");
        List<string>[] told = [[], []];
        ClientSession ann = group.Join(1, 101, new ClientOptions { Name = "Ann", Timeout = Timeout });
        Tell(group.Host, told[0]);
        Tell(ann, told[1]);
        group.Run(1);
        ClientSession bob = group.Join(2, 102, new ClientOptions { Name = "Bob", Timeout = Timeout });
        group.Run(1);
        bob.Leave();
        group.Run(1);
        Assert.Equal(["Came: 1 player Ann", "Came: 2 player Bob", "Gone: 2 player Bob"], told[0]);
        Assert.Equal(["Came: 0 player Hedy", "Came: 1 player Ann", "Came: 2 player Bob", "Gone: 2 player Bob"], told[1]);

        static void Tell(Session session, List<string> told) => session.RosterChanged += change =>
        {
            told.Add($"{change.Kind}: {change.Member}");
            Assert.Equal(change.Kind != RosterChangeKind.Gone, session.Roster.Contains(change.Member)); // it shows it already
        };
    }

    [Fact]
    public void Roster_OfOneWhoIsCutOff_TellsTheSilenceAndThenThatItIsGone()
    {
        SessionGroup group = Named(LinkProfiles.PureDelay(10), "Hedy", "Ann", "Bob");
        group.Run(1);
        List<string> told = [];
        group.Client(1).RosterChanged += change => told.Add($"{change}, {(change.Member.SilentSince is null ? "heard" : "silent")}");
        SimTime cut = group.Host.SharedTime.Now;
        group.Cut(2, 0);
        group.Cut(0, 2);
        Assert.True(group.RunUntil(() => told.Count == 1, 5));
        SimTime since = Assert.NotNull(group.Client(1).Roster.Single(m => m.Name == "Bob").SilentSince);
        Assert.InRange((since - cut).ToSeconds(), -2, 0.1);
        Assert.True(group.RunUntil(() => group.Client(2).Roster.Single(m => m.Name == "Hedy").SilentSince is not null, 2)); // by whom is cut off
        group.Restore(2, 0);
        group.Restore(0, 2);
        Assert.True(group.RunUntil(() => told.Count == 2, 5));
        group.Cut(2, 0);
        Assert.True(group.RunUntil(() => told.Count == 4, 10));
        Assert.Equal(
            ["changed: 2 player Bob, silent", "changed: 2 player Bob, heard", "changed: 2 player Bob, silent", "gone: 2 player Bob, silent"], told);
        Assert.Equal(2, group.Host.Roster.Count);
    }

    [Fact]
    public void Roster_OfOneWhoComesBackByPass_HasHimAsHeWas()
    {
        SessionGroup group = Named(LinkProfiles.PureDelay(10), "Hedy", "Ann", "Bob");
        group.Run(1);
        List<string> told = [];
        group.Client(1).RosterChanged += change => told.Add($"{change}");
        PlayerPass pass = group.Client(2).Pass!.Value;
        group.Cut(2, 0); // killed: it says no goodbye
        ClientSession again = group.Join(7, 77, new ClientOptions { Name = "Bob", Pass = pass, Timeout = Timeout });
        Assert.True(group.RunUntil(() => again.State == SessionState.Running));
        group.Run(1);
        Assert.Equal(2, again.Peer);
        Assert.Equal("0 player Hedy, 1 player Ann, 2 player Bob", Text(group.Client(1)));
        Assert.Empty(told);
    }

    [Fact]
    public void Roster_WhenANumberPassesToAnother_TellsThatOneIsGoneAndAnotherCame()
    {
        Scene seats = new SceneBuilder("seats").AddPlane("floor", Vector3D.Up, V(0)).AddBody("Bob's", Ball(), V(0, 2), players: PeerSet.Of(2)).Build();
        SessionGroup group = Named(LinkProfiles.PureDelay(100), static _ => false, seats, "Hedy", "Ann", "Bob");
        group.Run(1);
        List<string> told = [];
        group.Client(1).RosterChanged += change => told.Add($"{change}");
        group.Client(2).Leave(); // of a seat, which the next one takes
        group.Join(9, 90, new ClientOptions { Name = "Bob", Timeout = Timeout });
        group.Run(5);
        Assert.Equal(["gone: 2 player Bob", "came: 2 player Bob"], told);
    }

    [Fact]
    public void Spectator_TakesNoPlayersPlace_AndIsNotWaitedFor()
    {
        SessionGroup group = new(ScriptedActions.Box(), 1, LinkProfiles.PureDelay(5), options: _ => Host(""), expected: 1);
        ClientSession watcher = group.Join(1, 11, new ClientOptions { Role = PeerRole.Spectator });
        group.Run(3);
        Assert.Equal((byte)17, watcher.Peer);
        Assert.Equal(SessionState.Waiting, watcher.State);
        ClientSession player = group.Join(2, 12);
        Assert.True(group.RunUntil(() => watcher.State == SessionState.Running && player.State == SessionState.Running));
        Assert.Equal((byte)1, player.Peer);
        Assert.Equal(2, group.Host.ClientCount);
        group.Do(2, PlayerAction.Impulse(First, V(0, 1)));
        Assert.True(group.Settle(1));
        Assert.Null(group.Difference());
    }

    [Fact]
    public void Spectator_Do_IsRefusedAtOnce_AndByTheHost()
    {
        SessionGroup group = Named(LinkProfiles.PureDelay(5), "Hedy", "Ann");
        ClientSession watcher = group.Join(2, 12, new ClientOptions { Role = PeerRole.Spectator });
        Assert.True(group.RunUntil(() => watcher.State == SessionState.Running));
        SceneException refused = Assert.Throws<SceneException>(() => watcher.Do(PlayerAction.Impulse(First, V(0, 1))));
        Assert.Contains("spectator", refused.Message, StringComparison.Ordinal);
        Assert.Equal(0u, watcher.LogLength);

        RawClient liar = new(group, role: 2);
        liar.Claim(1, ExternalEvent.SetVelocity(group.Host.SharedTime.Now, liar.Peer, 1, First, V(1)));
        Assert.Equal((Verdict.NoRight, (byte)18), (group.Log[1].Verdict, liar.Peer));
        RawClient player = new(group, 51); // the control
        player.Claim(1, ExternalEvent.SetVelocity(group.Host.SharedTime.Now, player.Peer, 1, First, V(1)));
        Assert.Equal(Verdict.Accepted, group.Log[2].Verdict);
    }

    [Fact]
    public void Spectator_WithAPlayersPass_DoesNotTakeHisPlace()
    {
        SessionGroup group = Named(LinkProfiles.PureDelay(5), "Hedy", "Ann");
        PlayerPass pass = group.Client(1).Pass!.Value;
        ClientSession watcher = group.Join(2, 12, new ClientOptions { Role = PeerRole.Spectator, Pass = pass });
        Assert.True(group.RunUntil(() => watcher.State == SessionState.Running));
        Assert.Equal(((byte)17, SessionState.Running), (watcher.Peer, group.Client(1).State));
        PlayerPass watching = watcher.Pass!.Value;
        watcher.Leave();
        group.Run(1);
        ClientSession player = group.Join(3, 13, new ClientOptions { Pass = watching });
        Assert.True(group.RunUntil(() => player.State == SessionState.Running));
        Assert.Equal((byte)2, player.Peer);
    }

    [Fact]
    public void SpectatorPlaces_None_LetsNobodyWatch()
    {
        SessionGroup group = new(ScriptedActions.Box(), 1, LinkProfiles.PureDelay(5), options: _ => Host("") with { SpectatorPlaces = 0 });
        group.Connect();
        Assert.Equal(SessionState.Ended, EndOf(group, 1, PeerRole.Spectator));
        ClientSession player = group.Join(2, 12);
        Assert.True(group.RunUntil(() => player.State == SessionState.Running));
    }

    [Fact]
    public void Sixteen_Play_AndAgree()
    {
        SessionGroup group = new(
            ScriptedActions.Box(), SessionOptions.MaxClients + 1, LinkProfiles.PureDelay(25),
            options: peer => Host($"peer{peer}"));
        group.Connect();
        int done = 0;
        for (int n = 0; n < 8; n++)
        {
            done += new ScriptedActions(n, maxSpawns: 1).DoIn(group, 2).Count;
        }

        foreach (int peer in Enumerable.Range(1, SessionOptions.MaxClients))
        {
            group.Do(peer, PlayerAction.Impulse(First, V(0.1 * peer)));
            done++;
        }

        Assert.True(group.Settle(done));
        group.Run(1);
        Assert.Null(group.Difference());
        Assert.Equal(Enumerable.Range(1, 16), group.Sessions.Skip(1).Select(s => (int)s.Peer).Order());
        AssertSame(group);
    }

    [Fact]
    public void Sixteenth_MayBeGrantedARightAlone()
    {
        Scene scene = new SceneBuilder("rights").AddPlane("floor", Vector3D.Up, V(0))
            .AddBody("his", Ball(), V(0, 2), players: PeerSet.Of(SessionOptions.MaxClients)).Build();
        SessionGroup group = new(
            scene, SessionOptions.MaxClients + 1, LinkProfiles.PureDelay(5), options: _ => Host(""));
        group.Connect();
        int his = Enumerable.Range(1, 16).Single(peer => group.Sessions[peer].Peer == 16);
        group.Do(his, PlayerAction.Impulse(BodyId.OfScene(0), V(0, 1)));
        Assert.Throws<SceneException>(() => group.Do(his == 1 ? 2 : 1, PlayerAction.Impulse(BodyId.OfScene(0), V(0, 1))));
        Assert.True(group.Settle(1));
        Assert.Equal(1, group.Host.Counters.EventsAccepted);
    }

    [Theory]
    [InlineData("a\nb", "U+000A")]
    [InlineData("012345678901234567890123456789012345678901234567890123456789ääx", "65 bytes")]
    public void Name_ThatIsNone_IsRefusedWithASentence(string name, string why)
    {
        SessionOptions options = new ClientOptions { Name = name };
        Assert.Contains(why, Assert.Throws<ArgumentException>(options.Check).Message, StringComparison.Ordinal);
        options = new HostOptions { Name = name };
        Assert.Contains(why, Assert.Throws<ArgumentException>(options.Check).Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Options_OutOfRange_AreRefused()
    {
        Assert.Throws<ArgumentException>(new ClientOptions { Name = null! }.Check);
        Assert.Contains(
            "half a surrogate pair", Assert.Throws<ArgumentException>(new ClientOptions { Name = "a\ud800" }.Check).Message, StringComparison.Ordinal);
        Assert.Throws<ArgumentException>(new ClientOptions { Name = "\ud800\ud800" }.Check);
        Assert.Throws<ArgumentOutOfRangeException>(new ClientOptions { Role = (PeerRole)4 }.Check);
        Assert.Throws<ArgumentOutOfRangeException>(new ClientOptions { Role = 0 }.Check);
        Assert.Throws<ArgumentOutOfRangeException>(new HostOptions { SpectatorPlaces = -1 }.Check);
        Assert.Throws<ArgumentOutOfRangeException>(new HostOptions { SpectatorPlaces = 33 }.Check);
        new ClientOptions { Name = new string('x', SessionOptions.MaxNameBytes), Role = PeerRole.Bot }.Check();
    }

    private static SessionState EndOf(SessionGroup group, int address, PeerRole role)
    {
        ClientSession more = group.Join(address, (ulong)(5000 + address), new ClientOptions { Role = role });
        group.RunUntil(() => more.State == SessionState.Ended, 10);
        return more.State;
    }

    private static HostOptions Host(string name) => new()
    {
        Name = name,
        Timeout = Timeout,
        MaxClientsPerAddress = SessionOptions.MaxClients,
        SpectatorPlaces = SessionOptions.MaxSpectators,
    };

    /// <summary>A host and clients, which come in one after the other.</summary>
    private static SessionGroup Named(LinkProfile link, params string[] names) => Named(link, static _ => false, names);

    private static SessionGroup Named(LinkProfile link, Func<ReadOnlyMemory<byte>, bool> isLost, params string[] names) =>
        Named(link, isLost, ScriptedActions.Box(), names);

    private static SessionGroup Named(LinkProfile link, Func<ReadOnlyMemory<byte>, bool> isLost, Scene scene, params string[] names)
    {
        SessionGroup group = new(scene, 1, link, options: _ => Host(names[0]));
        group.Network.Lose((_, _, datagram) => isLost(datagram));
        group.Connect();
        for (int peer = 1; peer < names.Length; peer++)
        {
            ClientSession client = group.Join(peer, (ulong)(100 + peer), new ClientOptions { Name = names[peer], Timeout = Timeout });
            Assert.True(group.RunUntil(() => client.State == SessionState.Running));
        }

        return group;
    }

    private static string Text(Session session) => string.Join(", ", session.Roster);

    private static void AssertSame(SessionGroup group)
    {
        foreach (Session session in group.Sessions.Where(s => s.State != SessionState.Ended))
        {
            Assert.Equal(group.Host.Roster, session.Roster);
        }
    }
}
