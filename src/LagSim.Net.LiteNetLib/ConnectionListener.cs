using System;
using System.Collections.Concurrent;
using System.Net;
using System.Net.Sockets;
using System.Threading;
using LiteNetLib;

namespace LagSim.Net.Carriers;

/// <summary>
/// The callbacks of LiteNetLib, which run on its threads and sometimes under its locks. Nothing here waits or throws, or calls LiteNetLib
/// except to answer.
/// </summary>
/// <param name="key">The key that a request must carry.</param>
/// <param name="peers">The connections by address, kept up to date here.</param>
/// <param name="ring">Takes the datagrams that come in.</param>
/// <param name="hasRoom">Whether there is room for another connection.</param>
/// <param name="arrived">Called after each datagram.</param>
internal sealed class ConnectionListener(
    byte[] key, ConcurrentDictionary<PeerAddress, LiteNetPeer> peers, DatagramRing ring, Func<bool> hasRoom, Action arrived)
    : ILiteNetEventListener
{
    private long dropped;
    private long sendFailures;
    private long receiveFailures;
    private long connectionsRefused;
    private long connectionsFailed;

    /// <summary>See <see cref="LiteNetLibPort.Dropped"/>.</summary>
    internal long Dropped => Interlocked.Read(ref dropped);

    /// <summary>See <see cref="LiteNetLibPort.SendFailures"/>.</summary>
    internal long SendFailures => Interlocked.Read(ref sendFailures);

    /// <summary>See <see cref="LiteNetLibPort.ReceiveFailures"/>.</summary>
    internal long ReceiveFailures => Interlocked.Read(ref receiveFailures);

    /// <summary>See <see cref="LiteNetLibPort.ConnectionsRefused"/>.</summary>
    internal long ConnectionsRefused => Interlocked.Read(ref connectionsRefused);

    /// <summary>See <see cref="LiteNetLibPort.ConnectionsFailed"/>.</summary>
    internal long ConnectionsFailed => Interlocked.Read(ref connectionsFailed);

    /// <inheritdoc/>
    public void OnConnectionRequest(LiteConnectionRequest request)
    {
        if (hasRoom() && request.Data.GetRemainingBytesSpan().SequenceEqual(key))
        {
            request.Accept();
            return;
        }

        // Forced: after a polite refusal LiteNetLib would remember every stranger for seconds.
        Interlocked.Increment(ref connectionsRefused);
        request.RejectForce();
    }

    /// <inheritdoc/>
    public void OnPeerConnected(LiteNetPeer peer) => peers[PeerAddress.From(peer)] = peer;

    /// <inheritdoc/>
    public void OnPeerDisconnected(LiteNetPeer peer, DisconnectInfo disconnectInfo)
    {
        PeerAddress address = PeerAddress.From(peer);
        if (peers.TryGetValue(address, out LiteNetPeer? known) && ReferenceEquals(known, peer))
        {
            peers.TryRemove(address, out _);
        }

        if (disconnectInfo.Reason
            is DisconnectReason.ConnectionFailed or DisconnectReason.ConnectionRejected or DisconnectReason.InvalidProtocol)
        {
            Interlocked.Increment(ref connectionsFailed);
        }
    }

    /// <inheritdoc/>
    public void OnNetworkReceive(LiteNetPeer peer, NetPacketReader reader, DeliveryMethod deliveryMethod)
    {
        ReadOnlySpan<byte> datagram = reader.GetRemainingBytesSpan();
        if (deliveryMethod != DeliveryMethod.Unreliable
            || datagram.Length is 0 or > IDatagramPort.MaxDatagramBytes
            || !ring.TryPut(datagram, PeerAddress.From(peer)))
        {
            Interlocked.Increment(ref dropped);
            return;
        }

        arrived();
    }

    /// <inheritdoc/>
    public void OnNetworkError(IPEndPoint endPoint, SocketError socketError)
    {
        if (endPoint is not null)
        {
            NoteSendFailure();
        }
        else if (socketError is not (SocketError.ConnectionReset or SocketError.ConnectionRefused)) // ICMP: no process listens there
        {
            Interlocked.Increment(ref receiveFailures);
        }
    }

    /// <summary>Counts a datagram that could not be sent.</summary>
    internal void NoteSendFailure() => Interlocked.Increment(ref sendFailures);
}
