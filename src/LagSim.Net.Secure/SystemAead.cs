#if NET10_0_OR_GREATER
using System;
using System.Buffers.Binary;
using System.Security.Cryptography;

namespace LagSim.Net.Protection;

/// <summary>The system's ChaCha20-Poly1305, which allocates nothing for a datagram.</summary>
internal sealed class SystemAead(ReadOnlySpan<byte> key) : Aead
{
    private readonly ChaCha20Poly1305 cipher = new(key);

    /// <inheritdoc/>
    public override void Dispose() => cipher.Dispose();

    internal override void Seal(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> plain, Span<byte> destination)
    {
        Span<byte> nonce = stackalloc byte[NonceBytes];
        nonce.Clear();
        BinaryPrimitives.WriteUInt64LittleEndian(nonce[(NonceBytes - sizeof(ulong))..], number);
        cipher.Encrypt(nonce, plain, destination[..plain.Length], destination.Slice(plain.Length, TagBytes), associated);
    }

    internal override bool TryOpen(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> source, Span<byte> plain)
    {
        if (source.Length < TagBytes)
        {
            return false;
        }

        Span<byte> nonce = stackalloc byte[NonceBytes];
        nonce.Clear();
        BinaryPrimitives.WriteUInt64LittleEndian(nonce[(NonceBytes - sizeof(ulong))..], number);
        int length = source.Length - TagBytes;
        try
        {
            cipher.Decrypt(nonce, source[..length], source[length..], plain[..length], associated);
            return true;
        }
        catch (AuthenticationTagMismatchException)
        {
            return false; // the system has no way to ask without an exception
        }
    }
}
#endif
