using System;
using LagSim.Net.Protection;

namespace LagSim.Net.Wire;

/// <summary>The identity that a host shows: 32 bytes, all of them 0 for a host without protection.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
internal readonly struct PublicIdentity : IEquatable<PublicIdentity>
{
    private readonly (ulong, ulong, ulong, ulong) words;

    private PublicIdentity((ulong, ulong, ulong, ulong) words) => this.words = words;

    /// <summary>Whether it is none: the host has no protection.</summary>
    internal bool IsNone => words == default;

    /// <summary>The identity that a host shows to a client that wants the host with a fingerprint.</summary>
    /// <param name="protection">The host's protection; null for none.</param>
    /// <param name="wanted">The fingerprint.</param>
    /// <param name="key">Which of the host's keys it is.</param>
    internal static PublicIdentity Of(IHostProtection? protection, Token128 wanted, out int key)
    {
        key = 0;
        if (protection is null)
        {
            return default;
        }

        Span<byte> bytes = stackalloc byte[IHostProtection.IdentityBytes];
        Span<byte> fingerprint = stackalloc byte[IHostProtection.FingerprintBytes];
        wanted.CopyTo(fingerprint);
        key = protection.WriteIdentity(fingerprint, bytes);
        WireReader reader = new(bytes);
        return Read(ref reader);
    }

    /// <inheritdoc/>
    public bool Equals(PublicIdentity other) => words == other.words;

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is PublicIdentity other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => words.GetHashCode();

    internal static PublicIdentity Read(ref WireReader reader) =>
        new((reader.ReadUInt64(), reader.ReadUInt64(), reader.ReadUInt64(), reader.ReadUInt64()));

    internal void Write(ref WireWriter writer)
    {
        writer.WriteUInt64(words.Item1);
        writer.WriteUInt64(words.Item2);
        writer.WriteUInt64(words.Item3);
        writer.WriteUInt64(words.Item4);
    }
}
