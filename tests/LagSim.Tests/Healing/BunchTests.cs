using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Healing;

/// <summary>Many late events that come at once, as a live world takes them in: together they cost what they touch, and no more than a full rollback.</summary>
public sealed class BunchTests
{
    private const int Bodies = 300;

    [Theory]
    [InlineData(4)]
    [InlineData(60)]
    [InlineData(300)]
    public void LateEvents_ThatComeAtOnceInAnyOrder_CostNoMoreThanAFullRollback(int count)
    {
        Random random = new(count);
        ExternalEvent[] lateEvents = [.. Enumerable.Range(1, count).Select(n => ExternalEvent.Impulse(
            At(0.6 + (0.3 * random.NextDouble())), 1, (uint)n, BodyId.OfScene(random.Next(Bodies)), V(0.1, 0.05)))];
        (Simulation cone, HealReport healed, _) = Bring(HealingMode.CausalCone, together: true);
        (Simulation full, HealReport rolledBack, _) = Bring(HealingMode.FullRollback, together: true);
        Assert.Equal(count, healed.LateEvents);
        Assert.Equal(full.StateHash(At(1.5)), cone.StateHash(At(1.5)));
        Assert.Equal(full.EventHash(At(1.5)), cone.EventHash(At(1.5)));
        Assert.True(healed.Events < 1.3 * rolledBack.Events, $"{healed.Events} of {rolledBack.Events}");

        long single = Bring(HealingMode.CausalCone, together: false).All;
        Assert.True(healed.Events <= 1.3 * single, $"{healed.Events}, one by one {single}");
        if (count == 4)
        {
            Assert.True(healed.Events < 0.5 * rolledBack.Events, $"{healed.Events} of {rolledBack.Events}"); // each in a place of its own
        }

        (Simulation Simulation, HealReport Last, long All) Bring(HealingMode mode, bool together)
        {
            Simulation simulation = new(BuiltInScenes.Gas(Bodies), new SimulationOptions(default, SimDuration.FromSeconds(2), healing: mode));
            List<HealReport> reports = [];
            simulation.Healed += reports.Add;
            simulation.AdvanceTo(At(1.5));
            foreach (ExternalEvent external in lateEvents)
            {
                simulation.Submit(external);
                simulation.AdvanceTo(together ? simulation.SimulatedTo : At(1.5));
            }

            simulation.AdvanceTo(At(1.5));
            return (simulation, reports[^1], reports.Sum(r => r.Events));
        }
    }
}
