using System;
using System.Buffers.Binary;
using System.Security.Cryptography;
using Org.BouncyCastle.Crypto.Engines;
using Org.BouncyCastle.Crypto.Macs;
using Org.BouncyCastle.Crypto.Parameters;

namespace LagSim.Net.Protection;

/// <summary>
/// Bouncy Castle's ChaCha20 and Poly1305, combined as RFC 8439, section 2.8, says; for runtimes without libsodium: Mono, Unity, browsers.
/// </summary>
/// <remarks>
/// Bouncy Castle's own combination is not used, since it refuses a text by an exception, which makes a flood of forgeries expensive.
/// Allocates 80 bytes for each text: Poly1305 needs a new key for each, and takes it as an object only.
/// </remarks>
internal sealed class BouncyCastleAead : Aead
{
    private const int BlockBytes = 64; // of ChaCha20; the first gives Poly1305's key, the text has those after it
    private const int MacKeyBytes = 32;
    private const int MacBlockBytes = 16;

    private static readonly byte[] Zeros = new byte[BlockBytes];

    private readonly KeyStream stream;
    private readonly Poly1305 mac = new();
    private readonly byte[] nonce = new byte[NonceBytes];
    private readonly byte[] block = new byte[BlockBytes];
    private readonly byte[] lengths = new byte[2 * sizeof(ulong)];
    private readonly byte[] tag = new byte[TagBytes];
    private byte[] before = new byte[32]; // the associated text, which is no secret
    private byte[] from = new byte[1200];
    private byte[] to = new byte[1200];
    private bool isWiped;

    internal BouncyCastleAead(ReadOnlySpan<byte> key)
    {
        byte[] copy = key.ToArray();
        stream = new KeyStream(copy);
        CryptographicOperations.ZeroMemory(copy);
    }

    /// <inheritdoc/>
    public override void Dispose()
    {
        isWiped = true;
        stream.Wipe();
        mac.Init(new KeyParameter(Zeros, 0, MacKeyBytes)); // it keeps the key of the last text
        CryptographicOperations.ZeroMemory(block);
        CryptographicOperations.ZeroMemory(from);
        CryptographicOperations.ZeroMemory(to);
    }

    internal override void Seal(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> plain, Span<byte> destination)
    {
        Begin(number, plain);
        stream.ProcessBytes(from, 0, plain.Length, to, 0);
        ComputeTag(associated, to, plain.Length);
        to.AsSpan(0, plain.Length).CopyTo(destination);
        tag.AsSpan().CopyTo(destination.Slice(plain.Length));
    }

    internal override bool TryOpen(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> source, Span<byte> plain)
    {
        int length = source.Length - TagBytes;
        if (length < 0)
        {
            return false;
        }

        Begin(number, source.Slice(0, length));
        ComputeTag(associated, from, length);
        if (!CryptographicOperations.FixedTimeEquals(tag, source.Slice(length)))
        {
            return false;
        }

        stream.ProcessBytes(from, 0, length, to, 0);
        to.AsSpan(0, length).CopyTo(plain);
        return true;
    }

    /// <summary>Takes the text, and begins its key stream and its tag.</summary>
    private void Begin(ulong number, ReadOnlySpan<byte> text)
    {
        if (isWiped)
        {
            throw new ObjectDisposedException(nameof(BouncyCastleAead));
        }

        if (from.Length < text.Length)
        {
            CryptographicOperations.ZeroMemory(from);
            CryptographicOperations.ZeroMemory(to);
            from = new byte[text.Length];
            to = new byte[text.Length];
        }

        text.CopyTo(from);
        BinaryPrimitives.WriteUInt64LittleEndian(nonce.AsSpan(NonceBytes - sizeof(ulong)), number);
        stream.Restart(nonce);
        stream.ProcessBytes(Zeros, 0, BlockBytes, block, 0);
        mac.Init(new KeyParameter(block, 0, MacKeyBytes));
    }

    /// <summary>Computes the tag of the associated and the encrypted text, each filled up with zeros, and their lengths.</summary>
    private void ComputeTag(ReadOnlySpan<byte> associated, byte[] encrypted, int length)
    {
        if (!associated.IsEmpty)
        {
            if (before.Length < associated.Length)
            {
                before = new byte[associated.Length];
            }

            associated.CopyTo(before);
            Update(before, associated.Length);
        }

        Update(encrypted, length);
        BinaryPrimitives.WriteUInt64LittleEndian(lengths, (ulong)associated.Length);
        BinaryPrimitives.WriteUInt64LittleEndian(lengths.AsSpan(sizeof(ulong)), (ulong)length);
        mac.BlockUpdate(lengths, 0, lengths.Length);
        mac.DoFinal(tag, 0);
    }

    private void Update(byte[] text, int length)
    {
        mac.BlockUpdate(text, 0, length);
        mac.BlockUpdate(Zeros, 0, (MacBlockBytes - (length % MacBlockBytes)) % MacBlockBytes);
    }

    /// <summary>ChaCha20 with one key, begun again for each nonce without an object of parameters.</summary>
    private sealed class KeyStream : ChaCha7539Engine
    {
        internal KeyStream(byte[] key)
        {
            Init(true, new ParametersWithIV(new KeyParameter(new byte[KeyBytes]), new byte[NonceBytes])); // which copies that key
            SetKey(key, new byte[NonceBytes]);
            Reset();
        }

        internal void Restart(byte[] nonce)
        {
            SetKey(null, nonce);
            Reset();
        }

        /// <summary>Overwrites the key with one that protects nothing.</summary>
        internal void Wipe()
        {
            SetKey(new byte[KeyBytes], new byte[NonceBytes]);
            Reset();
            ProcessBytes(Zeros, 0, BlockBytes, new byte[BlockBytes], 0); // and what is left of the stream
        }
    }
}
