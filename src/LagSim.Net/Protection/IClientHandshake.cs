using System;

namespace LagSim.Net.Protection;

/// <summary>A handshake that a client has begun, and that the host's answer ends.</summary>
/// <remarks>For one thread. A message that cannot be read changes nothing. Disposing it wipes its keys.</remarks>
public interface IClientHandshake : IDisposable
{
    /// <summary>Writes what this handshake alone has, and no other with the same host and prologue: proofs of secrets cover it.</summary>
    /// <remarks>
    /// It is no secret. A proof that covers it is of no use in another handshake, not even to who can read this one with the host's stolen key.
    /// </remarks>
    /// <param name="destination">Receives <see cref="IHostProtection.BindingBytes"/> bytes.</param>
    void WriteBinding(Span<byte> destination);

    /// <summary>Writes the client's message. Once.</summary>
    /// <param name="payload">What to tell the host; only the owner of its identity can read it.</param>
    /// <param name="message">
    /// Receives the message, <see cref="IHostProtection.HandshakeOverhead"/> bytes more than the payload has.
    /// </param>
    void Write(ReadOnlySpan<byte> payload, Span<byte> message);

    /// <summary>Reads the answer that lets the client in. It proves the host, and that the host knows the connect key.</summary>
    /// <param name="connectKey">The key that both must know.</param>
    /// <param name="message">The host's message.</param>
    /// <param name="payload">
    /// Receives what the host said, in <see cref="IHostProtection.WelcomeOverhead"/> bytes less than the message has.
    /// </param>
    /// <returns>The cipher of the link to the host; null if the message is not an answer of this host to this handshake.</returns>
    IDatagramCipher? TryFinish(string connectKey, ReadOnlySpan<byte> message, Span<byte> payload);

    /// <summary>
    /// Whether the answer that let the client in says that the host has another key from now on: the one by which the client knew it vouches
    /// for that, and the <see cref="IClientProtection"/> that began this handshake wants the host with the new one. False before that answer.
    /// </summary>
    bool IsHostKeyChanged { get; }

    /// <summary>Reads the answer that does not let the client in.</summary>
    /// <param name="message">The host's message.</param>
    /// <param name="payload">
    /// Receives what the host said, in <see cref="IHostProtection.HandshakeOverhead"/> bytes less than the message has.
    /// </param>
    /// <returns>False if the message is not a refusal of this host.</returns>
    bool TryReadRefusal(ReadOnlySpan<byte> message, Span<byte> payload);
}
