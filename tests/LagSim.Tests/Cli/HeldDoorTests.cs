using System;
using System.Diagnostics;
using System.IO;
using System.Linq;
using System.Net;
using System.Net.Http;
using System.Net.Sockets;
using System.Net.WebSockets;
using System.Text;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Cli.Web;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using Microsoft.AspNetCore.Builder;
using Microsoft.AspNetCore.Hosting;
using Microsoft.Extensions.Logging;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>Machines that hold all connections to a host's page, over real sockets: an honest browser is in nevertheless, at its first try.</summary>
[Trait("Time", "real")]
public sealed class HeldDoorTests : IAsyncLifetime
{
    private const int Tries = 3;

    private static readonly TimeSpan Deadline = TimeSpan.FromSeconds(20);

    private readonly DirectoryInfo folder = Directory.CreateTempSubdirectory("lagsim-page");
    private readonly WebSocketHostPort port = new();
    private readonly HostOptions options = new() { Warmup = false, Unprotected = true };
    private PeerThread host = null!;
    private PageServer server = null!;

    private static CancellationToken Stop => TestContext.Current.CancellationToken;

    public async ValueTask InitializeAsync()
    {
        Assert.SkipWhen(OperatingSystem.IsMacOS(), "macOS has one loopback address, and so one machine.");
        await File.WriteAllBytesAsync(Path.Combine(folder.FullName, "join.html"), new byte[1 << 20]);
        host = PeerThread.Host(BuiltInScenes.Drop(), port, options);
        server = await PageServer.StartAsync(new IPEndPoint(IPAddress.Loopback, 0), "/join.html", null, CancellationToken.None);
        server.Open(new SessionDoor(port, BuiltInScenes.Drop(), null, options), [server.Address.TrimEnd('/')]);
        server.Serve(folder.FullName);
    }

    public async ValueTask DisposeAsync()
    {
        host?.Dispose();
        port.Dispose();
        if (server is not null)
        {
            await server.DisposeAsync();
        }

        folder.Delete(recursive: true);
    }

    [Theory]
    [InlineData(HostileConnection.IsSilent, 1, 128)]
    [InlineData(HostileConnection.IsSilent, 3, 128)]
    [InlineData(HostileConnection.DripsAHeader, 3, 128)]
    [InlineData(HostileConnection.AsksAndStays, 2, 128)]
    [InlineData(HostileConnection.AsksAndReadsNothing, 2, 128)]
    [InlineData(HostileConnection.AnswersPings, 2, 32)]
    [InlineData(HostileConnection.AnswersPings, 3, 64)]
    [InlineData(HostileConnection.SendsNonsense, 2, 64)]
    public async Task Door_WhileMachinesHoldAllConnections_LetsAnHonestBrowserIn(HostileConnection attack, byte machines, int connections)
    {
        HostileMachine[] hostile = [.. Enumerable.Range(2, machines).Select(n => new HostileMachine((byte)n, Local(server.Port), attack, connections))];
        try
        {
            bool overWebSockets = attack is HostileConnection.AnswersPings or HostileConnection.SendsNonsense;
            int all = overWebSockets ? WebSocketHostPort.DefaultMaxConnections : ConnectionGate.MaxConnections / (machines > 1 ? 1 : 2);
            Assert.True(SpinWait.SpinUntil(() => (overWebSockets ? port.Connections : server.Connections) >= all, Deadline));
            for (int n = 0; n < Tries; n++)
            {
                TimeSpan took = await JoinAsync(server.Port);
                TestContext.Current.TestOutputHelper!.WriteLine($"{attack}, {machines} x {connections}: in within {took.TotalMilliseconds:F0} ms");
            }
        }
        finally
        {
            await Task.WhenAll(hostile.Select(machine => machine.DisposeAsync().AsTask()));
        }
    }

