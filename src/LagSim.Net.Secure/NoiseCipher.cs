using System;
using System.Security.Cryptography;

namespace LagSim.Net.Protection;

/// <summary>The cipher of a link after a handshake: a chain of keys for each direction.</summary>
internal sealed class NoiseCipher : IDatagramCipher
{
    private readonly TransportKeys sending;
    private readonly TransportKeys receiving;

    private NoiseCipher(ReadOnlySpan<byte> sending, ReadOnlySpan<byte> receiving)
    {
        this.sending = new TransportKeys(sending);
        this.receiving = new TransportKeys(receiving);
    }

    /// <summary>The client's end of a link whose handshake is complete.</summary>
    internal static NoiseCipher OfClient(NoiseSymmetricState handshake) => Of(handshake, isHost: false);

    /// <summary>The host's end of a link whose handshake is complete.</summary>
    internal static NoiseCipher OfHost(NoiseSymmetricState handshake) => Of(handshake, isHost: true);

    /// <summary>Wipes the keys.</summary>
    public void Dispose()
    {
        sending.Dispose();
        receiving.Dispose();
    }

    /// <inheritdoc/>
    public void Seal(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> plain, Span<byte> destination) =>
        sending.Seal(number, associated, plain, destination);

    /// <inheritdoc/>
    public bool TryOpen(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> source, Span<byte> plain) =>
        receiving.TryOpen(number, associated, source, plain);

    private static NoiseCipher Of(NoiseSymmetricState handshake, bool isHost)
    {
        Span<byte> toHost = stackalloc byte[Aead.KeyBytes];
        Span<byte> toClient = stackalloc byte[Aead.KeyBytes];
        handshake.Split(toHost, toClient);
        NoiseCipher cipher = isHost ? new(toClient, toHost) : new(toHost, toClient);
        CryptographicOperations.ZeroMemory(toHost);
        CryptographicOperations.ZeroMemory(toClient);
        return cipher;
    }
}
