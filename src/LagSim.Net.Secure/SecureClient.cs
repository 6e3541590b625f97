using System;

namespace LagSim.Net.Protection;

/// <summary>Protects a client's session: every datagram is encrypted and authenticated, and the host is the one that is meant.</summary>
/// <remarks>
/// Give it to <see cref="Sessions.ClientOptions.Protection"/>, one to each session. A host without protection is not joined. Safe to read
/// from any thread.
/// </remarks>
/// <example>
/// <code>
/// HostAddress address = HostAddress.Parse("lagsim://192.168.0.7:5000#6f1c8a0b2d3e4f5061728394a5b6c7d8");
/// ClientOptions options = new() { Protection = new SecureClient(address.Fingerprint) };
/// using PeerThread client = PeerThread.Join(new IPEndPoint(Dns.GetHostAddresses(address.Host)[0], address.Port), options);
/// </code>
/// </example>
public sealed class SecureClient : IClientProtection
{
    private volatile object? other; // likewise
    private volatile object? trusted; // a boxed fingerprint, so that other threads read it whole

    /// <summary>Joins only the host with this fingerprint.</summary>
    public SecureClient(HostFingerprint fingerprint) => trusted = fingerprint;

    private SecureClient()
    {
    }

    /// <summary>
    /// The fingerprint of the host that this client joins; null while it joins whichever host answers first, and none has. It is another one
    /// once the host has changed its key (<see cref="HostIdentity.ChangeKey"/>), and the one that this client knew has vouched for the new
    /// one, in the handshake by which it joined: <see cref="Sessions.ClientSession.HostKeyChanged"/> says so.
    /// </summary>
    public HostFingerprint? Host => (HostFingerprint?)trusted;

    /// <summary>
    /// The fingerprint that the last host showed which answered and is not the one to join; null while none has. Nothing proves it.
    /// </summary>
    public HostFingerprint? Other => (HostFingerprint?)other;

    /// <inheritdoc/>
    public bool KnowsHost => trusted is not null;

    /// <summary>
    /// Joins whichever host answers first, and from then on only that one. Somebody on the path can be that host: show
    /// <see cref="Host"/> to the player, and keep it for the next time.
    /// </summary>
    public static SecureClient TrustOnFirstUse() => new();

    /// <inheritdoc/>
    public void WriteWanted(Span<byte> destination) => (Host ?? default).Write(destination);

    /// <inheritdoc/>
    public IClientHandshake? Begin(ReadOnlySpan<byte> identity, ReadOnlySpan<byte> prologue)
    {
        HostFingerprint shown = HostFingerprint.OfPublicKey(identity);
        if (Host is HostFingerprint wanted && wanted != shown)
        {
            other = shown;
            return null;
        }

        NoiseSymmetricState state = NoiseHandshake.Begin(prologue, identity);
        Curve25519KeyPair own = Curve25519KeyPair.Draw();
        if (!NoiseHandshake.TryMixFirst(state, own, identity))
        {
            state.Dispose();
            own.Dispose();
            return null; // that public key is none
        }

        return new ClientHandshake(state, own, shown, newest => trusted = newest);
    }
}
