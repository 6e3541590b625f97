using System;
using System.IO;
using System.Net;
using System.Net.Http;
using System.Net.Sockets;
using System.Net.WebSockets;
using System.Text;
using System.Text.Json;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Cli.Output;
using LagSim.Cli.Web;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Tests.Clocks;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>The way for browsers into a session, over real HTTP: what it tells, whom it lets in, and that it takes nothing else.</summary>
public sealed class SessionDoorTests : IAsyncLifetime
{
    private const string Friend = "https://friend.example";

    private static readonly TimeSpan Deadline = TimeSpan.FromSeconds(20);

    private readonly ManualClock clock = new();
    private readonly WebSocketHostPort port;
    private readonly HostOptions options = new() { ConnectKey = "open sesame", ExpectedClients = 2, Timeout = SimDuration.FromSeconds(3) };
    private readonly HttpClient http = new() { Timeout = Deadline };
    private readonly HostFingerprint fingerprint;
    private PageServer server = null!;

    public SessionDoorTests()
    {
        port = new WebSocketHostPort(clock: clock);
        using HostIdentity identity = HostIdentity.Draw();
        fingerprint = identity.Fingerprint;
    }

    public async ValueTask InitializeAsync()
    {
        server = await PageServer.StartAsync(new IPEndPoint(IPAddress.Loopback, 0), "/join.html", null, CancellationToken.None);
        server.Open(new SessionDoor(port, BuiltInScenes.Drop(), fingerprint, options), [server.Address.TrimEnd('/'), Friend]);
    }

    public async ValueTask DisposeAsync()
    {
        port.Dispose();
        await server.DisposeAsync();
        http.Dispose();
    }

    [Fact]
    public async Task Get_OfTheSession_TellsWhatAPageHasToKnow()
    {
        string text = await http.GetStringAsync(new Uri($"{server.Address}session"), TestContext.Current.CancellationToken);
        JsonElement told = JsonDocument.Parse(text).RootElement;
        Assert.Equal("drop", told.GetProperty("scene").GetString());
        Assert.Equal(fingerprint.ToString(), told.GetProperty("fingerprint").GetString());
        Assert.True(told.GetProperty("needs_key").GetBoolean());
        Assert.Equal((2, server.Address), (told.GetProperty("waits_for").GetInt32(), told.GetProperty("address").GetString()));
        Assert.Equal((3, 120), (told.GetProperty("timeout_s").GetDouble(), told.GetProperty("rejoin_s").GetDouble()));
    }

