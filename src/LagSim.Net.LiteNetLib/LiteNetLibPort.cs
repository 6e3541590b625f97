using System;
using System.Collections.Concurrent;
using System.Collections.Generic;
using System.IO;
using System.Net;
using System.Net.Sockets;
using System.Text;
using System.Threading;
using LagSim.Net.Sessions;
using LiteNetLib;

namespace LagSim.Net.Carriers;

/// <summary>A datagram port over LiteNetLib: its connections, with unreliable delivery.</summary>
/// <remarks>
/// <para>A datagram port has no connections, but LiteNetLib does. The first datagram to an address requests one. Datagrams sent before it
/// is granted are lost and counted; a session repeats what matters, as it must over UDP. So joining takes a round trip more than over UDP.
/// Either side may begin. After a connection broke, the next datagram requests a new one. If only one side knows that it broke, that may
/// take the 5 s after which a silent peer is dropped. A port cannot reach itself.</para>
/// <para>A request is granted if it carries the same key and there is room; otherwise it is not answered. The key is sent in the clear: it
/// keeps out other versions and strangers, and encrypts nothing. LiteNetLib has no cookie. So an attacker that knows the key and forges
/// sender addresses can hold all places for 5 s at a time. Set a key of your own where that matters.</para>
/// <para>Each datagram is sent in one packet, a byte longer than itself. Short datagrams that are sent together may share one. LiteNetLib
/// also sends a few bytes a second each way to keep the connection.</para>
/// <para>LiteNetLib's threads call back as soon as something happens (<see cref="LiteNetManager.UnsyncedEvents"/>). Polling would need a
/// caller to poll, which <see cref="Arrived"/> avoids, and would let a stranger's datagrams pile up without bound in between. Here
/// datagrams go into a ring of <see cref="RingSlots"/>. When it is full, newer ones are dropped and counted.</para>
/// <para>LiteNetLib writes complaints about malformed packets to the console. The first port stops that for the process, unless
/// <see cref="NetDebug.Logger"/> is set before or afterwards.</para>
/// <para>The counters may be read from any thread.</para>
/// </remarks>
public sealed class LiteNetLibPort : IDatagramPort
{
    /// <summary>How many datagrams can wait to be taken.</summary>
    public const int RingSlots = 1024;

    /// <summary>How many characters a user's key may have.</summary>
    public const int MaxKeyLength = 100;

    /// <summary>The default limit on connections: four times the clients that a host can have.</summary>
    public const int DefaultMaxConnections = 4 * SessionOptions.MaxClients;

    /// <summary>The most connections that can be asked for.</summary>
    public const int MaxConnections = 4096;

    /// <summary>The largest number of closed connections kept beside the live ones: LiteNetLib remembers a closed connection for as long as
    /// a silent one.</summary>
    private const int MaxClosed = 256;

    /// <summary>The longest that LiteNetLib's threads sleep: a send wakes one, a packet the other. Closing may take this long. In a world
    /// at rest they wake for nothing far less often than with LiteNetLib's default.</summary>
    private const int SleepMilliseconds = 100;

    private const int SilenceMilliseconds = 5000;
    private const int AskAgainMilliseconds = 100;

    private readonly LiteNetManager manager;
    private readonly DatagramRing ring = new(RingSlots);
    private readonly byte[] key;
    private readonly int maxConnections;

    /// <summary>The LiteNetLib peer at each address. Only a cache: the peer's state decides whether the connection is alive, and LiteNetLib
    /// has all peers.</summary>
    /// <remarks>No lock of ours is held while LiteNetLib is called, which calls back under locks of its own.</remarks>
    private readonly ConcurrentDictionary<PeerAddress, LiteNetPeer> peers = new();

    private readonly ConnectionListener listener;

    private int disposed;
    private long unconnected;

    static LiteNetLibPort() => NetDebug.Logger ??= new QuietLogger();

