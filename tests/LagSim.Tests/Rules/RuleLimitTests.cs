using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Rules;

/// <summary>Each limit of rules: what is just allowed all happens, and one more ends the world with the sentence.</summary>
public sealed class RuleLimitTests
{
    private static readonly SimDuration Soon = SimDuration.FromSeconds(0.25);

    public static TheoryData<string> Names => new(Limits.Keys);

    /// <summary>For each limit: a call that does as much of something, how much is allowed, what the state counts of it at the end, and the
    /// sentence about one more.</summary>
    private static Dictionary<string, (Action<RuleWorld, int> Do, int Most, int Counted, string Sentence)> Limits { get; } = new()
    {
        ["timers"] = (SetTimers, 256, 256, "256 timers are set; no more may be."),
        ["acts"] = (Push, 64, 0, "A call did 64 things to bodies; it may do no more."),
        ["notices"] = (Tell, 16, 0, "A call told 16 things; it may tell no more."),
        ["reads"] = (ReadBodies, 4096, 4096, "A call read 4096 things of the world; it may read no more."),
        ["reads of regions"] = (ReadRegions, 2048, 2048, "A call read 4096 things of the world; it may read no more."), // each is one, and the body in it
    };

    [Theory]
    [MemberData(nameof(Names))]
    public void Rules_AtALimit_DoAllOfIt(string which)
    {
        (Action<RuleWorld, int> act, int most, int counted, _) = Limits[which];
        Simulation world = Run(Scene(act, most), 2);
        Assert.True(world.TryReadRules(At(2), out GivenState state));
        Assert.Equal(counted, state.Count);
        Assert.Equal(which == "acts" ? 64 : 0, Read(world, First, 2).Velocity.X);
        Assert.Equal(which == "notices" ? 16 : 0, RuleEvents.Of(world).Count);
    }

    [Theory]
    [MemberData(nameof(Names))]
    public void Rules_OneBeyondALimit_EndTheWorldWithTheSentence(string which)
    {
        (Action<RuleWorld, int> act, int most, _, string sentence) = Limits[which];
        Simulation world = new(Scene(act, most + 1), KeepAll);
        SimulationException failure = Assert.Throws<SimulationException>(() => world.AdvanceTo(At(2)));
        Assert.Equal($"The rules 'given 1' failed at 0.25s, round 0, in OnTimer for timer 1: {sentence}", failure.Message);
        Assert.Throws<InvalidOperationException>(() => world.AdvanceTo(At(3)));
    }

    /// <summary>States are kept as copies within the history: more of them than the memory has would end the process.</summary>
    [Fact]
    public void States_OfMoreBytesThanMayBeKept_EndTheWorldWithTheSentence()
    {
        GivenRules rules = new(bodies: true)
        {
            Start = w => w.SetTimer(1, SimDuration.FromSeconds(0.01)),
            Timer = (w, timer) =>
            {
                w.SetTimer(timer, timer == 1 && w.State<GivenState>().Count < 64 ? SimDuration.FromSeconds(0.01) : SimDuration.FromTicks(1 << 20));
                w.State<GivenState>().Count++;
                for (int n = 0; n < 64 && w.State<GivenState>().Count <= 64; n++)
                {
                    w.Spawn(Ball(0.125), V(100 + (4 * w.State<GivenState>().Count), 4 * n));
                }
            },
            HearsAll = true,
            Spawned = (w, body) => w.State<GivenState>(body).Count = 1,
        };
        Scene scene = new SceneBuilder("large").WithGravity(Floating).WithSmallestRadius(0.125).AddBody("ball", Ball(), V(0)).WithRules(rules).Build();
        Simulation world = new(scene, KeepAll);
        SimulationException failure = Assert.Throws<SimulationException>(() => world.AdvanceTo(At(2)));
        Assert.Matches("the states after the [0-9]+ calls within the history take [0-9]+ bytes, more than 268435456: of each that changes something the parts are kept that differ, by up to 1024 bytes[.]$", failure.Message);
    }

