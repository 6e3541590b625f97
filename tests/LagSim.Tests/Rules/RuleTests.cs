using System;
using System.Collections.Generic;
using System.Collections.Immutable;
using System.Linq;
using LagSim.Events;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Rules;

/// <summary>What rules are called for, what they may do, and what is refused.</summary>
public sealed class RuleTests
{
    [Fact]
    public void OnContact_OfTheSurfaceThatIsHeard_CountsBounces()
    {
        Simulation world = Run(Scene(new GivenRules { Hears = (_, _, surface) => surface == 0, Contact = (w, _) => w.State<GivenState>().Count++ }), 3);
        int bounces = Impacts(world, First).Count;
        Assert.True(bounces > 1);
        Assert.Equal(bounces, Count(world, 3));
        Assert.Equal(0, Count(world, 0.1));
        Assert.Equal(0, Count(Run(Scene(new GivenRules { Contact = (w, _) => w.State<GivenState>().Count++ }), 3), 3)); // none is heard
    }

    [Fact]
    public void SetTimer_CountsDown_ExactlyThen()
    {
        GivenRules rules = new()
        {
            Start = w => w.SetTimer(1, SimDuration.FromSeconds(0.5)),
            Timer = (w, _) =>
            {
                if (++w.State<GivenState>().Count < 3)
                {
                    w.SetTimer(1, SimDuration.FromSeconds(0.5));
                }
            },
        };
        Simulation world = Run(Scene(rules), 4);
        Assert.Equal(0, CountAt(world, At(0.5) - SimDuration.OneTick));
        Assert.Equal(1, CountAt(world, At(0.5)));
        Assert.Equal(3, Count(world, 4));
    }

    /// <summary>Rules teleport a ball in round 2 of a tick; a spawn that comes late at that tick strikes it in round 1, while the ball is known
    /// beyond it by a round of the same tick. It had come there in that tick, too.</summary>
    [Theory]
    [InlineData(64)]
    [InlineData(0)]
    public void LateSpawn_AtTheTickOfATeleportByRules_StrikesInTheRoundBefore(int bruteForceLimit)
    {
        GivenRules rules = new()
        {
            Start = w => w.SetTimer(1, SimDuration.FromSeconds(1)),
            Timer = (w, timer) =>
            {
                if (timer == 1)
                {
                    w.Teleport(First, V(0));
                    w.SetTimer(2, SimDuration.Zero);
                }
                else if (timer == 2)
                {
                    w.SetTimer(3, SimDuration.Zero);
                }
                else
                {
                    w.Teleport(First, V(50));
                }
            },
        };
        Scene scene = new SceneBuilder("small").WithGravity(Floating).AddBody("ball", Ball(0.5), V(-50)).WithRules(rules).Build();
        ExternalEvent spawn = PlayerAction.Spawn(Ball(0.5), V(0.8), V(-1)).Stamp(At(1), 1, 1);
        Simulation onTime = Run(scene, 2, [spawn]);
        Simulation late = new(scene, KeepAll.WithBruteForceLimit(bruteForceLimit));
        late.AdvanceTo(At(2));
        late.Submit(spawn);
        late.AdvanceTo(At(2));
        Assert.Equal(onTime.StateHash(At(2)), late.StateHash(At(2)));
        Assert.NotEqual(Read(Run(scene, 2, [PlayerAction.Spawn(Ball(0.5), V(1.8), V(-1)).Stamp(At(1), 1, 1)]), spawn.Body, 2).Velocity, Read(late, spawn.Body, 2).Velocity); // it was struck
    }

    [Fact]
    public void CancelTimer_IsNotCalled()
    {
        GivenRules rules = new()
        {
            Start = w =>
            {
                w.SetTimer(1, SimDuration.FromSeconds(1));
                Assert.True(w.CancelTimer(1));
                Assert.False(w.CancelTimer(1));
            },
            Timer = (w, _) => w.State<GivenState>().Count++,
        };
        Assert.Equal(0, Count(Run(Scene(rules), 2), 2));
    }

