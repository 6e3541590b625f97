using System;
using Org.BouncyCastle.Math.EC.Rfc8032;

namespace LagSim.Net.Protection;

/// <summary>The public key of a backend that issues connect tokens, by which hosts check them. It is no secret.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public sealed class TokenKey : IEquatable<TokenKey>
{
    private readonly byte[] key;

    internal TokenKey(ReadOnlySpan<byte> key) => this.key = key.ToArray();

    internal ReadOnlySpan<byte> Bytes => key;

    /// <summary>Reads a key.</summary>
    /// <param name="text">The text of <see cref="ToString"/>: 64 hexadecimal digits, lower case.</param>
    /// <param name="key">The key; null if the text is none.</param>
    /// <returns>False if the text is none. Never throws.</returns>
    public static bool TryParse(string? text, out TokenKey? key)
    {
        Span<byte> bytes = stackalloc byte[Ed25519.PublicKeySize];
        key = text is not null && HexText.TryRead(text, bytes) && Ed25519.ValidatePublicKeyFull(bytes.ToArray(), 0)
            ? new TokenKey(bytes)
            : null;
        return key is not null;
    }

    /// <inheritdoc/>
    public bool Equals(TokenKey? other) => other is not null && key.AsSpan().SequenceEqual(other.key);

    /// <inheritdoc/>
    public override bool Equals(object? obj) => Equals(obj as TokenKey);

    /// <inheritdoc/>
    public override int GetHashCode() => BitConverter.ToInt32(key, 0);

    /// <summary>The 64 hexadecimal digits.</summary>
    public override string ToString() => HexText.Of(key);
}
