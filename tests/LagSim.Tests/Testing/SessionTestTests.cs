using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Sessions;
using LagSim.Net.Strategies;
using LagSim.Scenes;
using LagSim.Testing;
using LagSim.Testing.Links;
using LagSim.Tests.Faults;
using LagSim.Tests.Sessions;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Testing;

/// <summary>Tests of games: what passes, and what a world that is not the same looks like.</summary>
public sealed class SessionTestTests
{
    public static TheoryData<string> Links => [.. LinkProfiles.Names];

    private static CancellationToken Cancellation => TestContext.Current.CancellationToken;

    [Theory]
    [MemberData(nameof(Links))]
    public void Run_OnEveryLink_AllHaveTheSameWorld(string link)
    {
        Scene scene = Box();
        SessionTestResult result = Played(scene, link).Run(6, Cancellation);
        Assert.True(result.WorldsAgree && result.FirstDifference is null && result.Differing == 0);
        Assert.True(result.Compared > 300, $"{result.Compared} compared");
        Assert.Equal((5, 0, 0), (result.EventsAccepted, result.EventsRefused, result.EventsTooLate));
        Assert.Equal([0, 1, 2, 3], result.Players.Select(player => player.Number));
        Assert.Equal([null, link, link, link], result.Players.Select(player => player.Link?.Name));
        Assert.All(result.Players, player => Assert.Equal((0, 0), (player.EventsLost, player.StalledFrames)));
        Assert.All(result.Players.Skip(1), player => Assert.True(player.Traffic.BytesSent > 500 && player.Frames > 300, player.ToString()));
        Assert.True(result.Heals > 5 && result.LateEvents >= result.Heals, result.ToString());
        Assert.StartsWith("All worlds agree: ", result.ToString(), StringComparison.Ordinal);
    }

    [Fact]
    public void Run_SameSeedTwice_IsTheSameInAllThatIsTold()
    {
        SessionTest test = Played(Box(), "awful");
        string once = test.Run(6, Cancellation).ToString();
        SessionTestResult again = test.Run(6, Cancellation);
        Assert.Equal(once, again.ToString());
        SessionTestResult other = test.WithSeed(2).Run(6, Cancellation);
        Assert.NotEqual(once, other.ToString());
        Assert.Equal((2ul, 6.0), (other.Seed, other.Seconds));
        Assert.Equal(again.World.StateHash(again.World.Start + SimDuration.FromSeconds(6)), again.StateHash);
    }

    [Theory]
    [InlineData(1)]
    [InlineData(3)]
    internal void Run_HealingThatIsWrongOnOnePlayer_ThrowsAndNamesPlayerBodyAndInstant(int wrong)
    {
        SessionTest test = Played(Box(), "delay-200ms");
        test.PrepareSession = (player, session) => session.Put(
            new FaultyEngineParts { Healing = player == wrong ? HealingFault.ForgetsThePast : HealingFault.None });
        WorldsDifferException thrown = Assert.Throws<WorldsDifferException>(() => test.Run(6, Cancellation));
        Assert.Equal(wrong, thrown.Result!.FirstDifference!.Peer);
        Assert.False(thrown.Result.WorldsAgree);
        Assert.True(thrown.Result.Differing > 0 && thrown.Result.Differing < thrown.Result.Compared);
        Assert.Matches($"^Not every player ended up with the same world\\. Peer {wrong}, body 'b\\d+', .* at \\d\\.\\d+ s", thrown.Message);
        Assert.Contains($"{thrown.Result.Differing} of {thrown.Result.Compared} compared states and events differ.", thrown.Message);
        Assert.Contains("Usual causes: a force", thrown.Message, StringComparison.Ordinal);
        test.PrepareSession = null;
        test.Run(6, Cancellation); // it is the fault that is caught
    }

    [Fact]
    public void Run_WorldThatOneClientTampersWith_IsSeenThere()
    {
        SessionTest test = Played(Box(), "4g");
        test.PrepareSession = (player, session) => session.Put(new FaultyEngineParts { SwapsOperands = player == 2 });
        SessionTestResult result = test.RunUnchecked(8, Cancellation);
        Assert.False(result.WorldsAgree);
        Assert.Equal(2, result.FirstDifference!.Peer);
        Assert.Throws<WorldsDifferException>(result.ThrowIfWorldsDiffer);
    }

