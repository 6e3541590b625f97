using System;
using System.Security.Cryptography;

namespace LagSim.Net.Protection;

/// <summary>
/// Protects a host's sessions: every datagram is encrypted and authenticated, and clients can tell this host from any other.
/// </summary>
/// <remarks>
/// Give it to <see cref="Sessions.HostOptions.Protection"/>. Clients without a protection of their own are refused. Safe on any thread;
/// sessions on different ports may share it. Cost: one agreement for each join that is read, two more for each that is answered;
/// docs/SECURITY.md has times.
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
    private readonly UsedTokens used;
    private readonly TokenKey? tokens;
    private readonly Func<DateTimeOffset> clock;

    /// <summary>Protects the sessions of a host with this identity.</summary>
    /// <param name="identity">The identity.</param>
    /// <param name="tokens">The key of the backend whose connect tokens clients need; null to let in clients without a token.</param>
    /// <exception cref="ArgumentNullException">The identity is null.</exception>
    public SecureHost(HostIdentity identity, TokenKey? tokens = null)
        : this(identity, tokens, static () => DateTimeOffset.UtcNow)
    {
    }

    // clock is the date, by which tokens are valid; elapsed the time that nobody sets, by which used ones are forgotten.
    internal SecureHost(HostIdentity identity, TokenKey? tokens, Func<DateTimeOffset> clock, Func<TimeSpan>? elapsed = null)
    {
        used = new UsedTokens(elapsed);
        this.tokens = tokens;
        this.clock = clock;
        Identity = identity ?? throw new ArgumentNullException(nameof(identity));
    }

    /// <summary>The host's identity.</summary>
    public HostIdentity Identity { get; }

    /// <inheritdoc/>
    public bool RequiresToken => tokens is not null;

    /// <inheritdoc/>
    public TokenReading ReadToken(ReadOnlySpan<byte> token)
    {
        TokenReading reading = tokens is null
            ? new TokenReading(TokenFault.OtherIssuer)
            : ConnectToken.Read(token, Identity.Fingerprint, tokens, clock());
        return reading.Fault != TokenFault.None || !ConnectToken.TryReadId(token, out (ulong, ulong) id, out long until) ? reading
            : used.Contains(id) ? new TokenReading(TokenFault.Used)
            : used.SecondsForgotten(until) is long seconds
                ? new TokenReading(TokenFault.Expired, TimeSpan.FromSeconds(Math.Min(seconds, int.MaxValue)))
            : reading;
    }

    /// <inheritdoc/>
    public bool TryUseToken(ReadOnlySpan<byte> token) =>
        ConnectToken.TryReadId(token, out (ulong, ulong) id, out long until) && used.Add(id, until);

    /// <inheritdoc/>
    public void WriteIdentity(Span<byte> destination) => Identity.Keys.PublicKey.CopyTo(destination);

    /// <inheritdoc/>
    public IHostHandshake? TryRead(ReadOnlySpan<byte> prologue, ReadOnlySpan<byte> message, Span<byte> payload)
    {
        NoiseSymmetricState state = NoiseHandshake.Begin(prologue, Identity.Keys.PublicKey);
        byte[] binding = new byte[IHostProtection.BindingBytes];
        if (!NoiseHandshake.TryReadFirst(state, Identity.Keys, message, payload, binding))
        {
            state.Dispose();
            return null;
        }

        return new HostHandshake(state, message.Slice(0, NoiseHandshake.KeyBytes).ToArray(), binding);
    }

    /// <inheritdoc/>
    public void WriteResetKey(ReadOnlySpan<byte> link, Span<byte> key)
    {
        byte[] secret = Identity.Keys.PrivateKey.ToArray(), ofAll = new byte[Sha256.Bytes];
        Span<byte> hash = stackalloc byte[Sha256.Bytes];
        Sha256.Hmac(secret, "LagSim reset"u8, default, ofAll);
        Sha256.Hmac(ofAll, link, default, hash);
        hash.Slice(0, IHostProtection.ResetKeyBytes).CopyTo(key);
        CryptographicOperations.ZeroMemory(secret);
        CryptographicOperations.ZeroMemory(ofAll);
    }
}
