using System;

namespace LagSim.Net.Protection;

/// <summary>
/// The steps of <c>Noise_NNpsk0_25519_ChaChaPoly_SHA256</c> (Noise protocol framework, revision 34), by which a link gets fresh keys: both
/// ends know a secret of the keys before. <c>-> psk, e</c>, then <c>&lt;- e, ee</c>, without payloads.
/// </summary>
internal static class NoiseExchange
{
    private static ReadOnlySpan<byte> ProtocolName => "Noise_NNpsk0_25519_ChaChaPoly_SHA256"u8;

    /// <summary>Begins: what is known to both before the first message, and the token psk.</summary>
    internal static NoiseSymmetricState Begin(ReadOnlySpan<byte> prologue, ReadOnlySpan<byte> chain)
    {
        NoiseSymmetricState state = new(ProtocolName);
        state.MixHash(prologue);
        state.MixKeyAndHash(chain);
        return state;
    }

    /// <summary>The client's message: a key of one use.</summary>
    internal static void WriteFirst(NoiseSymmetricState state, Curve25519KeyPair own, ReadOnlySpan<byte> payload, Span<byte> message)
    {
        own.PublicKey.CopyTo(message);
        NoiseHandshake.MixPublicKey(state, own.PublicKey);
        state.EncryptAndHash(payload, message.Slice(NoiseHandshake.KeyBytes));
    }

    /// <summary>Reads that message; false if who wrote it does not know the secret.</summary>
    internal static bool TryReadFirst(NoiseSymmetricState state, ReadOnlySpan<byte> message, Span<byte> payload)
    {
        NoiseHandshake.MixPublicKey(state, message.Slice(0, NoiseHandshake.KeyBytes));
        return state.TryDecryptAndHash(message.Slice(NoiseHandshake.KeyBytes), payload);
    }

    /// <summary>The host's answer: another key of one use, agreed on with the client's.</summary>
    /// <returns>False if the client's public key is none.</returns>
    internal static bool TryWriteSecond(
        NoiseSymmetricState state, Curve25519KeyPair own, ReadOnlySpan<byte> clientKey, ReadOnlySpan<byte> payload, Span<byte> message)
    {
        own.PublicKey.CopyTo(message);
        NoiseHandshake.MixPublicKey(state, own.PublicKey);
        if (!NoiseHandshake.TryMixAgreement(state, own, clientKey))
        {
            return false;
        }

        state.EncryptAndHash(payload, message.Slice(NoiseHandshake.KeyBytes));
        return true;
    }

    /// <summary>Reads that answer.</summary>
    internal static bool TryReadSecond(NoiseSymmetricState state, Curve25519KeyPair own, ReadOnlySpan<byte> message, Span<byte> payload)
    {
        ReadOnlySpan<byte> hostKey = message.Slice(0, NoiseHandshake.KeyBytes);
        NoiseHandshake.MixPublicKey(state, hostKey);
        return NoiseHandshake.TryMixAgreement(state, own, hostKey)
            && state.TryDecryptAndHash(message.Slice(NoiseHandshake.KeyBytes), payload);
    }
}