    /// <summary>The control: a server with the limits that this one had before, which count all machines together.</summary>
    [Theory]
    [InlineData(HostileConnection.IsSilent, 1, 128)]
    [InlineData(HostileConnection.DripsAHeader, 1, 128)]
    [InlineData(HostileConnection.AnswersPings, 2, 32)]
    public async Task Door_WithLimitsForAllMachinesTogether_IsHeldShut(HostileConnection attack, byte machines, int connections)
    {
        await using WebApplication before = await StartAsItWasAsync();
        IPEndPoint local = Local(new Uri(before.Urls.Single()).Port);
        HostileMachine[] hostile = [.. Enumerable.Range(2, machines).Select(n => new HostileMachine((byte)n, local, attack, connections))];
        try
        {
            Assert.True(SpinWait.SpinUntil(() => hostile.Sum(machine => machine.Holding) == machines * connections, Deadline));
            for (int n = 0; n < Tries; n++)
            {
                if (attack == HostileConnection.AnswersPings)
                {
                    Exception refused = await Assert.ThrowsAsync<WebSocketException>(() => HostileMachine.OpenAsync(IPAddress.Loopback, local, Stop));
                    Assert.Contains("500", refused.Message, StringComparison.Ordinal);
                }
                else
                {
                    await Assert.ThrowsAnyAsync<HttpRequestException>(() => JoinAsync(local.Port));
                }
            }
        }
        finally
        {
            await Task.WhenAll(hostile.Select(machine => machine.DisposeAsync().AsTask()));
        }
    }

    /// <summary>A machine with its half, of which none is idle, is told that there is no room, over a connection as over a WebSocket.</summary>
    [Fact]
    public async Task Door_WithoutRoomForAMachine_SaysSo()
    {
        await using HostileMachine crowd = new(2, Local(server.Port), HostileConnection.AsksAndReadsNothing, ConnectionGate.MaxConnections / 2);
        IPAddress self = new([127, 0, 0, 2]);
        Assert.True(SpinWait.SpinUntil(() => server.Connections == ConnectionGate.MaxConnections / 2, Deadline));
        string answer = "";
        Assert.True(SpinWait.SpinUntil(() => (answer = Ask(self)).StartsWith("HTTP/1.1 503 ", StringComparison.Ordinal), Deadline)); // once all have asked
        Assert.EndsWith($"\r\n\r\n{ConnectionGate.Full}", answer, StringComparison.Ordinal);
        Assert.Contains("\r\nRetry-After: 5\r\n", answer, StringComparison.Ordinal);
        await JoinAsync(server.Port); // of another machine
    }

    [Fact]
    public async Task WebSocket_WithoutRoomForAMachine_IsRefusedWithASentence()
    {
        IPAddress self = new([127, 0, 0, 2]);
        await using HostileMachine crowd = new(2, Local(server.Port), HostileConnection.AnswersPings, WebSocketHostPort.DefaultMaxConnections / 2);
        Assert.True(SpinWait.SpinUntil(() => port.Connections == WebSocketHostPort.DefaultMaxConnections / 2, Deadline));
        WebSocketException refused = await Assert.ThrowsAsync<WebSocketException>(() => HostileMachine.OpenAsync(self, Local(server.Port), Stop));
        Assert.Contains("503", refused.Message, StringComparison.Ordinal);
        string answer = Ask(self); // as the page does
        Assert.StartsWith("HTTP/1.1 503 ", answer, StringComparison.Ordinal);
        Assert.Contains(ConnectionGate.Full, answer, StringComparison.Ordinal);
        Assert.Contains("\r\nContent-Type: text/plain", answer, StringComparison.Ordinal);
        Assert.Equal(0, port.ConnectionsRefused);
    }