    [Theory]
    [InlineData("?from=https://friend.example", true)]
    [InlineData("?from=https%3A%2F%2Ffriend.example", true)]
    [InlineData("?from=http://friend.example", false)]
    [InlineData("?from=", false)]
    [InlineData("", false)]
    public async Task Get_OfTheSession_TellsAPageWhetherItIsLetInAndNothingOfOthers(string query, bool isLetIn)
    {
        using HttpRequestMessage request = new(HttpMethod.Get, new Uri($"{server.Address}session{query}"));
        request.Headers.Host = "friend.example";
        using HttpResponseMessage answer = await http.SendAsync(request, TestContext.Current.CancellationToken);
        string text = await answer.Content.ReadAsStringAsync(TestContext.Current.CancellationToken);
        JsonElement told = JsonDocument.Parse(text).RootElement;
        Assert.Equal(isLetIn, told.GetProperty("lets_in").GetBoolean());
        Assert.Equal(JsonValueKind.Null, told.GetProperty("address").ValueKind); // who knows the name needs no other
        Assert.DoesNotContain("127.0.0.1", text, StringComparison.Ordinal);
        Assert.DoesNotContain(Friend, text, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("friend.example", HttpStatusCode.OK)] // of a server in front of it
    [InlineData("foe.example", HttpStatusCode.MisdirectedRequest)] // a name that somebody has made point here
    public async Task Get_OfTheSession_ByAName_IsAnsweredIfTheHostWasToldOfIt(string name, HttpStatusCode status)
    {
        using HttpRequestMessage request = new(HttpMethod.Get, new Uri($"{server.Address}session"));
        request.Headers.Host = name;
        using HttpResponseMessage answer = await http.SendAsync(request, TestContext.Current.CancellationToken);
        Assert.Equal(status, answer.StatusCode);
        string text = await answer.Content.ReadAsStringAsync(TestContext.Current.CancellationToken);
        Assert.Equal(status == HttpStatusCode.OK, text.Contains(fingerprint.ToString(), StringComparison.Ordinal));
        if (status != HttpStatusCode.OK)
        {
            JsonElement told = JsonDocument.Parse(text).RootElement;
            Assert.Equal(
                (name, "http", server.Address),
                (told.GetProperty("name").GetString(), told.GetProperty("scheme").GetString(), told.GetProperty("address").GetString()));
            Assert.Equal($"The host does not know itself by the name '{name}'.", told.GetProperty("problem").GetString());
            Assert.DoesNotContain(Friend, text, StringComparison.Ordinal); // it has reached one address, and is told of no other
        }
    }

    /// <summary>Over TCP, where the system keeps what a client does not read: it is bounded, and then the client loses its connection.</summary>
    [Fact]
    public async Task WebSocket_OfOneThatReadsNothing_HoldsLittleAndEnds()
    {
        const int Sent = 5000;
        using TcpClient client = new() { ReceiveBufferSize = 4096 };
        await client.ConnectAsync(IPAddress.Loopback, server.Port, TestContext.Current.CancellationToken);
        NetworkStream stream = client.GetStream();
        await stream.WriteAsync(Encoding.ASCII.GetBytes(
            $"GET /session HTTP/1.1\r\nHost: 127.0.0.1:{server.Port}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
            + $"Sec-WebSocket-Key: {Convert.ToBase64String(new byte[16])}\r\nSec-WebSocket-Protocol: {WebSocketClientPort.Subprotocol}\r\n\r\n"), TestContext.Current.CancellationToken);
        await stream.WriteAsync(new byte[] { 0x82, 0x81, 0, 0, 0, 0, 1 }, TestContext.Current.CancellationToken); // a binary message of one byte, with a mask of zeros
        byte[] datagram = new byte[IDatagramPort.MaxDatagramBytes];
        PeerAddress address = default;
        Assert.True(SpinWait.SpinUntil(() => port.TryReceive(datagram, out _, out address), Deadline));

        long written = 0;
        for (int n = 0; n < Sent; n++)
        {
            port.Send(datagram, address);
            await Task.Yield(); // lets the connection send what waits
            written = n + 1 - port.Superseded;
        }

        Assert.InRange(written * datagram.Length, 1, 256 << 10); // of six megabytes: in the socket at either end, and in the queue
        Assert.True(SpinWait.SpinUntil(() => port.LinkOf(address)?.BlockedFor >= SimDuration.Zero, Deadline));
        clock.Now += SimDuration.FromSeconds(WebSocketHostPort.MaxBlockedSeconds + 1);
        port.Send(datagram, address);
        Assert.Equal((1, 0), (port.Blocked, port.Connections));
        await Assert.ThrowsAnyAsync<IOException>(async () =>
        {
            while (await stream.ReadAsync(datagram, TestContext.Current.CancellationToken) > 0)
            {
                // What was on its way.
            }

            throw new EndOfStreamException();
        });
    }

    [Theory]
    [InlineData(null, true)] // a program, which says no origin
    [InlineData("own", true)]
    [InlineData(Friend, true)]
    [InlineData("https://friend.example:444", false)]
    [InlineData("http://friend.example", false)]
    [InlineData("https://foe.example", false)]
    [InlineData("null", false)] // a page in a frame without an origin, or from a file
    public async Task WebSocket_OfAPage_IsOpenedByItsOrigin(string? origin, bool isLetIn)
    {
        using ClientWebSocket socket = new();
        socket.Options.AddSubProtocol(WebSocketClientPort.Subprotocol);
        if (origin is not null)
        {
            socket.Options.SetRequestHeader("Origin", origin == "own" ? server.Address.TrimEnd('/') : origin);
        }

        Task opened = socket.ConnectAsync(Session(), TestContext.Current.CancellationToken);
        if (isLetIn)
        {
            await opened;
            await socket.SendAsync(new byte[] { 1, 2, 3 }, WebSocketMessageType.Binary, true, TestContext.Current.CancellationToken);
            byte[] datagram = new byte[IDatagramPort.MaxDatagramBytes];
            int length = 0;
            PeerAddress from = default;
            Assert.True(SpinWait.SpinUntil(() => port.TryReceive(datagram, out length, out from), Deadline));
            Assert.Equal((3, IPAddress.Loopback), (length, from.ToIPAddress()));
        }
        else
        {
            Assert.Contains("403", (await Assert.ThrowsAsync<WebSocketException>(() => opened)).Message, StringComparison.Ordinal);
            Assert.Equal(0, port.Connections);
        }
    }

    [Fact]
    public async Task WebSocket_OfAnotherProtocol_IsRefused()
    {
        using ClientWebSocket socket = new();
        socket.Options.AddSubProtocol("chat");
        WebSocketException refused = await Assert.ThrowsAsync<WebSocketException>(() => socket.ConnectAsync(Session(), TestContext.Current.CancellationToken));
        Assert.Contains("400", refused.Message, StringComparison.Ordinal);
    }

    [Fact]
    public async Task Server_OnAnAddressOfAnotherMachine_IsRefusedWithASentence()
    {
        IPEndPoint elsewhere = new(IPAddress.Parse("192.0.2.1"), 0); // of documents alone
        InputException refused = await Assert.ThrowsAsync<InputException>(() => PageServer.StartAsync(elsewhere, "/join.html", null, CancellationToken.None));
        Assert.StartsWith("Cannot listen on 192.0.2.1:0: ", refused.Message, StringComparison.Ordinal);
        await Assert.ThrowsAsync<InputException>(() => PageServer.StartAsync(new(IPAddress.Loopback, server.Port), "/join.html", null, CancellationToken.None));
    }

    [Fact]
    public async Task Request_ThatSendsSomething_IsRefused()
    {
        using StringContent content = new("x");
        using HttpResponseMessage answer = await http.PostAsync(new Uri($"{server.Address}session"), content, TestContext.Current.CancellationToken);
        Assert.Equal(HttpStatusCode.MethodNotAllowed, answer.StatusCode);
    }

    [Fact]
    public async Task Page_UntilItIsBuilt_SaysSo_AndThenIsThere()
    {
        using HttpResponseMessage before = await http.GetAsync(new Uri(server.Address), TestContext.Current.CancellationToken);
        Assert.Equal(HttpStatusCode.ServiceUnavailable, before.StatusCode);
        DirectoryInfo folder = Directory.CreateTempSubdirectory("lagsim-page");
        try
        {
            await File.WriteAllTextAsync(Path.Combine(folder.FullName, "join.html"), "the page", TestContext.Current.CancellationToken);
            server.Serve(folder.FullName);
            using HttpResponseMessage after = await http.GetAsync(new Uri(server.Address), TestContext.Current.CancellationToken);
            Assert.Equal("the page", await after.Content.ReadAsStringAsync(TestContext.Current.CancellationToken));
            Assert.Contains("default-src 'self'", string.Join(' ', after.Headers.GetValues("Content-Security-Policy")), StringComparison.Ordinal);
        }
        finally
        {
            folder.Delete(recursive: true);
        }
    }

    private Uri Session() => new(server.Address.Replace("http:", "ws:", StringComparison.Ordinal) + "session");
}