    /// <summary>An action with a long local lag lies ahead of every other world when the last player has heard of it.</summary>
    [Fact]
    public void Run_LastActionAheadOfEveryWorld_IsSimulatedAndComparedInAll()
    {
        LatencyCompensationWindow ahead = new LatencyCompensationWindow(lookAhead: SimDuration.FromSeconds(0.5))
            .WithLocalLag(EventKind.SetVelocity, SimDuration.FromSeconds(0.5));
        SessionTest test = new SessionTest(Box())
            .WithOptions(player => new ClientOptions { Window = player == 1 ? ahead : new LatencyCompensationWindow() })
            .WithClients(2, "lan");
        Dictionary<int, Session> sessions = [];
        test.PrepareSession = sessions.Add;
        SimTime last = SimTime.MaxValue;
        SessionTestResult result = test.At(2, 1, player => last = player.Do(PlayerAction.SetVelocity(First, V(4, 1))).Time).Run(2, Cancellation);
        Assert.Equal(1, result.EventsAccepted);
        Assert.Equal([0, 1, 2], sessions.Keys);
        Assert.All(sessions, s => Assert.True(s.Value.World!.Simulation.SimulatedTo >= last, $"player {s.Key}"));
    }

    [Fact]
    public void Run_ForceThatIsAnotherForOnePlayer_Throws()
    {
        Scene scene = new SceneBuilder("wind")
            .AddForce(Force.Supplied(new Wind(1)), out ForceSet wind)
            .AddBody("leaf", new BodySpec(0.1, 0.1, 0.5, forces: wind), V(0, 5))
            .Build();
        SessionTest test = new SessionTest(scene)
            .WithClients(2, "lan")
            .At(1, 1, PlayerAction.SetVelocity(First, V(1, 2)))
            .WithOptions(player => new ClientOptions { Accelerations = [new Wind(player == 2 ? 1.000001 : 1)] });
        WorldsDifferException thrown = Assert.Throws<WorldsDifferException>(() => test.Run(5, Cancellation));
        Assert.Equal(2, thrown.Result!.FirstDifference!.Peer);
        Assert.True(thrown.Result.Players[2].Renewals > 0, thrown.Message); // the session has seen it too, and repaired it: it still counts
        Assert.Contains("Peer 2, body 'leaf'", thrown.Message, StringComparison.Ordinal);
        test.WithOptions(_ => new HostOptions()).Run(3, Cancellation); // the scene's own, which are the same for all
    }

    [Fact]
    public void Run_ForceThatReadsWhatIsNotInTheWorld_Throws()
    {
        // What is simulated again is simulated with a wind that did not blow then.
        Wind blowing = new(1);
        Scene scene = new SceneBuilder("gusts")
            .AddForce(Force.Supplied(blowing), out ForceSet wind)
            .AddBody("leaf", new BodySpec(0.1, 0.1, 0.5, forces: wind), V(0, 5))
            .Build();
        SessionTest test = new SessionTest(scene)
            .WithClients(1, "delay-200ms")
            .At(1.0, 1, PlayerAction.SetVelocity(First, V(1, 2)))
            .At(1.1, 0, _ => blowing.Strength = 3);
        Assert.Throws<WorldsDifferException>(() => test.Run(3, Cancellation));
    }

    [Fact]
    public void Run_StrategyWithoutAgreement_SaysThatItPromisesNone()
    {
        SessionTest test = Played(Box(), "delay-200ms").WithOptions(_ => new HostOptions { Strategy = LateEventStrategy.ApplyOnArrival });
        SessionTestResult result = test.RunUnchecked(6, Cancellation);
        Assert.False(result.WorldsAgree);
        Assert.Contains("player 0 has a strategy that leaves late events as they are.", result.ToString(), StringComparison.Ordinal);
    }