    /// <summary>What is silent, or takes long for a request, is ended after seconds by itself.</summary>
    [Fact]
    public async Task Connections_WithoutARequest_AreEndedAfterSeconds()
    {
        Stopwatch watch = Stopwatch.StartNew();
        await Task.WhenAll(new[] { "", "GET / HTTP/1.1\r\nX: a", "HEAD / HTTP/1.1\r\nHost: a\r\n\r\n" }.Select(async said =>
        {
            using Socket socket = await HostileMachine.ConnectAsync(IPAddress.Loopback, Local(server.Port), Stop);
            await socket.SendAsync(Encoding.ASCII.GetBytes(said), Stop);
            byte[] heard = new byte[4096];
            while (await socket.ReceiveAsync(heard, Stop).AsTask().WaitAsync(Deadline, Stop) > 0)
            {
                // An answer, if there was a request.
            }

            Assert.True(watch.Elapsed.TotalSeconds > 4, said); // it was 130 s for one that is silent
        }));
        Assert.True(SpinWait.SpinUntil(() => server.Connections == 0, Deadline));
    }

    private static IPEndPoint Local(int port) => new(IPAddress.Loopback, port);

    /// <summary>Does what a browser does, once: gets the page, asks for the session, and joins it. It tries nothing twice.</summary>
    private static async Task<TimeSpan> JoinAsync(int port)
    {
        Stopwatch watch = Stopwatch.StartNew();
        using HttpClient browser = new() { Timeout = Deadline };
        using HttpResponseMessage page = await browser.GetAsync(new Uri($"http://127.0.0.1:{port}/"), Stop);
        Assert.Equal(HttpStatusCode.OK, page.StatusCode);
        Assert.Contains("wire_version", await browser.GetStringAsync(new Uri($"http://127.0.0.1:{port}/session"), Stop), StringComparison.Ordinal);
        WebSocketClientPort socket = new(new Uri($"ws://127.0.0.1:{port}/session"));
        using PeerThread client = PeerThread.Join(socket, WebSocketClientPort.Host, new ClientOptions { Warmup = false });
        Assert.True(client.WaitUntilRunning(Deadline), client.Session.EndReason ?? socket.Failure);
        Assert.Equal(0, socket.Reconnections);
        return watch.Elapsed;
    }

    /// <summary>Asks for the session from an address, and returns all that is answered until the connection ends or says no more.</summary>
    private string Ask(IPAddress from)
    {
        using Socket socket = HostileMachine.ConnectAsync(from, Local(server.Port), Stop).GetAwaiter().GetResult();
        socket.ReceiveTimeout = (int)Deadline.TotalMilliseconds;
        socket.Send(Encoding.ASCII.GetBytes($"GET /session HTTP/1.1\r\nHost: 127.0.0.1:{server.Port}\r\nConnection: close\r\n\r\n"));
        byte[] heard = new byte[4096];
        StringBuilder all = new();
        for (int length = socket.Receive(heard); length > 0; length = socket.Receive(heard))
        {
            all.Append(Encoding.ASCII.GetString(heard, 0, length));
        }

        return all.ToString();
    }

    private static async Task<WebApplication> StartAsItWasAsync()
    {
        WebApplicationBuilder builder = WebApplication.CreateSlimBuilder();
        builder.Logging.ClearProviders();
        builder.WebHost.ConfigureKestrel(kestrel =>
        {
            kestrel.Limits.MaxConcurrentConnections = 128;
            kestrel.Limits.MaxConcurrentUpgradedConnections = 64;
            kestrel.Listen(IPAddress.Loopback, 0);
        });
        WebApplication before = builder.Build();
        WebSocketHostPort sockets = new();
        before.Lifetime.ApplicationStopping.Register(sockets.Dispose);
        before.UseWebSockets();
        before.Run(async context =>
        {
            if (context.WebSockets.IsWebSocketRequest)
            {
                using WebSocket socket = await context.WebSockets.AcceptWebSocketAsync(WebSocketClientPort.Subprotocol);
                await sockets.ServeAsync(socket, context.Connection.RemoteIpAddress!, CancellationToken.None);
            }
        });
        await before.StartAsync(Stop);
        return before;
    }
}
