using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;

namespace LagSim.Tests.Behavior;

/// <summary>A body's events, all of them or from an instant on.</summary>
public sealed class TimelineTests
{
    [Theory]
    [InlineData("billiards")]
    [InlineData("crowd")]
    public void Timeline_FromAnyInstant_IsTheEndOfTheWholeBeginningWithTheLastEventBefore(string name)
    {
        Simulation world = new(SceneSource.Load(name), new SimulationOptions(history: SimDuration.FromSeconds(1)));
        world.AdvanceTo(SimTime.FromSeconds(3));
        SeededRandom random = new(7);
        int several = 0;
        for (int n = 0; n < 500; n++)
        {
            BodyId body = world.BodyAt(Index(random, world.BodyCount));
            IReadOnlyList<TimelineEntry> all = world.Timeline(body);

            // Anywhere, also before what is kept and after what is simulated, and at an event's own tick.
            SimTime from = Index(random, 3) == 0 ? all[Index(random, all.Count)].Key.Time : SimTime.FromSeconds(random.NextDouble(0, 4));
            int before = Math.Max(1, all.Count(e => e.Key.Time <= from));
            IReadOnlyList<TimelineEntry> some = world.Timeline(body, from);
            Assert.Equal(all.Skip(before - 1).Select(e => (e.Key, e.State)), some.Select(e => (e.Key, e.State)));
            several += some.Count > 1 && some.Count < all.Count ? 1 : 0;
        }

        Assert.True(several > 20, "hardly any began in the middle, so nothing was tested");
        Assert.Empty(world.Timeline(BodyId.OfScene(10_000), SimTime.Zero));
    }

    private static int Index(SeededRandom random, int count) => (int)(random.NextUInt64() % (ulong)count);
}