    [Fact]
    public void At_WithCode_SeesWhatThePlayerSeesAndActs()
    {
        Scene scene = Box();
        BodyId bullet = default;
        double seenAt = 0;
        List<bool> isThere = [];
        SessionTestResult result = new SessionTest(scene)
            .WithClients(2, "delay-100ms")
            .At(1, 1, player =>
            {
                seenAt = player.Seconds;
                Assert.True(player.TryRead(First, out BodyState state) && state.Motion != MotionLaw.Absent);
                Assert.Equal((1, 1), (player.Number, player.Session.Peer));
                bullet = player.Do(PlayerAction.Spawn(Ball(0.4), V(0, 8), V(2))).Body;
            })
            .At(1.05, 2, player => isThere.Add(player.TryRead(bullet, out _)))
            .At(1.5, 2, player => isThere.Add(player.TryRead(bullet, out _)))
            .At(2, 2, player => player.Do(PlayerAction.Remove(bullet)))
            .Run(4, Cancellation);
        Assert.InRange(seenAt, 0.95, 1.05);
        Assert.Equal([false, true], isThere);
        Assert.Equal(MotionLaw.Absent, result.StateOf(bullet).Motion);
        Assert.NotEqual(MotionLaw.Absent, result.StateOf(bullet, 1.6).Motion);
    }

    [Fact]
    public void Every_Frame_IsCalledWhileThePlayerIsIn()
    {
        int host = 0, late = 0;
        double first = double.MaxValue;
        SessionTestResult result = new SessionTest(Box())
            .WithClients(1, "4g")
            .WithLateClient(1, "4g")
            .Every(0.1, 0, _ => host++)
            .Every(0.1, 2, player =>
            {
                late++;
                first = Math.Min(first, player.Seconds);
                if (late == 10)
                {
                    player.Leave();
                }
            })
            .Run(4, Cancellation);
        Assert.Equal(41, host);
        Assert.Equal(10, late);
        Assert.InRange(first, 1.1, 2);
        Assert.True(result.WorldsAgree);
        Assert.InRange(result.Players[2].Frames, 50, 70);
    }

    [Fact]
    public void Contacts_OfEachPlayer_AreConfirmedAlike()
    {
        int[] players = [0, 1, 2];
        Dictionary<int, ContactNotices> notices = players.ToDictionary(player => player, _ => new ContactNotices(minClosingSpeed: 0.5));
        Dictionary<int, List<string>> confirmed = players.ToDictionary(player => player, _ => new List<string>());
        SessionTest test = new SessionTest(Box())
            .WithClients(2, "3g")
            .WithOptions(player => new HostOptions { Contacts = notices[player] })
            .At(0.5, 1, PlayerAction.SetVelocity(First, V(4, 1)))
            .At(0.6, 2, PlayerAction.SetVelocity(Second, V(-4, 1)));
        foreach (int number in players)
        {
            test.Every(0.05, number, player =>
            {
                while (notices[player.Number].TryRead(out ContactNotice notice))
                {
                    if (notice.Kind == NoticeKind.Confirmed)
                    {
                        confirmed[player.Number].Add($"{notice.First} {notice.Second} {notice.ClosingSpeed:R}");
                    }
                }
            });
        }

        test.Run(6, Cancellation);
        int least = confirmed.Values.Min(list => list.Count);
        Assert.True(least > 5, $"{least} confirmed");
        Assert.All(confirmed.Values, list => Assert.Equal(confirmed[0].Take(least), list.Take(least)));
    }

    [Fact]
    public void Run_EventsLaterThanTheWindow_AreCountedAndHappenLaterOrNot()
    {
        SessionTestResult result = new SessionTest(Box()).WithClients(1, "delay-500ms").At(1, 1, PlayerAction.SetVelocity(First, V(1)))
            .At(1, 1, PlayerAction.Teleport(First, V(0, 4)))
            .WithOptions(_ => new HostOptions { Window = new(SimDuration.FromMilliseconds(100)) }).Run(3, Cancellation);
        Assert.Equal((1, 1, 1, 1), (result.EventsAccepted, result.EventsMoved, result.EventsRefused, result.EventsTooLate));
    }

