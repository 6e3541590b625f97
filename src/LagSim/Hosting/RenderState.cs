using System;

namespace LagSim.Hosting;

/// <summary>A copy of a state of rules, for the game's thread. Its memory is used again for the next.</summary>
internal sealed class RenderState
{
    private byte[] bytes = Array.Empty<byte>();
    private int length;

    /// <summary>The encoded state.</summary>
    internal ReadOnlySpan<byte> Bytes => bytes.AsSpan(0, length);

    /// <summary>The number of the state; 0 before the first.</summary>
    internal long Serial { get; private set; }

    /// <summary>Takes over a state.</summary>
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
}
