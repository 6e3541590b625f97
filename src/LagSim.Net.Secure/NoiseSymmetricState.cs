using System;
using System.Security.Cryptography;

namespace LagSim.Net.Protection;

/// <summary>The SymmetricState of the Noise protocol framework (revision 34, section 5.2), for ChaChaPoly and SHA256.</summary>
/// <remarks>
/// It follows that section name by name, so that the two can be read side by side. For one thread. Disposing it wipes all of it.
/// Its ciphers are Bouncy Castle's: a key is for one message here, and libsodium takes longer to lock a key's memory than to encrypt one.
/// </remarks>
internal sealed class NoiseSymmetricState : IDisposable
{
    private readonly byte[] ck = new byte[Sha256.Bytes]; // the chaining key
    private readonly byte[] h = new byte[Sha256.Bytes]; // the hash of all that both sides have seen
    private readonly byte[] k = new byte[Aead.KeyBytes]; // the key, if there is one
    private bool hasKey;
    private ulong n;

    /// <summary>InitializeSymmetric.</summary>
    /// <param name="protocolName">Of 32 bytes or more, so that it is hashed.</param>
    internal NoiseSymmetricState(ReadOnlySpan<byte> protocolName)
    {
        Sha256.Hash(protocolName, default, h);
        h.CopyTo(ck, 0);
    }

    private NoiseSymmetricState(NoiseSymmetricState other)
    {
        other.ck.CopyTo(ck, 0);
        other.h.CopyTo(h, 0);
        other.k.CopyTo(k, 0);
        hasKey = other.hasKey;
        n = other.n;
    }

    /// <summary>GetHandshakeHash.</summary>
    internal ReadOnlySpan<byte> HandshakeHash => h;

    /// <summary>A copy, so that a message that turns out not to be readable leaves this state as it is.</summary>
    internal NoiseSymmetricState Copy() => new(this);

    /// <summary>Wipes all of it.</summary>
    public void Dispose()
    {
        CryptographicOperations.ZeroMemory(ck);
        CryptographicOperations.ZeroMemory(h);
        CryptographicOperations.ZeroMemory(k);
    }

    internal void MixKey(ReadOnlySpan<byte> input)
    {
        Sha256.Hkdf(ck, input, ck, k, default);
        hasKey = true;
        n = 0;
    }

    internal void MixHash(ReadOnlySpan<byte> data) => Sha256.Hash(h, data, h);

    internal void MixKeyAndHash(ReadOnlySpan<byte> input)
    {
        Span<byte> mixed = stackalloc byte[Sha256.Bytes];
        Sha256.Hkdf(ck, input, ck, mixed, k);
        MixHash(mixed);
        CryptographicOperations.ZeroMemory(mixed);
        hasKey = true;
        n = 0;
    }

    /// <summary>EncryptAndHash.</summary>
    /// <param name="plain">The payload.</param>
    /// <param name="destination">Receives it encrypted, with the tag.</param>
    internal void EncryptAndHash(ReadOnlySpan<byte> plain, Span<byte> destination)
    {
        ThrowIfNoKey();
        using BouncyCastleAead cipher = new(k);
        cipher.Seal(n++, h, plain, destination);
        MixHash(destination.Slice(0, plain.Length + Aead.TagBytes));
    }

    /// <summary>DecryptAndHash; false if the other side did not encrypt this. The state is of no use after that.</summary>
    internal bool TryDecryptAndHash(ReadOnlySpan<byte> source, Span<byte> plain)
    {
        ThrowIfNoKey();
        using BouncyCastleAead cipher = new(k);
        if (!cipher.TryOpen(n++, h, source, plain))
        {
            return false;
        }

        MixHash(source);
        return true;
    }

    /// <summary>Split, with a third output of the same HKDF.</summary>
    /// <param name="toHost">Receives the key of what the client sends.</param>
    /// <param name="toClient">Receives the key of what the host sends.</param>
    /// <param name="chain">Receives the secret that the next exchange of keys is mixed with; it seals nothing.</param>
    internal void Split(Span<byte> toHost, Span<byte> toClient, Span<byte> chain) => Sha256.Hkdf(ck, default, toHost, toClient, chain);

    private void ThrowIfNoKey()
    {
        if (!hasKey)
        {
            throw new InvalidOperationException("Nothing is sent in clear text: a Diffie-Hellman agreement comes first.");
        }
    }
}
