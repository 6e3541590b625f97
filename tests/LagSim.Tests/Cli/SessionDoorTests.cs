using System;
using System.IO;
using System.Net;
using System.Net.Http;
using System.Net.WebSockets;
using System.Text.Json;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Cli.Web;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>The way for browsers into a session, over real HTTP: what it tells, whom it lets in, and that it takes nothing else.</summary>
public sealed class SessionDoorTests : IAsyncLifetime
{
    private const string Friend = "https://friend.example";

    private static readonly TimeSpan Deadline = TimeSpan.FromSeconds(20);

    private readonly WebSocketHostPort port = new();
    private readonly HttpClient http = new() { Timeout = Deadline };
    private readonly HostFingerprint fingerprint;
    private PageServer server = null!;

    public SessionDoorTests()
    {
        using HostIdentity identity = HostIdentity.Draw();
        fingerprint = identity.Fingerprint;
    }

    public async ValueTask InitializeAsync()
    {
        server = await PageServer.StartAsync(new IPEndPoint(IPAddress.Loopback, 0), "/join.html", null, CancellationToken.None);
        server.Open(new SessionDoor(port, BuiltInScenes.Drop(), fingerprint, needsKey: true), [server.Address.TrimEnd('/'), Friend]);
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
