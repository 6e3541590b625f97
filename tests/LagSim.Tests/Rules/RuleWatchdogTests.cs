using System;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Sessions;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Tests.Sessions;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Rules;

/// <summary>A call of rules that does not return is given up, and the world ends with a sentence. Nothing here waits: calls look at themselves.</summary>
public sealed class RuleWatchdogTests
{
    private const string Sentence = "The rules 'given 1' failed at 0.25s, round 0, in OnTimer for timer 1: it has not"
        + " returned within 10s, and was given up.";

    [Fact]
    public void Look_AtACallThatRunsForTheLimit_EndsTheWorldWithASentence()
    {
        RuleWatchdog watchdog = new();
        int rounds = 0;
        LiveWorld world = Timed(watchdog, w =>
        {
            while (rounds < 1000)
            {
                rounds++;
                watchdog.Look();
                w.Random();
            }
        });
        world.Step(At(0.1));
        Assert.Equal(Sentence, Assert.Throws<SimulationException>(() => world.Step(At(1))).Message);
        Assert.Equal(RuleWatchdog.LooksToGiveUp + 1, rounds); // the first look begins the span
        Assert.Throws<InvalidOperationException>(() => world.Step(At(2)));
        Assert.Throws<InvalidOperationException>(() => world.Simulation.StateHash(At(0.1)));
    }

    [Fact]
    public void Look_AtCallsThatReturn_EndsNothing()
    {
        // The control: as many looks, but one fewer in each call than would end it, and a call that ends in between.
        RuleWatchdog watchdog = new();
        int looks = 0;
        LiveWorld world = Timed(watchdog, w =>
        {
            for (int n = 0; n < RuleWatchdog.LooksToGiveUp; n++)
            {
                watchdog.Look();
                looks++;
            }

            w.State<GivenState>().Count++;
            w.SetTimer(1, SimDuration.FromSeconds(0.25));
        });
        LiveWorld alone = Timed(null, w =>
        {
            w.State<GivenState>().Count++;
            w.SetTimer(1, SimDuration.FromSeconds(0.25));
        });
        world.Step(At(2));
        alone.Step(At(2));
        Assert.True(looks > 3 * RuleWatchdog.LooksToGiveUp);
        Assert.Equal(alone.Simulation.StateHash(At(2)), world.Simulation.StateHash(At(2)));
        Assert.Equal(alone.Simulation.EventHash(At(2)), world.Simulation.EventHash(At(2)));
    }

    [Fact]
    public void Look_AtACallThatReturnsAfterItWasGivenUp_EndsTheWorldToo()
    {
        // It asks nothing of the world, catches what it can, or throws something else: it comes to the same.
        Action<RuleWorld>[] ends =
        [
            _ => { },
            w =>
            {
                try
                {
                    w.SetTimer(1, SimDuration.FromSeconds(1));
                }
                catch (SimulationException)
                {
                    // As rules should not.
                }
            },
            _ => throw new InvalidTimeZoneException("something else"),
        ];
        foreach (Action<RuleWorld> end in ends)
        {
            RuleWatchdog watchdog = new();
            LiveWorld world = Timed(watchdog, w =>
            {
                LookForTheLimit(watchdog);
                end(w);
            });
            world.WaitsForLateEvents = true; // it does not wait for a late event: the world is over on this peer
            Assert.Equal(Sentence, Assert.Throws<SimulationException>(() => world.Step(At(1))).Message);
            Assert.Equal(SimTime.MaxValue, world.BlockedAt);
        }
    }

