using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Recordings;
using LagSim.Net.Sessions;
using LagSim.Net.Sessions.Hosts;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing;
using LagSim.Testing.Links;
using LagSim.Tests.Rules;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>
/// Rules hear of the players of a session: who joins, is away, returns and leaves, the same on every peer, with an identity that a person keeps.
/// In virtual time.
/// </summary>
public sealed class PlayersHeardTests
{
    private static readonly SimDuration Timeout = SimDuration.FromSeconds(2);
    private static readonly SimDuration Kept = SimDuration.FromSeconds(6);

    /// <summary>The state is a fold of all that was heard, in order; and a ball jumps by it, so that the motion hangs on it too.</summary>
    private static readonly GivenRules Hosts = new()
    {
        Player = (w, player) =>
        {
            ref GivenState state = ref w.State<GivenState>();
            state.Draw = After(state.Draw, player);
            state.Count++;
            BodyId ball = BodyId.OfScene(player.Number % 4);
            if (w.TryRead(ball, out BodyState at))
            {
                w.SetVelocity(ball, at.Velocity + V(0.1 * player.Number, (byte)player.Kind));
            }
        },
        Command = (w, _, _) => w.State<GivenState>().Height += w.State<GivenState>().Count,
    };

    [Fact]
    public void Start_ThoseWhoAreIn_JoinAtTheVeryStartWithNameAndRole()
    {
        SessionGroup group = Group(3, options: peer => peer == 0
            ? new HostOptions { Name = "Zoë", Role = PeerRole.Spectator } : new ClientOptions { Name = $"Ann{peer}", Role = peer == 1 ? PeerRole.Bot : PeerRole.Player });
        Assert.Equal(
            ["Joined of spectator 0 Zoë", $"Joined of bot {group.Client(1).Peer} Ann1", $"Joined of player {group.Client(2).Peer} Ann2"],
            Said(group).Select(p => p.ToString()).OrderBy(text => text.Contains(" 0 ", StringComparison.Ordinal) ? 0 : text.Contains("bot", StringComparison.Ordinal) ? 1 : 2));
        Assert.All(group.Accepted, e => Assert.Equal((group.Host.World!.Simulation.Start, EventKind.Player, (byte)0), (e.Time, e.Kind, e.Peer)));
        Assert.Equal(3, Said(group).Select(p => p.Identity).Distinct().Count());
        AssertHeardByAll(group);
    }

    /// <summary>The control: what a scene does not use costs nothing, not an event and not a byte of the log.</summary>
    [Fact]
    public void Scene_WhoseRulesHearNobody_LogsNothing()
    {
        foreach (Scene scene in new[] { ScriptedActions.Box(), ScriptedActions.Box().With(new GivenRules(), 1) })
        {
            SessionGroup group = new SessionGroup(scene, 3, LinkProfiles.PureDelay(5), options: _ => Usual()).Connect();
            group.Client(1).Leave();
            group.Steps.Freeze(2);
            group.Run(12);
            Assert.Equal((0u, 0), (group.Host.LogLength, group.Host.ClientCount));
        }
    }

    /// <summary>A player goes silent, is heard again, goes for a while, comes back, and goes for good; another joins later and knows it all.</summary>
    [Fact]
    public void Course_OfOnePlayer_IsHeardInOrderByAllAndByOneWhoComesLate()
    {
        SessionGroup group = Group(3);
        byte number = group.Client(1).Peer;
        PlayerPass pass = group.Client(1).Pass!.Value;
        group.Steps.Freeze(1);
        group.Run(1.5);
        group.Steps.Thaw(1);
        group.Run(1);
        group.Client(1).KeepsPlace = true;
        group.Client(1).Leave();
        group.Run(1);
        ClientSession back = Join(group, 7, pass, "Ann");
        group.Run(1);
        back.Leave();
        group.Run(0.5);
        ClientSession late = Join(group, 8);
        Assert.True(late.BegunFrom is not null);
        group.Run(1);

        PlayerEvent[] hers = [.. Said(group).Where(p => p.Number == number)];
        Assert.Equal(
            [PlayerEventKind.Joined, PlayerEventKind.Away, PlayerEventKind.Returned, PlayerEventKind.Away, PlayerEventKind.Returned, PlayerEventKind.Left], hers.Select(p => p.Kind));
        Assert.Single(hers.Select(p => p.Identity).Distinct());
        Assert.Equal(["", "", "", "", "Ann", "Ann"], hers.Select(p => p.Name)); // as it calls itself when it comes back
        Assert.Equal(4 + hers.Length - 1, Said(group).Count); // the host, the other one and the late one joined once each, and nothing else
        AssertHeardByAll(group);
    }