    [Fact]
    public void Run_CodeThatThrows_ThrowsThat()
    {
        SessionTest test = new SessionTest(Box()).At(1, 0, _ => throw new TimeoutException("mine"));
        Assert.Equal("mine", Assert.Throws<TimeoutException>(() => test.Run(2, Cancellation)).Message);
    }

    [Fact]
    public void Run_WhatMayNotBeDone_SaysWhoWhenAndWhy()
    {
        Scene scene = new SceneBuilder("rights").AddBody("mine", Ball(), V(0, 1), players: PeerSet.Of(2)).Build();
        SessionTest test = new SessionTest(scene).WithClients(2, "lan").At(1, 2, PlayerAction.SetVelocity(First, V(1)));
        Assert.Equal(1, test.Run(2, Cancellation).EventsAccepted);
        test.At(1.5, 1, PlayerAction.SetVelocity(First, V(1)));
        string message = Assert.Throws<SessionTestException>(() => test.Run(2, Cancellation)).Message;
        Assert.StartsWith("Player 1 could not do its SetVelocity at 1.5 s: ", message, StringComparison.Ordinal);
    }

    [Fact]
    public void Run_PlayerThatIsNotIn_SaysSo()
    {
        SessionTest test = new SessionTest(Box()).WithLateClient(2, "lan").At(1, 1, PlayerAction.SetVelocity(First, V(1)));
        Assert.Equal("Player 1 cannot act at 1 s: it has not asked to join yet.", Message(test));

        test = new SessionTest(Box())
            .WithClients(1, "lan")
            .At(1, 1, player => player.Leave())
            .At(1.5, 1, PlayerAction.SetVelocity(First, V(1)));
        Assert.Equal("Player 1 cannot act at 1.5 s: it has left.", Message(test));

        test = new SessionTest(Box()).At(1, 0, player => player.Leave());
        Assert.Equal("Player 0 is the host and cannot leave: without it there is no session to test.", Message(test));

        static string Message(SessionTest test) => Assert.Throws<SessionTestException>(() => test.Run(3, Cancellation)).Message;
    }

    [Fact]
    public void Run_LinkThatLosesEverything_SaysWhoIsNotIn()
    {
        SessionTest test = new SessionTest(Box()).WithClients(1, new LinkProfile("cut", new LinkLeg(10, lossPercent: 100)));
        string message = Assert.Throws<SessionTestException>(() => test.Run(1, Cancellation)).Message;
        Assert.StartsWith("Player 1 was not let in", message, StringComparison.Ordinal);
        Assert.Contains("player 1 is out: ", message, StringComparison.Ordinal);
    }

    /// <summary>What a player did last before it was sent away is in its own world alone, and no difference: its going is what happened.</summary>
    [Fact]
    public void Run_PlayerWhomTheHostSendsAway_SaysSo()
    {
        Session host = null!;
        SessionTest test = new SessionTest(Box()).WithClients(2, "delay-100ms")
            .At(1, 0, _ => Assert.True(((HostSession)host).Kick(1)))
            .At(1.05, 1, PlayerAction.SetVelocity(First, V(3, 1)));
        test.PrepareSession = (player, session) => host = player == 0 ? session : host;
        string message = Assert.Throws<SessionTestException>(() => test.Run(3, Cancellation)).Message;
        Assert.Contains("player 1 is out: The host sent this player away", message, StringComparison.Ordinal);
        Assert.Contains("player 2 is running", message, StringComparison.Ordinal);
    }

    [Fact]
    public void Run_Cancelled_Stops()
    {
        using CancellationTokenSource stop = new();
        SessionTest test = new SessionTest(Box()).At(1, 0, _ => stop.Cancel());
        Assert.ThrowsAny<OperationCanceledException>(() => test.Run(3, stop.Token));
    }

