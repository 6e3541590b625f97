using System;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Rollback;

/// <summary>Many late events that come before a heal of them begins: what each of them rewinds does not grow with their number.</summary>
public sealed class ManyLateEventsTests
{
    private const int Events = 500;

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Teleports_ThatLookWhetherTheirPlaceIsFree_AreRewoundOnceForEach(bool reversed)
    {
        CountingParts parts = new(rewindsAgain: false);
        Bring(parts, reversed);
        Assert.InRange(parts.Rewinds, Events, 3 * Events);
    }

    /// <summary>The control: each late event rewinds all that come after it.</summary>
    [Fact]
    public void Teleports_ThatAreRewoundAgain_AreSeenToBeQuadratic()
    {
        CountingParts parts = new(rewindsAgain: true);
        Bring(parts, reversed: true);
        Assert.True(parts.Rewinds > Events * Events / 4, $"{parts.Rewinds}");
    }

    private static void Bring(CountingParts parts, bool reversed)
    {
        Scene scene = new SceneBuilder("two").AddPlane("floor", Vector3D.Up, 0)
            .AddBody("a", new BodySpec(0.2, 1, 0.7), new Vector3D(0, 1, 0)).AddBody("b", new BodySpec(0.2, 1, 0.7), new Vector3D(3, 2, 0)).Build();
        ExternalEvent[] events = Enumerable.Range(1, Events).Select(n => PlayerAction
            .Teleport(BodyId.OfScene(n % 2), new Vector3D(n % 2 * 3, 3, 0), default, WhenOccupied.Beside).Stamp(At(0.9 * n / Events), 1, (uint)n)).ToArray();
        SimulationOptions options = new SimulationOptions(history: SimDuration.FromSeconds(5)).WithParts(parts);
        Simulation expected = new(scene, options);
        Array.ForEach(events, e => expected.Submit(e));
        expected.AdvanceTo(At(1));
        Assert.Equal(0, parts.Rewinds);

        Simulation late = new(scene, options);
        late.AdvanceTo(At(1));
        foreach (ExternalEvent e in reversed ? events.Reverse() : events.OrderBy(e => e.Sequence * 37 % Events))
        {
            late.Submit(e);
        }

        late.AdvanceTo(At(1));
        Assert.Equal(expected.EventHash(At(1)), late.EventHash(At(1)));
    }
}
