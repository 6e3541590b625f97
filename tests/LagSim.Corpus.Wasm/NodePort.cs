using System;
using System.Net;
using System.Runtime.InteropServices.JavaScript;
using LagSim.Net.Carriers;

namespace LagSim.Corpus;

/// <summary>A UDP socket of Node.js on the loopback interface.</summary>
internal sealed partial class NodePort : IDatagramPort
{
    private const int PortBytes = 2; // in front of what arrived

    public event Action? Arrived
    {
        add { }
        remove { } // it is asked instead
    }

    public PeerAddress LocalAddress => At(GetPort());

    public void Dispose()
    {
    }

    public void Send(ReadOnlySpan<byte> datagram, PeerAddress to) => Send(datagram.ToArray(), to.ToEndPoint().Port);

    public bool TryReceive(Span<byte> buffer, out int length, out PeerAddress from)
    {
        byte[] bytes = Receive();
        length = Math.Max(0, bytes.Length - PortBytes);
        from = length == 0 ? default : At((bytes[0] << 8) | bytes[1]);
        bytes.AsSpan(bytes.Length - length).CopyTo(buffer);
        return length > 0;
    }

    private static PeerAddress At(int port) => PeerAddress.From(new IPEndPoint(IPAddress.Loopback, port));

    [JSImport("port", "udp")]
    private static partial int GetPort();

    [JSImport("send", "udp")]
    private static partial void Send(byte[] datagram, int to);

    [JSImport("receive", "udp")]
    private static partial byte[] Receive();
}
