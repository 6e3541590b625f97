using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Sessions;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>A player who lost its host comes back as the player it was, and nobody else does.</summary>
public sealed class RejoiningTests
{
    private static readonly SimDuration Timeout = SimDuration.FromSeconds(3);

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    [InlineData(4)]
    public void Silence_LongerThanTheTimeout_BringsTheSamePlayerBackWithTheSameWorld(int seed)
    {
        SessionGroup group = Group(3, seed: seed);
        ClientSession client = group.Client(1);
        byte number = client.Peer;
        PlayerPass? pass = client.Pass;
        List<string> told = Listen(client);
        group.Do(1, PlayerAction.Impulse(First, V(0.2, 1)));
        group.Run(0.5);
        Cut(group, 1);
        group.Do(2, PlayerAction.Impulse(Second, V(-0.3, 1)));
        ExternalEvent unheard = group.Do(1, PlayerAction.Impulse(First, V(0.1, 2)));
        group.Run(Timeout.ToSeconds() + seed);
        Assert.Equal((SessionState.Rejoining, 1), (client.State, group.Host.ClientCount));
        Mend(group, 1);
        Assert.True(group.RunUntil(() => client.State == SessionState.Running, 2), client.EndReason);
        Assert.Equal((number, pass, 2), (client.Peer, client.Pass, group.Host.ClientCount));
        Assert.Equal(["interrupted", "renewed"], told);
        Assert.Equal((1L, 1L), (client.Counters.Renewals, client.Counters.EventsUnanswered));

        // What it does from then on bears numbers that nobody used, those of what was never heard apart.
        ExternalEvent next = group.Do(1, PlayerAction.Impulse(First, V(0, 1)));
        group.Run(4);
        Assert.Contains(next, group.Accepted);
        Assert.DoesNotContain(unheard, group.Accepted);
        Assert.Null(group.Difference());
        Assert.All(group.Sessions, s => Assert.Equal((0L, 0L), (s.Counters.StatesDiffered, s.Counters.EventsLost)));
        Assert.True(client.Counters.StatesAgreed > 0);
    }

    /// <summary>
    /// The host is heard again in the very moment in which the client is let in anew: its answer to a connect request overtakes its update. It goes
    /// on in one way or the other, and is not disconnected for having asked.
    /// </summary>
    [Fact]
    public void Silence_OneWay_ThatEndsWhileItAsks_InterruptsOnce()
    {
        int regained = 0, renewed = 0, overtaken = 0;
        for (int seed = 1; seed <= 40; seed++)
        {
            SessionGroup group = Group(2, seed: seed);
            ClientSession client = group.Client(1);
            List<string> told = Listen(client);
            bool hasJoined = false;
            group.Network.Lose((from, _, datagram) =>
            {
                hasJoined |= from == 1 && datagram.Span[3] == (byte)Net.Wire.DatagramType.Join;
                return false;
            });
            hasJoined = false;
            group.Cut(0, 1);
            Assert.True(group.RunUntil(() => client.State == SessionState.Rejoining, 10));
            group.Do(0, PlayerAction.Impulse(First, V(0, 1))); // repeated until it is heard: an update is soon on its way
            group.Run(0.0537 * seed);
            group.Restore(0, 1, 20);
            Assert.True(group.RunUntil(() => client.State is SessionState.Running or SessionState.Ended, 2), $"{seed}: {client.State}");
            bool isRegained = told.Contains("regained");
            overtaken += isRegained && hasJoined ? 1 : 0;
            regained += isRegained ? 1 : 0;
            renewed += isRegained ? 0 : 1;
            group.Run(8);
            Assert.Equal((SessionState.Running, 2), (client.State, told.Count));
            Assert.Equal(1, group.Host.ClientCount);
            Assert.Null(group.Difference());
        }

        Assert.True(
            regained > 0 && overtaken > 0,
            $"{regained} heard their host again, {overtaken} of them after they had asked; {renewed} did not");
    }

    [Fact]
    public void Pass_OfAProgramThatWasStartedAgain_GivesTheNumberBack()
    {
        SessionGroup group = Group(3);
        group.Do(2, PlayerAction.Impulse(First, V(0, 1)));
        group.Run(1);
        ClientSession before = group.Client(2);
        PlayerPass pass = before.Pass!.Value;
        group.DropLast(); // killed: it says nothing
        Assert.True(PlayerPass.TryParse(pass.ToString(), out PlayerPass kept));
        ClientSession after = group.Join(7, 77, new ClientOptions { Pass = kept });
        Assert.True(group.RunUntil(() => after.State == SessionState.Running, 2));
        Assert.Equal((before.Peer, pass, 2), (after.Peer, after.Pass, group.Host.ClientCount)); // at once: nobody waits for the time-out
        ExternalEvent next = after.Do(PlayerAction.Impulse(First, V(0, 1)));
        Assert.Equal(2u, next.Sequence);
        group.Run(1);
        Assert.Contains(next, group.Accepted);
    }

