using System;
using System.IO;
using System.Net.WebSockets;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Hosting;
using LagSim.Time;

namespace LagSim.Net.Carriers;

/// <summary>A datagram port over one WebSocket to a host: a client's end, in a browser as elsewhere.</summary>
/// <remarks>
/// <para>It connects at once, and again whenever the connection has ended, until it is disposed: after 0.2 s, and after twice as long each
/// time that it fails, up to 2 s. The session goes on over the new connection as over another address of the same client. What is sent
/// while there is no connection is lost and counted.</para>
/// <para>Of what the network does not take, the newest 64 datagrams wait. A host that takes nothing for
/// <see cref="WebSocketHostPort.MaxBlockedSeconds"/> is connected to again.</para>
/// <para>It blocks no thread, so it works in a browser, where there is one. The counters are for any thread.</para>
/// </remarks>
public sealed class WebSocketClientPort : IDatagramPort
{
    /// <summary>How many datagrams can wait to be taken.</summary>
    public const int RingSlots = 1024;

    /// <summary>The subprotocol that it asks for (RFC 6455, 1.9): a server that speaks another refuses it.</summary>
    public const string Subprotocol = "lagsim";

    private static readonly TimeSpan FirstPause = TimeSpan.FromMilliseconds(200);
    private static readonly TimeSpan LastPause = TimeSpan.FromSeconds(2);

    private readonly Func<CancellationToken, Task<WebSocket>> connect;
    private readonly Func<TimeSpan, CancellationToken, Task> pause;
    private readonly IClock clock;
    private readonly DatagramRing ring = new(RingSlots);
    private readonly CancellationTokenSource closing = new();
    private volatile WebSocketLink? link;
    private volatile string? failure;
    private long dropped;
    private long superseded;
    private long unconnected;
    private long connections;

    /// <summary>Begins to connect.</summary>
    /// <param name="server">The address of the WebSocket, <c>ws://</c> or <c>wss://</c>.</param>
    /// <exception cref="ArgumentNullException">The address is null.</exception>
    /// <exception cref="ArgumentException">It is not the absolute address of a WebSocket, or it has a fragment.</exception>
    public WebSocketClientPort(Uri server)
        : this(ConnectorTo(Checked(server)), Task.Delay, new StopwatchClock())
    {
    }

    internal WebSocketClientPort(
        Func<CancellationToken, Task<WebSocket>> connect, Func<TimeSpan, CancellationToken, Task> pause, IClock clock)
    {
        this.connect = connect;
        this.pause = pause;
        this.clock = clock;
        Running = RunAsync();
    }

    /// <inheritdoc/>
    public event Action? Arrived;

    /// <summary>The host's address, for a <see cref="Sessions.ClientSession"/>. A client has one connection, so it is the same for every host.</summary>
    public static PeerAddress Host { get; } = PeerAddress.Virtual(0);

    /// <summary>None: a client is at the end of its connection.</summary>
    public PeerAddress LocalAddress => default;

    /// <summary>Whether there is a connection now.</summary>
    public bool IsConnected => link is not null;

    /// <summary>Why there is no connection, as a sentence; null while there is one, and before the first attempt has ended. A browser does
    /// not tell a page more than that it failed.</summary>
    public string? Failure => link is null ? failure : null;

    /// <summary>The number of datagrams that arrived and for which the ring had no room.</summary>
    public long Dropped => Interlocked.Read(ref dropped);

    /// <summary>The number of datagrams that were not sent because newer ones came while the network took nothing.</summary>
    public long Superseded => Interlocked.Read(ref superseded);

    /// <summary>The number of datagrams that were not sent because there was no connection.</summary>
    public long Unconnected => Interlocked.Read(ref unconnected);

    /// <summary>How often it has connected again.</summary>
    public long Reconnections => Math.Max(0, Interlocked.Read(ref connections) - 1);

    /// <summary>Ends once the port is disposed and its connection closed.</summary>
    internal Task Running { get; }

    /// <inheritdoc/>
    /// <exception cref="ObjectDisposedException">The port is closed.</exception>
    public void Send(ReadOnlySpan<byte> datagram, PeerAddress to)
    {
        DatagramArguments.ThrowIfNoDatagram(datagram);
        if (to != Host)
        {
            throw new ArgumentException($"This port reaches its host alone, '{Host}', and not '{to}'.", nameof(to));
        }

        if (closing.IsCancellationRequested)
        {
            throw new ObjectDisposedException(nameof(WebSocketClientPort));
        }

        if (link is not WebSocketLink open)
        {
            Interlocked.Increment(ref unconnected);
        }
        else if (open.BlockedFor > SimDuration.FromSeconds(WebSocketHostPort.MaxBlockedSeconds))
        {
            open.Abort();
        }
        else if (open.Send(datagram))
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

    /// <summary>Closes the connection, and connects no more. Datagrams that wait in the ring can still be received.</summary>
    public void Dispose() => closing.Cancel();

    private static Uri Checked(Uri server)
    {
        if (server is null)
        {
            throw new ArgumentNullException(nameof(server));
        }

        if (!server.IsAbsoluteUri || server.Scheme is not ("ws" or "wss") || server.Fragment.Length > 0)
        {
            throw new ArgumentException($"'{server}' is no address of a WebSocket: it must begin with ws:// or wss://, and have no fragment.", nameof(server));
        }

        return server;
    }

    private static Func<CancellationToken, Task<WebSocket>> ConnectorTo(Uri server) => stop => ConnectAsync(server, stop);

    private static async Task<WebSocket> ConnectAsync(Uri server, CancellationToken stop)
    {
        ClientWebSocket socket = new();
        try
        {
            socket.Options.AddSubProtocol(Subprotocol);
            await socket.ConnectAsync(server, stop).ConfigureAwait(false);
            return socket;
        }
        catch
        {
            socket.Dispose();
            throw;
        }
    }

    private async Task RunAsync()
    {
        CancellationToken stop = closing.Token;
        TimeSpan next = FirstPause;
        while (!stop.IsCancellationRequested)
        {
            bool isHeard = false;
            try
            {
                WebSocketLink open = new(await connect(stop).ConfigureAwait(false), clock);
                Interlocked.Increment(ref connections);
                link = open;
                await open.RunAsync(datagram => { isHeard = true; Take(datagram.Span); }, stop).ConfigureAwait(false);
                failure = "The connection has ended.";
            }
            catch (Exception failed) when (failed is WebSocketException or IOException or OperationCanceledException or InvalidOperationException)
            {
                failure = Sentence(failed);
            }
            finally
            {
                link = null;
            }

            next = isHeard ? FirstPause : next; // who only accepts, and then has no room, is not asked more often
            try
            {
                await pause(next, stop).ConfigureAwait(false);
            }
            catch (OperationCanceledException)
            {
                // Disposed.
            }

            next = next + next < LastPause ? next + next : LastPause;
        }
    }

    /// <summary>What failed, and what that came of: a certificate that is not trusted, say.</summary>
    private static string Sentence(Exception failed)
    {
        string cause = failed.GetBaseException().Message;
        return failed.Message.Contains(cause, StringComparison.Ordinal) ? failed.Message : $"{failed.Message}: {cause}";
    }

    private void Take(ReadOnlySpan<byte> datagram)
    {
        if (ring.TryPut(datagram, Host))
        {
            Arrived?.Invoke();
        }
        else
        {
            Interlocked.Increment(ref dropped);
        }
    }
}
