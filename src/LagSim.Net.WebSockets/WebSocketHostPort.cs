using System;
using System.Collections.Concurrent;
using System.Collections.Generic;
using System.Linq;
using System.Net;
using System.Net.WebSockets;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Hosting;
using LagSim.Net.Sessions;
using LagSim.Time;

namespace LagSim.Net.Carriers;

/// <summary>A datagram port over the WebSockets that clients open to a web server: a host's end.</summary>
/// <remarks>
/// <para>It listens to nothing itself. The web server accepts a WebSocket, once it has checked where the page comes from (its
/// <c>Origin</c>), and hands it to <see cref="ServeAsync"/>. Each connection is an address of its own
/// (<see cref="PeerAddress.OfConnection"/>), which counts to the machine that it came from.</para>
/// <para>Of what a slow client does not take, the newest 64 datagrams wait, and older ones are lost, as
/// datagrams may be. A client that takes nothing for <see cref="MaxBlockedSeconds"/> loses its connection, and with it its place, once the
/// session's timeout is over. What arrives goes into a ring of <see cref="RingSlots"/> datagrams; when that is full, newer ones
/// are dropped and counted. So the most that it keeps is 1.2 MB and 77 kB a connection.</para>
/// <para>The counters, <see cref="ServeAsync"/> and <see cref="Dispose"/> are for any thread.</para>
/// </remarks>
public sealed class WebSocketHostPort : IDatagramPort
{
    /// <summary>How many datagrams can wait to be taken.</summary>
    public const int RingSlots = 1024;

    /// <summary>The default limit on connections: four times the clients that a host can have.</summary>
    public const int DefaultMaxConnections = 4 * SessionOptions.MaxClients;

    /// <summary>The most connections that can be asked for.</summary>
    public const int MaxConnections = 4096;

    /// <summary>How long a connection is safe from having to make room for another, though nothing arrives over it: a session's default
    /// timeout.</summary>
    public const double SafeSeconds = 10;

    /// <summary>For how long a client may take nothing before its connection is ended: half of a session's default timeout.</summary>
    public const double MaxBlockedSeconds = 5;

    private const WebSocketCloseStatus TryAgainLater = (WebSocketCloseStatus)1013; // of the registry that RFC 6455 has made

    private readonly int maxConnections;
    private readonly IClock clock;
    private readonly DatagramRing ring = new(RingSlots);
    private readonly ConcurrentDictionary<PeerAddress, WebSocketLink> links = new();
    private readonly CancellationTokenSource closing = new();
    private readonly object adding = new();
    private int lastNumber;
    private long dropped;
    private long superseded;
    private long blocked;
    private long unconnected;
    private long refused;

    /// <summary>Creates a port without connections.</summary>
    /// <param name="maxConnections">How many connections there may be at a time, 1 to <see cref="MaxConnections"/>, and half of them, or one, from
    /// one machine. One more takes the place of one over which nothing has arrived for <see cref="SafeSeconds"/>, or is told to try again
    /// later.</param>
    /// <param name="clock">By which it is told that a client takes nothing; null for this machine's.</param>
    /// <exception cref="ArgumentOutOfRangeException"><paramref name="maxConnections"/> is out of range.</exception>
    public WebSocketHostPort(int maxConnections = DefaultMaxConnections, IClock? clock = null)
    {
        if (maxConnections is < 1 or > MaxConnections)
        {
            throw new ArgumentOutOfRangeException(
                nameof(maxConnections), maxConnections, $"There can be 1 to {MaxConnections} connections.");
        }

        this.maxConnections = maxConnections;
        this.clock = clock ?? new StopwatchClock();
    }

    /// <inheritdoc/>
    public event Action? Arrived;

    /// <summary>None: clients open the address of the web server.</summary>
    public PeerAddress LocalAddress => default;

    /// <summary>The number of open connections.</summary>
    public int Connections => links.Count;

    /// <summary>The number of datagrams that arrived and for which the ring had no room.</summary>
    public long Dropped => Interlocked.Read(ref dropped);

    /// <summary>The number of datagrams that were not sent because newer ones came while the client took nothing.</summary>
    public long Superseded => Interlocked.Read(ref superseded);

    /// <summary>The number of connections that were ended because the client took nothing.</summary>
    public long Blocked => Interlocked.Read(ref blocked);

    /// <summary>The number of datagrams that were not sent because their connection had ended.</summary>
    public long Unconnected => Interlocked.Read(ref unconnected);

    /// <summary>The number of connections for which there was no room.</summary>
    public long ConnectionsRefused => Interlocked.Read(ref refused);

