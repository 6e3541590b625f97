using System;
using System.Security.Cryptography;

namespace LagSim.Net.Protection;

/// <summary>The system's SHA-256, and HMAC and Noise's HKDF with it.</summary>
internal static class Sha256
{
    internal const int Bytes = 32;

    /// <summary>Hashes two texts, one after the other.</summary>
    internal static void Hash(ReadOnlySpan<byte> first, ReadOnlySpan<byte> second, Span<byte> destination)
    {
        using IncrementalHash hash = IncrementalHash.CreateHash(HashAlgorithmName.SHA256);
        hash.AppendData(first);
        hash.AppendData(second);
        Finish(hash, destination);
    }

    /// <summary>HMAC-SHA-256 of two texts, one after the other.</summary>
    internal static void Hmac(byte[] key, ReadOnlySpan<byte> first, ReadOnlySpan<byte> second, Span<byte> destination)
    {
        using IncrementalHash hash = IncrementalHash.CreateHMAC(HashAlgorithmName.SHA256, key);
        hash.AppendData(first);
        hash.AppendData(second);
        Finish(hash, destination);
    }

    /// <summary>Noise's HKDF (revision 34, section 4.3), which gives two or three keys; an empty span for one that is not wanted.</summary>
    internal static void Hkdf(ReadOnlySpan<byte> chainingKey, ReadOnlySpan<byte> input, Span<byte> one, Span<byte> two, Span<byte> three)
    {
        byte[] key = chainingKey.ToArray();
        byte[] secret = new byte[Bytes];
        Hmac(key, input, default, secret);
        Hmac(secret, [1], default, one);
        Hmac(secret, one, [2], two);
        if (!three.IsEmpty)
        {
            Hmac(secret, two, [3], three);
        }

        CryptographicOperations.ZeroMemory(key);
        CryptographicOperations.ZeroMemory(secret);
    }

    private static void Finish(IncrementalHash hash, Span<byte> destination)
    {
        if (!hash.TryGetHashAndReset(destination, out int length) || length != Bytes)
        {
            throw new InvalidOperationException($"SHA-256 gave {length} bytes instead of {Bytes}.");
        }
    }
}
