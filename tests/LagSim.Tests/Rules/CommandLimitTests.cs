using System;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Tests.Sessions;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Rules;

/// <summary>Commands that are too long, too early, too many, unknown, or not for who sends them.</summary>
public sealed class CommandLimitTests
{
    private const int Known = 1;

    /// <summary>They count each known command, and take no notice of any other.</summary>
    private static readonly GivenRules Counting = new()
    {
        Command = (w, _, command) => w.State<GivenState>().Count += command.Number == Known && command.TryRead(out int value) ? value : 0,
    };

    private static readonly PlayerAction One = PlayerAction.Command(GameCommand.Of(Known, 1));

    [Fact]
    public void Command_OfTheMostBytes_IsTakenAndAReasonToldForOneMore()
    {
        byte[] most = [.. Enumerable.Range(0, 128).Select(n => (byte)n)];
        Assert.Equal(most, new GameCommand(65_535, most).Data.ToArray());
        Assert.Equal(
            "Command 3 carries 129 bytes; at most 128 are allowed. (Parameter 'data')", Assert.Throws<ArgumentException>(() => new GameCommand(3, new byte[129])).Message);
        Assert.StartsWith(
            "Command 3 carries 136 bytes; at most 128 are allowed.",
            Assert.Throws<ArgumentException>(() => GameCommand.Of(3, (default(Large), 1L))).Message, StringComparison.Ordinal);
        foreach (int number in new[] { -1, 65_536 })
        {
            Assert.StartsWith(
                "The number of a command is 0 to 65535.", Assert.Throws<ArgumentOutOfRangeException>(() => new GameCommand(number)).Message, StringComparison.Ordinal);
        }
    }

    [Fact]
    public void Commands_UnknownOrOfOtherBytes_AreCarriedAndChangeNothing()
    {
        SessionGroup group = Group();
        group.Do(1, PlayerAction.Command(new GameCommand(999)));
        group.Do(2, PlayerAction.Command(new GameCommand(Known, new byte[128])));
        group.Do(0, PlayerAction.Command(new GameCommand(Known)));
        Assert.True(group.Settle(3));
        group.Run(1);
        Assert.Equal([0, 0, 0], Counts(group));
        group.Do(1, One); // the control
        Assert.True(group.Settle(4));
        group.Run(1);
        Assert.Equal([1, 1, 1], Counts(group));
        Assert.Equal(4, group.Host.Counters.EventsAccepted);
        Assert.Null(group.Difference());
    }

    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    public void Command_ForAFutureInstant_IsHeardThenAndNotFurtherAheadThanAllowed(int peer)
    {
        SessionGroup group = Group();
        Session me = group.Sessions[peer];
        SimTime now = me.SharedTime.Now;
        SimTime at = now + me.MaxAhead;
        ArgumentOutOfRangeException no = Assert.Throws<ArgumentOutOfRangeException>(() => me.Do(One, at + SimDuration.OneTick));
        Assert.StartsWith(
            $"An action can be done from now, {now.ToShortString()}, to 0.5s later, half of the history of the window.", no.Message, StringComparison.Ordinal);
        Assert.Equal((at + SimDuration.OneTick).ToShortString(), no.ActualValue);
        ExternalEvent done = me.Do(One, at);
        group.Steps.Wake(peer);
        Assert.True(group.Settle(1));
        group.Run(1);
        Assert.Equal(at, done.Time);
        Assert.All(group.Sessions, session =>
        {
            Simulation world = session.World!.Simulation;
            Assert.True(world.TryReadRules(at - SimDuration.OneTick, out GivenState before));
            Assert.True(world.TryReadRules(at, out GivenState after));
            Assert.Equal((0, 1), (before.Count, after.Count));
            Assert.Equal(0, session.Counters.Heals);
        });
        Assert.Null(group.Difference());
    }

    [Fact]
    public void Commands_OfALiarOrASpectator_AreRefusedByTheHost()
    {
        SessionGroup group = Group();
        RawClient liar = new(group);
        SimTime now = group.Host.SharedTime.Now;
        liar.Claim(1, Tell(1, now, liar), Tell(2, now + SimDuration.FromSeconds(1.5), liar), Tell(3, now - SimDuration.FromSeconds(5), liar));
        RawClient watcher = new(group, address: 51, role: 2);
        watcher.Claim(1, Tell(1, group.Host.SharedTime.Now, watcher));
        group.Run(1);
        Assert.Equal([Verdict.Accepted, Verdict.TooEarly, Verdict.TooLate, Verdict.NoRight], group.Log.Values.Select(entry => entry.Verdict));
        Assert.Equal([1, 1, 1], Counts(group));
        Assert.Null(group.Difference());
    }

    [Fact]
    public void Command_OfASpectator_Throws()
    {
        SessionGroup group = Group();
        group.Network.Connect(9, 0, LinkProfiles.PureDelay(20));
        ClientSession watcher = group.Join(9, 99, new ClientOptions { Rules = [Counting], Role = PeerRole.Spectator });
        Assert.True(group.RunUntil(() => watcher.State == SessionState.Running));
        Assert.Equal(
            "Command is not for a spectator, which only watches; join as a player (SessionOptions.Role) to do something.",
            Assert.Throws<SceneException>(() => watcher.Do(One)).Message);
        group.Do(1, One); // the control: who plays may
        Assert.True(group.Settle(1));
        group.Run(1);
        Assert.Equal([1, 1, 1, 1], Counts(group));
        Assert.Single(group.Log);
    }

    [Fact]
    public void Commands_MoreThanTheHostTakesInASecond_AreLeftForLaterAndNoneIsLost()
    {
        SessionGroup group = Group(events: 20, history: 5);
        for (int n = 0; n < 60; n++)
        {
            group.Do(1, One);
            group.Run(0.01);
        }

        Assert.True(group.Settle(60));
        group.Run(1);
        Assert.True(group.Host.Counters.EventsDeferred > 0, "none was left for later");
        Assert.Equal((60, 0), (group.Host.Counters.EventsAccepted, group.Host.Counters.EventsRefused));
        Assert.Equal([60, 60, 60], Counts(group));
        Assert.Null(group.Difference());

        SessionGroup usual = Group(history: 5); // the control: the usual budget leaves none
        for (int n = 0; n < 60; n++)
        {
            usual.Do(1, One);
            usual.Run(0.01);
        }

        Assert.True(usual.Settle(60));
        Assert.Equal(0, usual.Host.Counters.EventsDeferred);
    }

    private static ExternalEvent Tell(uint sequence, SimTime time, RawClient client) => One.Stamp(time, client.Peer, sequence);

    private static int[] Counts(SessionGroup group) => [.. group.Sessions.Select(session =>
        session.World!.Simulation.TryReadRules(session.World.Simulation.SimulatedTo, out GivenState state) ? state.Count : -1)];

    private static SessionGroup Group(int events = 500, double history = 1)
    {
        Scene scene = new SceneBuilder("commands").AddPlane("floor", Vector3D.Up, V(0), 1).AddBody("ball", Ball(), V(0, 2)).WithRules(Counting).Build();
        LagSim.Timelines.LatencyCompensationWindow window = new(SimDuration.FromSeconds(history));
        return new SessionGroup(scene, 3, LinkProfiles.PureDelay(20), options: peer => peer == 0
            ? new HostOptions { MaxEventsPerSecond = events, Window = window }
            : new ClientOptions { Rules = [Counting], Window = window }).Connect();
    }

#pragma warning disable CS0649 // its size is all that matters
    [System.Runtime.CompilerServices.InlineArray(16)]
    private struct Large
    {
        internal long First;
    }
#pragma warning restore CS0649
}