    [Fact]
    public void Builder_BadInput_NamesTheValueAndWhatIsAllowed()
    {
        SessionTest test = new(Box());
        Says(() => test.WithClients(17, "lan"), "A host has room for 16 clients and 0 are there: 1 to 16 can be added.");
        Says(() => test.WithClients(0, "lan"), "1 to 16 can be added.");
        Says(() => test.WithClients(1, "wlan"), "There is no link profile 'wlan'; there are loopback, lan,");
        Says(() => test.WithLateClient(-1, "lan"), "Things happen 0 to 3600 s after the start.");
        Says(() => test.At(1, 1, PlayerAction.Remove(First)), "Add clients before what they do: there is only player 0, the host");
        Says(() => test.WithClients(2, "lan").At(1, 3, PlayerAction.Remove(First)), "there are players 0, the host, to 2");
        Says(() => test.At(double.NaN, 0, PlayerAction.Remove(First)), "Things happen 0 to 3600 s after the start.");
        Says(() => test.Every(0, 0, _ => { }), "A player acts every 0.001 to 3600 s.");
        Says(() => test.Run(0, Cancellation), "A run lasts above 0 and up to 3600 s.");
        Says(() => test.At(5, 0, PlayerAction.Remove(First)).Run(4, Cancellation), "Player 0 acts at 5 s; the run must last that long");
        Says(() => new SessionTest(Box()).WithLateClient(5, "lan").Run(4, Cancellation), "Player 1 asks to join at 5 s; the run must last");
        Says(() => new SessionTest(Box()).Run(1, Cancellation).StateOf(First, 1.5), "The run lasted from 0 to 1 s.");
        Says(() => new SessionTest(Box()).Run(1, Cancellation).StateOfRules<long>(double.NaN), "The run lasted from 0 to 1 s.");
        Assert.Contains(
            "has no rules.", Assert.Throws<InvalidOperationException>(() => new SessionTest(Box()).Run(1, Cancellation).StateOfRules<long>()).Message);
        SessionTest longKey = new SessionTest(Box()).WithOptions(_ => new HostOptions { ConnectKey = new string('x', 300) });
        Says(() => longKey.Run(1, Cancellation), "A connect key has 0 to 256 characters.");
        SessionTest none = new SessionTest(Box()).WithOptions(_ => null!);
        Assert.Contains("no session options for player 0", Assert.Throws<SessionTestException>(() => none.Run(1, Cancellation)).Message);

        static void Says(Action bad, string sentence) => Assert.Contains(sentence, Assert.ThrowsAny<ArgumentException>(bad).Message);
    }

    /// <summary>Eight balls in a box that all of them cross all the time.</summary>
    private static Scene Box()
    {
        SceneBuilder box = new SceneBuilder("box")
            .AddPlane("floor", Vector3D.Up, V(0), 0.9)
            .AddPlane("west", V(1), V(-3), 0.9).AddPlane("east", V(-1), V(3), 0.9)
            .AddPlane("south", V(0, 0, 1), V(0, 0, -3), 0.9).AddPlane("north", V(0, 0, -1), V(0, 0, 3), 0.9);
        for (int n = 0; n < 8; n++)
        {
            box.AddBody($"b{n}", Ball(0.4, e: 0.9), V((n % 4 * 1.2) - 1.8, 1 + (0.3 * n), (n / 4 * 1.4) - 0.7), V(n - 3, 0, 4 - n));
        }

        return box.Build();
    }

    private static SessionTest Played(Scene scene, string link) => new SessionTest(scene)
        .WithOptions(_ => new HostOptions { Window = new(LatencyCompensationWindow.MaxHistory) })
        .WithClients(3, link)
        .At(0.5, 1, PlayerAction.SetVelocity(scene.BodyNamed("b0"), V(5, 2)))
        .At(0.5, 2, PlayerAction.SetVelocity(scene.BodyNamed("b0"), V(-5, 2)))
        .At(1, 0, PlayerAction.Impulse(scene.BodyNamed("b1"), V(1, 3, 1)))
        .At(1.5, 3, PlayerAction.Teleport(scene.BodyNamed("b2"), V(0, 4), V(1)))
        .At(2.5, 2, PlayerAction.Impulse(scene.BodyNamed("b3"), V(-2, 1, 2)));

    private sealed class Wind(double strength) : IAcceleration
    {
        internal double Strength { get; set; } = strength;

        public string Name => "wind";

        public int Version => 1;

        public Vector3D At(double seconds, in Vector3D position, in Vector3D velocity) => V(Strength);
    }
}
