using System;

namespace LagSim.Net.Protection;

/// <summary>A handshake that a client has begun.</summary>
internal sealed class ClientHandshake : IClientHandshake
{
    private readonly NoiseSymmetricState state;
    private readonly Curve25519KeyPair own;
    private readonly Action finished;
    private readonly byte[] binding;

    /// <param name="state">What is known after the tokens of the client's message, before its payload.</param>
    /// <param name="own">The client's key of one use.</param>
    /// <param name="finished">Called once an answer has proved the host.</param>
    internal ClientHandshake(NoiseSymmetricState state, Curve25519KeyPair own, Action finished)
    {
        this.state = state;
        this.own = own;
        this.finished = finished;
        binding = state.HandshakeHash.ToArray();
    }

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
        bool isProved = NoiseHandshake.TryReadSecond(trial, own, key, message, payload);
        System.Security.Cryptography.CryptographicOperations.ZeroMemory(key);
        if (!isProved)
        {
            return null;
        }

        finished();
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
