using System;
using System.Net;
using System.Net.Sockets;
using System.Text;
using LagSim.Net.Carriers;
using LagSim.Net.Wire;

namespace LagSim.Tests.Carriers;

/// <summary>LiteNetLib's packets by hand, over a socket: to see what is on the wire, and to send what LiteNetLib would not.</summary>
internal sealed class RawLiteNetLib : IDisposable
{
    internal static readonly string Key = $"LagSim {WireFormat.Version}";
    internal const byte ConnectRequest = 6, ConnectAccept = 7, InvalidProtocol = 16;
    private const int Protocol = 13;

    private readonly Socket socket = new(AddressFamily.InterNetwork, SocketType.Dgram, ProtocolType.Udp);
    private readonly byte[] buffer = new byte[2000];

    internal RawLiteNetLib()
    {
        socket.Bind(new IPEndPoint(IPAddress.Loopback, 0));
        socket.ReceiveTimeout = (int)PortEnd.Deadline.TotalMilliseconds;
    }

    internal PeerAddress Address => PeerAddress.From((IPEndPoint)socket.LocalEndPoint!);

    public void Dispose() => socket.Dispose();

    internal void Send(byte[] packet, PeerAddress to) => socket.SendTo(packet, to.ToEndPoint());

    /// <summary>The next packet of a kind; others are passed over.</summary>
    internal byte[] Take(byte kind)
    {
        EndPoint from = new IPEndPoint(IPAddress.Any, 0);
        for (int i = 0; i < 1000; i++)
        {
            int length = socket.ReceiveFrom(buffer, ref from);
            if (length > 0 && (buffer[0] & 0x1F) == kind)
            {
                return buffer[..length];
            }
        }

        throw new Xunit.Sdk.XunitException($"No packet of kind {kind} among a thousand.");
    }

    /// <summary>Grants the connection that a port asks for when it first sends.</summary>
    internal void Accept(IDatagramPort port)
    {
        port.Send(new byte[] { 0 }, Address);
        byte[] request = Take(ConnectRequest);
        byte[] accept = new byte[15];
        accept[0] = ConnectAccept;
        request.AsSpan(5, 8).CopyTo(accept.AsSpan(1)); // which request it answers
        Send(accept, port.LocalAddress);
    }

    /// <summary>Has a port grant a connection to this socket.</summary>
    internal void Connect(IDatagramPort port)
    {
        Send(Request(Key), port.LocalAddress);
        Take(ConnectAccept);
    }

    /// <summary>A request for a connection.</summary>
    internal static byte[] Request(string key, int protocol = Protocol, byte addressSize = 16)
    {
        byte[] text = Encoding.UTF8.GetBytes(key);
        byte[] packet = new byte[18 + 16 + text.Length];
        packet[0] = ConnectRequest;
        BitConverter.TryWriteBytes(packet.AsSpan(1), protocol);
        BitConverter.TryWriteBytes(packet.AsSpan(5), DateTime.UtcNow.Ticks);
        packet[17] = addressSize;
        text.CopyTo(packet, 18 + 16);
        return packet;
    }
}
