using System;

namespace LagSim.Net.Protection;

/// <summary>
/// The steps of <c>Noise_NKpsk2_25519_ChaChaPoly_SHA256</c> (Noise protocol framework, revision 34): the client knows the host's public
/// key beforehand, both know a key, and the client stays anonymous. <c>-> e, es</c>, then <c>&lt;- e, ee, psk</c>.
/// </summary>
/// <remarks>Messages are a public key of one use and the payload, encrypted. Host and client differ only in who draws which key.</remarks>
internal static class NoiseHandshake
{
    internal const int KeyBytes = Curve25519KeyPair.Bytes;

    private static ReadOnlySpan<byte> ProtocolName => "Noise_NKpsk2_25519_ChaChaPoly_SHA256"u8;

    /// <summary>Begins: what is known to both before the first message.</summary>
    internal static NoiseSymmetricState Begin(ReadOnlySpan<byte> prologue, ReadOnlySpan<byte> hostPublicKey)
    {
        NoiseSymmetricState state = new(ProtocolName);
        state.MixHash(prologue);
        state.MixHash(hostPublicKey);
        return state;
    }

    /// <summary>The tokens of the client's first message: a new key of one use, agreed on with the host's.</summary>
    /// <returns>False if the host's public key is none.</returns>
    internal static bool TryMixFirst(NoiseSymmetricState state, Curve25519KeyPair own, ReadOnlySpan<byte> hostPublicKey)
    {
        MixPublicKey(state, own.PublicKey);
        return TryMixAgreement(state, own, hostPublicKey);
    }

    /// <summary>The message after them: the key of one use, and the payload for the host's key alone.</summary>
    internal static void WriteFirst(NoiseSymmetricState state, Curve25519KeyPair own, ReadOnlySpan<byte> payload, Span<byte> message)
    {
        own.PublicKey.CopyTo(message);
        state.EncryptAndHash(payload, message.Slice(KeyBytes));
    }

    /// <summary>Reads that message.</summary>
    /// <param name="state">What is known before it.</param>
    /// <param name="host">The host's keys.</param>
    /// <param name="message">The message.</param>
    /// <param name="payload">Receives the payload.</param>
    /// <param name="binding">Receives the handshake's hash after the tokens, before the payload.</param>
    internal static bool TryReadFirst(
        NoiseSymmetricState state, Curve25519KeyPair host, ReadOnlySpan<byte> message, Span<byte> payload, Span<byte> binding)
    {
        if (message.Length < KeyBytes + Aead.TagBytes)
        {
            return false;
        }

        ReadOnlySpan<byte> clientKey = message.Slice(0, KeyBytes);
        MixPublicKey(state, clientKey);
        state.HandshakeHash.CopyTo(binding);
        return TryMixAgreement(state, host, clientKey) && state.TryDecryptAndHash(message.Slice(KeyBytes), payload);
    }

    /// <summary>
    /// The host's answer: another key of one use, and the payload for who began the handshake and has the pre-shared key.
    /// </summary>
    /// <returns>False if the client's public key is none.</returns>
    internal static bool TryWriteSecond(
        NoiseSymmetricState state, Curve25519KeyPair own, ReadOnlySpan<byte> clientKey, ReadOnlySpan<byte> preSharedKey,
        ReadOnlySpan<byte> payload, Span<byte> message)
    {
        own.PublicKey.CopyTo(message);
        MixPublicKey(state, own.PublicKey);
        if (!TryMixAgreement(state, own, clientKey))
        {
            return false;
        }

        state.MixKeyAndHash(preSharedKey);
        state.EncryptAndHash(payload, message.Slice(KeyBytes));
        return true;
    }

    /// <summary>Reads that answer.</summary>
    internal static bool TryReadSecond(
        NoiseSymmetricState state, Curve25519KeyPair own, ReadOnlySpan<byte> preSharedKey, ReadOnlySpan<byte> message, Span<byte> payload)
    {
        if (message.Length < KeyBytes + Aead.TagBytes)
        {
            return false;
        }

        ReadOnlySpan<byte> hostKey = message.Slice(0, KeyBytes);
        MixPublicKey(state, hostKey);
        if (!TryMixAgreement(state, own, hostKey))
        {
            return false;
        }

        state.MixKeyAndHash(preSharedKey);
        return state.TryDecryptAndHash(message.Slice(KeyBytes), payload);
    }

    /// <summary>The token e, which with a pre-shared key is mixed into the key too (section 9.2).</summary>
    internal static void MixPublicKey(NoiseSymmetricState state, ReadOnlySpan<byte> publicKey)
    {
        state.MixHash(publicKey);
        state.MixKey(publicKey);
    }

    /// <summary>The tokens es and ee: what two keys agree on. False if the other's key is none.</summary>
    internal static bool TryMixAgreement(NoiseSymmetricState state, Curve25519KeyPair own, ReadOnlySpan<byte> other)
    {
        Span<byte> secret = stackalloc byte[KeyBytes];
        bool isSecret = own.TryAgree(other, secret);
        state.MixKey(secret);
        System.Security.Cryptography.CryptographicOperations.ZeroMemory(secret);
        return isSecret;
    }
}