    /// <summary>Carries datagrams over a WebSocket until it ends. It is disposed then.</summary>
    /// <param name="socket">An open WebSocket, which nothing else reads or writes.</param>
    /// <param name="machine">The IP address of the machine at its other end, as far as the server knows. Behind a proxy that is the address
    /// that the proxy reports; without it all players would be of one machine, for which a host has limits.</param>
    /// <param name="stop">Ends the connection.</param>
    /// <returns>A task that ends with the connection. It fails only with what a handler of <see cref="Arrived"/> throws.</returns>
    /// <exception cref="ArgumentNullException">An argument is null.</exception>
    public async Task ServeAsync(WebSocket socket, IPAddress machine, CancellationToken stop = default)
    {
        WebSocketLink link = new(socket ?? throw new ArgumentNullException(nameof(socket)), clock);
        machine = machine ?? throw new ArgumentNullException(nameof(machine));
        using CancellationTokenSource either = CancellationTokenSource.CreateLinkedTokenSource(stop, closing.Token);
        bool isIn = TryAdd(machine, link, out PeerAddress address);
        if (!isIn)
        {
            Interlocked.Increment(ref refused);
            link.Close(TryAgainLater, "There is no room for another connection.");
        }

        try
        {
            await link.RunAsync(datagram => Take(datagram.Span, address, isIn), either.Token).ConfigureAwait(false);
        }
        finally
        {
            if (isIn)
            {
                links.TryRemove(address, out _);
            }
        }
    }

    /// <inheritdoc/>
    /// <exception cref="ObjectDisposedException">The port is closed.</exception>
    public void Send(ReadOnlySpan<byte> datagram, PeerAddress to)
    {
        DatagramArguments.ThrowIfNoDatagram(datagram);
        if (!to.IsConnection)
        {
            throw new ArgumentException($"WebSockets do not reach '{to}': it is no connection.", nameof(to));
        }

        if (closing.IsCancellationRequested)
        {
            throw new ObjectDisposedException(nameof(WebSocketHostPort));
        }

        if (!links.TryGetValue(to, out WebSocketLink? link))
        {
            Interlocked.Increment(ref unconnected);
        }
        else if (link.BlockedFor > SimDuration.FromSeconds(MaxBlockedSeconds))
        {
            if (links.TryRemove(to, out _))
            {
                Interlocked.Increment(ref blocked);
                link.Abort();
            }
        }
        else if (link.Send(datagram))
        {
            Interlocked.Increment(ref superseded);
        }
    }

    /// <inheritdoc/>
    /// <exception cref="ArgumentException"><paramref name="buffer"/> is too short.</exception>
    public bool TryReceive(Span<byte> buffer, out int length, out PeerAddress from)
    {
        DatagramArguments.ThrowIfTooShort(buffer);
        return ring.TryTake(buffer, out length, out from);
    }

    /// <summary>Ends all connections. Datagrams that wait in the ring can still be received.</summary>
    public void Dispose() => closing.Cancel();

    /// <summary>The connection of an address; null if it has ended.</summary>
    internal WebSocketLink? LinkOf(PeerAddress address) => links.TryGetValue(address, out WebSocketLink? link) ? link : null;

    /// <summary>Gives a connection an address, if there is room, or one that has been silent makes room.</summary>
    private bool TryAdd(IPAddress machine, WebSocketLink link, out PeerAddress address)
    {
        lock (adding)
        {
            address = default;
            List<KeyValuePair<PeerAddress, WebSocketLink>> ofMachine = [.. links.Where(one => one.Key.ToIPAddress().Equals(machine))];
            bool isFull = ofMachine.Count >= Math.Max(1, maxConnections / 2)
                ? !TryMakeRoom(ofMachine)
                : links.Count >= maxConnections && !TryMakeRoom(links);
            while (!isFull)
            {
                address = PeerAddress.OfConnection(machine, (ushort)++lastNumber);
                if (links.TryAdd(address, link))
                {
                    return true;
                }
            }

            return false;
        }
    }

    /// <summary>Ends the connection that has been silent for the longest, if it is not safe.</summary>
    private bool TryMakeRoom(IEnumerable<KeyValuePair<PeerAddress, WebSocketLink>> among)
    {
        (PeerAddress address, WebSocketLink silent) = among.OrderByDescending(one => one.Value.SilentFor).First();
        if (silent.SilentFor <= SimDuration.FromSeconds(SafeSeconds) || !links.TryRemove(address, out _))
        {
            return false;
        }

        silent.Abort();
        return true;
    }

    private void Take(ReadOnlySpan<byte> datagram, PeerAddress from, bool isIn)
    {
        if (!isIn)
        {
            return;
        }

        if (ring.TryPut(datagram, from))
        {
            Arrived?.Invoke();
        }
        else
        {
            Interlocked.Increment(ref dropped);
        }
    }
}
