using LagSim.Events;
using LagSim.Hosting;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Hosting;

/// <summary>How much room the timelines of a render snapshot take.</summary>
public sealed class RenderTimelineTests
{
    private const int Strokes = 400;

    [Fact]
    public void Room_LongAfterALivelyMoment_IsGivenBack()
    {
        Simulation simulation = Lively();
        RenderSnapshot snapshot = new();
        Follow(snapshot, simulation, from: 0, copies: 1);
        int most = snapshot.Room;
        Assert.True(most > Strokes);
        Follow(snapshot, simulation, from: 1.5, copies: 500); // a next moment may well need it
        Assert.Equal(most, snapshot.Room);
        Follow(snapshot, simulation, from: 1.5, copies: 5000);
        Assert.InRange(snapshot.Room, 1, 32);
        AssertShown(simulation, snapshot, 1.7);
    }

    /// <summary>The control: what is needed is kept.</summary>
    [Fact]
    public void Room_ThatGoesOnBeingNeeded_IsKept()
    {
        Simulation simulation = Lively();
        RenderSnapshot snapshot = new();
        Follow(snapshot, simulation, from: 0, copies: 1);
        int most = snapshot.Room;
        Follow(snapshot, simulation, from: 0.2, copies: 5000);
        Assert.Equal(most, snapshot.Room);
        AssertShown(simulation, snapshot, 0.3);
    }

    private static void AssertShown(Simulation simulation, RenderSnapshot snapshot, double seconds)
    {
        Assert.True(simulation.TryRead(First, At(seconds), out BodyState expected));
        Assert.True(snapshot.TryRead(First, At(seconds), out BodyState actual));
        SameBits(expected, actual);
    }

    /// <summary>A body that is struck 400 times in the first second, and never after.</summary>
    private static Simulation Lively()
    {
        Simulation simulation = new(Drop(50, 0.8), KeepAll);
        for (int n = 0; n < Strokes; n++)
        {
            simulation.Submit(ExternalEvent.SetVelocity(At((n + 1) / (double)Strokes), 1, (uint)n + 1, First, V(n % 2)));
        }

        simulation.AdvanceTo(At(2));
        return simulation;
    }

    private static void Follow(RenderSnapshot snapshot, Simulation simulation, double from, int copies)
    {
        for (int n = 0; n < copies; n++)
        {
            snapshot.Follow(simulation, At(from), n + 1);
        }
    }
}
