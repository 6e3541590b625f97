using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Scenes;
using LagSim.Tests.Determinism;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Rules;

/// <summary>What rules tell, as a game hears of it: predicted, and then either confirmed or retracted, each once.</summary>
public sealed class RuleNoticesTests
{
    [Theory]
    [InlineData(HealingMode.CausalCone)]
    [InlineData(HealingMode.FullRollback)]
    public void Notices_OfRandomWorldsWithLateEvents_ConfirmEachOnceInOrderAndNoOther(HealingMode mode)
    {
        int confirmed = 0, moved = 0, different = 0;
        for (int seed = 0; seed < 60; seed++)
        {
            RandomWorld world = new(seed, sensors: seed % 2 == 0, rules: true);
            RuleEvents late = new();
            Simulation simulation = new(world.Scene, new SimulationOptions(history: SimDuration.MaxValue, healing: mode));
            simulation.Engine.Rules!.Listen();
            simulation.Healed += _ => late.Notices.Tell(simulation);
            Random arrivals = new(seed);
            foreach ((SimTime heard, ExternalEvent one) in world.Events
                .Select(e => (SimTime.Min(At(RandomWorld.End), e.Time + SimDuration.FromSeconds(arrivals.NextDouble())), e)).OrderBy(e => e.Item1))
            {
                simulation.AdvanceTo(SimTime.Max(heard, simulation.SimulatedTo));
                late.Notices.Tell(simulation); // what is predicted before the event is known
                simulation.Submit(one);
            }

            simulation.AdvanceTo(At(RandomWorld.End));
            simulation.DropHistoryBefore(simulation.SimulatedTo);
            late.Notices.Tell(simulation);
            Assert.Equal(RuleEvents.Of(world.OnTime(), At(RandomWorld.End)), late.Confirmed);
            Assert.Equal(late.Predicted - late.Retracted, late.Confirmed.Count + late.Notices.Pending);
            different += RuleEvents.Of(world.OnTime(world.Events.Skip(1)), At(RandomWorld.End)).SequenceEqual(late.Confirmed) ? 0 : 1;
            confirmed += late.Confirmed.Count;
            moved += late.Moved;
        }

        Assert.True(confirmed > 300 && moved > 50, $"{confirmed} confirmed, {moved} moved");
        Assert.True(different > 10, $"{different}"); // the control: without one of the events they told something else
    }

    [Fact]
    public void Notices_OfSeveralContactsOfOneImpact_AreToldApartByTheirPlaces()
    {
        // A ball falls into a groove and meets both of its sides at once: two calls of one key.
        GivenRules rules = new()
        {
            Hears = (_, _, _) => true,
            Contact = (w, contact) => w.Tell(contact.Surface, contact.Surface == 1 ? w.State<GivenState>().Count : 0),
            Command = (w, _, command) => w.State<GivenState>().Count = command.Number,
        };
        Scene groove = new SceneBuilder("groove").AddPlane("left", V(1, 1), V(0), 0.5).AddPlane("right", V(-1, 1), V(0), 0.5).AddBody("ball", Ball(e: 0.5), V(0, 2))
            .WithRules(rules).Build();
        RuleEvents told = new();
        LiveWorld world = new(groove, new SimulationOptions(history: SimDuration.FromSeconds(0.9)), notices: told.Notices);
        world.Step(At(0.6));
        Assert.True(told.All.Count >= 2 && told.All.All(one => one.Kind == NoticeKind.Predicted));
        EventKey impact = told.All[0].Key;
        Assert.Equal([(impact, 0, 0, 0L), (impact, 1, 1, 0L)], told.All.Take(2).Select(one => (one.Key, one.Place, one.Notice.Code, one.Notice.Value)));
        int before = told.All.Count;

        // A late command changes what is told of one side: that of the other stands.
        world.Submit(PlayerAction.Command(new GameCommand(7)).Stamp(At(0.1), 1, 1));
        world.Step(At(0.6));
        Assert.DoesNotContain(told.All.Skip(before), one => one.Notice.Code == 0);
        Assert.Equal(
            [(NoticeKind.Moved, 1, 7L)],
            told.All.Skip(before).Where(one => one.Key == impact).Select(one => (one.Kind, one.Place, one.Notice.Value)));

        // A push makes the ball meet the sides one after the other.
        world.Submit(PlayerAction.Impulse(First, V(0.25)).Stamp(At(0.2), 1, 2));
        world.Step(At(0.6));
        world.Step(At(1.6));
        Assert.Equal(told.Predicted - told.Retracted, told.Confirmed.Count + told.Notices.Pending);
        Assert.DoesNotContain(told.Confirmed, one => one.Key == impact);
        Simulation alone = Run(groove, 2, [
            PlayerAction.Command(new GameCommand(7)).Stamp(At(0.1), 1, 1), PlayerAction.Impulse(First, V(0.25)).Stamp(At(0.2), 1, 2)]);
        Assert.True(told.Confirmed.Count >= 2);
        Assert.Equal(RuleEvents.Of(alone).Take(told.Confirmed.Count), told.Confirmed);
    }

