using System;

namespace LagSim.Net.Protection;

/// <summary>Which host a client wants, and its side of the handshake. The package <c>LagSim.Net.Secure</c> has one.</summary>
/// <remarks>For one session. Give it to a client by <see cref="Sessions.ClientOptions.Protection"/>.</remarks>
public interface IClientProtection
{
    /// <summary>Whether it knows which host it wants. Only then may a connect token be told.</summary>
    bool KnowsHost { get; }

    /// <summary>Writes the fingerprint of the host that it wants, which everybody may know.</summary>
    /// <param name="destination">Receives <see cref="IHostProtection.FingerprintBytes"/> bytes, all 0 if any host will do.</param>
    void WriteWanted(Span<byte> destination);

    /// <summary>Begins a handshake with the host that shows this identity. Cost: one Diffie-Hellman agreement.</summary>
    /// <param name="identity">The identity, of <see cref="IHostProtection.IdentityBytes"/> bytes; it is not proved yet.</param>
    /// <param name="prologue">What both sides know of the handshake so far.</param>
    /// <returns>The handshake; null if the host with that identity is not the one that the client wants.</returns>
    IClientHandshake? Begin(ReadOnlySpan<byte> identity, ReadOnlySpan<byte> prologue);
}