    [Fact]
    public void OnCommand_LateOrOnTime_SameState()
    {
        GivenRules rules = new() { Command = (w, player, command) => w.State<GivenState>().Count = (w.State<GivenState>().Count * 10) + (player * command.Number) };
        ExternalEvent first = PlayerAction.Command(new GameCommand(2)).Stamp(At(0.5), 1, 1);
        ExternalEvent second = PlayerAction.Command(new GameCommand(3)).Stamp(At(0.7), 2, 1);
        Simulation onTime = Run(Scene(rules), 2, [first, second]);
        Simulation late = Run(Scene(rules), 2, [second]);
        Assert.Equal(SubmitResult.RolledBack, late.Submit(first));
        Assert.Equal(SubmitResult.Duplicate, late.Submit(first));
        late.AdvanceTo(At(3));
        onTime.AdvanceTo(At(3));
        Assert.Equal(26, Count(onTime, 3));
        Assert.Equal(onTime.StateHash(At(3)), late.StateHash(At(3)));
        Assert.True(late.Retract(first));
        Assert.False(late.Retract(first));
        late.AdvanceTo(At(3));
        Assert.Equal(6, Count(late, 3));
    }

    [Fact]
    public void Acts_HappenAtThatTickInTheNextRound()
    {
        GivenRules rules = new()
        {
            Command = (w, _, _) =>
            {
                w.Teleport(First, V(0, 5, 0), V(1, 0, 0));
                w.Spawn(Ball(0.25), V(3, 3, 0));
            },
        };
        Simulation world = Run(Scene(rules), 1, [PlayerAction.Command(new GameCommand(1)).Stamp(At(0.25), 1, 1)]);
        BodyState state = Read(world, First, At(0.25));
        Assert.Equal(V(0, 5, 0), state.Position);
        Assert.Equal(V(1, 0, 0), state.Velocity);
        EventKey key = world.Timeline(First).Last(entry => entry.Key.Kind == EventKind.Teleport).Key;
        Assert.Equal(1u, key.Round);
        Assert.Equal(SceneRules.Peer, key.Peer);
        Assert.NotEqual(MotionLaw.Absent, Read(world, new BodyId(SceneRules.Peer, 1, 0), At(0.25)).Motion);
        Assert.Equal(MotionLaw.Absent, Read(world, new BodyId(SceneRules.Peer, 1, 0), At(0.25) - SimDuration.OneTick).Motion);
    }

    [Fact]
    public void TryRead_OfABodyThatIsKnownBeyond_SeesItAtTheCall()
    {
        GivenRules rules = new() { Command = (w, _, _) => w.State<GivenState>().Height = w.TryRead(First, out BodyState state) ? state.Position.Y : -1 };
        Simulation world = Run(Scene(rules), 2);
        world.Submit(PlayerAction.Command(new GameCommand(1)).Stamp(At(0.5), 1, 1));
        world.AdvanceTo(At(2));
        Assert.True(world.TryReadRules(At(2), out GivenState score));
        Assert.Equal(Read(world, First, At(0.5)).Position.Y, score.Height);
    }

    [Fact]
    public void LateEvent_OfABodyThatNoCallRead_MakesNoCallAgain()
    {
        GivenRules rules = new()
        {
            Start = w => w.SetTimer(1, SimDuration.FromSeconds(0.1)),
            Timer = (w, timer) =>
            {
                w.SetTimer(timer, SimDuration.FromSeconds(0.1));
                w.State<GivenState>().Height += w.TryRead(First, out BodyState state) ? state.Position.Y : 0;
            },
        };
        Scene scene = new SceneBuilder("two").WithGravity(Floating).AddBody("read", Ball(), V(0, 0, 0), V(0.5)).AddBody("other", Ball(), V(0, 10, 0)).WithRules(rules).Build();
        Simulation world = Run(scene, 2);
        long made = world.Engine.Caller!.Made;
        world.Submit(PlayerAction.Impulse(Second, V(0, 3, 0)).Stamp(At(0.55), 1, 1));
        world.AdvanceTo(At(2));
        Assert.True(made > 15);
        Assert.Equal(made, world.Engine.Caller.Made);
        world.Submit(PlayerAction.Impulse(First, V(0, 3, 0)).Stamp(At(0.55), 1, 2));
        world.AdvanceTo(At(2));
        Assert.Equal(made + made - 6, world.Engine.Caller.Made); // all but the start and those before 0.55 s
    }

