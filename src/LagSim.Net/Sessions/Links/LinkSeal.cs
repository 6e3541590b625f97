using System;
using LagSim.Net.Protection;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Links;

/// <summary>
/// Seals the datagrams of one link, and opens those of its other end: encrypted, authenticated, numbered, and each accepted once.
/// </summary>
/// <remarks>
/// A number is never used twice with one key: it counts up as long as the link lasts, and every join has keys of its own. For one thread.
/// </remarks>
internal sealed class LinkSeal : IDisposable
{
    private readonly SeenNumbers opened = new();
    private ulong sent;

    /// <param name="cipher">The cipher that the handshake gave the link.</param>
    /// <param name="resetKey">The key by which a host proves that it does not have the link any more; for a client's end.</param>
    internal LinkSeal(IDatagramCipher cipher, Token128 resetKey = default)
    {
        Keys = new LinkKeys(cipher);
        ResetKey = resetKey;
    }

    /// <summary>The key by which a host proves that it does not have the link any more.</summary>
    internal Token128 ResetKey { get; private set; }

    /// <summary>The keys, of which fresh ones are agreed on while the link lasts.</summary>
    internal LinkKeys Keys { get; }

    /// <summary>Whether the keys are wiped, since the link is over. Nothing can be sealed or opened any more.</summary>
    internal bool IsWiped => Keys.IsWiped;

    /// <summary>Wipes the keys.</summary>
    public void Dispose()
    {
        Keys.Dispose();
        ResetKey = default;
    }

    /// <summary>Seals a datagram.</summary>
    /// <returns>The length, <see cref="WireFormat.SealBytes"/> more than before.</returns>
    /// <exception cref="InvalidOperationException">The numbers are used up, after 127 days at 100,000 datagrams a second; a session lasts 23 at most.</exception>
    internal int Seal(ReadOnlySpan<byte> datagram, Span<byte> destination)
    {
        if (sent == SealedDatagram.MaxNumber)
        {
            throw new InvalidOperationException($"The link has sealed {sent} datagrams, the most there are numbers for.");
        }

        return Keys.Seal(datagram, ++sent, destination);
    }

    /// <summary>Opens a datagram.</summary>
    /// <param name="datagram">The sealed datagram.</param>
    /// <param name="destination">Receives what it seals.</param>
    /// <param name="length">The length of that.</param>
    /// <param name="isRepeated">Whether it is refused because its number came before, or is too old to know.</param>
    /// <returns>False if the other end did not seal it, or if it came before.</returns>
    internal bool TryOpen(in SealedDatagram datagram, Span<byte> destination, out int length, out bool isRepeated)
    {
        length = 0;
        isRepeated = !opened.IsNew(datagram.Number);
        return !isRepeated && Keys.TryOpen(datagram, destination, out length) && opened.Add(datagram.Number);
    }
}