    /// <summary>What goes on for ever without a chain in one tick: a timer of a tick that sets itself again.</summary>
    [Fact]
    public void Calls_WithoutEnd_EndTheWorldWithTheSentence()
    {
        GivenRules rules = new() { Start = w => w.SetTimer(1, SimDuration.OneTick), Timer = (w, _) => w.SetTimer(1, SimDuration.OneTick) };
        Scene scene = new SceneBuilder("endless").WithGravity(Vector3D.Zero).WithSmallestRadius(0.5).WithRules(rules).Build();
        SimulationException failure = Assert.Throws<SimulationException>(() => new Simulation(scene, KeepAll).AdvanceTo(At(1)));
        Assert.EndsWith(": it is one more than the 262144 that may lie within the history.", failure.Message, StringComparison.Ordinal);
        Assert.StartsWith("The rules 'given 1' failed at ", failure.Message, StringComparison.Ordinal);
    }

    /// <summary>A history that moves on makes room: rules may be called as often as they like in the long run.</summary>
    [Fact]
    public void Calls_MoreThanTheLimitInAll_GoOnWhereTheHistoryMovesOn()
    {
        GivenRules rules = new()
        {
            Start = w => w.SetTimer(1, SimDuration.FromMilliseconds(1)),
            Timer = (w, _) =>
            {
                w.State<GivenState>().Count++;
                w.SetTimer(1, SimDuration.FromMilliseconds(1));
            },
        };
        Simulation world = new(new SceneBuilder("long").WithRules(rules).Build(), new SimulationOptions(history: SimDuration.FromSeconds(1)));
        world.AdvanceTo(At(300));
        Assert.True(world.TryReadRules(At(300), out GivenState state) && state.Count > RuleCaller.MaxCalls, $"{state.Count} calls");
    }

    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Hearing_ThatThrows_NamesTheRulesTheMethodAndTheEvent(bool ofContact)
    {
        GivenRules rules = ofContact
            ? new() { Hears = (_, _, _) => throw new InvalidOperationException("broken") }
            : new() { HearsSensor = (_, _) => throw new InvalidOperationException("broken") };
        Scene scene = new SceneBuilder("hears").AddPlane("floor", Vector3D.Up, V(0)).AddBody("ball", Ball(0.5), V(0, 1)).AddSensorPlane("low", Vector3D.Up, 0.75).WithRules(rules).Build();
        SimulationException failure = Assert.Throws<SimulationException>(() => new Simulation(scene, KeepAll).AdvanceTo(At(2)));
        Assert.StartsWith("The rules 'given 1' failed at 0.", failure.Message, StringComparison.Ordinal);
        Assert.EndsWith(": broken.", failure.Message, StringComparison.Ordinal);
        Assert.Contains(ofContact ? " in HearsContact for " : " in HearsCrossing for ", failure.Message, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("timer", -5, 0, 1, "has timer -5; numbers are at least 0")]
    [InlineData("round", 1, 7, 1, "has timer 1 due 1 ticks and 7 rounds after it")]
    [InlineData("late", 1, 0, long.MaxValue >> 1, "ticks are allowed|and no round are allowed")]
    [InlineData("twice", 1, 0, 1, "has timer 1 twice")]
    [InlineData("spawned", 1, 0, 1, "has rules that have spawned 18446744073709551615 bodies")]
    public void Snapshot_WithAStateThatRulesCannotHave_IsRefused(string what, int number, int round, long after, string sentence)
    {
        GivenRules rules = new();
        byte[] state = new byte[StateLayout.HeadBytes + (2 * StateLayout.TimerBytes) + rules.WorldBytes];
        long ticks = SimDuration.FromSeconds(1).Ticks;
        BitConverter.TryWriteBytes(state.AsSpan(0), what == "spawned" ? ulong.MaxValue : 3ul);
        BitConverter.TryWriteBytes(state.AsSpan(8), 2);
        WriteTimer(state.AsSpan(StateLayout.HeadBytes), ticks, 0, what == "twice" ? 1 : 0);
        WriteTimer(state.AsSpan(StateLayout.HeadBytes + StateLayout.TimerBytes), ticks + after, round, number);
        string message = Assert.Throws<SceneException>(() => StateLayout.Check(state, rules, ticks)).Message;
        Assert.Contains(sentence.Split('|')[^1], message, StringComparison.Ordinal);

        // The control: the same with nothing wrong.
        BitConverter.TryWriteBytes(state.AsSpan(0), 3ul);
        WriteTimer(state.AsSpan(StateLayout.HeadBytes), ticks, 0, 0);
        WriteTimer(state.AsSpan(StateLayout.HeadBytes + StateLayout.TimerBytes), ticks + 1, 0, 1);
        StateLayout.Check(state, rules, ticks);

        static void WriteTimer(Span<byte> to, long at, int round, int number)
        {
            BitConverter.TryWriteBytes(to, at);
            BitConverter.TryWriteBytes(to[8..], round);
            BitConverter.TryWriteBytes(to[12..], number);
        }
    }

    [Theory]
    [InlineData(0, 0.5)]
    [InlineData(int.MaxValue, 1 << 20)]
    public void SetTimer_AtTheEndsOfItsRanges_IsSet(int number, double seconds)
    {
        int before = 0;
        Simulation world = Run(Scene((w, _) => w.SetTimer(number, SimDuration.FromSeconds(seconds)), 1, (w, timer) => before += timer == number ? 1 : 0), 1);
        Assert.Equal(seconds < 1 ? 1 : 0, before);
        Assert.Equal(seconds < 1 ? 0 : 1, StateLayout.Timers(world.Engine.Rules!.Current.Bytes));
    }

    [Theory]
    [InlineData(-1, 1, "Timer -1 is set to 1s from now")]
    [InlineData(2, -1, "Timer 2 is set to -1s from now")]
    [InlineData(2, (1 << 20) + 1, "Timer 2 is set to 1048577s from now")]
    public void SetTimer_OutOfARange_EndsTheWorldWithTheSentence(int number, double seconds, string value)
    {
        Simulation world = new(Scene((w, _) => w.SetTimer(number, SimDuration.FromSeconds(seconds)), 1), KeepAll);
        SimulationException failure = Assert.Throws<SimulationException>(() => world.AdvanceTo(At(2)));
        Assert.EndsWith($": {value}; its number must be at least 0, and the time 0 s to 1048576s.", failure.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void State_OfAsManyBodiesAsMayHaveOne_IsThere_AndOfOneMoreEndsTheWorld()
    {
        SceneBuilder builder = new SceneBuilder("many").WithGravity(Floating);
        for (int n = 0; n <= 4096; n++)
        {
            builder.AddBody(FormattableString.Invariant($"ball {n}"), Ball(0.25), V(n % 64 * 2, n / 64 * 2));
        }

        GivenRules rules = new(bodies: true)
        {
            Start = w => w.SetTimer(1, Soon),
            Timer = (w, timer) =>
            {
                for (int n = 0; timer == 1 && n < 4096; n++)
                {
                    w.State<GivenState>(BodyId.OfScene(n)).Count = n;
                }

                if (timer == 2)
                {
                    w.State<GivenState>(BodyId.OfScene(4095)).Count++; // the control: one that has a state keeps it
                    w.State<GivenState>(BodyId.OfScene(4096)).Count++;
                }

                w.SetTimer(2, SimDuration.FromSeconds(1));
            },
        };
        Simulation world = new(builder.WithRules(rules).Build(), KeepAll);
        world.AdvanceTo(At(1));
        Assert.All(Enumerable.Range(0, 4096), n => Assert.True(world.TryReadRules(BodyId.OfScene(n), At(1), out GivenState state) && state.Count == n));
        Assert.False(world.TryReadRules(BodyId.OfScene(4096), At(1), out GivenState _));
        Assert.EndsWith(
            ": 4096 bodies have a state; no more may have one.", Assert.Throws<SimulationException>(() => world.AdvanceTo(At(2))).Message, StringComparison.Ordinal);
    }

    [Fact]
    public void State_OfTheLargestSizes_IsDeclared_AndOneByteMoreIsRefused()
    {
        Assert.Equal((16_384, 256), (new Declares<World, Body>().WorldBytes, new Declares<World, Body>().BodyBytes));
        Assert.Equal(
            $"The state of the world, {typeof(TooLargeWorld)}, takes 16385 bytes; at most 16384 are allowed.",
            Assert.Throws<SceneException>(() => new Declares<TooLargeWorld, Body>()).Message);
        Assert.Equal(
            $"The state of a body, {typeof(TooLargeBody)}, takes 257 bytes; at most 256 are allowed.",
            Assert.Throws<SceneException>(() => new Declares<World, TooLargeBody>()).Message);
    }

    [Theory]
    [InlineData(-1)]
    [InlineData(double.NaN)]
    [InlineData(double.PositiveInfinity)]
    public void Within_OfNoSphere_EndsTheWorldWithTheSentence(double radius)
    {
        Simulation world = new(Scene((w, _) => w.Within(V(1), radius, default), 1), KeepAll);
        Assert.Contains(
            "both must be finite, and the radius at least zero.", Assert.Throws<SimulationException>(() => world.AdvanceTo(At(2))).Message, StringComparison.Ordinal);
    }

    private static void SetTimers(RuleWorld world, int count)
    {
        for (int n = 0; n < count; n++)
        {
            world.SetTimer(10 + n, Soon);
            world.SetTimer(10 + n, Soon + Soon); // in the place of that: one is set, not two
        }
    }

    private static void Push(RuleWorld world, int count) => Repeat(count, () => world.Impulse(First, V(1)));

    private static void Tell(RuleWorld world, int count) => Repeat(count, () => world.Tell(1));

    private static void ReadBodies(RuleWorld world, int count) => Repeat(count, () => world.State<GivenState>().Count += world.TryRead(First, out _) ? 1 : 0);

    private static void ReadRegions(RuleWorld world, int count) => Repeat(count, () => world.State<GivenState>().Count += world.Within(V(0), 1, default));

    private static void Repeat(int count, Action act)
    {
        for (int n = 0; n < count; n++)
        {
            act();
        }
    }

    /// <summary>A ball at rest, and rules that do as much of something a quarter of a second after the start. Other timers are counted.</summary>
    private static Scene Scene(Action<RuleWorld, int> act, int count, Action<RuleWorld, int>? other = null) => new SceneBuilder("limits").WithGravity(Floating)
        .AddBody("ball", Ball(), V(0)).WithRules(new GivenRules
        {
            Start = w => w.SetTimer(1, Soon),
            Timer = (w, timer) =>
            {
                if (timer == 1)
                {
                    act(w, count);
                    return;
                }

                w.State<GivenState>().Count++;
                other?.Invoke(w, timer);
            },
        }).Build();

#pragma warning disable CS0649 // sizes are all that matters
    [System.Runtime.CompilerServices.InlineArray(16_384)]
    private struct World
    {
        internal byte First;
    }

    [System.Runtime.CompilerServices.InlineArray(16_385)]
    private struct TooLargeWorld
    {
        internal byte First;
    }

    [System.Runtime.CompilerServices.InlineArray(256)]
    private struct Body
    {
        internal byte First;
    }

    [System.Runtime.CompilerServices.InlineArray(257)]
    private struct TooLargeBody
    {
        internal byte First;
    }
#pragma warning restore CS0649

    private sealed class Declares<TWorld, TBody> : GameRules
        where TWorld : unmanaged
        where TBody : unmanaged
    {
        internal Declares()
            : base("declares", 1)
        {
            WithWorldState<TWorld>();
            WithBodyState<TBody>();
        }
    }
}