    [Theory]
    [InlineData("HearsContact")]
    [InlineData("HearsCrossing")]
    [InlineData("OnContact")]
    [InlineData("OnCrossing")]
    [InlineData("OnCommand")]
    [InlineData("OnSpawned")]
    [InlineData("OnRemoved")]
    [InlineData("OnTimer")]
    public void Look_AtAnyMethod_NamesIt(string method)
    {
        RuleWatchdog watchdog = new(SimDuration.FromSeconds(0.5));
        void In(string which)
        {
            if (which == method)
            {
                LookForTheLimit(watchdog);
            }
        }

        GivenRules rules = new()
        {
            HearsAll = true,
            Start = w => w.SetTimer(1, SimDuration.FromSeconds(2)),
            Hears = (_, _, _) =>
            {
                In("HearsContact");
                return true;
            },
            HearsSensor = (_, _) =>
            {
                In("HearsCrossing");
                return true;
            },
            Contact = (_, _) => In("OnContact"),
            Crossed = (_, _) => In("OnCrossing"),
            Command = (_, _, _) => In("OnCommand"),
            Spawned = (_, _) => In("OnSpawned"),
            Removed = (_, _) => In("OnRemoved"),
            Timer = (_, _) => In("OnTimer"),
        };
        LiveWorld world = new(Fall(rules), new SimulationOptions(), watchdog: watchdog);
        world.Submit(PlayerAction.Command(new GameCommand(1)).Stamp(At(0.5), 1, 1));
        world.Submit(PlayerAction.Spawn(Ball(0.125), V(8, 8)).Stamp(At(0.5), 1, 2));
        world.Submit(PlayerAction.Remove(new BodyId(1, 2, 0)).Stamp(At(0.75), 1, 3));
        SimulationException failure = Assert.Throws<SimulationException>(() => world.Step(At(3)));
        Assert.Matches($", in {method} for .*: it has not returned within 0.5s, and was given up\\.", failure.Message);
    }

