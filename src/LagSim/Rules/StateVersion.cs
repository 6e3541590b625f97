using System;

namespace LagSim.Rules;

/// <summary>The state of rules after a call, in its one encoding. Calls that change nothing share it.</summary>
internal sealed class StateVersion
{
    private byte[] bytes = Array.Empty<byte>();
    private int length;

    /// <summary>How many keep it.</summary>
    internal int Uses { get; set; }

    /// <summary>The encoded state.</summary>
    internal ReadOnlySpan<byte> Bytes => bytes.AsSpan(0, length);

    /// <summary>A number that no other state of this world ever has; 0 before the first.</summary>
    internal long Serial { get; private set; }

    /// <summary>Takes the place of another state that nobody keeps.</summary>
    internal void Set(ReadOnlySpan<byte> state, long serial)
    {
        Serial = serial;
        if (bytes.Length < state.Length)
        {
            bytes = new byte[Math.Max(state.Length, 2 * bytes.Length)];
        }

        state.CopyTo(bytes);
        length = state.Length;
    }

    /// <summary>Whether it is the same state, to the bit.</summary>
    internal bool IsSameAs(StateVersion other) => ReferenceEquals(this, other) || Bytes.SequenceEqual(other.Bytes);
}
