using System;
using System.Collections.Generic;
using LagSim.Net.Carriers;

namespace LagSim.Testing.Links;

/// <summary>One node's port of a <see cref="VirtualNetwork"/>; for the network's one thread.</summary>
internal sealed class VirtualPort : IDatagramPort
{
    private readonly VirtualNetwork network;
    private readonly Queue<(byte[] Datagram, PeerAddress From)> inbox = new();

    internal VirtualPort(VirtualNetwork network, int number)
    {
        this.network = network;
        Number = number;
        LocalAddress = PeerAddress.Virtual(number);
    }

    public event Action? Arrived;

    public PeerAddress LocalAddress { get; internal set; }

    internal int Number { get; }

    internal bool IsDisposed { get; private set; }

    internal PortTraffic Traffic { get; set; }

    public void Send(ReadOnlySpan<byte> datagram, PeerAddress to)
    {
        ObjectDisposedException.ThrowIf(IsDisposed, this);
        if (datagram.IsEmpty || datagram.Length > IDatagramPort.MaxDatagramBytes)
        {
            throw new ArgumentException(
                $"A datagram has 1 to {IDatagramPort.MaxDatagramBytes} bytes, not {datagram.Length}.", nameof(datagram));
        }

        if (to.IsNone)
        {
            throw new ArgumentException("There is no address to send to.", nameof(to));
        }

        network.Send(this, to, datagram.ToArray());
    }

    public bool TryReceive(Span<byte> buffer, out int length, out PeerAddress from)
    {
        if (buffer.Length < IDatagramPort.MaxDatagramBytes)
        {
            throw new ArgumentException($"The buffer must have at least {IDatagramPort.MaxDatagramBytes} bytes.", nameof(buffer));
        }

        if (!inbox.TryDequeue(out (byte[] Datagram, PeerAddress From) next))
        {
            length = 0;
            from = default;
            return false;
        }

        next.Datagram.CopyTo(buffer);
        length = next.Datagram.Length;
        from = next.From;
        return true;
    }

    public void Dispose()
    {
        IsDisposed = true;
        inbox.Clear();
    }

    /// <summary>Accepts a datagram that arrived; false if too many wait already.</summary>
    internal bool Deliver(byte[] datagram, PeerAddress from, int room)
    {
        Traffic = Traffic.WithReceived(datagram.Length);
        if (inbox.Count >= room)
        {
            return false;
        }

        inbox.Enqueue((datagram, from));
        Arrived?.Invoke();
        return true;
    }
}
