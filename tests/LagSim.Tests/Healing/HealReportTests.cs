using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Healing;

/// <summary>What a simulation tells of its heals.</summary>
public sealed class HealReportTests
{
    [Theory]
    [InlineData(HealingMode.CausalCone)]
    [InlineData(HealingMode.FullRollback)]
    public void Healed_OneLateEventAmongStrangers_CountsWhatWasRewritten(HealingMode mode)
    {
        (Simulation simulation, List<HealReport> reports) = Row(mode, 10);
        simulation.AdvanceTo(At(1));
        simulation.Submit(ExternalEvent.SetVelocity(At(0.5), 1, 1, BodyId.OfScene(3), V(0, 5)));
        Assert.Empty(reports); // it is only marked
        Assert.Equal(At(0.5) - SimDuration.OneTick, simulation.SimulatedTo);
        simulation.AdvanceTo(At(1));

        HealReport report = Assert.Single(reports);
        Assert.Equal((At(0.5), At(1), 1), (report.From, report.To, report.LateEvents));
        Assert.Equal(mode == HealingMode.CausalCone ? 1 : 10, report.Bodies); // nobody meets anybody
        Assert.Equal(mode == HealingMode.CausalCone ? 1 : 10, report.SegmentsCut); // each bounced at 0.64 s
        Assert.Equal(mode == HealingMode.CausalCone ? 1 : 10, report.Events); // and the kicked one does not any more
    }

    [Fact]
    public void Healed_AnotherLateEventBeforeItIsFinished_IsOneReport()
    {
        (Simulation simulation, List<HealReport> reports) = Row(HealingMode.CausalCone, 4);
        simulation.AdvanceTo(At(1));
        foreach (int body in Enumerable.Range(0, 3))
        {
            simulation.Submit(ExternalEvent.SetVelocity(At(0.5 - (0.1 * body)), 1, (uint)body + 1, BodyId.OfScene(body), V(0, 5)));
            Assert.Empty(reports);
        }

        simulation.AdvanceTo(At(0.9));
        Assert.Empty(reports);
        simulation.AdvanceTo(At(1.5));
        Assert.Equal((At(0.3), At(1), 3, 3), (Assert.Single(reports).From, reports[0].To, reports[0].LateEvents, reports[0].Bodies));
    }

    private static (Simulation Simulation, List<HealReport> Reports) Row(HealingMode mode, int count)
    {
        SceneBuilder builder = new SceneBuilder("row").AddPlane("floor", Vector3D.Up, V(0), 0.9);
        for (int i = 0; i < count; i++)
        {
            builder.AddBody($"ball {i}", Ball(0.25, 1, 0.9), V(i, 2.25));
        }

        Simulation simulation = new(builder.Build(), new SimulationOptions(default, SimDuration.MaxValue, healing: mode));
        List<HealReport> reports = [];
        simulation.Healed += reports.Add;
        return (simulation, reports);
    }
}
