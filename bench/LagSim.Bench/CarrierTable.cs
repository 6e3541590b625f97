using System;
using System.Buffers.Binary;
using System.Collections.Generic;
using System.Diagnostics;
using System.Globalization;
using System.Linq;
using System.Net;
using System.Threading;
using LagSim.Net.Carriers;
using Microsoft.AspNetCore.Builder;
using Microsoft.AspNetCore.Hosting;
using Microsoft.Extensions.Logging;

namespace LagSim.Bench;

/// <summary>How old the newest is that the other end knows, over UDP and over a WebSocket, through the same network at the same time.</summary>
/// <remarks>Each datagram of a session repeats what has not been confirmed, so what counts is not how long one takes, but how old what is known
/// is. The network is that of the process: give it one of its own, and make that bad (bench/README.md).</remarks>
internal static class CarrierTable
{
    private const int UdpNumber = 8198; // which the rules that lose packets name
    private const int WebNumber = 8199;
    private const int PerSecond = 60;
    private const int Bytes = 200;

    internal static void Print(bool brief)
    {
        double seconds = brief ? 2 : 60;
        WebApplicationBuilder builder = WebApplication.CreateSlimBuilder();
        builder.Logging.ClearProviders();
        builder.WebHost.UseUrls($"http://127.0.0.1:{WebNumber}");
        using WebSocketHostPort sockets = new();
        WebApplication server = builder.Build();
        server.UseWebSockets();
        server.Run(async context =>
        {
            using System.Net.WebSockets.WebSocket socket = await context.WebSockets.AcceptWebSocketAsync(WebSocketClientPort.Subprotocol);
            await sockets.ServeAsync(socket, IPAddress.Loopback);
        });
        server.StartAsync().GetAwaiter().GetResult();
        using UdpPort udpHost = new(new IPEndPoint(IPAddress.Loopback, UdpNumber)), udpClient = new(new IPEndPoint(IPAddress.Loopback, 0));
        using WebSocketClientPort client = new(new Uri($"ws://127.0.0.1:{WebNumber}/"));
        SpinWait.SpinUntil(() => client.IsConnected, TimeSpan.FromSeconds(30));

        Way[] ways = [new("UDP", udpClient, udpHost.LocalAddress, udpHost), new("WebSocket", client, WebSocketClientPort.Host, sockets)];
        Stopwatch clock = Stopwatch.StartNew();
        for (double next = 0; clock.Elapsed.TotalSeconds < seconds;)
        {
            if (clock.Elapsed.TotalSeconds >= next)
            {
                next += 1.0 / PerSecond;
                Array.ForEach(ways, way => way.Send(clock));
            }

            Array.ForEach(ways, way => way.Look(clock));
            Thread.Sleep(1);
        }

        Console.WriteLine(string.Create(
            CultureInfo.InvariantCulture, $"{PerSecond} datagrams of {Bytes} bytes a second for {seconds} s, one way, both at once; age in ms of the newest that has arrived, looked at each millisecond"));
        Console.WriteLine("| carrier | arrived | p50 | p99 | p99.9 | max |");
        Console.WriteLine("|---|---|---|---|---|---|");
        Array.ForEach(ways, way => Console.WriteLine(way.Row()));
        Console.WriteLine(string.Create(CultureInfo.InvariantCulture, $"p99 over the WebSocket is {ways[1].Quantile(0.99) / ways[0].Quantile(0.99):0.0} times that over UDP"));
        server.DisposeAsync().AsTask().Wait();
    }

    private sealed class Way(string name, IDatagramPort from, PeerAddress to, IDatagramPort at)
    {
        private readonly byte[] datagram = new byte[Bytes];
        private readonly byte[] buffer = new byte[IDatagramPort.MaxDatagramBytes];
        private readonly List<double> ages = [];
        private long newest = -1;
        private int sent;
        private int arrived;

        internal void Send(Stopwatch clock)
        {
            BinaryPrimitives.WriteInt64LittleEndian(datagram, clock.ElapsedTicks);
            from.Send(datagram, to);
            sent++;
        }

        internal void Look(Stopwatch clock)
        {
            while (at.TryReceive(buffer, out _, out _))
            {
                arrived++;
                newest = Math.Max(newest, BinaryPrimitives.ReadInt64LittleEndian(buffer));
            }

            if (newest >= 0)
            {
                ages.Add(1000.0 * (clock.ElapsedTicks - newest) / Stopwatch.Frequency);
            }
        }

        internal double Quantile(double q) => ages.Order().ElementAt((int)(q * (ages.Count - 1)));

        internal string Row() => string.Create(
            CultureInfo.InvariantCulture,
            $"| {name} | {100.0 * arrived / sent:0.0} % | {Quantile(0.5):0} | {Quantile(0.99):0} | {Quantile(0.999):0} | {Quantile(1):0} |");
    }
}
