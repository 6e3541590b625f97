using System;
using System.Globalization;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>
/// The hashes of a peer's world at a time that no late event can change any more. They are equal on every peer, or the peers differ for
/// good.
/// </summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public readonly struct CommittedState : IEquatable<CommittedState>
{
    /// <summary>Creates a committed state.</summary>
    public CommittedState(SimTime time, ulong stateHash, ulong eventHash)
    {
        Time = time;
        StateHash = stateHash;
        EventHash = eventHash;
    }

    /// <summary>The shared time; in a session the start and a whole number of <see cref="SessionOptions.CommitInterval"/>.</summary>
    public SimTime Time { get; }

    /// <summary><see cref="Simulation.StateHash"/> at that time.</summary>
    public ulong StateHash { get; }

    /// <summary><see cref="Simulation.EventHash"/> at that time.</summary>
    public ulong EventHash { get; }

    /// <inheritdoc/>
    public bool Equals(CommittedState other) => Time == other.Time && StateHash == other.StateHash && EventHash == other.EventHash;

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is CommittedState other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => Time.GetHashCode() ^ StateHash.GetHashCode() ^ (EventHash.GetHashCode() * 397);

    /// <summary>Both hashes in 16 hex digits each, without the time.</summary>
    public override string ToString() => string.Format(CultureInfo.InvariantCulture, "state {0:x16}, events {1:x16}", StateHash, EventHash);
}