    /// <summary>Opens a port, begins to receive, and grants connections.</summary>
    /// <param name="bind">Where to listen: an IPv4 address, or <see cref="IPAddress.IPv6Any"/> for every address of both families; port 0
    /// takes any free one, which <see cref="LocalAddress"/> then returns.</param>
    /// <param name="key">The shared secret that a peer must present to connect, 1 to <see cref="MaxKeyLength"/> characters; null for none.
    /// The name and version of LagSim's protocol are always compared too.</param>
    /// <param name="maxConnections">How many connections there may be, both granted and asked for, 1 to
    /// <see cref="MaxConnections"/>.</param>
    /// <exception cref="ArgumentNullException"><paramref name="bind"/> is null.</exception>
    /// <exception cref="ArgumentException">Another IPv6 address, which LiteNetLib cannot bind to alone; or a key of another
    /// length.</exception>
    /// <exception cref="ArgumentOutOfRangeException"><paramref name="maxConnections"/> is out of range.</exception>
    /// <exception cref="IOException">The system cannot bind the endpoint, for instance because its port is in use.</exception>
    public LiteNetLibPort(IPEndPoint bind, string? key = null, int maxConnections = DefaultMaxConnections)
    {
        Check(bind, key, maxConnections);
        this.key = Encoding.UTF8.GetBytes(key is null ? $"LagSim {Session.WireVersion}" : $"LagSim {Session.WireVersion}: {key}");
        this.maxConnections = maxConnections;
        listener = new ConnectionListener(this.key, peers, ring, HasRoom, () => Arrived?.Invoke());
        bool isDual = bind.AddressFamily == AddressFamily.InterNetworkV6;
        manager = new LiteNetManager(listener)
        {
            AutoRecycle = true,
            DisconnectTimeout = SilenceMilliseconds,
            IPv6Enabled = isDual,
            MaxConnectAttempts = SilenceMilliseconds / AskAgainMilliseconds,
            MaxFragmentsCount = 1, // no peer of ours sends fragments, and a sender of fragments could make this port reserve much memory
            // By default LiteNetLib refuses to send more than 1,023 bytes.
            MtuOverride = IDatagramPort.MaxDatagramBytes + NetConstants.HeaderSize,
            ReceivePollingTime = SleepMilliseconds * 1000,
            ReconnectDelay = AskAgainMilliseconds,
            UnsyncedEvents = true,
            UpdateTime = SleepMilliseconds,
        };
        Start(bind, isDual);
        IPAddress reachable = isDual ? IPAddress.IPv6Loopback : bind.Address.Equals(IPAddress.Any) ? IPAddress.Loopback : bind.Address;
        LocalAddress = PeerAddress.From(new IPEndPoint(reachable, manager.LocalPort));
    }

    /// <inheritdoc/>
    public event Action? Arrived;

    /// <summary>Where this port is reached; on this machine only, if it is bound to every address there is.</summary>
    public PeerAddress LocalAddress { get; }

    /// <summary>The LiteNetLib manager of this port, for NAT punching (<see cref="LiteNetManager.NatPunchModule"/>) and
    /// statistics.</summary>
    /// <remarks>Stopping it, or changing its timing, its events or its MTU, breaks the port.</remarks>
    public LiteNetManager Manager => manager;

    /// <summary>The number of open connections.</summary>
    public int Connections => manager.ConnectedPeersCount;

    /// <summary>How many datagrams came in over a connection and were thrown away: too long, empty, not sent as unreliable, or no room in
    /// the ring.</summary>
    public long Dropped => listener.Dropped;

    /// <summary>How many datagrams were not sent because there was no connection yet, or no room for one.</summary>
    public long Unconnected => Interlocked.Read(ref unconnected);

    /// <summary>The number of datagrams that the network refused, as far as LiteNetLib reports it.</summary>
    public long SendFailures => listener.SendFailures;

    /// <summary>The number of errors that the system reported instead of a packet. A report that no process listens at the other end is not
    /// counted.</summary>
    public long ReceiveFailures => listener.ReceiveFailures;

    /// <summary>How many requests for a connection were not granted: another key, or no room.</summary>
    public long ConnectionsRefused => listener.ConnectionsRefused;

    /// <summary>How many connections this port asked for, for 5 s each, and was not granted.</summary>
    public long ConnectionsFailed => listener.ConnectionsFailed;