    /// <summary>
    /// One who is away for longer than its number is kept has left, then and not when somebody looks; its pass still says who it is when it comes.
    /// </summary>
    [Fact]
    public void Away_ForTooLong_HasLeftAtThatMoment_AndItsPassIsTheSamePerson()
    {
        SessionGroup group = Group(2);
        PlayerPass pass = group.Client(1).Pass!.Value;
        group.Client(1).KeepsPlace = true;
        group.Client(1).Leave();
        group.Run(Kept.ToSeconds() + 3);
        ExternalEvent away = group.Accepted.Single(e => e.PlayerEvent?.Kind == PlayerEventKind.Away), left = group.Accepted.Single(e => e.PlayerEvent?.Kind == PlayerEventKind.Left);
        Assert.InRange((left.Time - away.Time).ToSeconds(), Kept.ToSeconds() - 0.001, Kept.ToSeconds() + 0.05);
        ClientSession back = Join(group, 7, pass);
        Assert.Equal((1, pass.Number), (Said(group).Count(p => p.Kind == PlayerEventKind.Left), back.Peer));
        Assert.Equal((PlayerEventKind.Joined, Said(group).First(p => p.Number > 0).Identity), (Said(group)[^1].Kind, Said(group)[^1].Identity));
        AssertHeardByAll(group);
    }

    /// <summary>A program that crashed is one who is away; with the pass that it saved it is who it was, without one somebody else.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Crash_AndReturn_IsTheSamePersonByItsPassAlone(bool hasPass)
    {
        SessionGroup group = Group(2);
        PlayerPass pass = group.Client(1).Pass!.Value;
        group.Steps.Freeze(1);
        group.Run(3);
        Assert.Equal(0, group.Host.ClientCount);
        ClientSession back = Join(group, 7, hasPass ? pass : default);
        PlayerEvent first = Said(group).First(p => p.Number > 0), last = Said(group)[^1];
        Assert.Equal(
            hasPass ? (PlayerEventKind.Returned, first.Identity, first.Number) : (PlayerEventKind.Joined, last.Identity, back.Peer), (last.Kind, last.Identity, last.Number));
        Assert.Equal(hasPass, last.Identity == first.Identity);
        AssertHeardByAll(group, but: group.Client(1));
    }

    /// <summary>
    /// Somebody else who gets the number, free or kept for one who is away, is told as another person, after it was told that the first has left.
    /// </summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Stranger_WhoTakesTheNumber_IsAnotherPerson(bool isKept)
    {
        Dictionary<byte, string> keys = Enumerable.Range(2, SessionOptions.MaxClients - 1).ToDictionary(n => (byte)n, n => $"key {n}"); // so that one number is left
        SessionGroup group = Group(2, options: _ => Usual() with { PlayerKeys = keys });
        group.Client(1).KeepsPlace = isKept;
        group.Client(1).Leave();
        group.Run(0.2);
        Assert.Equal(1, Join(group, 7).Peer);
        PlayerEvent[] said = [.. Said(group).Where(p => p.Number == 1)];
        PlayerEventKind[] expected = isKept
            ? [PlayerEventKind.Joined, PlayerEventKind.Away, PlayerEventKind.Left, PlayerEventKind.Joined] : [PlayerEventKind.Joined, PlayerEventKind.Left, PlayerEventKind.Joined];
        Assert.Equal(expected, said.Select(p => p.Kind));
        Assert.Equal(2, said.Select(p => p.Identity).Distinct().Count());
        Assert.Single(said.Take(said.Length - 1).Select(p => p.Identity).Distinct());
        AssertHeardByAll(group);
    }

    [Fact]
    public void Kick_IsLeft()
    {
        SessionGroup group = Group(2);
        Assert.True(group.Host.Kick(1));
        group.Run(0.1);
        Assert.Equal(PlayerEventKind.Left, Said(group)[^1].Kind);
        AssertHeardByAll(group);
    }

