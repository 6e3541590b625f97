using System;

namespace LagSim.Net.Protection;

/// <summary>A handshake that a host has read, and answers once.</summary>
/// <remarks>For one thread. Disposing it wipes its keys.</remarks>
public interface IHostHandshake : IDisposable
{
    /// <summary>Writes what this handshake alone has; the client's proofs cover it (<see cref="IClientHandshake.WriteBinding"/>).</summary>
    /// <param name="destination">Receives <see cref="IHostProtection.BindingBytes"/> bytes.</param>
    void WriteBinding(Span<byte> destination);

    /// <summary>Writes the answer that lets the client in.</summary>
    /// <param name="connectKey">The key that both must know; the answer can be read with it only.</param>
    /// <param name="payload">What to tell the client.</param>
    /// <param name="message">
    /// Receives the message, <see cref="IHostProtection.WelcomeOverhead"/> bytes more than the payload has.
    /// </param>
    /// <returns>The cipher of the link to that client.</returns>
    IDatagramCipher Accept(string connectKey, ReadOnlySpan<byte> payload, Span<byte> message);

    /// <summary>Writes the answer that does not let the client in. It can be read without the connect key, and proves the host.</summary>
    /// <param name="payload">What to tell the client.</param>
    /// <param name="message">
    /// Receives the message, <see cref="IHostProtection.HandshakeOverhead"/> bytes more than the payload has.
    /// </param>
    void Refuse(ReadOnlySpan<byte> payload, Span<byte> message);
}
