using System;
using LagSim.Net.Carriers;
using LagSim.Testing.Links;

namespace LagSim.Harness.Relays;

/// <summary>A port that counts the traffic of another one.</summary>
/// <remarks>Sends and receives on the thread that the inner port allows; <see cref="Traffic"/> may be read from any thread.</remarks>
public sealed class CountingPort : IDatagramPort
{
    private readonly IDatagramPort inner;
    private readonly object gate = new(); // guards four counters that belong together
    private PortTraffic traffic;

    /// <summary>Wraps <paramref name="inner"/>, which it then owns and disposes.</summary>
    public CountingPort(IDatagramPort inner)
    {
        ArgumentNullException.ThrowIfNull(inner);
        this.inner = inner;
    }

    /// <inheritdoc/>
    public event Action? Arrived
    {
        add => inner.Arrived += value;
        remove => inner.Arrived -= value;
    }

    /// <inheritdoc/>
    public PeerAddress LocalAddress => inner.LocalAddress;

    /// <summary>The traffic so far.</summary>
    public PortTraffic Traffic
    {
        get
        {
            lock (gate)
            {
                return traffic;
            }
        }
    }

    /// <inheritdoc/>
    public void Send(ReadOnlySpan<byte> datagram, PeerAddress to)
    {
        inner.Send(datagram, to);
        lock (gate)
        {
            traffic = traffic.WithSent(datagram.Length);
        }
    }

    /// <inheritdoc/>
    public bool TryReceive(Span<byte> buffer, out int length, out PeerAddress from)
    {
        if (!inner.TryReceive(buffer, out length, out from))
        {
            return false;
        }

        lock (gate)
        {
            traffic = traffic.WithReceived(length);
        }

        return true;
    }

    /// <inheritdoc/>
    public void NoteSeated(PeerAddress peer) => inner.NoteSeated(peer);

    /// <inheritdoc/>
    public void Dispose() => inner.Dispose();
}
