using System;
using LagSim.Net.Wire;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Net.Recordings;

/// <summary>The initial state of a peer that joined late, in place of the part of the log that it never got.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
internal sealed class JoinedState
{
    /// <summary>Creates a state.</summary>
    /// <param name="firstIndex">See <see cref="FirstIndex"/>.</param>
    /// <param name="snapshot">See <see cref="Snapshot"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">The index is 0.</exception>
    /// <exception cref="ArgumentException">
    /// The snapshot is further than 48 days from the origin, at its start or before, or longer than
    /// <see cref="RecordingFormat.MaxSnapshotBytes"/>.
    /// </exception>
    public JoinedState(uint firstIndex, WorldSnapshot? snapshot)
    {
        if (firstIndex == 0)
        {
            throw new ArgumentOutOfRangeException(nameof(firstIndex), firstIndex, "The entries of a log are counted from 1.");
        }

        if (snapshot is not null && !SnapshotFormat.IsInRange(snapshot))
        {
            throw new ArgumentException(
                $"The snapshot is of {snapshot.Time.ToShortString()} in a world that began at {snapshot.Start.ToShortString()}; it must come after that, and"
                + " both lie within 48 days of the origin.",
                nameof(snapshot));
        }

        long length = snapshot is null ? 0 : SnapshotFormat.EncodedLength(snapshot);
        if (length > RecordingFormat.MaxSnapshotBytes)
        {
            throw new ArgumentException($"The snapshot takes {length} bytes; at most {RecordingFormat.MaxSnapshotBytes} are allowed.", nameof(snapshot));
        }

        FirstIndex = firstIndex;
        Snapshot = snapshot;
    }

    /// <summary>The first entry of the log that this peer got, counted from 1. Every accepted one before it is in the snapshot.</summary>
    public uint FirstIndex { get; }

    /// <summary>
    /// The world it began from, including every accepted event before <see cref="Time"/>, wherever it is in the log. Null if it began from
    /// the scene; then nothing before <see cref="FirstIndex"/> was accepted.
    /// </summary>
    public WorldSnapshot? Snapshot { get; }

    /// <summary>The shared time of the snapshot; null without one.</summary>
    public SimTime? Time => Snapshot?.Time;
}
