using System;
using System.Net;
using System.Net.Sockets;
using System.Threading;
using LiteNetLib;

namespace LagSim.Net.Carriers;

public sealed partial class LiteNetLibPort
{
    /// <summary>
    /// The callbacks of LiteNetLib, which run on its threads and sometimes under its locks. Nothing here waits or throws, or calls
    /// LiteNetLib except to answer.
    /// </summary>
    private sealed class Listener : ILiteNetEventListener
    {
        private readonly LiteNetLibPort port;

        internal Listener(LiteNetLibPort port) => this.port = port;

        /// <inheritdoc/>
        public void OnConnectionRequest(LiteConnectionRequest request)
        {
            if (port.HasRoom() && request.Data.GetRemainingBytesSpan().SequenceEqual(port.key))
            {
                request.Accept();
                return;
            }

            // Forced: after a polite refusal LiteNetLib would remember every stranger for seconds.
            Interlocked.Increment(ref port.connectionsRefused);
            request.RejectForce();
        }

        /// <inheritdoc/>
        public void OnPeerConnected(LiteNetPeer peer) => port.peers[PeerAddress.From(peer)] = peer;

        /// <inheritdoc/>
        public void OnPeerDisconnected(LiteNetPeer peer, DisconnectInfo disconnectInfo)
        {
            PeerAddress address = PeerAddress.From(peer);
            if (port.peers.TryGetValue(address, out LiteNetPeer? known) && ReferenceEquals(known, peer))
            {
                port.peers.TryRemove(address, out _);
            }

            if (disconnectInfo.Reason is DisconnectReason.ConnectionFailed or DisconnectReason.ConnectionRejected or DisconnectReason.InvalidProtocol)
            {
                Interlocked.Increment(ref port.connectionsFailed);
            }
        }

        /// <inheritdoc/>
        public void OnNetworkReceive(LiteNetPeer peer, NetPacketReader reader, DeliveryMethod deliveryMethod)
        {
            ReadOnlySpan<byte> datagram = reader.GetRemainingBytesSpan();
            if (deliveryMethod != DeliveryMethod.Unreliable
                || datagram.Length is 0 or > IDatagramPort.MaxDatagramBytes
                || !port.ring.TryPut(datagram, PeerAddress.From(peer)))
            {
                Interlocked.Increment(ref port.dropped);
                return;
            }

            port.Arrived?.Invoke();
        }

        /// <inheritdoc/>
        public void OnNetworkError(IPEndPoint endPoint, SocketError socketError)
        {
            if (endPoint is not null)
            {
                Interlocked.Increment(ref port.sendFailures);
            }
            else if (socketError is not (SocketError.ConnectionReset or SocketError.ConnectionRefused)) // ICMP: no process listens there
            {
                Interlocked.Increment(ref port.receiveFailures);
            }
        }
    }
}
