using System;

namespace LagSim.Net.Protection;

/// <summary>
/// A host's identity, and its side of the handshake by which a joining client and a host agree on keys. The package
/// <c>LagSim.Net.Secure</c> has one.
/// </summary>
/// <remarks>
/// Safe on any thread: sessions on different ports may share it. Give it to a host by <see cref="Sessions.HostOptions.Protection"/>.
/// </remarks>
public interface IHostProtection
{
    /// <summary>The length of the identity that a host shows, in bytes.</summary>
    public const int IdentityBytes = 32;

    /// <summary>How much longer a handshake message is than its payload, in bytes; but see <see cref="WelcomeOverhead"/>.</summary>
    public const int HandshakeOverhead = 48;

    /// <summary>The length of what clients name a host by, in bytes (<see cref="IClientProtection.WriteWanted"/>).</summary>
    public const int FingerprintBytes = 16;

    /// <summary>
    /// How much longer the answer that lets a client in is than its payload, in bytes: it tells the host's newest fingerprint, too.
    /// </summary>
    public const int WelcomeOverhead = HandshakeOverhead + FingerprintBytes;

    /// <summary>The length of what a handshake alone has, in bytes (<see cref="IHostHandshake.WriteBinding"/>).</summary>
    public const int BindingBytes = 32;

    /// <summary>The length of a reset key, in bytes.</summary>
    public const int ResetKeyBytes = 16;

    /// <summary>The longest connect token, in bytes.</summary>
    public const int MaxTokenBytes = 256;

    /// <summary>How many keys a host may have at a time: its own, and former ones.</summary>
    public const int MaxKeys = 8;

    /// <summary>
    /// Whether clients need a connect token: one with a valid one, or with the pass of a player that came in with one, is let in.
    /// </summary>
    bool RequiresToken { get; }

    /// <summary>Writes the identity that this host shows to a client: the public key that it wants, if that is one of its own, else the newest.</summary>
    /// <param name="wanted">The fingerprint of the host that the client says it wants; all 0 for any.</param>
    /// <param name="destination">Receives <see cref="IdentityBytes"/> bytes.</param>
    /// <returns>Which key it is, for <see cref="TryRead"/>: from 0 to below <see cref="MaxKeys"/>, always the same for one key.</returns>
    int WriteIdentity(ReadOnlySpan<byte> wanted, Span<byte> destination);

    /// <summary>Reads a client's handshake message. Cost: one Diffie-Hellman agreement, however many keys there are.</summary>
    /// <param name="key">Which key the client was shown, as <see cref="WriteIdentity"/> returned it.</param>
    /// <param name="prologue">What both sides know of the handshake so far; if theirs differ, the message cannot be read.</param>
    /// <param name="message">The message.</param>
    /// <param name="payload">
    /// Receives what the client said, in <see cref="HandshakeOverhead"/> bytes less than the message has. Nobody but this host can read
    /// it, and it is not known yet who wrote it.
    /// </param>
    /// <returns>The handshake, to be answered or disposed; null if the message is not one for this host. Never throws.</returns>
    IHostHandshake? TryRead(int key, ReadOnlySpan<byte> prologue, ReadOnlySpan<byte> message, Span<byte> payload);

    /// <summary>Reads a connect token. Cost: one signature checked.</summary>
    /// <param name="token">The token, up to <see cref="MaxTokenBytes"/> bytes.</param>
    /// <returns>What it says, or what is wrong with it. Never throws.</returns>
    TokenReading ReadToken(ReadOnlySpan<byte> token);

    /// <summary>Marks a token that was read as used: from then on it is <see cref="TokenFault.Used"/>.</summary>
    /// <returns>False if it was used before.</returns>
    bool TryUseToken(ReadOnlySpan<byte> token);

    /// <summary>
    /// Writes the key by which this host, even after a restart, proves to the client of a link that it does not know the link.
    /// </summary>
    /// <param name="link">What identifies the link: its session id, and where the host listens.</param>
    /// <param name="key">Receives <see cref="ResetKeyBytes"/> bytes: always the same for one link and identity.</param>
    void WriteResetKey(ReadOnlySpan<byte> link, Span<byte> key);
}