    [Fact]
    public void Notices_OfALiveWorld_AreConfirmedWhenNothingCanChangeThem()
    {
        GivenRules rules = new() { Start = w => w.SetTimer(1, SimDuration.FromSeconds(0.5)), Timer = (w, timer) => w.Tell(timer, 42) };
        Scene scene = new SceneBuilder("told").WithGravity(Floating).AddBody("ball", Ball(), V(0)).WithRules(rules).Build();
        RuleNotices notices = new(16);
        LiveWorld world = new(scene, new SimulationOptions(history: SimDuration.FromSeconds(1)), notices: notices);
        Assert.Same(notices, world.Notices);
        SimTime due = At(0);
        List<(SimTime, NoticeKind)> seen = [];
        for (int steps = 0; due != SimTime.MaxValue; steps++)
        {
            Assert.True(steps < 1000);
            SimTime now = due;
            due = world.Step(now);
            while (notices.TryRead(out RuleEvent told))
            {
                Assert.Equal((At(0.5), 0, 1, 42L), (told.Time, told.Place, told.Notice.Code, told.Notice.Value));
                seen.Add((now, told.Kind));
            }
        }

        Assert.Equal([NoticeKind.Predicted, NoticeKind.Confirmed], seen.Select(one => one.Item2));
        Assert.True(seen[0].Item1 <= At(0.5));
        Assert.InRange(seen[1].Item1.ToSeconds(), 1.4, 1.6); // a history later, less what the world is ahead
        Assert.Equal(0, notices.Pending);
        Assert.Throws<InvalidOperationException>(() => new LiveWorld(scene, new SimulationOptions(), notices: notices));
        Assert.Contains("From 16 to 1048576", Assert.Throws<ArgumentOutOfRangeException>(() => new RuleNotices(3)).Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Notices_MoreThanHaveRoom_AreCountedAndHeardAllTheSame()
    {
        GivenRules rules = new()
        {
            Start = w => w.SetTimer(1, SimDuration.FromSeconds(0.1)),
            Timer = (w, timer) =>
            {
                w.SetTimer(timer, SimDuration.FromSeconds(0.1));
                w.Tell(1);
                w.Tell(2);
            },
        };
        Scene scene = new SceneBuilder("told").WithGravity(Floating).AddBody("ball", Ball(), V(0)).WithRules(rules).Build();
        RuleNotices notices = new(16);
        int heard = 0, read = 0;
        notices.Noticed += _ => heard++;
        LiveWorld world = new(scene, new SimulationOptions(history: SimDuration.FromSeconds(100)), notices: notices);
        world.Step(At(2.01));
        while (notices.TryRead(out RuleEvent told))
        {
            Assert.Equal(NoticeKind.Predicted, told.Kind);
            read++;
        }

        Assert.Equal((40, 8, 32L, 40), (heard, read, notices.Lost, notices.Pending)); // predictions take half of the queue
        world.Retire();
        Assert.Equal((80, 40), (heard, notices.Pending)); // all are in doubt
    }
}
