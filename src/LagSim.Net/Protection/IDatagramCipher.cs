using System;

namespace LagSim.Net.Protection;

/// <summary>Encrypts and authenticates the datagrams between two peers, with a key for each direction, and makes way for fresh keys.</summary>
/// <remarks>
/// For one thread. Every datagram has a number, which the caller counts up and sends along: the same number is never sealed twice, and
/// of the datagrams that arrive the caller accepts each number once. Its keys never change: an exchange over the link, begun by the client's
/// end, gives another cipher, whose keys cannot be computed from this one's. Disposing it wipes the keys.
/// </remarks>
public interface IDatagramCipher : IDisposable
{
    /// <summary>How much longer a sealed datagram is, in bytes.</summary>
    public const int TagBytes = 16;

    /// <summary>The length of each of the two messages of an exchange of fresh keys, in bytes.</summary>
    public const int ExchangeBytes = 48;

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

    /// <summary>Begins an exchange of fresh keys, on the client's end. Cost: one public key computed.</summary>
    /// <param name="prologue">What both ends know of the exchange; if theirs differ, its messages cannot be read.</param>
    /// <param name="message">Receives the message for the host, <see cref="ExchangeBytes"/> bytes.</param>
    /// <returns>The exchange, to be finished or disposed.</returns>
    IKeyExchange BeginExchange(ReadOnlySpan<byte> prologue, Span<byte> message);

    /// <summary>Answers an exchange of fresh keys, on the host's end. Cost: one Diffie-Hellman agreement, and one public key computed.</summary>
    /// <param name="prologue">What both ends know of the exchange.</param>
    /// <param name="message">The client's message.</param>
    /// <param name="answer">Receives the answer, <see cref="ExchangeBytes"/> bytes.</param>
    /// <returns>The cipher with the fresh keys; null if the message is not one of the link's other end. Never throws.</returns>
    IDatagramCipher? TryAnswerExchange(ReadOnlySpan<byte> prologue, ReadOnlySpan<byte> message, Span<byte> answer);
}
