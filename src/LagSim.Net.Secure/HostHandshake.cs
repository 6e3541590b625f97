using System;
using System.Security.Cryptography;

namespace LagSim.Net.Protection;

/// <summary>A client's handshake message that a host has read.</summary>
/// <param name="state">What is known after the client's message.</param>
/// <param name="clientKey">The client's key of one use.</param>
/// <param name="binding">What the handshake alone has.</param>
/// <param name="newest">What the host is known by from now on: the key of the handshake vouches for it.</param>
internal sealed class HostHandshake(NoiseSymmetricState state, byte[] clientKey, byte[] binding, HostFingerprint newest) : IHostHandshake
{
    /// <inheritdoc/>
    public void WriteBinding(Span<byte> destination) => binding.CopyTo(destination);

    /// <inheritdoc/>
    public IDatagramCipher Accept(string connectKey, ReadOnlySpan<byte> payload, Span<byte> message)
    {
        Span<byte> key = stackalloc byte[PreSharedKey.Bytes];
        PreSharedKey.Write(connectKey, key);
        Span<byte> said = stackalloc byte[HostFingerprint.Bytes + payload.Length];
        newest.Write(said);
        payload.CopyTo(said.Slice(HostFingerprint.Bytes));
        Answer(key, said, message);
        CryptographicOperations.ZeroMemory(key);
        CryptographicOperations.ZeroMemory(said); // what the client is told is a secret, too
        return NoiseCipher.OfHost(state);
    }

    /// <inheritdoc/>
    public void Refuse(ReadOnlySpan<byte> payload, Span<byte> message) => Answer(PreSharedKey.OfRefusal, payload, message);

    /// <summary>Wipes the keys.</summary>
    public void Dispose() => state.Dispose();

    private void Answer(ReadOnlySpan<byte> preSharedKey, ReadOnlySpan<byte> payload, Span<byte> message)
    {
        using Curve25519KeyPair own = Curve25519KeyPair.Draw();
        if (!NoiseHandshake.TryWriteSecond(state, own, clientKey, preSharedKey, payload, message))
        {
            throw new InvalidOperationException("The client's key is none; its message should not have been read.");
        }
    }
}
