using System;

namespace LagSim.Net.Protection;

/// <summary>Encrypts and authenticates the datagrams between two peers, with a key for each direction.</summary>
/// <remarks>
/// For one thread. Every datagram has a number, which the caller counts up and sends along: the same number is never sealed twice, and
/// of the datagrams that arrive the caller accepts each number once. Disposing it wipes the keys.
/// </remarks>
public interface IDatagramCipher : IDisposable
{
    /// <summary>How much longer a sealed datagram is, in bytes.</summary>
    public const int TagBytes = 16;

    /// <summary>Encrypts a datagram to the other peer.</summary>
    /// <param name="number">Its number: another one for each.</param>
    /// <param name="associated">What is sent in clear text before it, and authenticated with it.</param>
    /// <param name="plain">What to encrypt.</param>
    /// <param name="destination">Receives the encrypted bytes and the tag, <see cref="TagBytes"/> more than the plain ones.</param>
    void Seal(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> plain, Span<byte> destination);

    /// <summary>Decrypts a datagram of the other peer.</summary>
    /// <param name="number">The number that it says it has.</param>
    /// <param name="associated">What came in clear text before it.</param>
    /// <param name="source">The encrypted bytes and the tag.</param>
    /// <param name="plain">Receives the plain bytes; arbitrary ones on failure.</param>
    /// <returns>False if the other peer did not seal this, with this number and after this text. Never throws for bytes that arrived.</returns>
    bool TryOpen(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> source, Span<byte> plain);
}
