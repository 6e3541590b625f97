using System;

namespace LagSim.Net.Carriers;

/// <summary>A bounded queue of datagrams whose memory is all allocated at construction. Safe on any thread.</summary>
internal sealed class DatagramRing
{
    private readonly object gate = new();
    private readonly byte[] bytes;
    private readonly int[] lengths;
    private readonly PeerAddress[] senders;
    private int first;
    private int count;

    /// <summary>Creates a queue of that many slots of <see cref="IDatagramPort.MaxDatagramBytes"/> each.</summary>
    internal DatagramRing(int slots)
    {
        bytes = new byte[slots * IDatagramPort.MaxDatagramBytes];
        lengths = new int[slots];
        senders = new PeerAddress[slots];
    }

    /// <summary>Copies a datagram in; false if every slot is taken.</summary>
    internal bool TryPut(ReadOnlySpan<byte> datagram, PeerAddress from)
    {
        lock (gate)
        {
            bool fits = count < lengths.Length;
            if (fits)
            {
                int slot = (first + count) % lengths.Length;
                datagram.CopyTo(Slot(slot));
                lengths[slot] = datagram.Length;
                senders[slot] = from;
                count++;
            }

            return fits;
        }
    }

    /// <summary>Copies a datagram in; if every slot is taken, the oldest makes room for it.</summary>
    /// <returns>Whether one was lost.</returns>
    internal bool PutNewest(ReadOnlySpan<byte> datagram, PeerAddress from)
    {
        lock (gate)
        {
            bool isFull = count == lengths.Length;
            first = isFull ? (first + 1) % lengths.Length : first;
            count -= isFull ? 1 : 0;
            TryPut(datagram, from);
            return isFull;
        }
    }

    /// <summary>Copies the oldest datagram out; false if there is none.</summary>
    internal bool TryTake(Span<byte> buffer, out int length, out PeerAddress from)
    {
        lock (gate)
        {
            bool any = count > 0;
            length = any ? lengths[first] : 0;
            from = any ? senders[first] : default;
            Slot(first).Slice(0, length).CopyTo(buffer);
            first = any ? (first + 1) % lengths.Length : first;
            count -= any ? 1 : 0;
            return any;
        }
    }

    private Span<byte> Slot(int slot) => bytes.AsSpan(slot * IDatagramPort.MaxDatagramBytes, IDatagramPort.MaxDatagramBytes);
}
