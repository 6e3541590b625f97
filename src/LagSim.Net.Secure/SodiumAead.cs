#if NET10_0_OR_GREATER
using System;
using System.Buffers.Binary;
using NSec.Cryptography;

namespace LagSim.Net.Protection;

/// <summary>libsodium's ChaCha20-Poly1305 by NSec, which allocates nothing for a datagram, and refuses one without an exception.</summary>
/// <remarks>
/// The system's own cipher is not used, since it refuses a datagram by an exception, which costs more than all else that a host does for a
/// forged one.
/// </remarks>
internal sealed class SodiumAead(ReadOnlySpan<byte> key) : Aead
{
    private readonly Key key = Key.Import(AeadAlgorithm.ChaCha20Poly1305, key, KeyBlobFormat.RawSymmetricKey);

    /// <summary>Whether libsodium runs here. It does not in a browser, nor where its native library is missing.</summary>
    internal static bool IsSupported { get; } = Loads();

    /// <inheritdoc/>
    public override void Dispose() => key.Dispose();

    internal override void Seal(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> plain, Span<byte> destination)
    {
        Span<byte> nonce = stackalloc byte[NonceBytes];
        WriteNonce(number, nonce);
        AeadAlgorithm.ChaCha20Poly1305.Encrypt(key, nonce, associated, plain, destination[..(plain.Length + TagBytes)]);
    }

    internal override bool TryOpen(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> source, Span<byte> plain)
    {
        if (source.Length < TagBytes)
        {
            return false;
        }

        Span<byte> nonce = stackalloc byte[NonceBytes];
        WriteNonce(number, nonce);
        return AeadAlgorithm.ChaCha20Poly1305.Decrypt(key, nonce, associated, source, plain[..(source.Length - TagBytes)]);
    }

    private static void WriteNonce(ulong number, Span<byte> nonce)
    {
        nonce.Clear();
        BinaryPrimitives.WriteUInt64LittleEndian(nonce[(NonceBytes - sizeof(ulong))..], number);
    }

    private static bool Loads()
    {
        try
        {
            return AeadAlgorithm.ChaCha20Poly1305.KeySize == KeyBytes; // the first use loads the library
        }
        catch (Exception missing) when (missing is TypeInitializationException or TypeLoadException // a library or a function is not there
            or BadImageFormatException or InvalidOperationException or PlatformNotSupportedException) // or it is another version
        {
            return false;
        }
    }
}
#endif
