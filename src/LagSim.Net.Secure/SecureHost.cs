using System;
using System.Buffers.Binary;

namespace LagSim.Net.Protection;

/// <summary>Protects a host's sessions: every datagram is encrypted and authenticated, and clients can tell this host from any other.</summary>
/// <remarks>
/// Give it to <see cref="Sessions.HostOptions.Protection"/>. Clients without a protection of their own are refused. Safe on any thread;
/// sessions may share it. Cost: one agreement for each join that is read, two more for each that is answered; docs/SECURITY.md has times.
/// </remarks>
/// <example>
/// <code>
/// HostIdentity identity = HostIdentity.Draw();
/// using PeerThread host = PeerThread.Host(scene, udpPort: 5000, new HostOptions { Protection = new SecureHost(identity) });
/// Console.WriteLine(new HostAddress("192.168.0.7", 5000, identity.Fingerprint)); // all that a client needs
/// </code>
/// </example>
public sealed class SecureHost : IHostProtection
{
    private readonly byte[] resetKey = new byte[Sha256.Bytes];

    /// <summary>Protects the sessions of a host with this identity.</summary>
    /// <exception cref="ArgumentNullException">The identity is null.</exception>
    public SecureHost(HostIdentity identity)
    {
        Identity = identity ?? throw new ArgumentNullException(nameof(identity));
        Sha256.Hmac(identity.Keys.PrivateKey.ToArray(), "LagSim reset"u8, default, resetKey);
    }

    /// <summary>The host's identity.</summary>
    public HostIdentity Identity { get; }

    /// <inheritdoc/>
    public void WriteIdentity(Span<byte> destination) => Identity.Keys.PublicKey.CopyTo(destination);

    /// <inheritdoc/>
    public IHostHandshake? TryRead(ReadOnlySpan<byte> prologue, ReadOnlySpan<byte> message, Span<byte> payload)
    {
        NoiseSymmetricState state = NoiseHandshake.Begin(prologue, Identity.Keys.PublicKey);
        if (!NoiseHandshake.TryReadFirst(state, Identity.Keys, message, payload))
        {
            state.Dispose();
            return null;
        }

        return new HostHandshake(state, message.Slice(0, NoiseHandshake.KeyBytes).ToArray());
    }

    /// <inheritdoc/>
    public void WriteResetToken(ulong sessionId, Span<byte> token)
    {
        Span<byte> id = stackalloc byte[sizeof(ulong)];
        BinaryPrimitives.WriteUInt64LittleEndian(id, sessionId);
        Span<byte> hash = stackalloc byte[Sha256.Bytes];
        Sha256.Hmac(resetKey, id, default, hash);
        hash.Slice(0, IHostProtection.ResetTokenBytes).CopyTo(token);
    }
}
