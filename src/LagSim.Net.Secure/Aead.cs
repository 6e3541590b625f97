using System;

namespace LagSim.Net.Protection;

/// <summary>ChaCha20-Poly1305 (RFC 8439) with one key: by libsodium where it runs, otherwise by Bouncy Castle.</summary>
/// <remarks>
/// Both give the same bytes. A nonce is 32 zero bits and a number, little-endian, as Noise's ChaChaPoly has it. For one thread.
/// </remarks>
internal abstract class Aead : IDisposable
{
    internal const int KeyBytes = 32;
    internal const int TagBytes = IDatagramCipher.TagBytes;

    /// <summary>The length of a nonce, of which the number is the last eight bytes.</summary>
    protected const int NonceBytes = 12;

    /// <summary>Creates the cipher of a key, which is copied.</summary>
    internal static Aead Of(ReadOnlySpan<byte> key)
    {
#if NET10_0_OR_GREATER
        if (SodiumAead.IsSupported)
        {
            return new SodiumAead(key);
        }
#endif
        return new BouncyCastleAead(key);
    }

    /// <summary>Wipes the key.</summary>
    public abstract void Dispose();

    /// <summary>Encrypts and authenticates.</summary>
    /// <param name="number">The nonce; never the same for two different texts.</param>
    /// <param name="associated">What is authenticated too, and not sent.</param>
    /// <param name="plain">The text.</param>
    /// <param name="destination">Receives the encrypted text and the tag.</param>
    internal abstract void Seal(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> plain, Span<byte> destination);

    /// <summary>Decrypts; false if it was not sealed with this key, number and associated text.</summary>
    internal abstract bool TryOpen(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> source, Span<byte> plain);
}
