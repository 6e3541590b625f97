using System;
using System.Security.Cryptography;
using System.Threading;
using Org.BouncyCastle.Math.EC.Rfc7748;

namespace LagSim.Net.Protection;

/// <summary>A key pair of the X25519 key agreement (RFC 7748), computed by Bouncy Castle.</summary>
/// <remarks>Agreements are safe on any thread. Disposing it wipes the private key.</remarks>
internal sealed class Curve25519KeyPair : IDisposable
{
    internal const int Bytes = 32;

    private readonly byte[] privateKey;
    private readonly byte[] publicKey = new byte[Bytes];
    private bool isWiped;
    private long agreements;

    /// <summary>Takes the private key of a pair.</summary>
    internal Curve25519KeyPair(ReadOnlySpan<byte> privateKey)
    {
        this.privateKey = privateKey.ToArray();
        X25519.ScalarMultBase(this.privateKey, 0, publicKey, 0);
    }

    /// <exception cref="ObjectDisposedException">It is wiped.</exception>
    internal ReadOnlySpan<byte> PrivateKey => isWiped ? throw new ObjectDisposedException(nameof(Curve25519KeyPair)) : privateKey;

    internal ReadOnlySpan<byte> PublicKey => publicKey;

    /// <summary>How many agreements were computed with it, each of which takes a tenth of a millisecond or more: what a host may be made to do.</summary>
    internal long Agreements => Interlocked.Read(ref agreements);

    /// <summary>Draws a pair.</summary>
    internal static Curve25519KeyPair Draw()
    {
        Span<byte> drawn = stackalloc byte[Bytes];
        RandomNumberGenerator.Fill(drawn);
        Curve25519KeyPair pair = new(drawn);
        CryptographicOperations.ZeroMemory(drawn);
        return pair;
    }

    /// <summary>Wipes the private key.</summary>
    public void Dispose()
    {
        isWiped = true;
        CryptographicOperations.ZeroMemory(privateKey);
    }

    /// <summary>
    /// Computes the secret that this pair shares with another. False if the other's key is one of the few that give everybody the same
    /// secret, zero.
    /// </summary>
    internal bool TryAgree(ReadOnlySpan<byte> otherPublicKey, Span<byte> secret)
    {
        if (isWiped)
        {
            throw new ObjectDisposedException(nameof(Curve25519KeyPair));
        }

        Interlocked.Increment(ref agreements);
        byte[] agreed = new byte[Bytes];
        bool isSecret = X25519.CalculateAgreement(privateKey, 0, otherPublicKey.ToArray(), 0, agreed, 0);
        agreed.CopyTo(secret);
        CryptographicOperations.ZeroMemory(agreed);
        return isSecret;
    }
}
