using System;
using System.Security.Cryptography;

namespace LagSim.Net.Protection;

/// <summary>A handshake that a client has begun.</summary>
internal sealed class ClientHandshake : IClientHandshake
{
    private readonly NoiseSymmetricState state;
    private readonly Curve25519KeyPair own;
    private readonly HostFingerprint shown;
    private readonly Action<HostFingerprint> finished;
    private readonly byte[] binding;

    /// <param name="state">What is known after the tokens of the client's message, before its payload.</param>
    /// <param name="own">The client's key of one use.</param>
    /// <param name="shown">The fingerprint of the key by which the host proves itself in this handshake.</param>
    /// <param name="finished">Called once an answer has proved the host, with the fingerprint that it has from now on.</param>
    internal ClientHandshake(NoiseSymmetricState state, Curve25519KeyPair own, HostFingerprint shown, Action<HostFingerprint> finished)
    {
        this.state = state;
        this.own = own;
        this.shown = shown;
        this.finished = finished;
        binding = state.HandshakeHash.ToArray();
    }

    /// <inheritdoc/>
    public bool IsHostKeyChanged { get; private set; }

    /// <inheritdoc/>
    public void WriteBinding(Span<byte> destination) => binding.CopyTo(destination);

    /// <inheritdoc/>
    public void Write(ReadOnlySpan<byte> payload, Span<byte> message) => NoiseHandshake.WriteFirst(state, own, payload, message);

    /// <inheritdoc/>
    public IDatagramCipher? TryFinish(string connectKey, ReadOnlySpan<byte> message, Span<byte> payload)
    {
        Span<byte> key = stackalloc byte[PreSharedKey.Bytes];
        PreSharedKey.Write(connectKey, key);
        using NoiseSymmetricState trial = state.Copy();
        Span<byte> said = stackalloc byte[HostFingerprint.Bytes + payload.Length];
        bool isProved = message.Length == NoiseHandshake.KeyBytes + said.Length + Aead.TagBytes
            && NoiseHandshake.TryReadSecond(trial, own, key, message, said);
        CryptographicOperations.ZeroMemory(key);
        if (!isProved)
        {
            return null;
        }

        said.Slice(HostFingerprint.Bytes).CopyTo(payload);
        HostFingerprint newest = HostFingerprint.Read(said);
        IsHostKeyChanged = newest != shown;
        finished(newest);
        CryptographicOperations.ZeroMemory(said); // what the host told is a secret, too
        return NoiseCipher.OfClient(trial);
    }

    /// <inheritdoc/>
    public bool TryReadRefusal(ReadOnlySpan<byte> message, Span<byte> payload)
    {
        using NoiseSymmetricState trial = state.Copy();
        return NoiseHandshake.TryReadSecond(trial, own, PreSharedKey.OfRefusal, message, payload);
    }

    /// <summary>Wipes the keys.</summary>
    public void Dispose()
    {
        state.Dispose();
        own.Dispose();
    }
}