    /// <summary>
    /// One who is sent away, by hand or for what it cost, has left as who it was, with number, name, role and identity, though a place would be
    /// kept for one who is away. The control: the other one, who stays.
    /// </summary>
    [Theory]
    [InlineData("kicked")]
    [InlineData("banned")]
    [InlineData("over its budget")]
    public void SentAway_HasLeftAsWhoItWas(string how)
    {
        PlayerBudget? budget = how == "over its budget" ? new PlayerBudget(20, 100) : null;
        SessionGroup group = Group(3, options: peer => peer == 0
            ? Usual() with { PlayerBudget = budget } : new ClientOptions { Timeout = Timeout, RejoinTime = Kept, Name = $"Zoë{peer}", Role = peer == 1 ? PeerRole.Bot : PeerRole.Player });
        ClientSession one = group.Client(1);
        byte number = one.Peer;
        if (budget is null)
        {
            Assert.True(how == "banned" ? group.Host.Ban(number) is not null : group.Host.Kick(number));
        }

        for (int n = 0; n < 100 && one.State == SessionState.Running; n++)
        {
            group.Do(1, PlayerAction.Impulse(BodyId.OfScene(n % 4), V(1, 3)));
            group.Run(0.02);
        }

        Assert.Equal(SessionEnd.Kicked, one.EndedBy);
        PlayerEvent[] hers = [.. Said(group).Where(p => p.Number == number)];
        Assert.Equal(new PlayerEvent(PlayerEventKind.Joined, number, hers[0].Identity, "Zoë1", PeerRole.Bot), hers[0]);
        Assert.Equal([hers[0], new PlayerEvent(PlayerEventKind.Left, number, hers[0].Identity, "Zoë1", PeerRole.Bot)], hers);
        Assert.All(Said(group).Where(p => p.Number != number), p => Assert.Equal(PlayerEventKind.Joined, p.Kind));
        AssertHeardByAll(group, but: one);
    }

    /// <summary>One who was expelled keeps its pass, but is not waited for. The control: one who is away is.</summary>
    [Theory]
    [InlineData(LeaveReason.Kicked, false)]
    [InlineData(LeaveReason.Away, true)]
    internal void Place_OfOneWhoKeepsItsPass_IsKeptUnlessItWasSentAway(LeaveReason why, bool isKept)
    {
        PlayerPlaces places = new(Usual(), SimTime.Zero);
        PlayerPlaces.Place place = places[1];
        place.Take(isSamePlayer: false, PeerAddress.Virtual(1), identity: 5);
        Token128? pass = place.Pass;
        place.Leave(isKept, 1, why, SimTime.Zero);
        place.Keep(pass, null);
        Assert.Equal((isKept, 5UL), (places.IsKept(place, At(1)), place.Identity));
        Assert.False(places.IsKept(place, At(Kept.ToSeconds() + 1)));
    }

    /// <summary>Who has a key of its own, or a backend's account, is the same person also after it left for good; the number says nothing else.</summary>
    [Fact]
    public void Identity_ByKeyOrToken_OutlastsLeavingForGood()
    {
        SessionGroup group = Group(1, options: _ => Usual() with { PlayerKeys = new Dictionary<byte, string> { [3] = "carol" } });
        for (int visit = 0; visit < 2; visit++)
        {
            ClientSession carol = Join(group, 20 + visit, key: "carol");
            Assert.Equal(3, carol.Peer);
            carol.Leave();
            group.Run(0.2);
        }

        PlayerEvent[] hers = [.. Said(group).Where(p => p.Number == 3)];
        Assert.Equal([PlayerEventKind.Joined, PlayerEventKind.Left, PlayerEventKind.Joined, PlayerEventKind.Left], hers.Select(p => p.Kind));
        Assert.Single(hers.Select(p => p.Identity).Distinct());
        AssertHeardByAll(group);

        PlayerIds ids = new(5), others = new(6);
        JoinIdentity ann = new("", 0, null, new PlayerAdmission("account 1")), bob = new("", 0, null, new PlayerAdmission("account 2")), keyed = new("", 2, null), guest = new("", 0, null);
        Assert.Equal(ids.Of(ann, 1), ids.Of(ann, 2)); // another visit of the same account
        Assert.Equal(ids.Of(keyed, 1), ids.Of(keyed, 2));
        Assert.NotEqual(ids.Of(guest, 1), ids.Of(guest, 2));
        Assert.NotEqual(ids.Of(ann, 1), others.Of(ann, 1)); // in another session nobody can tell that it is the same
        Assert.Equal(6, new[] { ids.OfHost, ids.Of(ann, 1), ids.Of(bob, 1), ids.Of(keyed, 1), ids.Of(guest, 1), ids.Of(guest, 2) }.Distinct().Count());
    }