    [Fact]
    public void Look_AtTheStart_EndsTheMakingOfTheWorld()
    {
        RuleWatchdog watchdog = new();
        GivenRules rules = new() { Start = _ => LookForTheLimit(watchdog) };
        SimulationException failure = Assert.Throws<SimulationException>(() => new LiveWorld(Fall(rules), new SimulationOptions(), watchdog: watchdog));
        Assert.Contains(", in OnStart: it has not returned", failure.Message, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("Time")]
    [InlineData("Elapsed")]
    [InlineData("State")]
    [InlineData("TryRead")]
    [InlineData("Within")]
    [InlineData("Random")]
    [InlineData("SetTimer")]
    [InlineData("CancelTimer")]
    [InlineData("Impulse")]
    [InlineData("Tell")]
    public void Asked_AfterTheCallWasGivenUp_TheWorldThrows(string member)
    {
        RuleWatchdog watchdog = new();
        Exception? thrown = null;
        LiveWorld world = Timed(watchdog, w =>
        {
            Ask(w); // the control: it does not throw before
            LookForTheLimit(watchdog);
            thrown = Record.Exception(() => Ask(w));
        });
        Assert.Throws<SimulationException>(() => world.Step(At(1)));
        Assert.Equal(Sentence, Assert.IsType<SimulationException>(thrown).Message);

        void Ask(RuleWorld w)
        {
            Span<BodyId> found = stackalloc BodyId[1];
            _ = member switch
            {
                "Time" => w.Time.Ticks,
                "Elapsed" => w.Elapsed.Ticks,
                "State" => w.State<GivenState>().Count,
                "TryRead" => w.TryRead(First, out _) ? 1 : 0,
                "Within" => w.Within(V(0), 1, found),
                "Random" => w.Random(6),
                "SetTimer" => Void(() => w.SetTimer(2, SimDuration.FromSeconds(1))),
                "CancelTimer" => w.CancelTimer(2) ? 1 : 0,
                "Impulse" => Void(() => w.Impulse(First, V(1))),
                _ => Void(() => w.Tell(1)),
            };
        }
    }

    [Fact]
    public void SyncTest_WhoseTwinIsInTheCall_EndsToo()
    {
        RuleWatchdog watchdog = new();
        int calls = 0;
        GivenRules rules = new()
        {
            Start = w => w.SetTimer(1, SimDuration.FromSeconds(0.25)),
            Timer = (_, _) =>
            {
                if (++calls == 2)
                {
                    LookForTheLimit(watchdog); // the world's own call was the first
                }
            },
        };
        LiveWorld world = new(Fall(rules), new SimulationOptions(history: SimDuration.FromSeconds(1), healing: HealingMode.SyncTest), watchdog: watchdog);
        Assert.Equal(Sentence, Assert.Throws<SimulationException>(() => world.Step(At(1))).Message);
        Assert.Throws<SimulationException>(() => world.Step(At(2)));
    }

    /// <summary>On the game's own thread nobody can be done without; what asks the world ends. The others go on, and agree.</summary>
    [Fact]
    public void Session_OnTheGamesOwnThread_EndsWithTheSentenceAndTheOthersGoOn()
    {
        SessionGroup? group = null;
        int stepped = -1;
        bool hangs = false;
        GivenRules rules = new()
        {
            Hears = (_, _, surface) => surface == 0,
            Contact = (w, _) =>
            {
                w.State<GivenState>().Count++;
                for (int n = 0; hangs && stepped == 1 && n < 1000; n++)
                {
                    group!.Sessions[1].Parts.World.Watchdog.Look();
                    w.Random();
                }
            },
        };
        group = new SessionGroup(
            Fall(rules), 3, LinkProfiles.Transatlantic, options: _ => new ClientOptions { Rules = [rules] })
        { BeforeStep = peer => stepped = peer };
        group.Connect();
        group.Run(1);
        Assert.Null(group.Difference());
        hangs = true;
        group.Do(2, PlayerAction.Impulse(First, V(0, 3)));
        group.Run(4);

        ClientSession ended = group.Client(1);
        Assert.Equal((SessionState.Ended, SessionEnd.Failed), (ended.State, ended.EndedBy));
        Assert.StartsWith("The world cannot be simulated any further. The rules 'given 1' failed at ", ended.EndReason, StringComparison.Ordinal);
        Assert.Matches(", in OnContact for .*: it has not returned within 10s, and was given up\\.$", ended.EndReason);
        Assert.Equal((SessionState.Running, SessionState.Running), (group.Host.State, group.Client(2).State));
        Assert.DoesNotContain(group.Host.Roster, member => member.Number == ended.Peer); // it said goodbye
        SimTime time = group.Host.World!.Simulation.SimulatedTo - SimDuration.FromSeconds(0.5);
        Assert.True(time > group.Host.World.Simulation.Start + SimDuration.FromSeconds(3));
        Simulation alone = group.Alone();
        Assert.Equal(alone.StateHash(time), group.Host.World.Simulation.StateHash(time));
        Assert.Equal(alone.StateHash(time), group.Client(2).World!.Simulation.StateHash(time));
        Assert.True(alone.TryReadRules(time, out GivenState state) && state.Count > 2);
    }

    [Fact]
    public void Limit_OutOfItsRange_IsRefusedWithTheRange()
    {
        foreach (double seconds in new[] { 0, 0.0999, 600.1 })
        {
            ArgumentOutOfRangeException refused = Assert.Throws<ArgumentOutOfRangeException>(() => new RuleWatchdog(SimDuration.FromSeconds(seconds)));
            Assert.Contains("from 100 ms to 600 s", refused.Message, StringComparison.Ordinal);
        }
    }

    private static void LookForTheLimit(RuleWatchdog watchdog)
    {
        for (int n = 0; n <= RuleWatchdog.LooksToGiveUp; n++)
        {
            watchdog.Look();
        }
    }

    private static long Void(Action act)
    {
        act();
        return 0;
    }

    private static LiveWorld Timed(RuleWatchdog? watchdog, Action<RuleWorld> timer) => new(
        Fall(new GivenRules { Start = w => w.SetTimer(1, SimDuration.FromSeconds(0.25)), Timer = (w, _) => timer(w) }), new SimulationOptions(history: SimDuration.FromSeconds(5)),
        watchdog: watchdog);

    private static Scene Fall(GameRules rules) => new SceneBuilder("fall").AddPlane("floor", Vector3D.Up, V(0), 0.9).AddBody("ball", Ball(e: 0.9), V(0, 2))
        .AddSensorPlane("low", Vector3D.Up, 1.0).WithSmallestRadius(0.125).WithRules(rules).Build();
}
