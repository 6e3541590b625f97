using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Net;
using System.Net.Http;
using System.Net.Sockets;
using System.Net.WebSockets;
using System.Text;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Net.Carriers;

namespace LagSim.Tests.Cli;

/// <summary>A machine that holds as many connections to a server as it gets, and opens each again when it has lost it. It has an address of
/// its own of the loopback network.</summary>
internal sealed class HostileMachine : IAsyncDisposable
{
    private static readonly TimeSpan Pause = TimeSpan.FromMilliseconds(100);

    private readonly IPAddress self;
    private readonly IPEndPoint server;
    private readonly CancellationTokenSource stopping = new();
    private readonly Task running;
    private int holding;

    /// <param name="number">Of the machine: the last part of its address, from 2 on.</param>
    /// <param name="server">Whom it attacks.</param>
    /// <param name="attack">What it does with each connection.</param>
    /// <param name="connections">How many it wants.</param>
    internal HostileMachine(byte number, IPEndPoint server, HostileConnection attack, int connections)
    {
        self = new IPAddress([127, 0, 0, number]);
        this.server = server;
        running = Task.WhenAll(Enumerable.Range(0, connections).Select(_ => Task.Run(() => GoOnAsync(attack))));
    }

    /// <summary>How many connections it has, as far as it knows: the system takes them in before the server does.</summary>
    internal int Holding => Volatile.Read(ref holding);

    /// <summary>Opens a connection from an address.</summary>
    internal static async Task<Socket> ConnectAsync(IPAddress from, IPEndPoint to, CancellationToken stop)
    {
        Socket socket = new(to.AddressFamily, SocketType.Stream, ProtocolType.Tcp) { NoDelay = true, ReceiveBufferSize = 4096 };
        try
        {
            socket.Bind(new IPEndPoint(from, 0));
            await socket.ConnectAsync(to, stop);
            return socket;
        }
        catch
        {
            socket.Dispose();
            throw;
        }
    }

    /// <summary>Opens a WebSocket from an address.</summary>
    internal static async Task<ClientWebSocket> OpenAsync(IPAddress from, IPEndPoint to, CancellationToken stop)
    {
        ClientWebSocket socket = new();
        try
        {
            socket.Options.AddSubProtocol(WebSocketClientPort.Subprotocol);
            socket.Options.CollectHttpResponseDetails = true;
            using SocketsHttpHandler handler = new() { ConnectCallback = async (_, patience) => new NetworkStream(await ConnectAsync(from, to, patience), ownsSocket: true) };
            using HttpMessageInvoker invoker = new(handler, disposeHandler: false);
            await socket.ConnectAsync(new Uri($"ws://{to}/session"), invoker, stop);
            return socket;
        }
        catch
        {
            socket.Dispose();
            throw;
        }
    }

    public async ValueTask DisposeAsync()
    {
        await stopping.CancelAsync();
        await running;
        stopping.Dispose();
    }

    private async Task GoOnAsync(HostileConnection attack)
    {
        byte[] heard = new byte[4096];
        while (!stopping.IsCancellationRequested)
        {
            try
            {
                await HoldAsync(attack, heard);
                await Task.Delay(Pause, stopping.Token);
            }
            catch (Exception lost) when (lost is SocketException or WebSocketException or IOException or HttpRequestException or OperationCanceledException)
            {
                await Task.WhenAny(Task.Delay(Pause, stopping.Token)); // the server has ended it, or there was no room
            }
        }
    }

    /// <summary>Holds one connection until it ends.</summary>
    private async Task HoldAsync(HostileConnection attack, byte[] heard)
    {
        CancellationToken stop = stopping.Token;
        if (attack is HostileConnection.AnswersPings or HostileConnection.SendsNonsense)
        {
            using ClientWebSocket open = await OpenAsync(self, server, stop);
            await CountAsync(async () =>
            {
                Task<WebSocketReceiveResult> ended = open.ReceiveAsync(heard, stop); // which answers pings
                while (await Task.WhenAny(ended, Task.Delay(attack == HostileConnection.SendsNonsense ? Pause : Timeout.InfiniteTimeSpan, stop)) != ended)
                {
                    await open.SendAsync(new byte[] { 1, 2, 3 }, WebSocketMessageType.Binary, true, stop);
                }

                await ended;
            });
            return;
        }

        using Socket socket = await ConnectAsync(self, server, stop);
        await CountAsync(async () =>
        {
            string request = attack == HostileConnection.AsksAndReadsNothing ? "GET / HTTP/1.1\r\nHost: a\r\n\r\n"
                : attack == HostileConnection.AsksAndStays ? "GET /session HTTP/1.1\r\nHost: " + server + "\r\n\r\n" : "";
            await socket.SendAsync(Encoding.ASCII.GetBytes(request), stop);
            IEnumerator<byte> drip = Encoding.ASCII.GetBytes("GET / HTTP/1.1\r\nX: " + new string('a', 4000)).AsEnumerable().GetEnumerator();
            Task ended = attack == HostileConnection.AsksAndReadsNothing ? Task.Delay(Timeout.Infinite, stop) : UntilEndAsync(socket, heard);
            while (await Task.WhenAny(ended, Task.Delay(attack == HostileConnection.DripsAHeader ? Pause : Timeout.InfiniteTimeSpan, stop)) != ended && drip.MoveNext())
            {
                await socket.SendAsync(new[] { drip.Current }, stop);
            }

            await ended;
        });
    }

    private async Task UntilEndAsync(Socket socket, byte[] heard)
    {
        while (await socket.ReceiveAsync(heard, stopping.Token) > 0)
        {
            // What was answered.
        }
    }

    private async Task CountAsync(Func<Task> hold)
    {
        Interlocked.Increment(ref holding);
        try
        {
            await hold();
        }
        finally
        {
            Interlocked.Decrement(ref holding);
        }
    }
}
