using System;
using System.IO;
using System.Net.WebSockets;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Time;

namespace LagSim.Net.Carriers;

/// <summary>One WebSocket as a carrier of datagrams: each binary message is one.</summary>
/// <remarks>
/// <para>TCP keeps what it was given until it has arrived, so a peer that is slow would be sent news that is old by then. Each datagram of
/// a session supersedes those before it: it repeats whatever has not been confirmed. So at most <see cref="QueueSlots"/> wait here, and
/// where they are too many the oldest is lost, as any datagram may be.</para>
/// <para><see cref="Send"/> is for one thread at a time.</para>
/// </remarks>
internal sealed class WebSocketLink
{
    /// <summary>How many datagrams may wait: a session begins with 50 on their way at most (RFC 9002, 7.2, with its window of bytes).</summary>
    internal const int QueueSlots = 64;

    private static readonly TimeSpan Goodbye = TimeSpan.FromSeconds(1);

    private readonly WebSocket socket;
    private readonly IClock clock;
    private readonly DatagramRing waiting = new(QueueSlots);
    private readonly SemaphoreSlim signal = new(0, 1);
    private readonly TaskCompletionSource<bool> ended = new(TaskCreationOptions.RunContinuationsAsynchronously);
    private readonly byte[] datagram = new byte[IDatagramPort.MaxDatagramBytes + 1]; // that arrives; one byte more shows that it is too long
    private int received;
    private long sendingSince = long.MaxValue; // ticks of the clock; the largest while nothing is being sent
    private WebSocketCloseStatus status = WebSocketCloseStatus.NormalClosure;
    private string? reason;

    internal WebSocketLink(WebSocket socket, IClock clock)
    {
        this.socket = socket;
        this.clock = clock;
    }

    /// <summary>How long the datagram that is being sent now has waited for the network to take it; zero if none does.</summary>
    internal SimDuration BlockedFor
    {
        get
        {
            long since = Interlocked.Read(ref sendingSince);
            return since == long.MaxValue ? SimDuration.Zero : clock.Now - SimTime.FromTicks(since);
        }
    }

    /// <summary>Has a datagram sent, after those that wait. Never blocks.</summary>
    /// <returns>Whether an older one was lost to make room.</returns>
    internal bool Send(ReadOnlySpan<byte> datagram)
    {
        bool isLost = waiting.PutNewest(datagram, default);
        Wake();
        return isLost;
    }

    /// <summary>Ends the connection, and says why to the other side.</summary>
    internal void Close(WebSocketCloseStatus why, string sentence)
    {
        if (!ended.Task.IsCompleted)
        {
            (status, reason) = (why, sentence);
        }

        End();
    }

    /// <summary>Ends the connection at once, without a word: for a peer that takes none.</summary>
    internal void Abort()
    {
        End();
        socket.Abort();
    }

    /// <summary>Sends and receives until the connection ends.</summary>
    /// <param name="arrived">Is given each datagram that arrives, on any thread.</param>
    /// <param name="stop">Ends the connection.</param>
    internal async Task RunAsync(Action<ReadOnlyMemory<byte>> arrived, CancellationToken stop)
    {
        using CancellationTokenRegistration stopped = stop.Register(() => Close(WebSocketCloseStatus.EndpointUnavailable, "The session has ended."));
        Task sending = SendAllAsync();
        Task receiving = ReceiveAllAsync(arrived);
        await Task.WhenAny(receiving, ended.Task).ConfigureAwait(false);
        End();

        // To cancel a send or a receive would break the connection, and the reason would not arrive.
        using CancellationTokenSource patience = new(Goodbye);
        using CancellationTokenRegistration enough = patience.Token.Register(socket.Abort);
        try
        {
            await sending.ConfigureAwait(false);
            await SayGoodbyeAsync(patience.Token).ConfigureAwait(false);
            await receiving.ConfigureAwait(false);
        }
        finally
        {
            socket.Dispose();
        }
    }

    private async Task SendAllAsync()
    {
        byte[] next = new byte[IDatagramPort.MaxDatagramBytes];
        try
        {
            while (true)
            {
                while (waiting.TryTake(next, out int length, out _))
                {
                    Interlocked.Exchange(ref sendingSince, clock.Now.Ticks);
                    await socket.SendAsync(next.AsMemory(0, length), WebSocketMessageType.Binary, true, CancellationToken.None).ConfigureAwait(false);
                    Interlocked.Exchange(ref sendingSince, long.MaxValue);
                }

                if (ended.Task.IsCompleted)
                {
                    return; // with what was sent before, such as a goodbye
                }

                await signal.WaitAsync().ConfigureAwait(false);
            }
        }
        catch (Exception failure) when (IsOfTheConnection(failure))
        {
            End(); // the connection broke
        }
    }

    private async Task ReceiveAllAsync(Action<ReadOnlyMemory<byte>> arrived)
    {
        try
        {
            while (await TryReceiveAsync().ConfigureAwait(false))
            {
                if (!ended.Task.IsCompleted)
                {
                    arrived(datagram.AsMemory(0, received));
                }
            }
        }
        catch (Exception failure) when (IsOfTheConnection(failure))
        {
            // The connection broke, or was ended from here.
        }
    }

    /// <summary>Receives a datagram; false if the other side closes the connection, or sends what is none.</summary>
    private async Task<bool> TryReceiveAsync()
    {
        received = 0;
        ValueWebSocketReceiveResult got;
        do
        {
            got = await socket.ReceiveAsync(datagram.AsMemory(received), CancellationToken.None).ConfigureAwait(false);
            received += got.Count;
        }
        while (!got.EndOfMessage && got.MessageType == WebSocketMessageType.Binary && received < datagram.Length);

        if (got.MessageType == WebSocketMessageType.Close)
        {
            return false;
        }

        if (got.MessageType == WebSocketMessageType.Text)
        {
            Close(WebSocketCloseStatus.InvalidMessageType, "A datagram is a binary message; this one was text.");
            return false;
        }

        if (received is 0 or > IDatagramPort.MaxDatagramBytes)
        {
            Close(
                received == 0 ? WebSocketCloseStatus.PolicyViolation : WebSocketCloseStatus.MessageTooBig,
                $"A datagram has 1 to {IDatagramPort.MaxDatagramBytes} bytes; this one has {(received == 0 ? "none" : "more")}.");
            return false;
        }

        return true;
    }

    /// <summary>Says why the connection ends, if the other side takes it.</summary>
    private async Task SayGoodbyeAsync(CancellationToken patience)
    {
        try
        {
            if (socket.State is WebSocketState.Open or WebSocketState.CloseReceived)
            {
                await socket.CloseOutputAsync(status, reason, patience).ConfigureAwait(false);
            }
        }
        catch (Exception failure) when (IsOfTheConnection(failure))
        {
            // It is gone.
        }
    }

    /// <summary>Whether the connection broke, or was ended, rather than something else. ObjectDisposedException is an InvalidOperationException,
    /// which browsers' sockets throw, too, when they have closed by themselves.</summary>
    private static bool IsOfTheConnection(Exception failure) =>
        failure is WebSocketException or OperationCanceledException or IOException or InvalidOperationException;

    private void End()
    {
        ended.TrySetResult(true);
        Wake();
    }

    private void Wake()
    {
        try
        {
            signal.Release();
        }
        catch (SemaphoreFullException)
        {
            // It is awake already.
        }
    }
}