    /// <summary>
    /// Drawn sessions on bad links: clients come, go, come back, stand still and are sent away while all play. At the end every peer that is in
    /// has heard the same in the same order, and has the same world to the bit. It was healed on the way, and a world that misses one of the
    /// events is another.
    /// </summary>
    [Theory]
    [InlineData("awful", 1)]
    [InlineData("awful", 2)]
    [InlineData("4g", 3)]
    [InlineData("delay-300ms", 4)]
    public void DrawnSessions_OnBadLinks_HearTheSameEverywhere(string link, int seed)
    {
        Random draws = new(seed);
        SessionGroup group = Group(3, LinkProfiles.Get(link), (ulong)seed, _ => Usual() with { ConfirmsEarly = seed % 2 == 0 });
        List<ClientSession> clients = [group.Client(1), group.Client(2)];
        List<PlayerPass> passes = [];
        Dictionary<int, double> frozen = [];
        for (int n = 0; n < 40; n++)
        {
            ClientSession[] running = [.. clients.Where(c => c.State == SessionState.Running)];
            int who = draws.Next(clients.Count);
            switch (draws.Next(8))
            {
                case 0 when clients.Count < 9:
                    bool returns = passes.Count > 0 && draws.Next(2) == 0;
                    clients.Add(group.Join(10 + n, (ulong)(100 + n), Usual(returns ? passes[^1] : default)));
                    break;
                case 1 when running.Length > 1:
                    ClientSession leaver = running[draws.Next(running.Length)];
                    passes.Add(leaver.Pass!.Value);
                    leaver.KeepsPlace = draws.Next(2) == 0;
                    leaver.Leave();
                    break;
                case 2 when frozen.Count < 2:
                    frozen[who + 1] = n + draws.Next(1, 6);
                    group.Steps.Freeze(who + 1);
                    break;
                case 3 when running.Length > 2:
                    group.Host.Kick(running[draws.Next(running.Length)].Peer);
                    break;
                default:
                    int actor = draws.Next(clients.Count + 1);
                    if (group.Sessions[actor].State == SessionState.Running)
                    {
                        group.Do(actor, draws.Next(2) == 0 ? PlayerAction.Command(new GameCommand(1)) : PlayerAction.Impulse(BodyId.OfScene(draws.Next(4)), V(draws.NextDouble() - 0.5, 1)));
                    }

                    break;
            }

            group.Run(0.3 + draws.NextDouble());
            foreach (int peer in frozen.Where(f => f.Value <= n).Select(f => f.Key).ToArray())
            {
                group.Steps.Thaw(peer);
                frozen.Remove(peer);
            }
        }

        frozen.Keys.ToList().ForEach(group.Steps.Thaw);
        group.Run(12);
        Assert.True(Said(group).Count >= 10 && Said(group).Select(p => p.Kind).Distinct().Count() == 4, string.Join("; ", Said(group)));
        Assert.Contains(group.Sessions.Skip(1), s => s.State == SessionState.Running && s.Counters.Heals > 0);
        AssertHeardByAll(group);
        AssertCourses(group);
        ExternalEvent missed = group.Accepted.Last(e => e.Kind == EventKind.Player);
        SimTime end = group.Host.World!.Simulation.SimulatedTo;
        Assert.NotEqual(group.Alone().StateHash(end), group.Alone(group.Accepted.Where(e => !e.Equals(missed))).StateHash(end));
    }

