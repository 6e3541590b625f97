using System;
using System.Security.Cryptography;

namespace LagSim.Net.Protection;

/// <summary>
/// The cipher of a link after a handshake, or after an exchange of fresh keys: a key for each direction, and a secret for the next exchange.
/// </summary>
/// <remarks>No key of a direction is kept but within its cipher, by libsodium out of managed memory. The secret seals nothing.</remarks>
internal sealed class NoiseCipher : IDatagramCipher
{
    private readonly Aead sending;
    private readonly Aead receiving;
    private readonly byte[] chain;
    private bool isWiped;

    private NoiseCipher(ReadOnlySpan<byte> sending, ReadOnlySpan<byte> receiving, byte[] chain)
    {
        this.sending = Aead.Of(sending);
        this.receiving = Aead.Of(receiving);
        this.chain = chain;
    }

    /// <summary>The client's end of a link whose handshake is complete.</summary>
    internal static NoiseCipher OfClient(NoiseSymmetricState handshake) => Of(handshake, isHost: false);

    /// <summary>The host's end of a link whose handshake is complete.</summary>
    internal static NoiseCipher OfHost(NoiseSymmetricState handshake) => Of(handshake, isHost: true);

    /// <summary>Wipes the keys.</summary>
    public void Dispose()
    {
        isWiped = true;
        sending.Dispose();
        receiving.Dispose();
        CryptographicOperations.ZeroMemory(chain);
    }

    /// <inheritdoc/>
    public void Seal(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> plain, Span<byte> destination) =>
        sending.Seal(number, associated, plain, destination);

    /// <inheritdoc/>
    public bool TryOpen(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> source, Span<byte> plain) =>
        receiving.TryOpen(number, associated, source, plain);

    /// <inheritdoc/>
    public IKeyExchange BeginExchange(ReadOnlySpan<byte> prologue, Span<byte> message)
    {
        NoiseSymmetricState state = NoiseExchange.Begin(prologue, Chain());
        Curve25519KeyPair own = Curve25519KeyPair.Draw();
        NoiseExchange.WriteFirst(state, own, default, message);
        return new KeyExchange(state, own);
    }

    /// <inheritdoc/>
    public IDatagramCipher? TryAnswerExchange(ReadOnlySpan<byte> prologue, ReadOnlySpan<byte> message, Span<byte> answer)
    {
        using NoiseSymmetricState state = NoiseExchange.Begin(prologue, Chain());
        if (message.Length != IDatagramCipher.ExchangeBytes || !NoiseExchange.TryReadFirst(state, message, default))
        {
            return null;
        }

        using Curve25519KeyPair own = Curve25519KeyPair.Draw();
        bool isAgreed = NoiseExchange.TryWriteSecond(state, own, message.Slice(0, NoiseHandshake.KeyBytes), default, answer);
        return isAgreed ? OfHost(state) : null;
    }

    /// <summary>The secret for the next exchange. A wiped one is known to everybody, so it begins none.</summary>
    private byte[] Chain() => isWiped ? throw new ObjectDisposedException(nameof(NoiseCipher)) : chain;

    private static NoiseCipher Of(NoiseSymmetricState handshake, bool isHost)
    {
        Span<byte> toHost = stackalloc byte[Aead.KeyBytes];
        Span<byte> toClient = stackalloc byte[Aead.KeyBytes];
        byte[] chain = new byte[Sha256.Bytes];
        handshake.Split(toHost, toClient, chain);
        NoiseCipher cipher = isHost ? new(toClient, toHost, chain) : new(toHost, toClient, chain);
        CryptographicOperations.ZeroMemory(toHost);
        CryptographicOperations.ZeroMemory(toClient);
        return cipher;
    }
}