    [Fact]
    public void Acts_OfCallsOfOneTickThatALateCallComesBefore_AreAllThere()
    {
        GivenRules rules = new() { Command = (w, player, _) => w.SetVelocity(First, V(player)) };
        ExternalEvent[] commands = [.. Enumerable.Range(1, 3).Select(n => PlayerAction.Command(new GameCommand(1)).Stamp(At(0.25), (byte)n, 1))];
        Simulation onTime = Run(Scene(rules), 1, commands);
        Simulation late = Run(Scene(rules), 1, [commands[1], commands[2]]);
        late.Submit(commands[0]);
        late.AdvanceTo(At(1));
        Assert.Equal([1u, 2, 3], late.Timeline(First).Where(entry => entry.Key.Peer == SceneRules.Peer).Select(entry => entry.Key.Sequence));
        Assert.Equal(onTime.EventHash(At(1)), late.EventHash(At(1)));
        late.Retract(commands[0]);
        late.AdvanceTo(At(1));
        Assert.Equal([1u, 2], late.Timeline(First).Where(entry => entry.Key.Peer == SceneRules.Peer).Select(entry => entry.Key.Sequence));
    }

    [Fact]
    public void Random_IsOfTheSeedAndTheEvent()
    {
        GivenRules rules = new() { Command = (w, _, _) => w.State<GivenState>().Draw = w.Random() ^ (ulong)w.Random(6) };
        ExternalEvent one = PlayerAction.Command(new GameCommand(1)).Stamp(At(0.5), 1, 1);
        ExternalEvent other = PlayerAction.Command(new GameCommand(1)).Stamp(At(0.5), 1, 2);
        ulong[] draws = [Draw(0, one), Draw(0, one), Draw(7, one), Draw(0, other)];
        Assert.Equal(draws[0], draws[1]);
        Assert.Equal(3, draws.Distinct().Count());

        ulong Draw(ulong seed, ExternalEvent command)
        {
            Run(Scene(rules, seed), 1, [command]).TryReadRules(At(1), out GivenState score);
            return score.Draw;
        }
    }

    [Fact]
    public void BodyState_GoesWithTheBody()
    {
        GivenRules rules = new(bodies: true)
        {
            HearsAll = true,
            Spawned = (w, body) => w.State<GivenState>(body).Count = 5,
            Removed = (w, body) => w.State<GivenState>().Count += w.State<GivenState>(body).Count,
        };
        BodyId spawned = new(1, 1, 0);
        Simulation world = Run(Scene(rules), 2, [
            PlayerAction.Spawn(Ball(), V(4, 4)).Stamp(At(0.5), 1, 1), PlayerAction.Remove(spawned).Stamp(At(1), 1, 2)]);
        Assert.True(world.TryReadRules(spawned, At(0.75), out GivenState there));
        Assert.Equal(5, there.Count);
        Assert.False(world.TryReadRules(spawned, At(1), out GivenState _));
        Assert.Equal(5, Count(world, 2));
    }

    /// <summary>A body that never had a state has one of zeros to the last, like any other.</summary>
    [Fact]
    public void BodyState_OfABodyThatIsRemovedAndNeverHadOne_IsZero()
    {
        GivenRules rules = new(bodies: true) { HearsAll = true, Removed = (w, body) => w.State<GivenState>().Count = 7 + w.State<GivenState>(body).Count };
        Simulation world = Run(Scene(rules), 1, [PlayerAction.Remove(First).Stamp(At(0.5), 1, 1)]);
        Assert.Equal(7, Count(world, 1));
        Assert.False(world.TryReadRules(First, At(1), out GivenState _));
    }

    /// <summary>Across the edge of a periodic box a body is as near as it is to its image.</summary>
    [Theory]
    [InlineData(0.05, 1)]
    [InlineData(0.5, 0)]
    public void Within_AcrossTheEdgeOfAPeriodicBox_FindsTheNearestImage(double x, int expected)
    {
        GivenRules rules = new() { Command = (w, _, _) => w.State<GivenState>().Count = w.Within(V(x, 5, 5), 0.5, default) };
        Scene scene = new SceneBuilder("box").WithGravity(V(0)).WithPeriodicBox(V(10, 10, 10)).AddBody("far", Ball(0.25), V(9.9, 5, 5)).WithRules(rules).Build();
        Assert.Equal(expected, Count(Run(scene, 1, [PlayerAction.Command(new GameCommand(1)).Stamp(At(0.5), 1, 1)]), 1));
    }