    [Fact]
    public void Pass_OfOneWhoIsStillThere_TakesItsPlaceAndTellsIt()
    {
        SessionGroup group = Group(3);
        ClientSession before = group.Client(1);
        ClientSession after = group.Join(7, 77, new ClientOptions { Pass = before.Pass!.Value });
        Assert.True(group.RunUntil(() => after.State == SessionState.Running && before.State == SessionState.Ended, 2));
        Assert.Equal((before.Peer, 2, SessionEnd.Disconnected), (after.Peer, group.Host.ClientCount, before.EndedBy));
        Assert.Equal("This player came in from elsewhere; the host let this peer go.", before.EndReason);
    }

    [Fact]
    public void Pass_WithAnotherSecret_IsOfNoUse()
    {
        SessionGroup group = Group(3);
        Random random = new(1);
        for (int n = 0; n < 20; n++)
        {
            Assert.True(PlayerPass.TryParse($"1-{random.NextInt64():x16}{random.NextInt64():x16}", out PlayerPass guessed));
            ClientSession stranger = group.Join(7, 77 + (ulong)n, new ClientOptions { Pass = guessed });
            Assert.True(group.RunUntil(() => stranger.State == SessionState.Running, 2));
            Assert.Equal((3 + (n % (SessionOptions.MaxClients / 2)), 3), (stranger.Peer, group.Host.ClientCount)); // as anybody
            Assert.NotEqual(guessed, stranger.Pass);
            stranger.Leave();
            group.Run(0.1);
            group.DropLast();
        }

        Assert.All(group.Sessions, s => Assert.Equal(SessionState.Running, s.State));
    }

    [Fact]
    public void Pass_OfOneWhoLeft_OrWhoseNumberAnotherGot_IsOfNoUse()
    {
        SessionGroup group = Group(2);
        PlayerPass left = group.Client(1).Pass!.Value;
        group.Client(1).Leave();
        group.Run(0.1);
        group.DropLast();
        ClientSession next = Running(group, 10, left);
        Assert.Equal(2, next.Peer); // as anybody: the least that nobody had
        Assert.NotEqual(left, next.Pass);

        // It falls silent, and somebody else needs its number.
        PlayerPass former = next.Pass!.Value;
        group.DropLast();
        group.Run(Timeout.ToSeconds() + 1);
        Assert.Equal(0, group.Host.ClientCount);
        List<ClientSession> others = [.. Enumerable.Range(20, SessionOptions.MaxClients).Select(node => Running(group, node, default))];
        Assert.Equal(Enumerable.Range(3, SessionOptions.MaxClients - 2).Concat([1, 2]), others.Select(s => (int)s.Peer)); // its number last of all
        ClientSession again = group.Join(40, 40, new ClientOptions { Pass = former, RejoinTime = SimDuration.FromSeconds(3) });
        group.Run(2);
        Assert.Equal(SessionState.Joining, again.State); // who had a place asks on: somebody may leave
        Assert.True(group.RunUntil(() => again.State == SessionState.Ended, 4));
        Assert.Equal("The host refused: the session is full.", again.EndReason);
        Assert.All(others, s => Assert.Equal(SessionState.Running, s.State));
    }

    [Fact]
    public void Full_WhileItAsksToBeLetInAgain_IsWaitedFor()
    {
        SessionGroup group = Group(2);
        ClientSession client = group.Client(1);
        Cut(group, 1);
        group.Run(Timeout.ToSeconds() + 1);
        List<ClientSession> others = [.. Enumerable.Range(20, SessionOptions.MaxClients).Select(node => Running(group, node, default))];
        Mend(group, 1);
        group.Run(5);
        Assert.Equal(SessionState.Rejoining, client.State);
        others[3].Leave();
        Assert.True(group.RunUntil(() => client.State == SessionState.Running, 3), client.EndReason);
        Assert.Equal(5, client.Peer); // the number that is free now: its own is another's
    }

