using System;
using System.Collections.Concurrent;
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

    /// <summary>How long a connection is safe from having to make room for another of a machine that has as many, after it was opened, and
    /// after the session has last heard a peer over it that has a place: a session's default timeout. What else arrives counts for nothing,
    /// or whoever sends anything could keep others out.</summary>
    public const double SafeSeconds = 10;

    /// <summary>For how long a client may take nothing before its connection is ended: half of a session's default timeout.</summary>
    public const double MaxBlockedSeconds = 5;

    private const WebSocketCloseStatus TryAgainLater = (WebSocketCloseStatus)1013; // of the registry that RFC 6455 has made

    private readonly IClock clock;
    private readonly ConnectionLimiter limiter;
    private readonly DatagramRing ring = new(RingSlots);
    private readonly ConcurrentDictionary<PeerAddress, (WebSocketLink Link, ConnectionPlace Place)> links = new();
    private readonly CancellationTokenSource closing = new();
    private int lastNumber;
    private long dropped;
    private long superseded;
    private long blocked;
    private long unconnected;
    private long refused;

    /// <summary>Creates a port without connections.</summary>
    /// <param name="maxConnections">How many connections there may be at a time, 1 to <see cref="MaxConnections"/>, and half of them, or one, from
    /// one machine. One more takes the place of one without a place in the session: where all are taken, at once one of the machine that has
    /// the most of those, if it has more than its share; otherwise one that has not been safe for the longest (<see cref="SafeSeconds"/>).
    /// Where there is none, it is told to try again later.</param>
    /// <param name="clock">By which it is told that a client takes nothing; null for this machine's.</param>
    /// <exception cref="ArgumentOutOfRangeException"><paramref name="maxConnections"/> is out of range.</exception>
    public WebSocketHostPort(int maxConnections = DefaultMaxConnections, IClock? clock = null)
    {
        if (maxConnections is < 1 or > MaxConnections)
        {
            throw new ArgumentOutOfRangeException(
                nameof(maxConnections), maxConnections, $"There can be 1 to {MaxConnections} connections.");
        }

        this.clock = clock ?? new StopwatchClock();
        limiter = new ConnectionLimiter(maxConnections, this.clock);
    }

    /// <inheritdoc/>
    public event Action? Arrived;

    /// <summary>None: clients open the address of the web server.</summary>
    public PeerAddress LocalAddress => default;

    /// <summary>The number of open connections.</summary>
    public int Connections => limiter.Taken;

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
        using ConnectionPlace? place = limiter.TryEnter(MachineOf(machine), SimDuration.FromSeconds(SafeSeconds), link.Abort);
        PeerAddress address = place is null ? default : Add(machine, link, place);
        if (place is null)
        {
            Interlocked.Increment(ref refused);
            link.Close(TryAgainLater, "There is no room for another connection.");
        }

        try
        {
            await link.RunAsync(datagram => Take(datagram.Span, address), either.Token).ConfigureAwait(false);
        }
        finally
        {
            if (place is not null)
            {
                links.TryRemove(address, out _);
            }
        }
    }

    /// <summary>Whether a connection of a machine would be let in now: a web server asks before it accepts a WebSocket, and otherwise answers
    /// 503, which says more than a connection that ends at once. For any thread.</summary>
    /// <param name="machine">As for <see cref="ServeAsync"/>.</param>
    /// <exception cref="ArgumentNullException">The machine is null.</exception>
    public bool HasRoomFor(IPAddress machine) => limiter.HasRoom(MachineOf(machine ?? throw new ArgumentNullException(nameof(machine))));

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

        if (!links.TryGetValue(to, out (WebSocketLink Link, ConnectionPlace Place) one))
        {
            Interlocked.Increment(ref unconnected);
        }
        else if (one.Link.BlockedFor > SimDuration.FromSeconds(MaxBlockedSeconds))
        {
            if (links.TryRemove(to, out _))
            {
                Interlocked.Increment(ref blocked);
                one.Place.Dispose();
                one.Link.Abort();
            }
        }
        else if (one.Link.Send(datagram))
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

    /// <inheritdoc/>
    public void NoteSeated(PeerAddress peer)
    {
        if (links.TryGetValue(peer, out (WebSocketLink Link, ConnectionPlace Place) one))
        {
            one.Place.Hold(SimDuration.FromSeconds(SafeSeconds));
        }
    }

    /// <summary>Ends all connections. Datagrams that wait in the ring can still be received.</summary>
    public void Dispose() => closing.Cancel();

    /// <summary>The connection of an address; null if it has ended.</summary>
    internal WebSocketLink? LinkOf(PeerAddress address) => links.TryGetValue(address, out (WebSocketLink Link, ConnectionPlace Place) one) ? one.Link : null;

    private static PeerAddress MachineOf(IPAddress machine) => PeerAddress.From(new IPEndPoint(machine, 0));

    /// <summary>Gives a connection an address.</summary>
    private PeerAddress Add(IPAddress machine, WebSocketLink link, ConnectionPlace place)
    {
        PeerAddress address;
        do
        {
            address = PeerAddress.OfConnection(machine, (ushort)Interlocked.Increment(ref lastNumber));
        }
        while (!links.TryAdd(address, (link, place)));

        return address;
    }

    private void Take(ReadOnlySpan<byte> datagram, PeerAddress from)
    {
        if (from.IsNone)
        {
            return; // of one for which there was no room
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
