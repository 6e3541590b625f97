using System;
using System.Collections.Generic;
using LagSim.Net.Carriers;

namespace LagSim.Net.Sessions;

/// <summary>One end of an in-memory link without loss or delay.</summary>
/// <remarks>Both ends belong to one thread.</remarks>
internal sealed class WarmupPort : IDatagramPort
{
    private readonly Queue<byte[]> incoming = new();
    private WarmupPort? other;

    private WarmupPort(int number) => LocalAddress = PeerAddress.Virtual(number);

    /// <inheritdoc/>
    public event Action? Arrived;

    /// <inheritdoc/>
    public PeerAddress LocalAddress { get; }

    /// <summary>Whether incoming datagrams are held back, as if still in transit.</summary>
    internal bool IsHeld { get; set; }

    /// <summary>Creates the two ends of a link.</summary>
    internal static (WarmupPort First, WarmupPort Second) Pair()
    {
        WarmupPort first = new(0), second = new(1);
        (first.other, second.other) = (second, first);
        return (first, second);
    }

    /// <inheritdoc/>
    public void Send(ReadOnlySpan<byte> datagram, PeerAddress to)
    {
        other!.incoming.Enqueue(datagram.ToArray());
        other.Arrived?.Invoke();
    }

    /// <inheritdoc/>
    public bool TryReceive(Span<byte> buffer, out int length, out PeerAddress from)
    {
        from = other!.LocalAddress;
        length = 0;
        if (IsHeld || !incoming.TryDequeue(out byte[]? datagram))
        {
            return false;
        }

        datagram.CopyTo(buffer);
        length = datagram.Length;
        return true;
    }

    /// <inheritdoc/>
    public void Dispose()
    {
    }
}
