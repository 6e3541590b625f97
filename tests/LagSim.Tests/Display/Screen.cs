using System;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Display;
using LagSim.Scenes;
using LagSim.Time;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Display;

/// <summary>A world, its render snapshots, and what is drawn of it frame by frame.</summary>
internal sealed class Screen
{
    private readonly RenderTripleBuffer snapshots = new();
    private readonly double past;
    private uint sequence;

    internal Screen(Scene scene, DisplayOptions? options = null, double past = 0.25)
    {
        World = new Simulation(scene, new SimulationOptions(default, SimDuration.FromSeconds(2)));
        Offsets = new DisplayOffsets(scene, options);
        this.past = past;
    }

    internal Simulation World { get; }

    internal DisplayOffsets Offsets { get; }

    internal SubmitResult Do(double time, PlayerAction action) => World.Submit(action.Stamp(At(time), 1, ++sequence));

    internal RenderSnapshot Publish(double now)
    {
        World.AdvanceTo(SimTime.Max(At(now) + SimDuration.FromSeconds(0.05), World.SimulatedTo));
        snapshots.Publish(World, SimTime.Max(At(now - past), World.HistoryEdge));
        return snapshots.Latest();
    }

    /// <summary>A frame with a render snapshot of its own.</summary>
    internal void Frame(double now) => Xunit.Assert.True(Offsets.Update(Publish(now), At(now)));

    internal DrawnBody Drawn(BodyId body)
    {
        Xunit.Assert.True(Offsets.TryRead(body, out DrawnBody drawn));
        return drawn;
    }

    /// <summary>Frames from one instant on, each told of the first body.</summary>
    internal void Frames(double from, int hertz, int count, Action<int, DrawnBody> each)
    {
        for (int n = 1; n <= count; n++)
        {
            Frame(from + (n / (double)hertz));
            each(n, Drawn(First));
        }
    }
}
