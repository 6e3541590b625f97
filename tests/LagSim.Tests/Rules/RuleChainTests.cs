using System;
using System.Linq;
using LagSim.Events;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Rules;

/// <summary>Chains of rules that answer what they cause themselves end in their tick by a stated rule, are told, and leave the world.</summary>
public sealed class RuleChainTests
{
    private static readonly SimDuration Soon = SimDuration.FromSeconds(0.25);

    /// <summary>Each body that rules spawn brings another, at its own tick: 64 of them come, and the 65th does not.</summary>
    [Fact]
    public void Chain_OfRoundsWithoutEnd_EndsAfterAllOfThemAndIsTold()
    {
        GivenRules rules = new() { Start = w => w.SetTimer(1, Soon), Timer = (w, _) => SpawnOne(w), HearsAll = true, Spawned = (w, _) => SpawnOne(w) };
        Simulation world = Run(Empty(rules), 2);
        Assert.Equal(64, Bodies(world).Count(body => Read(world, body, 2).Motion != MotionLaw.Absent));
        (EventKey key, int _, RuleNotice told) = Assert.Single(RuleEvents.Of(world));
        Assert.Equal((RuleNotice.ChainEnded, 1L, 64u, At(0.25)), (told.Code, told.Value, key.Round, key.Time));
        Assert.Equal(
            "At 0.25s, round 64, the rules 'given 1' in OnSpawned for body (255.64.0) wanted to do more, but in one tick rules may cause 64 rounds of events,"
                + " do 16384 things to bodies and hear contacts and crossings among 65536 calls; the rest had no effect.",
            told.Sentence!.Replace(world.Scene.Describe(key.Body), "body (255.64.0)", StringComparison.Ordinal));
    }

    /// <summary>A timer without delay is due in the next round, and after 64 of them in the next tick.</summary>
    [Theory]
    [InlineData(64)]
    [InlineData(65)]
    public void Chain_OfTimers_GoesOnInTheNextTick(int count)
    {
        GivenRules rules = new()
        {
            Start = w => w.SetTimer(1, Soon),
            Timer = (w, _) =>
            {
                if (w.State<GivenState>().Count++ < count)
                {
                    w.SetTimer(1, SimDuration.Zero);
                }
            },
        };
        Simulation world = Run(Empty(rules), 2);
        Assert.Equal(65, CountAt(world, At(0.25)));
        Assert.Equal(count + 1, CountAt(world, At(0.25) + SimDuration.OneTick));
        Assert.Equal(count - 64, RuleEvents.Of(world).Count);
    }

    /// <summary>Each body brings two more: their number doubles until rules have done all that they may in a tick.</summary>
    [Fact]
    public void Chain_OfActsThatDouble_EndsAtAllOfThem()
    {
        GivenRules rules = new() { Start = w => w.SetTimer(1, Soon), Timer = (w, _) => SpawnTwo(w), HearsAll = true, Spawned = (w, _) => SpawnTwo(w) };
        Simulation world = new(Empty(rules), KeepAll);
        world.AdvanceTo(At(0.25));
        Assert.Equal(RuleTally.MaxActs, world.BodyCount);
        Assert.Single(RuleEvents.Of(world));

        static void SpawnTwo(RuleWorld world)
        {
            SpawnOne(world);
            SpawnOne(world);
        }
    }

    /// <summary>In a call that is too much rules are told so, and can do it later.</summary>
    [Fact]
    public void IsChainOver_InTheCallWhoseActsHaveNoEffect_LetsItBeDoneLater()
    {
        GivenRules rules = new()
        {
            Start = w => w.SetTimer(1, Soon),
            Timer = (w, _) => SpawnOne(w),
            HearsAll = true,
            Spawned = (w, body) =>
            {
                if (w.IsChainOver)
                {
                    w.SetTimer(1, Soon);
                }
                else if (w.State<GivenState>().Count < 100)
                {
                    SpawnOne(w);
                }
            },
        };
        Simulation world = Run(Empty(rules), 2);
        Assert.Equal((64, 100), (Present(0.3), Present(1)));
        Assert.Empty(RuleEvents.Of(world)); // it wanted nothing more

        int Present(double at) => Bodies(world).Count(body => Read(world, body, at).Motion != MotionLaw.Absent);
    }

