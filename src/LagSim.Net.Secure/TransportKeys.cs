using System;
using System.Security.Cryptography;

namespace LagSim.Net.Protection;

/// <summary>
/// The keys of one direction of a link, one for each <see cref="Span"/> datagrams. Each is made from the one before by Noise's REKEY and
/// cannot be computed back, so a stolen key opens nothing older.
/// </summary>
/// <remarks>
/// Keys go by the datagrams' numbers, so nothing has to be agreed on. Kept are the key in use, the one before for what was overtaken, and,
/// once a datagram asks for it, the one after: only a datagram that the next key opens makes it the one in use. No key is kept but within
/// its cipher, by libsodium out of managed memory. For one thread.
/// </remarks>
internal sealed class TransportKeys : IDisposable
{
    /// <summary>
    /// How many datagrams have one key: 65,536, half an hour at 33 a second. The cipher itself would bear more than anybody sends
    /// (RFC 9001, 6.6).
    /// </summary>
    internal const ulong Span = 1 << 16;

    private ulong period; // of the key in use
    private Aead? before;
    private Aead current;
    private Aead? next; // made when first needed

    internal TransportKeys(ReadOnlySpan<byte> first) => current = Aead.Of(first);

    private Aead Next => next ??= After(current);

    /// <summary>Wipes the keys.</summary>
    public void Dispose()
    {
        before?.Dispose();
        current.Dispose();
        next?.Dispose();
    }

    internal void Seal(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> plain, Span<byte> destination)
    {
        while (number / Span > period)
        {
            Advance();
        }

        current.Seal(number, associated, plain, destination);
    }

    internal bool TryOpen(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> source, Span<byte> plain)
    {
        ulong wanted = number / Span;
        if (wanted == period)
        {
            return current.TryOpen(number, associated, source, plain);
        }

        if (wanted + 1 == period)
        {
            return before!.TryOpen(number, associated, source, plain);
        }

        if (wanted != period + 1 || !Next.TryOpen(number, associated, source, plain))
        {
            return false;
        }

        Advance();
        return true;
    }

    private void Advance()
    {
        before?.Dispose();
        before = current;
        current = Next;
        next = null;
        period++;
    }

    /// <summary>
    /// Noise's REKEY (revision 34, section 4.2): what the key makes of 32 zero bytes and the highest nonce, without the tag.
    /// </summary>
    private static Aead After(Aead key)
    {
        Span<byte> encrypted = stackalloc byte[Aead.KeyBytes + Aead.TagBytes];
        Span<byte> zeros = stackalloc byte[Aead.KeyBytes];
        zeros.Clear();
        key.Seal(ulong.MaxValue, default, zeros, encrypted);
        Aead after = Aead.Of(encrypted.Slice(0, Aead.KeyBytes));
        CryptographicOperations.ZeroMemory(encrypted);
        return after;
    }
}
