using System;
using LagSim.Net.Protection;

namespace LagSim.Net.Wire;

/// <summary>The identity that a host shows: 32 bytes, all of them 0 for a host without protection.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
internal readonly struct PublicIdentity : IEquatable<PublicIdentity>
{
    private readonly Token128 first;
    private readonly Token128 second;

    private PublicIdentity(Token128 first, Token128 second)
    {
        this.first = first;
        this.second = second;
    }

    /// <summary>Whether it is none: the host has no protection.</summary>
    internal bool IsNone => first == default && second == default;

    /// <summary>The identity that a host shows.</summary>
    internal static PublicIdentity Of(IHostProtection? protection)
    {
        if (protection is null)
        {
            return default;
        }

        Span<byte> bytes = stackalloc byte[IHostProtection.IdentityBytes];
        protection.WriteIdentity(bytes);
        return new PublicIdentity(new Token128(bytes), new Token128(bytes.Slice(Token128.Bytes)));
    }

    /// <inheritdoc/>
    public bool Equals(PublicIdentity other) => first == other.first && second == other.second;

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is PublicIdentity other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => first.GetHashCode();

    internal static PublicIdentity Read(ref WireReader reader) => new(Token128.Read(ref reader), Token128.Read(ref reader));

    internal void Write(ref WireWriter writer)
    {
        first.Write(ref writer);
        second.Write(ref writer);
    }
}
