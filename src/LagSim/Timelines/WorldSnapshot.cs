using System;
using System.Collections.Generic;
using LagSim.Time;

namespace LagSim.Timelines;

/// <summary>
/// The complete state of a world after everything before an instant: a simulation that continues from it stays identical, bit for bit.
/// </summary>
/// <remarks>Immutable, safe on any thread. It contains no external event stamped at its time or later.</remarks>
public sealed class WorldSnapshot
{
    private readonly BodySnapshot[] bodies;

    /// <summary>Creates a snapshot from its parts.</summary>
    /// <param name="start">See <see cref="Start"/>.</param>
    /// <param name="time">See <see cref="Time"/>.</param>
    /// <param name="eventHash">See <see cref="EventHash"/>.</param>
    /// <param name="bodies">The bodies that exist, by ascending identity; copied.</param>
    /// <param name="ruleState">See <see cref="RuleState"/>; copied.</param>
    public WorldSnapshot(
        SimTime start, SimTime time, ulong eventHash, ReadOnlySpan<BodySnapshot> bodies, ReadOnlySpan<byte> ruleState = default)
        : this(start, time, eventHash, bodies.ToArray(), ruleState.ToArray())
    {
    }

    internal WorldSnapshot(SimTime start, SimTime time, ulong eventHash, BodySnapshot[] bodies, byte[] ruleState)
    {
        RuleStateArray = ruleState;
        Start = start;
        Time = time;
        EventHash = eventHash;
        this.bodies = bodies;
    }

    /// <summary>The instant at which the scene began.</summary>
    public SimTime Start { get; }

    /// <summary>The instant before which everything has happened, and at which nothing has yet.</summary>
    public SimTime Time { get; }

    /// <summary>The hash of every event before <see cref="Time"/>, as <see cref="Simulation.EventHash"/> gives it.</summary>
    public ulong EventHash { get; }

    /// <summary>The bodies that exist, by ascending identity.</summary>
    public IReadOnlyList<BodySnapshot> Bodies => bodies;

    /// <summary>The state of the rules, encoded; empty for a scene without.</summary>
    public ReadOnlySpan<byte> RuleState => RuleStateArray;

    internal byte[] RuleStateArray { get; }

    internal BodySnapshot[] BodyArray => bodies;
}
