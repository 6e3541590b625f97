using System;
using System.Collections.Generic;
using System.IO;
using System.Net;
using System.Net.Sockets;
using System.Runtime.InteropServices;
using System.Threading;

namespace LagSim.Net.Carriers;

/// <summary>A datagram port over UDP, through <see cref="Socket"/>.</summary>
/// <remarks>
/// <para>A background thread takes datagrams from the socket into a ring of <see cref="RingSlots"/>; when that is full, newer ones are
/// dropped and counted. Bound to <see cref="IPAddress.IPv6Any"/> it also speaks IPv4. The scope of a link-local IPv6 address is not
/// kept.</para>
/// <para>The counters may be read from any thread.</para>
/// </remarks>
public sealed class UdpPort : IDatagramPort
{
    /// <summary>The number of datagrams that can wait to be taken.</summary>
    public const int RingSlots = 1024;

    private const int SioUdpConnReset = unchecked((int)0x9800000C);
    private const int MaxKnownEndPoints = 256;
    private static readonly TimeSpan ExitTimeout = TimeSpan.FromSeconds(2);

    private readonly Socket socket;
    private readonly Thread receiver;
    private readonly ManualResetEventSlim stopping = new();
    private readonly DatagramRing ring = new(RingSlots);
    private readonly byte[] outgoing = new byte[IDatagramPort.MaxDatagramBytes];
    private readonly Dictionary<PeerAddress, IPEndPoint> endPoints = new(); // so that a send to a known peer allocates nothing
    private long dropped;
    private long sendFailures;
    private long receiveFailures;

    /// <summary>Opens a port and begins to receive.</summary>
    /// <param name="bind">The address to listen on; port 0 takes any free one, which <see cref="LocalAddress"/> then returns.</param>
    /// <exception cref="ArgumentNullException"><paramref name="bind"/> is null.</exception>
    /// <exception cref="IOException">The system refuses the endpoint, for instance because its port is in use.</exception>
    public UdpPort(IPEndPoint bind)
    {
        if (bind is null)
        {
            throw new ArgumentNullException(nameof(bind));
        }

        socket = Open(bind);
        IsForThisMachineAlone = IPAddress.IsLoopback(bind.Address);
        LocalAddress = PeerAddress.From(Reachable((IPEndPoint)socket.LocalEndPoint!));
        receiver = new Thread(Receive) { Name = $"LagSim UDP {LocalAddress}", IsBackground = true };
        receiver.Start();
    }

    /// <inheritdoc/>
    public event Action? Arrived;

    /// <summary>The address of this port; if it is bound to every address, it is reached there from this machine only.</summary>
    public PeerAddress LocalAddress { get; }

    /// <summary>Whether only this machine reaches it; <see cref="LocalAddress"/> does not tell.</summary>
    internal bool IsForThisMachineAlone { get; }

    /// <summary>The number of received datagrams that were discarded: too long, empty, or no room in the ring.</summary>
    public long Dropped => Interlocked.Read(ref dropped);

    /// <summary>The number of datagrams that the network did not accept.</summary>
    public long SendFailures => Interlocked.Read(ref sendFailures);

    /// <summary>
    /// How often the system reported an error instead of a datagram. A report that no process listens at the other end is not counted.
    /// </summary>
    public long ReceiveFailures => Interlocked.Read(ref receiveFailures);

    /// <inheritdoc/>
    /// <exception cref="ObjectDisposedException">The port is closed.</exception>
    public void Send(ReadOnlySpan<byte> datagram, PeerAddress to)
    {
        if (datagram.Length is 0 or > IDatagramPort.MaxDatagramBytes)
        {
            throw new ArgumentException(
                $"A datagram has 1 to {IDatagramPort.MaxDatagramBytes} bytes; this one has {datagram.Length}.", nameof(datagram));
        }

        if (stopping.IsSet)
        {
            throw new ObjectDisposedException(nameof(UdpPort));
        }

        IPEndPoint endPoint = EndPointOf(to);
        try
        {
            // Only if the system has room: otherwise the send would block.
            if (CanReach(endPoint) && socket.Poll(0, SelectMode.SelectWrite))
            {
                datagram.CopyTo(outgoing);
                socket.SendTo(outgoing, 0, datagram.Length, SocketFlags.None, endPoint);
                return;
            }
        }
        catch (SocketException)
        {
            // Counted below; the datagram is lost, as any may be.
        }

        Interlocked.Increment(ref sendFailures);
    }

