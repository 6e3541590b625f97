using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Play;

/// <summary>The world without any delay: it has what a person does in the very instant in which it is done.</summary>
/// <remarks>What the host refuses is taken back. Not thread-safe.</remarks>
internal sealed class Truth
{
    private readonly Simulation world;

    internal Truth(Scene scene, SimTime start)
    {
        world = new Simulation(scene, new SimulationOptions(start, SimDuration.FromSeconds(4)));
    }

    /// <summary>A person does something.</summary>
    internal void Do(in ExternalEvent done) => world.Submit(done);

    /// <summary>The host has decided on something.</summary>
    internal void Hear(LogEntry entry)
    {
        if (entry.Verdict != Verdict.Accepted)
        {
            world.Retract(entry.Event);
        }

        if (entry.Verdict == Verdict.Moved)
        {
            world.Submit(entry.Event);
        }
    }

    /// <summary>Goes on to a time.</summary>
    internal void AdvanceTo(SimTime now)
    {
        if (now > world.SimulatedTo)
        {
            world.AdvanceTo(now);
        }
    }

    /// <summary>Where a body is.</summary>
    internal bool TryRead(BodyId body, SimTime time, out BodyState state) =>
        world.TryRead(body, SimTime.Max(world.HistoryEdge, SimTime.Min(time, world.Horizon)), out state);

    /// <summary>Whether a time is within what it remembers and knows.</summary>
    internal bool Covers(SimTime time) => time >= world.HistoryEdge && time <= world.SimulatedTo;

    /// <summary>The hash of the state at a time that it has reached; null for one that it does not know any more.</summary>
    internal ulong? HashAt(SimTime time) => time >= world.HistoryEdge && time <= world.Horizon ? world.StateHash(time) : null;
}
