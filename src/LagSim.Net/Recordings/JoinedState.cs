using System;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Recordings;

/// <summary>What a peer that joined late began with, in place of the part of the log that it never got.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public sealed class JoinedState
{
    private readonly byte[] state;

    /// <summary>A state, of which a copy is kept.</summary>
    /// <param name="firstIndex">The first entry of the log that comes after it, counted from 1.</param>
    /// <param name="time">The shared time of the state. Every accepted event up to and including it is in the state.</param>
    /// <param name="state">The state in the form of whoever restores it, at most <see cref="RecordingFormat.MaxJoinedBytes"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">The index is 0.</exception>
    /// <exception cref="ArgumentException">The state is too long, or its time further than 48 days from the origin.</exception>
    public JoinedState(uint firstIndex, SimTime time, ReadOnlySpan<byte> state)
    {
        if (firstIndex == 0)
        {
            throw new ArgumentOutOfRangeException(nameof(firstIndex), firstIndex, "The entries of a log are counted from 1.");
        }

        if (!WireFormat.IsInRange(time))
        {
            throw new ArgumentException($"The time of the state is {time}; it must lie within 48 days of the origin.", nameof(time));
        }

        if (state.Length > RecordingFormat.MaxJoinedBytes)
        {
            throw new ArgumentException(
                $"The state takes {state.Length} bytes; at most {RecordingFormat.MaxJoinedBytes} are allowed.", nameof(state));
        }

        FirstIndex = firstIndex;
        Time = time;
        this.state = state.ToArray();
    }

    /// <summary>The first entry of the log that comes after it, counted from 1.</summary>
    public uint FirstIndex { get; }

    /// <summary>The shared time of the state. Every accepted event up to and including it is in the state.</summary>
    public SimTime Time { get; }

    /// <summary>The state, in the form of whoever restores it.</summary>
    public ReadOnlyMemory<byte> State => state;
}
