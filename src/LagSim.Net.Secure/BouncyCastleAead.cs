using System;
using System.Buffers.Binary;
using System.Security.Cryptography;
using Org.BouncyCastle.Crypto;
using Org.BouncyCastle.Crypto.Parameters;

namespace LagSim.Net.Protection;

/// <summary>Bouncy Castle's ChaCha20-Poly1305, for runtimes without libsodium: Mono, Unity, browsers.</summary>
internal sealed class BouncyCastleAead : Aead
{
    private readonly Org.BouncyCastle.Crypto.Modes.ChaCha20Poly1305 cipher = new();
    private readonly byte[] nonce = new byte[NonceBytes];
    private readonly byte[] wipe; // Bouncy Castle copies keys; this is ours
    private KeyParameter? key;
    private byte[] from = new byte[1200];
    private byte[] to = new byte[1200];

    internal BouncyCastleAead(ReadOnlySpan<byte> key)
    {
        wipe = key.ToArray();
        this.key = new KeyParameter(wipe);
    }

    /// <inheritdoc/>
    public override void Dispose()
    {
        // What Bouncy Castle holds is overwritten with a key that protects nothing, as it has no other way to wipe it.
        CryptographicOperations.ZeroMemory(wipe);
        CryptographicOperations.ZeroMemory(from);
        CryptographicOperations.ZeroMemory(to);
        cipher.Init(false, new ParametersWithIV(new KeyParameter(wipe), new byte[NonceBytes]));
        key = null;
    }

    internal override void Seal(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> plain, Span<byte> destination)
    {
        Begin(forEncryption: true, number, associated);
        int length = Run(plain);
        to.AsSpan(0, length).CopyTo(destination);
    }

    internal override bool TryOpen(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> source, Span<byte> plain)
    {
        if (source.Length < TagBytes)
        {
            return false;
        }

        Begin(forEncryption: false, number, associated);
        try
        {
            int length = Run(source);
            to.AsSpan(0, length).CopyTo(plain);
            return true;
        }
        catch (InvalidCipherTextException)
        {
            return false; // the library has no way to ask without an exception
        }
    }

    private void Begin(bool forEncryption, ulong number, ReadOnlySpan<byte> associated)
    {
        BinaryPrimitives.WriteUInt64LittleEndian(nonce.AsSpan(NonceBytes - sizeof(ulong)), number);
        cipher.Init(forEncryption, new ParametersWithIV(key ?? throw new ObjectDisposedException(nameof(BouncyCastleAead)), nonce));
        if (!associated.IsEmpty)
        {
            cipher.ProcessAadBytes(associated.ToArray(), 0, associated.Length);
        }
    }

    private int Run(ReadOnlySpan<byte> text)
    {
        if (from.Length < text.Length + TagBytes)
        {
            from = new byte[text.Length + TagBytes];
            to = new byte[text.Length + TagBytes];
        }

        text.CopyTo(from);
        int length = cipher.ProcessBytes(from, 0, text.Length, to, 0);
        return length + cipher.DoFinal(to, length);
    }
}
