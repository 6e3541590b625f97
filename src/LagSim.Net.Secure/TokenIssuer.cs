using System;
using System.Security.Cryptography;
using Org.BouncyCastle.Math.EC.Rfc8032;

namespace LagSim.Net.Protection;

/// <summary>Issues connect tokens: for a backend that knows its players, and decides who may join which host.</summary>
/// <remarks>
/// <para>The backend keeps <see cref="ToSecretText"/> where only it can read it, and gives hosts the <see cref="Key"/>. With the
/// secret anyone can admit players.</para>
/// <para>Safe on any thread. Disposing it wipes the secret.</para>
/// </remarks>
/// <example>
/// <code>
/// using TokenIssuer issuer = TokenIssuer.Draw(); // or the one that was kept
/// byte[] token = issuer.Issue(new PlayerAdmission("account 4711", "Ada"), hostAddress.Fingerprint);
/// </code>
/// </example>
public sealed class TokenIssuer : IDisposable
{
    /// <summary>How long a token is valid unless another time is given: a minute.</summary>
    public static readonly TimeSpan DefaultValidity = TimeSpan.FromMinutes(1);

    /// <summary>The longest time that a token is valid: a day.</summary>
    public static readonly TimeSpan MaxValidity = TimeSpan.FromDays(1);

    /// <summary>How far a token's time begins before it is issued, since a host's clock may be behind.</summary>
    private static readonly TimeSpan Leeway = TimeSpan.FromSeconds(10);

    private readonly byte[] secret;
    private bool isWiped;

    private TokenIssuer(ReadOnlySpan<byte> secret)
    {
        this.secret = secret.ToArray();
        byte[] publicKey = new byte[Ed25519.PublicKeySize];
        Ed25519.GeneratePublicKey(this.secret, 0, publicKey, 0);
        Key = new TokenKey(publicKey);
    }

    /// <summary>The public key, for the hosts.</summary>
    public TokenKey Key { get; }

    /// <summary>Draws a new secret, from the system's random numbers.</summary>
    public static TokenIssuer Draw()
    {
        Span<byte> drawn = stackalloc byte[Ed25519.SecretKeySize];
        RandomNumberGenerator.Fill(drawn);
        TokenIssuer issuer = new(drawn);
        CryptographicOperations.ZeroMemory(drawn);
        return issuer;
    }

    /// <summary>Reads a secret that was kept.</summary>
    /// <param name="text">The text of <see cref="ToSecretText"/>: 64 hexadecimal digits, lower case.</param>
    /// <param name="issuer">The issuer; null if the text is no secret.</param>
    /// <returns>False if the text is none. Never throws.</returns>
    public static bool TryParse(string? text, out TokenIssuer? issuer)
    {
        Span<byte> read = stackalloc byte[Ed25519.SecretKeySize];
        issuer = text is not null && HexText.TryRead(text, read) ? new TokenIssuer(read) : null;
        CryptographicOperations.ZeroMemory(read);
        return issuer is not null;
    }

    /// <summary>Issues a token that admits one player to one host, once.</summary>
    /// <param name="admission">Who the player is, and what it may do.</param>
    /// <param name="host">The host.</param>
    /// <param name="validity">How long the player may take to join, 1 s to <see cref="MaxValidity"/>; default a minute.</param>
    /// <param name="now">The time; default the system's.</param>
    /// <returns>The token, up to 256 bytes: a secret of that player's until it is used.</returns>
    /// <exception cref="ArgumentException">An argument is missing.</exception>
    /// <exception cref="ObjectDisposedException">The secret is wiped.</exception>
    /// <exception cref="ArgumentOutOfRangeException">The validity is out of range.</exception>
    public byte[] Issue(PlayerAdmission admission, HostFingerprint host, TimeSpan? validity = null, DateTimeOffset? now = null)
    {
        if (isWiped)
        {
            throw new ObjectDisposedException(nameof(TokenIssuer));
        }

        if (host == default)
        {
            throw new ArgumentException("The fingerprint is the default, which is no host's.", nameof(host));
        }

        TimeSpan time = validity ?? DefaultValidity;
        if (time < TimeSpan.FromSeconds(1) || time > MaxValidity)
        {
            throw new ArgumentOutOfRangeException(nameof(validity), time, "A token is valid for 1 s to a day.");
        }

        Span<byte> id = stackalloc byte[ConnectToken.IdBytes];
        RandomNumberGenerator.Fill(id);
        DateTimeOffset issued = now ?? DateTimeOffset.UtcNow;
        return ConnectToken.Write(
            admission ?? throw new ArgumentNullException(nameof(admission)), host, issued - Leeway, issued + time, id, Key, secret);
    }

    /// <summary>The secret as 64 hexadecimal digits, for <see cref="TryParse"/>. Keep it like a password.</summary>
    /// <exception cref="ObjectDisposedException">The secret is wiped.</exception>
    public string ToSecretText() => isWiped ? throw new ObjectDisposedException(nameof(TokenIssuer)) : HexText.Of(secret);

    /// <summary>The public key; never the secret.</summary>
    public override string ToString() => Key.ToString();

    /// <summary>Wipes the secret.</summary>
    public void Dispose()
    {
        isWiped = true;
        CryptographicOperations.ZeroMemory(secret);
    }
}