    [Theory]
    [MemberData(nameof(Failures))]
    public void Rules_ThatFail_AreNamedWithCallAndInstant(string which, string part)
    {
        Simulation world = new(Scene(Failing[which]), KeepAll);
        SimulationException failure = Assert.Throws<SimulationException>(() => world.AdvanceTo(At(1)));
        Assert.Contains("'given 1'", failure.Message, StringComparison.Ordinal);
        Assert.Contains("0.25", failure.Message, StringComparison.Ordinal);
        Assert.Contains(part, failure.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Rules_ThatFail_InAWorldThatWaits_BlockItUntilTheCauseIsGone()
    {
        GivenRules rules = new() { Command = (_, _, command) => throw new InvalidOperationException("No such command.") };
        Simulation world = new(Scene(rules), KeepAll) { WaitsForLateEvents = true };
        ExternalEvent bad = PlayerAction.Command(new GameCommand(1)).Stamp(At(0.5), 1, 1);
        world.Submit(bad);
        long events = long.MaxValue;
        Assert.False(world.TryAdvanceTo(At(1), ref events));
        Assert.Equal(At(0.5), world.Engine.Loop.BlockedAt);
        Assert.True(world.Retract(bad));
        Assert.True(world.TryAdvanceTo(At(1), ref events));
        Assert.Equal(Run(Scene(rules), 1).StateHash(At(1)), world.StateHash(At(1)));
    }

    [Fact]
    public void State_WithPaddingOrTooLarge_IsRefused()
    {
        Assert.Contains("fields use 9", Assert.Throws<SceneException>(() => new Declares<Padded>()).Message, StringComparison.Ordinal);
        Assert.Contains("at most 16384", Assert.Throws<SceneException>(() => new Declares<Large>()).Message, StringComparison.Ordinal);
        Assert.Equal(24, new Declares<GivenState>().WorldBytes);
        Assert.Equal(32, new Declares<Nested>().WorldBytes);
    }

    [Fact]
    public void Command_WithoutRulesOrOfTheRulesThemselves_IsRefused()
    {
        ExternalEvent command = PlayerAction.Command(new GameCommand(1)).Stamp(At(0.5), 1, 1);
        Assert.Contains("has no rules", Assert.Throws<SceneException>(() => new Simulation(Drop(1, 1)).Submit(command)).Message, StringComparison.Ordinal);
        Simulation world = new(Scene(new GivenRules()));
        Assert.Contains("of peer 255", Assert.Throws<SceneException>(() => world.Submit(PlayerAction.Command(new GameCommand(1)).Stamp(At(0.5), 255, 1))).Message, StringComparison.Ordinal);
        Assert.Contains("counts its events from 1", Assert.Throws<SceneException>(() => world.Submit(PlayerAction.Command(new GameCommand(1)).Stamp(At(0.5), 1, 0))).Message,
            StringComparison.Ordinal);
        Assert.Throws<ArgumentException>(() => new GameCommand(1, new byte[GameCommand.MaxBytes + 1]));
        Assert.Throws<ArgumentOutOfRangeException>(() => new GameCommand(65_536));
    }

    [Fact]
    public void Command_OfAValue_ReadsItBack()
    {
        GameCommand command = GameCommand.Of(3, new GivenState { Count = 7, Draw = 9 });
        Assert.True(command.TryRead(out GivenState score));
        Assert.Equal((7, 9UL), (score.Count, score.Draw));
        Assert.False(command.TryRead(out int _));
        Assert.Equal(command, GameCommand.Of(3, score));
        Assert.NotEqual(command, GameCommand.Of(4, score));
    }

    [Fact]
    [Trait("Time", "real")] // one of the rules reads a clock
    public void SyncTest_SeesRulesThatAreNoFunctionOfTheWorld()
    {
        int calls = 0;
        long Stamp() => System.Diagnostics.Stopwatch.GetTimestamp();
        GivenRules[] faulty =
        [
            new() { Contact = (w, _) => w.State<GivenState>().Count = ++calls, Hears = (_, _, _) => true },
            new() { Contact = (w, _) => w.State<GivenState>().Draw = (ulong)Stamp(), Hears = (_, _, _) => true },
            new() { Contact = (w, _) => w.State<GivenState>().Count = FirstOfASet(), Hears = (_, _, _) => true },
        ];
        foreach (GivenRules rules in faulty)
        {
            Simulation world = new(Scene(rules), new SimulationOptions(default, SimDuration.MaxValue, healing: HealingMode.SyncTest));
            Assert.Contains("sync test", Assert.Throws<SimulationException>(() => world.AdvanceTo(At(3))).Message, StringComparison.Ordinal);
        }

        GivenRules sound = new() { Contact = (w, _) => w.State<GivenState>().Count++, Hears = (_, _, _) => true };
        Simulation right = new(Scene(sound), new SimulationOptions(default, SimDuration.MaxValue, healing: HealingMode.SyncTest));
        right.AdvanceTo(At(3));
        right.Submit(PlayerAction.Impulse(First, V(0, 2, 0)).Stamp(At(1), 1, 1));
        right.AdvanceTo(At(3));
    }

    [Fact]
    public void Hash_OfASceneWithRules_IsOfNameVersionAndSeed()
    {
        ulong[] hashes = [Scene(null!).Hash, Scene(new GivenRules()).Hash, Scene(new GivenRules(), 3).Hash, Scene(new GivenRules(bodies: true)).Hash];
        Assert.Equal(4, hashes.Distinct().Count());
        Assert.Equal(hashes[1], Scene(new GivenRules()).Hash);
    }

    public static TheoryData<string, string> Failures() => new()
    {
        { "throws", "broken" }, { "timers", "may lie within the history" }, { "acts", "did 64 things" },
        { "wrong state", "the rules declared" }, { "absent", "is not there" }, { "delay", "Timer 1 is set to" }, { "limit", "random number below 0" },
    };

    private static readonly Dictionary<string, GivenRules> Failing = new()
    {
        ["throws"] = At025(_ => throw new InvalidOperationException("broken")),
        ["timers"] = new() { Start = Later, Timer = (w, t) => w.SetTimer(t, SimDuration.Zero) },
        ["acts"] = At025(w =>
        {
            for (int n = 0; n < 65; n++)
            {
                w.Impulse(First, V(1));
            }
        }),
        ["wrong state"] = At025(w => w.State<long>()++),
        ["absent"] = new(bodies: true) { Start = Later, Timer = (w, _) => w.State<GivenState>(new BodyId(3, 3, 0)).Count++ },
        ["delay"] = At025(w => w.SetTimer(1, SimDuration.FromSeconds(-1))),
        ["limit"] = At025(w => w.Random(0)),
    };

    /// <summary>Which of sixteen objects a set lists first: it lists them by their hashes, which no object has of another world.</summary>
    private static int FirstOfASet()
    {
        object[] objects = [.. Enumerable.Range(0, 16).Select(_ => new object())];
        return Array.IndexOf(objects, ImmutableHashSet.Create(objects).First());
    }

    private static GivenRules At025(Action<RuleWorld> act) => new() { Start = Later, Timer = (w, _) => act(w) };

    private static void Later(RuleWorld world) => world.SetTimer(1, SimDuration.FromSeconds(0.25));

    private static Scene Scene(GameRules? rules, ulong seed = 0)
    {
        SceneBuilder builder = new SceneBuilder("ruled").AddPlane("floor", Vector3D.Up, V(0), 0.8).AddBody("ball", Ball(e: 0.8), V(0, 2)).WithSmallestRadius(0.125).WithSeed(seed);
        return (rules is null ? builder : builder.WithRules(rules)).Build();
    }

    private static int Count(Simulation world, double seconds) => CountAt(world, At(seconds));

    private static int CountAt(Simulation world, SimTime time) => world.TryReadRules(time, out GivenState score) ? score.Count : -1;

#pragma warning disable CS0649 // sizes are all that matters of some
    private struct Padded
    {
        internal long Wide;
        internal byte Narrow;
    }

    private struct Nested
    {
        internal GivenState GivenState;
        internal SimTime Time;
    }

    [System.Runtime.CompilerServices.InlineArray(16_385)]
    private struct Large
    {
        internal byte First;
    }

#pragma warning restore CS0649

    private sealed class Declares<T> : GameRules
        where T : unmanaged
    {
        internal Declares()
            : base("declares", 1) => WithWorldState<T>();
    }
}