    /// <inheritdoc/>
    /// <exception cref="ObjectDisposedException">The port is closed.</exception>
    public void Send(ReadOnlySpan<byte> datagram, PeerAddress to)
    {
        if (datagram.Length is 0 or > IDatagramPort.MaxDatagramBytes)
        {
            throw new ArgumentException(
                $"A datagram has 1 to {IDatagramPort.MaxDatagramBytes} bytes; this one has {datagram.Length}.", nameof(datagram));
        }

        ThrowIfDisposed();
        if (!peers.TryGetValue(to, out LiteNetPeer? peer) || !IsAlive(peer))
        {
            IPEndPoint endPoint = EndPointOf(to);
            if (endPoint.AddressFamily == AddressFamily.InterNetworkV6 && !manager.IPv6Enabled)
            {
                listener.NoteSendFailure();
                return;
            }

            peer = Connect(endPoint, to);
        }

        if (peer is null || peer.ConnectionState != ConnectionState.Connected)
        {
            Interlocked.Increment(ref unconnected);
            return;
        }

        peer.Send(datagram, DeliveryMethod.Unreliable);
        manager.TriggerUpdate(); // otherwise it would wait for LiteNetLib's next round
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

    /// <summary>Notifies all connected peers, closes the port and ends its threads. Datagrams that wait in the ring can still be
    /// received.</summary>
    public void Dispose()
    {
        if (Interlocked.Exchange(ref disposed, 1) == 0)
        {
            manager.Stop();
            peers.Clear();
        }
    }

    private static void Check(IPEndPoint bind, string? key, int maxConnections)
    {
        if (bind is null)
        {
            throw new ArgumentNullException(nameof(bind));
        }

        if (bind.AddressFamily != AddressFamily.InterNetwork && !bind.Address.Equals(IPAddress.IPv6Any))
        {
            throw new ArgumentException($"LiteNetLib cannot bind to '{bind}' alone: an IPv4 address or {IPAddress.IPv6Any} is needed.", nameof(bind));
        }

        if (key is { Length: 0 or > MaxKeyLength })
        {
            throw new ArgumentException($"A key has 1 to {MaxKeyLength} characters; this one has {key.Length}.", nameof(key));
        }

        if (maxConnections is < 1 or > MaxConnections)
        {
            throw new ArgumentOutOfRangeException(
                nameof(maxConnections), maxConnections, $"There can be 1 to {MaxConnections} connections.");
        }
    }

    private static bool IsAlive(LiteNetPeer peer) => peer.ConnectionState is ConnectionState.Connected or ConnectionState.Outgoing;

    private static IPEndPoint EndPointOf(PeerAddress to)
    {
        try
        {
            return to.ToEndPoint();
        }
        catch (InvalidOperationException failure)
        {
            throw new ArgumentException($"LiteNetLib does not reach '{to}': it is not an IP address and port.", nameof(to), failure);
        }
    }

    /// <summary>LiteNetLib reports only that it could not be opened; a socket of our own shows why.</summary>
    private static SocketException? WhyNot(IPEndPoint bind)
    {
        try
        {
            using Socket socket = new(bind.AddressFamily, SocketType.Dgram, ProtocolType.Udp) { ExclusiveAddressUse = true };
            socket.Bind(bind);
            return null;
        }
        catch (SocketException failure)
        {
            return failure;
        }
    }

    private void Start(IPEndPoint bind, bool isDual)
    {
        IPEndPoint v4 = isDual ? new IPEndPoint(IPAddress.Any, bind.Port) : bind;
        if (!manager.Start(v4.Address, IPAddress.IPv6Any, bind.Port))
        {
            SocketException? failure = WhyNot(v4);
            string why = failure is null ? "LiteNetLib does not say why" : $"{failure.Message} ({failure.SocketErrorCode})";
            throw new IOException($"UDP port {bind} cannot be opened: {why}.", failure);
        }

        // It goes without IPv6 in silence, if that half of the port is taken; but then it sends nothing there.
        if (isDual && !manager.SendUnconnectedMessage(new byte[1], new IPEndPoint(IPAddress.IPv6Loopback, manager.LocalPort)))
        {
            int port = manager.LocalPort;
            manager.Stop();
            SocketException? failure = WhyNot(new IPEndPoint(IPAddress.IPv6Any, port));
            throw new IOException(
                $"UDP port {new IPEndPoint(IPAddress.IPv6Any, port)} cannot be opened for IPv6{(failure is null ? "" : $": {failure.Message}")}.", failure);
        }
    }

    /// <summary>The connection to an address, requested if there is none; null if there is no room for it, or if the other side is
    /// requesting one at the moment.</summary>
    private LiteNetPeer? Connect(IPEndPoint endPoint, PeerAddress to)
    {
        if (peers.Count > maxConnections)
        {
            ForgetTheDead();
        }

        try
        {
            LiteNetPeer? peer = HasRoom() ? manager.Connect(endPoint, key) : null;
            if (peer is not null)
            {
                peers[to] = peer; // it may have ended or been replaced since: check its state, and ask LiteNetLib again
            }

            return peer;
        }
        catch (InvalidOperationException) when (Volatile.Read(ref disposed) != 0)
        {
            throw new ObjectDisposedException(nameof(LiteNetLibPort)); // closed in the meantime by another thread
        }
    }

    private bool HasRoom() =>
        manager.GetPeersCount(ConnectionState.Any) < maxConnections
        && manager.GetPeersCount(ConnectionState.Any | ConnectionState.Disconnected) < maxConnections + MaxClosed;

    private void ForgetTheDead()
    {
        foreach (KeyValuePair<PeerAddress, LiteNetPeer> known in peers)
        {
            if (!IsAlive(known.Value))
            {
                peers.TryRemove(known.Key, out _);
            }
        }
    }

    private void ThrowIfDisposed()
    {
        if (Volatile.Read(ref disposed) != 0)
        {
            throw new ObjectDisposedException(nameof(LiteNetLibPort));
        }
    }
}