    /// <inheritdoc/>
    /// <exception cref="ArgumentException"><paramref name="buffer"/> is too short.</exception>
    public bool TryReceive(Span<byte> buffer, out int length, out PeerAddress from)
    {
        if (buffer.Length < IDatagramPort.MaxDatagramBytes)
        {
            throw new ArgumentException($"{buffer.Length} bytes may be too few: {IDatagramPort.MaxDatagramBytes} are needed.", nameof(buffer));
        }

        return ring.TryTake(buffer, out length, out from);
    }

    /// <summary>Closes the port and ends its thread. Datagrams in the ring can still be taken. Call it from any other thread.</summary>
    public void Dispose()
    {
        if (!stopping.IsSet)
        {
            stopping.Set();
            socket.Dispose();
            if (Thread.CurrentThread != receiver)
            {
                receiver.Join(ExitTimeout); // bounded: a runtime that does not wake the thread must not hang the game
            }
        }
    }

    private static Socket Open(IPEndPoint bind)
    {
        Socket? opened = null;
        try
        {
            opened = new Socket(bind.AddressFamily, SocketType.Dgram, ProtocolType.Udp); // a system may lack the kind
            if (RuntimeInformation.IsOSPlatform(OSPlatform.Windows))
            {
                // Windows would fail a receive because an earlier send reached no listener, and would let another program share the port.
                opened.IOControl(SioUdpConnReset, new byte[sizeof(int)], null);
                opened.ExclusiveAddressUse = true;
            }

            if (bind.Address.Equals(IPAddress.IPv6Any))
            {
                opened.DualMode = true;
            }

            opened.Bind(bind);
            return opened;
        }
        catch (SocketException failure)
        {
            opened?.Dispose();
            throw new IOException($"UDP port {bind} cannot be opened: {failure.Message} ({failure.SocketErrorCode}).", failure);
        }
    }

    private static IPEndPoint Reachable(IPEndPoint bound) =>
        bound.Address.Equals(IPAddress.Any) ? new IPEndPoint(IPAddress.Loopback, bound.Port)
        : bound.Address.Equals(IPAddress.IPv6Any) ? new IPEndPoint(IPAddress.IPv6Loopback, bound.Port)
        : bound;

    private bool CanReach(IPEndPoint endPoint) =>
        endPoint.AddressFamily == socket.AddressFamily || (socket.AddressFamily == AddressFamily.InterNetworkV6 && socket.DualMode);

    private IPEndPoint EndPointOf(PeerAddress to)
    {
        if (endPoints.TryGetValue(to, out IPEndPoint? known))
        {
            return known;
        }

        try
        {
            IPEndPoint made = to.ToEndPoint();
            if (endPoints.Count == MaxKnownEndPoints)
            {
                endPoints.Clear(); // strangers must not make it grow
            }

            endPoints.Add(to, made);
            return made;
        }
        catch (InvalidOperationException failure)
        {
            throw new ArgumentException($"UDP does not reach '{to}': it is not an IP address and port.", nameof(to), failure);
        }
    }

    private void Receive()
    {
        // One byte more than allowed, to detect a datagram that is too long.
        byte[] incoming = new byte[IDatagramPort.MaxDatagramBytes + 1];
        EndPoint sender = new IPEndPoint(socket.AddressFamily == AddressFamily.InterNetwork ? IPAddress.Any : IPAddress.IPv6Any, 0);
        while (!stopping.IsSet)
        {
            try
            {
                int length = socket.ReceiveFrom(incoming, ref sender);
                Accept(incoming.AsSpan(0, length), (IPEndPoint)sender);
            }
            catch (SocketException failure)
            {
                Overcome(failure.SocketErrorCode);
            }
            catch (ObjectDisposedException)
            {
                return;
            }
        }
    }

    private void Accept(ReadOnlySpan<byte> datagram, IPEndPoint sender)
    {
        if (stopping.IsSet)
        {
            return; // on some systems closing ends the wait with an empty datagram
        }

        if (datagram.Length is 0 or > IDatagramPort.MaxDatagramBytes || !ring.TryPut(datagram, PeerAddress.From(sender)))
        {
            Interlocked.Increment(ref dropped);
            return;
        }

        Arrived?.Invoke();
    }

    private void Overcome(SocketError error)
    {
        switch (error)
        {
            case SocketError.MessageSize: // Windows: longer than the buffer
                Interlocked.Increment(ref dropped);
                break;
            case SocketError.ConnectionReset or SocketError.ConnectionRefused: // ICMP: no process listens where an earlier send went
                break;
            default:
                if (!stopping.IsSet)
                {
                    Interlocked.Increment(ref receiveFailures);
                    stopping.Wait(10); // a persistent error must not take a core; closing ends the wait
                }

                break;
        }
    }
}