    /// <summary>Of two numbers, the one that is kept is the last to be given away. That time over, the one that is free longer is the first.</summary>
    [Theory]
    [InlineData(10, 1)]
    [InlineData(30, 0)]
    public void Number_OfOneWhoFellSilent_IsKeptForTheHostsRejoinTime(double seconds, int expected)
    {
        SessionGroup group = new SessionGroup(
            ScriptedActions.Box(), 1, LinkProfiles.PureDelay(5), options: _ => new HostOptions { Timeout = Timeout, RejoinTime = SimDuration.FromSeconds(20), SpectatorPlaces = 2 }).Connect();
        int gone = 0;
        group.Host.ClientGone += _ => gone++;
        byte[] numbers = [Watch(5).Peer, 0];
        group.DropLast(); // killed: it says nothing
        ClientSession other = Watch(6);
        numbers[1] = other.Peer;
        Assert.Equal((0, 2), (gone, group.Host.ClientCount));
        Assert.True(group.RunUntil(() => gone == 1, Timeout.ToSeconds() + 0.1));
        group.Run(0.1);
        other.Leave();
        group.Run(seconds);
        Assert.Equal(0, group.Host.ClientCount);
        Assert.Equal(numbers[expected], Watch(7).Peer);

        ClientSession Watch(int node)
        {
            ClientSession session = group.Join(node, (ulong)node, new ClientOptions { Role = PeerRole.Spectator, Timeout = Timeout });
            Assert.True(group.RunUntil(() => session.State == SessionState.Running, 2), session.WhyNotRunning);
            return session;
        }
    }

    [Fact]
    public void RejoinTime_OfNothing_EndsAtOnceByWhatHappened()
    {
        SessionGroup group = Group(3, _ => SimDuration.Zero);
        group.Cut(0, 1);
        group.Cut(2, 0);
        group.Run(Timeout.ToSeconds() + 1);
        Assert.Equal([SessionEnd.None, SessionEnd.HostSilent, SessionEnd.Disconnected], group.Sessions.Select(s => s.EndedBy));
        Assert.Equal("The host fell silent for 3 s.", group.Sessions[1].EndReason);
    }

    /// <summary>Its world is full and it does not ask again: it says so, and that it can come again; its place is free at once.</summary>
    [Fact]
    public void RejoinTime_OfNothing_WithTimelinesFull_TellsThatItCanJoinAgain()
    {
        SessionGroup group = new SessionGroup(BuiltInScenes.Billiards(), 3, LinkProfiles.PureDelay(20), 1, peer => new ClientOptions
        {
            MaxSegments = peer == 1 ? 60 : SimulationOptions.DefaultMaxSegments,
            RejoinTime = peer == 1 ? SimDuration.Zero : SimDuration.FromSeconds(60),
        }).Connect();
        ClientSession full = group.Client(1);
        Assert.True(group.RunUntil(() => full.State == SessionState.Ended, 20));
        Assert.Equal(SessionEnd.TimelinesFull, full.EndedBy);
        Assert.StartsWith(
            "This peer has no more room for what may still change, and left; it can join again. ", full.EndReason, StringComparison.Ordinal);
        group.Run(0.1);
        Assert.Equal(1, group.Host.ClientCount);
    }

    [Fact]
    public void RejoinTime_ThatPasses_EndsWithBothSentences()
    {
        SessionGroup group = Group(2, _ => SimDuration.FromSeconds(5));
        Cut(group, 1);
        group.Run(Timeout.ToSeconds() + 5.5);
        Assert.Equal((SessionState.Ended, SessionEnd.HostSilent), (group.Sessions[1].State, group.Sessions[1].EndedBy));
        Assert.Equal(
            "The host fell silent for 3 s. This peer asked for 5 s to be let in again, in vain.", group.Sessions[1].EndReason);
    }

    private static SessionGroup Group(int peers, Func<int, SimDuration>? rejoinTime = null, int seed = 1) => new SessionGroup(
        ScriptedActions.Box(),
        peers,
        LinkProfiles.PureDelay(5),
        (ulong)seed,
        peer => new HostOptions { Timeout = Timeout, RejoinTime = rejoinTime?.Invoke(peer) ?? SimDuration.FromSeconds(120) }).Connect();

    private static ClientSession Running(SessionGroup group, int node, PlayerPass pass)
    {
        ClientSession session = group.Join(node, (ulong)node, new ClientOptions { Pass = pass });
        Assert.True(group.RunUntil(() => session.State == SessionState.Running, 2), session.EndReason);
        return session;
    }

    private static void Cut(SessionGroup group, int peer)
    {
        group.Cut(0, peer);
        group.Cut(peer, 0);
    }

    private static void Mend(SessionGroup group, int peer)
    {
        group.Restore(0, peer);
        group.Restore(peer, 0);
    }

    private static List<string> Listen(ClientSession client)
    {
        List<string> told = [];
        client.Interrupted += _ => told.Add("interrupted");
        client.Renewed += _ => told.Add("renewed");
        client.Regained += () => told.Add("regained");
        return told;
    }
}
