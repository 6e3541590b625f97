using System;

namespace LagSim.Net.Carriers;

/// <summary>Two carriers as one, so that a host has native peers over datagrams and browsers over connections in one session.</summary>
/// <remarks>What is sent goes by the kind of its address (<see cref="PeerAddress.IsConnection"/>). What arrives is taken from both in turn,
/// so that neither waits for the other. For the session's thread, as any port.</remarks>
public sealed class MultiplexPort : IDatagramPort
{
    private readonly IDatagramPort datagrams;
    private readonly IDatagramPort connections;
    private bool isConnectionsTurn;

    /// <summary>Creates the port.</summary>
    /// <param name="datagrams">Carries to endpoints, such as a <see cref="UdpPort"/>.</param>
    /// <param name="connections">Carries over connections, such as a <see cref="WebSocketHostPort"/>.</param>
    /// <exception cref="ArgumentNullException">An argument is null.</exception>
    public MultiplexPort(IDatagramPort datagrams, IDatagramPort connections)
    {
        this.datagrams = datagrams ?? throw new ArgumentNullException(nameof(datagrams));
        this.connections = connections ?? throw new ArgumentNullException(nameof(connections));
    }

    /// <inheritdoc/>
    public event Action? Arrived
    {
        add
        {
            datagrams.Arrived += value;
            connections.Arrived += value;
        }

        remove
        {
            datagrams.Arrived -= value;
            connections.Arrived -= value;
        }
    }

    /// <summary>The address of the port for datagrams.</summary>
    public PeerAddress LocalAddress => datagrams.LocalAddress;

    /// <inheritdoc/>
    public void Send(ReadOnlySpan<byte> datagram, PeerAddress to) => (to.IsConnection ? connections : datagrams).Send(datagram, to);

    /// <inheritdoc/>
    public bool TryReceive(Span<byte> buffer, out int length, out PeerAddress from)
    {
        isConnectionsTurn = !isConnectionsTurn;
        return isConnectionsTurn
            ? connections.TryReceive(buffer, out length, out from) || datagrams.TryReceive(buffer, out length, out from)
            : datagrams.TryReceive(buffer, out length, out from) || connections.TryReceive(buffer, out length, out from);
    }

    /// <inheritdoc/>
    public void NoteSeated(PeerAddress peer) => (peer.IsConnection ? connections : datagrams).NoteSeated(peer);

    /// <summary>Closes both.</summary>
    public void Dispose()
    {
        datagrams.Dispose();
        connections.Dispose();
    }
}