    /// <summary>A client that is given a fresh copy, and one of a host that was started again, hear nothing twice.</summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Renewal_OrAHostThatIsStartedAgain_TellsNothingTwice(bool restarts)
    {
        SessionGroup group = Group(3);
        ClientSession client = group.Client(1);
        if (restarts)
        {
            List<PlayerEvent> before = [.. Said(group)];
            HostSession host = group.RestartHost(Usual());
            List<PlayerEvent> said = [];
            host.Logged += entry => said.Add(entry.Event.PlayerEvent!);
            Assert.True(group.RunUntil(() => group.Sessions.All(s => s.State == SessionState.Running && s.Counters.Renewals == (s is HostSession ? 0 : 1))));
            group.Run(1);
            Assert.Equal([0, 1, 2], said.Select(p => (int)p.Number).Order());
            Assert.All(said, p => Assert.Equal(PlayerEventKind.Joined, p.Kind));
            Assert.Empty(said.Select(p => p.Identity).Intersect(before.Select(p => p.Identity))); // another session
            AssertStates(group, said);
            return;
        }

        group.Cut(0, 1);
        group.Cut(1, 0);
        Assert.True(group.RunUntil(() => client.State == SessionState.Rejoining, 10));
        group.Restore(0, 1);
        group.Restore(1, 0);
        Assert.True(group.RunUntil(() => client.State == SessionState.Running, 10));
        group.Run(1);
        Assert.Equal(1, client.Counters.Renewals);
        Assert.Equal(
            [PlayerEventKind.Joined, PlayerEventKind.Away, PlayerEventKind.Returned], Said(group).Where(p => p.Number == client.Peer).Select(p => p.Kind));
        AssertHeardByAll(group);
    }

    /// <summary>Nobody but the host says who comes and goes: under its own number it cannot be written, and under the host's it is a forgery.</summary>
    [Fact]
    public void Client_ThatSaysWhoJoined_IsRefused()
    {
        SessionGroup group = Group(2);
        RawClient liar = new(group);
        group.Run(0.1);
        uint length = group.Host.LogLength;
        ExternalEvent said = new PlayerEvent(PlayerEventKind.Joined, 9, 9).Stamp(group.Host.SharedTime.Now, 1);
        (long forged, long malformed) = (group.Host.Counters.EventsForged, group.Host.Counters.DatagramsMalformed);
        liar.Claim(1, said);
        group.Run(0.05);
        Assert.Equal(forged + 1, group.Host.Counters.EventsForged);

        byte[] own = liar.Bytes(1, said);
        int at = own.AsSpan().IndexOf([(byte)EventKind.Player, (byte)0, (byte)1, (byte)0, (byte)0, (byte)0]);
        own[at + 1] = liar.Peer;
        liar.Send(own);
        group.Run(0.05);
        Assert.Equal(malformed + 1, group.Host.Counters.DatagramsMalformed);
        Assert.Equal(length, group.Host.LogLength);
        AssertHeardByAll(group);
    }

    /// <summary>One who comes and goes again and again costs two events each time, and all of them are healed on its account.</summary>
    [Fact]
    public void Loop_OfJoiningAndLeaving_CostsTwoEventsEachTime()
    {
        SessionGroup group = Group(1);
        for (int n = 0; n < 10; n++)
        {
            Join(group, 30 + n).Leave();
            group.Run(0.2);
        }

        Assert.Equal(1 + (2 * 10), Said(group).Count);
        Assert.Equal(Said(group).Count, (int)group.Host.LogLength);
        AssertHeardByAll(group);
        Assert.True(group.Host.Costs.Where(cost => cost.Player > 0).Sum(cost => cost.Work) >= 20 * 5, string.Join("; ", group.Host.Costs));
    }

    /// <summary>What a peer records has it all, and is the same world again.</summary>
    [Fact]
    public void Recording_OfASessionThatPlayersCameToAndLeft_Replays()
    {
        SessionGroup group = new(ScriptedActions.Box().With(Hosts, 1), 2, LinkProfiles.PureDelay(20), options: _ => Usual());
        MemoryStream[] streams = [new(), new()];
        SessionRecorder[] recorders = [new(group.Host, _ => streams[0]), new(group.Client(1), _ => streams[1])];
        group.Connect();
        Join(group, 7, name: "Zoë").Leave();
        group.Run(8);
        group.Host.Leave();
        Assert.True(group.RunUntil(() => group.Sessions.All(s => s.State == SessionState.Ended)));
        Array.ForEach(recorders, recorder => recorder.Dispose());
        Recording[] recordings = [.. streams.Select(stream => Recording.Read(new MemoryStream(stream.ToArray()), null, [Hosts]))];
        foreach (Recording recording in recordings)
        {
            Assert.Equal(Said(group), recording.Entries.Select(entry => entry.Event.PlayerEvent!));
            Assert.Equal(ReplayOutcome.Agrees, RecordingReplay.Run(recording, TestContext.Current.CancellationToken).Outcome);
        }
    }

