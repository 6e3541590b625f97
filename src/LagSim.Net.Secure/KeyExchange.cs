using System;

namespace LagSim.Net.Protection;

/// <summary>An exchange of fresh keys that a client has begun.</summary>
internal sealed class KeyExchange(NoiseSymmetricState state, Curve25519KeyPair own) : IKeyExchange
{
    /// <inheritdoc/>
    public IDatagramCipher? TryFinish(ReadOnlySpan<byte> answer)
    {
        using NoiseSymmetricState trial = state.Copy();
        return answer.Length == IDatagramCipher.ExchangeBytes && NoiseExchange.TryReadSecond(trial, own, answer, default)
            ? NoiseCipher.OfClient(trial)
            : null;
    }

    /// <summary>Wipes the keys.</summary>
    public void Dispose()
    {
        state.Dispose();
        own.Dispose();
    }
}
