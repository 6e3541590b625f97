using System;
using System.Security.Cryptography;

namespace LagSim.Net.Protection;

/// <summary>A host's key pair, by which clients know that they are talking to this host and no other.</summary>
/// <remarks>
/// <para>A program that hosts again and again draws one once, keeps <see cref="ToSecretText"/> in a file that only it can read, and
/// publishes the <see cref="Fingerprint"/>. With the secret anyone can pose as this host, and read what clients said in joins that they
/// recorded; what was said in sessions stays unreadable.</para>
/// <para>Safe on any thread. Disposing it wipes the key; dispose it after the sessions that use it.</para>
/// </remarks>
public sealed class HostIdentity : IDisposable
{
    private readonly Curve25519KeyPair keys;

    private HostIdentity(Curve25519KeyPair keys)
    {
        this.keys = keys;
        Fingerprint = HostFingerprint.OfPublicKey(keys.PublicKey);
    }

    /// <summary>What clients know this host by.</summary>
    public HostFingerprint Fingerprint { get; }

    internal Curve25519KeyPair Keys => keys;

    /// <summary>Draws a new identity, from the system's random numbers.</summary>
    public static HostIdentity Draw() => new(Curve25519KeyPair.Draw());

    /// <summary>Reads an identity that was kept.</summary>
    /// <param name="text">The text of <see cref="ToSecretText"/>: 64 hexadecimal digits, lower case.</param>
    /// <param name="identity">The identity; null if the text is none.</param>
    /// <returns>False if the text is none. Never throws.</returns>
    public static bool TryParse(string? text, out HostIdentity? identity)
    {
        Span<byte> key = stackalloc byte[Curve25519KeyPair.Bytes];
        identity = text is not null && HexText.TryRead(text, key) ? new HostIdentity(new Curve25519KeyPair(key)) : null;
        CryptographicOperations.ZeroMemory(key);
        return identity is not null;
    }

    /// <summary>The private key as 64 hexadecimal digits, for <see cref="TryParse"/>. Keep it like a password.</summary>
    /// <exception cref="ObjectDisposedException">The key is wiped.</exception>
    public string ToSecretText() => HexText.Of(keys.PrivateKey);

    /// <summary>The fingerprint; never the secret.</summary>
    public override string ToString() => Fingerprint.ToString();

    /// <summary>Wipes the private key.</summary>
    public void Dispose() => keys.Dispose();
}