    /// <summary>A game's own test plays it without doing anything for it.</summary>
    [Fact]
    public void SessionTest_WithALateClient_HearsOfAll()
    {
        SessionTestResult result = new SessionTest(ScriptedActions.Box().With(Hosts, 1)).WithClients(2, "awful").WithLateClient(1, "4g").Run(seconds: 4, TestContext.Current.CancellationToken);
        Assert.Equal(4, result.StateOfRules<GivenState>().Count);
    }

    private static HostOptions Usual() => new() { Timeout = Timeout, RejoinTime = Kept, MaxClientsPerAddress = SessionOptions.MaxClients };

    private static ClientOptions Usual(PlayerPass pass, string name = "", string key = "") =>
        new() { Timeout = Timeout, RejoinTime = Kept, Rules = [Hosts], Pass = pass, Name = name, ConnectKey = key };

    private static SessionGroup Group(int peers, LinkProfile? link = null, ulong seed = 1, Func<int, SessionOptions>? options = null) =>
        new SessionGroup(ScriptedActions.Box().With(Hosts, 1), peers, link ?? LinkProfiles.PureDelay(5), seed, options ?? (_ => Usual())).Connect();

    private static ClientSession Join(SessionGroup group, int address, PlayerPass pass = default, string name = "", string key = "")
    {
        ClientSession client = group.Join(address, (ulong)address, Usual(pass, name, key));
        Assert.True(group.RunUntil(() => client.State == SessionState.Running, 5), client.WhyNotRunning);
        group.Run(0.1);
        return client;
    }

    private static List<PlayerEvent> Said(SessionGroup group) =>
        [.. group.Accepted.Where(e => e.Kind == EventKind.Player).Select(e => e.PlayerEvent!)];

    private static ulong After(ulong before, PlayerEvent player) =>
        unchecked((before * 31) + player.Identity + ((ulong)player.Kind << 60) + ((ulong)player.Role << 50) + player.Number + (ulong)player.Name.Length);

    /// <summary>All peers that are in have the state that follows from what was said, and the world of one who had all events at once.</summary>
    private static void AssertHeardByAll(SessionGroup group, Session? but = null)
    {
        group.Run(1);
        AssertStates(group, Said(group), but);
        Simulation alone = group.Alone();
        foreach (Session session in group.Sessions.Where(s => s.State == SessionState.Running && s != but))
        {
            Simulation actual = session.World!.Simulation;
            SimTime end = SimTime.Min(actual.SimulatedTo, alone.SimulatedTo);
            Assert.True(actual.HistoryEdge < end);
            Assert.Equal((alone.StateHash(end), alone.EventHash(end)), (actual.StateHash(end), actual.EventHash(end)));
        }
    }

    private static void AssertStates(SessionGroup group, List<PlayerEvent> said, Session? but = null)
    {
        Session[] running = [.. group.Sessions.Where(s => s.State == SessionState.Running && s != but)];
        Assert.Contains(group.Host, running);
        foreach (Session session in running)
        {
            Simulation world = session.World!.Simulation;
            Assert.True(world.TryReadRules(world.SimulatedTo, out GivenState state));
            Assert.Equal((said.Count, said.Aggregate(0UL, After)), (state.Count, state.Draw));
        }
    }

    /// <summary>Of each number every course is one that can be: joined, then away and returned by turns, then left, by one person.</summary>
    private static void AssertCourses(SessionGroup group)
    {
        foreach (IGrouping<byte, PlayerEvent> one in Said(group).GroupBy(p => p.Number))
        {
            PlayerEvent? before = null;
            foreach (PlayerEvent next in one)
            {
                bool isRight = next.Kind switch
                {
                    PlayerEventKind.Joined => before is null or { Kind: PlayerEventKind.Left },
                    PlayerEventKind.Returned => before?.Kind == PlayerEventKind.Away,
                    PlayerEventKind.Away => before?.Kind is PlayerEventKind.Joined or PlayerEventKind.Returned,
                    _ => before is not null and not { Kind: PlayerEventKind.Left },
                };
                Assert.True(isRight && (next.Kind == PlayerEventKind.Joined || next.Identity == before!.Identity), $"{before} then {next}");
                before = next;
            }
        }
    }
}