    /// <summary>In the last call of a round one act more is made where a late event has moved another body: so a call of the next round, which
    /// begins with the same and reads the same, may make one less.</summary>
    [Theory]
    [InlineData(RuleFault.None, true)]
    [InlineData(RuleFault.IgnoresTally, false)]
    internal void Acts_OfACallOfTheNextRound_HangOnWhatIsDoneBefore(RuleFault fault, bool isRight)
    {
        const int Last = RuleWorld.MaxTimers - 1;
        GivenRules rules = new()
        {
            Start = w =>
            {
                for (int timer = 0; timer <= Last; timer++)
                {
                    w.SetTimer(timer, Soon);
                }
            },
            Timer = (w, timer) =>
            {
                if (timer == 1)
                {
                    SpawnOne(w);
                }

                int more = timer == Last && w.TryRead(Second, out BodyState other) && other.Velocity.Y > 0 ? 1 : 0;
                Push(w, timer switch { 0 => 1, 1 or Last => RuleWorld.MaxActs - 1 + more, _ => RuleWorld.MaxActs });
            },
            HearsAll = true,
            Spawned = (w, _) => Push(w, RuleWorld.MaxActs),
        };
        Scene scene = new SceneBuilder("acts").WithGravity(Floating).WithSmallestRadius(0.125).AddBody("ball", Ball(), V(0, 5)).AddBody("other", Ball(), V(0, 9))
            .WithRules(rules).Build();
        ExternalEvent push = PlayerAction.SetVelocity(Second, V(0, 1)).Stamp(At(0.1), 1, 1);
        Simulation onTime = Run(scene, 0.3, [push]);
        Simulation late = new(scene, KeepAll.WithParts(new FaultyRules(fault)));
        late.AdvanceTo(At(0.3));
        Assert.Equal(RuleTally.MaxActs - 1, Read(late, First, 0.3).Velocity.X); // all of them pushes but one
        Assert.Empty(RuleEvents.Of(late));
        late.Submit(push);
        late.AdvanceTo(At(0.3));
        Assert.Equal(RuleTally.MaxActs - 1, Read(onTime, First, 0.3).Velocity.X);
        Assert.Single(RuleEvents.Of(onTime));
        Assert.Equal(isRight, onTime.StateHash(At(0.3)) == late.StateHash(At(0.3)) && RuleComparison.FirstDifference(onTime.Engine, late.Engine) is null);
    }

    /// <summary>What each call is numbered after is what all before it at its tick did.</summary>
    [Fact]
    public void Tally_OfEveryCallOfDrawnWorlds_IsTheSumOfThoseBefore()
    {
        int later = 0;
        for (int seed = 1; seed <= 40; seed++)
        {
            RuleLog log = new Determinism.RandomWorld(seed, sensors: true, rules: true).Shuffled(seed).Engine.Rules!;
            for (int n = 0; n < log.Position; n++)
            {
                int before = Enumerable.Range(0, n).Where(m => log[m].Key.Time == log[n].Key.Time && log[m].Key.Round == log[n].Key.Round).Sum(m => log[m].Acts.Count);
                Assert.Equal((uint)before, log[n].Before.First);
                later += before > 0 ? 1 : 0;
            }
        }

        Assert.True(later > 5, $"{later} calls after acts of their round");
    }

    private static void SpawnOne(RuleWorld world) => world.Spawn(Ball(0.125), V(world.State<GivenState>().Count++));

    private static void Push(RuleWorld world, int count)
    {
        for (int n = 0; n < count; n++)
        {
            world.Impulse(First, V(1));
        }
    }

    private static int CountAt(Simulation world, SimTime time) => world.TryReadRules(time, out GivenState score) ? score.Count : -1;

    private static Scene Empty(GivenRules rules) => new SceneBuilder("chain").WithGravity(Floating).WithSmallestRadius(0.125).WithRules(rules).Build();
}
