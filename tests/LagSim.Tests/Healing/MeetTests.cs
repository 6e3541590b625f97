using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Scenes;
using LagSim.Tests.Determinism;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Healing;

/// <summary>A heal is done where the new paths meet the old ones, to the bit.</summary>
public sealed class MeetTests
{
    private static readonly BodyId Ball3 = BodyId.OfScene(3);
    private static readonly ExternalEvent Back = ExternalEvent.Teleport(At(1), 2, 1, Ball3, V(3, 5), V(0));

    [Fact]
    public void Healed_LateEventWithoutEffect_RunsThatAloneAndLeavesTheRest()
    {
        (Simulation simulation, List<HealReport> reports) = Row();
        simulation.AdvanceTo(At(4));
        long cut = simulation.SegmentsCut;
        ExternalEvent late = ExternalEvent.Release(At(0.5), 1, 1, Ball3); // of what nobody holds
        simulation.Submit(late);
        simulation.AdvanceTo(At(4));

        HealReport report = Assert.Single(reports);
        Assert.Equal(At(0.5), report.ReconvergedAt);
        Assert.Equal((1L, 1), (report.Events, report.Bodies));
        Assert.True(simulation.SegmentsCut - cut > 2); // it had bounced a few times, and that stands again
        AssertIs(Row(late).Simulation, simulation);
    }

    [Fact]
    public void Healed_LateEventUndoneByATeleport_IsDoneThere()
    {
        (Simulation simulation, List<HealReport> reports) = Row(Back);
        simulation.AdvanceTo(At(4));
        ExternalEvent late = ExternalEvent.SetVelocity(At(0.5), 1, 1, Ball3, V(0.5, 5)); // meets nobody in half a second
        simulation.Submit(late);
        simulation.AdvanceTo(At(4));

        HealReport report = Assert.Single(reports);
        Assert.Equal(At(1), report.ReconvergedAt);
        Assert.Equal((2L, 1), (report.Events, report.Bodies));
        AssertIs(Row(Back, late).Simulation, simulation);
    }

    [Fact]
    public void Healed_LateEventThatLasts_GoesOnToTheEnd()
    {
        (Simulation simulation, List<HealReport> reports) = Row();
        simulation.AdvanceTo(At(4));
        simulation.Submit(ExternalEvent.SetVelocity(At(0.5), 1, 1, Ball3, V(0, 5)));
        simulation.AdvanceTo(At(4));
        Assert.Null(Assert.Single(reports).ReconvergedAt);
    }

    [Fact]
    public void Healed_WhereWhatWasStruckIsAheadOfTheTeleport_DoesNotStopBeforeThatHasMetToo()
    {
        // Ball 3 strikes ball 4 before it is put back; so ball 4 has another path for good.
        (Simulation simulation, List<HealReport> reports) = Row(Back);
        simulation.AdvanceTo(At(4));
        simulation.Submit(ExternalEvent.SetVelocity(At(0.5), 1, 1, Ball3, V(5, 0)));
        simulation.AdvanceTo(At(4));
        Assert.Null(Assert.Single(reports).ReconvergedAt);
        Assert.True(reports[0].Bodies > 1);
    }

    [Fact]
    public void Healed_WhereWhatWasStruckHadNothingToBeCut_DoesNotStopEither()
    {
        // Without a floor ball 4 has one flight and no more, so that the impact comes after all it did.
        Simulation simulation = new(Scene(hasFloor: false), new SimulationOptions(default, SimDuration.MaxValue));
        List<HealReport> reports = [];
        simulation.Healed += reports.Add;
        simulation.Submit(Back);
        simulation.AdvanceTo(At(4));
        simulation.Submit(ExternalEvent.SetVelocity(At(0.5), 1, 1, Ball3, V(5, -0.5 * 9.81)));
        simulation.AdvanceTo(At(4));
        Assert.Null(Assert.Single(reports).ReconvergedAt);
        Assert.Equal(7, reports[0].Bodies); // it and all in the row beyond, each of which had one flight
        Simulation onTime = new(simulation.Scene, new SimulationOptions(default, SimDuration.MaxValue));
        onTime.Submit(Back);
        onTime.Submit(ExternalEvent.SetVelocity(At(0.5), 1, 1, Ball3, V(5, -0.5 * 9.81)));
        AssertIs(onTime, simulation);
    }

    [Fact]
    public void Healed_InPiecesAndWithAnIndex_MeetsToo()
    {
        (Simulation simulation, List<HealReport> reports) = Row(0, Back);
        simulation.AdvanceTo(At(4));
        simulation.Submit(ExternalEvent.SetVelocity(At(0.5), 1, 1, Ball3, V(0.5, 5)));
        Assert.Empty(reports);
        Assert.True(simulation.SimulatedTo < At(0.5));
        long events = 1;
        while (!simulation.TryAdvanceTo(At(4), ref events))
        {
            events = 1;
        }

        Assert.Equal(At(1), Assert.Single(reports).ReconvergedAt);
        simulation.AdvanceTo(At(6)); // the index knows what was put back: it goes on like one that never lost it
        Simulation onTime = Row(Back, ExternalEvent.SetVelocity(At(0.5), 1, 1, Ball3, V(0.5, 5))).Simulation;
        onTime.AdvanceTo(At(6));
        Assert.Equal(onTime.EventHash(At(6)), simulation.EventHash(At(6)));
        Assert.Equal(onTime.StateHash(At(6)), simulation.StateHash(At(6)));
    }

    [Fact]
    public void Healed_AnotherLateEventBeforeItIsFinished_IsNotLookedFor()
    {
        (Simulation simulation, List<HealReport> reports) = Row();
        simulation.AdvanceTo(At(4));
        simulation.Submit(ExternalEvent.Release(At(0.5), 1, 1, Ball3, V(0)));
        simulation.Submit(ExternalEvent.Release(At(0.6), 1, 2, Ball3, V(0)));
        simulation.AdvanceTo(At(4));
        Assert.Null(Assert.Single(reports).ReconvergedAt);
        Assert.Equal(2, reports[0].LateEvents);
    }

    [Fact]
    public void Contacts_OfAHealThatWasDoneEarly_AreTheOldOnesAndNothingIsTold()
    {
        ContactNotices notices = new();
        List<ContactNotice> told = [];
        notices.Noticed += told.Add;
        LiveWorld world = new(Scene(), new SimulationOptions(default, SimDuration.FromSeconds(10)), contacts: notices);
        world.Step(At(4));
        int before = told.Count;
        Assert.True(before > 10);
        world.Submit(ExternalEvent.Release(At(0.5), 1, 1, Ball3, V(0)));
        world.Step(At(4));
        Assert.Empty(told.Skip(before));
        Assert.Equal(1, world.Simulation.Rollbacks);
    }

    [Fact]
    public void RandomWorlds_HealedInAnyOrder_MeetNowAndThen()
    {
        // That what is met is right is what InvariantTests are for; here only that it happens in them, with hands that come too late.
        int met = 0;
        int cut = 0;
        foreach (int seed in Enumerable.Range(0, 40))
        {
            new RandomWorld(seed, hands: true).Shuffled(seed, prepare: simulation => simulation.Healed += report =>
            {
                met += report.ReconvergedAt is null ? 0 : 1;
                cut += report.ReconvergedAt is null ? 0 : (int)report.SegmentsCut;
            });
        }

        Assert.True(met > 20 && cut > 20, $"{met} met, {cut} segments put back");
    }

    private static void AssertIs(Simulation onTime, Simulation healed)
    {
        onTime.AdvanceTo(At(4));
        Assert.Equal(onTime.Timeline(Ball3).Count, healed.Timeline(Ball3).Count);
        foreach (double time in new[] { 0.5, 0.9, 1, 1.5, 2, 4 })
        {
            Assert.Equal(onTime.StateHash(At(time)), healed.StateHash(At(time)));
            Assert.Equal(onTime.EventHash(At(time)), healed.EventHash(At(time)));
        }
    }

    private static Scene Scene(bool hasFloor = true)
    {
        SceneBuilder builder = new("row");
        if (hasFloor)
        {
            builder.AddPlane("floor", Vector3D.Up, V(0), 0.9);
        }

        for (int i = 0; i < 10; i++)
        {
            builder.AddBody($"ball {i}", Ball(0.25, 1, 0.9), V(i, 2.25));
        }

        return builder.Build();
    }

    private static (Simulation Simulation, List<HealReport> Reports) Row(params ExternalEvent[] events) => Row(SimulationOptions.DefaultBruteForceLimit, events);

    private static (Simulation Simulation, List<HealReport> Reports) Row(int bruteForceLimit, params ExternalEvent[] events)
    {
        Simulation simulation = new(Scene(), new SimulationOptions(default, SimDuration.MaxValue).WithBruteForceLimit(bruteForceLimit));
        foreach (ExternalEvent external in events)
        {
            simulation.Submit(external);
        }

        List<HealReport> reports = [];
        simulation.Healed += reports.Add;
        return (simulation, reports);
    }
}
