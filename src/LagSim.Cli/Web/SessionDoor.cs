using System;
using System.Collections.Generic;
using System.Linq;
using System.Net;
using System.Net.WebSockets;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Play;
using LagSim.Scenes;
using Microsoft.AspNetCore.Builder;
using Microsoft.AspNetCore.Http;

namespace LagSim.Cli.Web;

/// <summary>The way for browsers into a host's session: what a page has to know of it, and the WebSocket that it joins by.</summary>
/// <remarks>A page of another site could open a WebSocket to a host on its visitor's own machine or network. So a browser is let in only if
/// its page comes from an origin in the list. That a page and the socket have the same origin is not enough: anybody can make a name of
/// their own point to this machine (DNS rebinding).</remarks>
internal sealed class SessionDoor : IDisposable
{
    /// <summary>The path of both: a plain request gets what there is to know, one for a WebSocket joins.</summary>
    internal const string Path = "/session";

    private static readonly TimeSpan AskEvery = TimeSpan.FromSeconds(10);

    private readonly WebSocketHostPort port;
    private readonly Scene scene;
    private readonly HostFingerprint? fingerprint;
    private readonly HostOptions options;

    /// <param name="port">Carries what comes; closed with the door.</param>
    /// <param name="scene">The scene of the session.</param>
    /// <param name="fingerprint">Of the host; null if the session is not protected.</param>
    /// <param name="options">Of the session: what a client has to do likewise.</param>
    internal SessionDoor(WebSocketHostPort port, Scene scene, HostFingerprint? fingerprint, HostOptions options)
    {
        (this.port, this.scene, this.fingerprint, this.options) = (port, scene, fingerprint, options);
    }

    /// <summary>Returns what answers at <see cref="Path"/>.</summary>
    /// <param name="services">The server's services.</param>
    /// <param name="origins">Where pages may come from. The first is that of the address which others are told.</param>
    internal RequestDelegate Build(IServiceProvider services, IReadOnlyList<string> origins)
    {
        WebSocketOptions options = new() { KeepAliveInterval = AskEvery, KeepAliveTimeout = AskEvery };
        foreach (string origin in origins)
        {
            options.AllowedOrigins.Add(origin);
        }

        ApplicationBuilder pipeline = new(services);
        pipeline.UseWebSockets(options);
        pipeline.Run(context => AnswerAsync(context, origins));
        return pipeline.Build();
    }

    /// <summary>Ends the connections of all who came in.</summary>
    public void Dispose() => port.Dispose();

    /// <summary>What a page has to know. It says where it comes from, since a browser does not tell that of its own server; of where others
    /// come from, and of the host's addresses, only a page that was opened on this machine is told one.</summary>
    private byte[] Describe(HttpRequest request, IReadOnlyList<string> origins) => JsonBytes.Of(json =>
    {
        json.WriteNumber("wire_version", Session.WireVersion);
        json.WriteString("scene", scene.Name);
        json.WriteString("fingerprint", fingerprint?.ToString());
        json.WriteBoolean("needs_key", options.ConnectKey.Length > 0);
        json.WriteNumber("timeout_s", options.Timeout.ToSeconds());
        json.WriteNumber("rejoin_s", options.RejoinTime.ToSeconds());
        json.WriteNumber("waits_for", options.ExpectedClients);
        json.WriteBoolean("lets_in", origins.Contains(request.Query["from"].ToString()));
        bool isOfThisMachine = request.Host.Host == "localhost" || (IPAddress.TryParse(request.Host.Host, out IPAddress? name) && IPAddress.IsLoopback(name));
        json.WriteString("address", isOfThisMachine ? $"{origins[0]}/" : null);
    });

    private async Task AnswerAsync(HttpContext context, IReadOnlyList<string> origins)
    {
        IPAddress machine = context.Connection.RemoteIpAddress ?? IPAddress.None;
        bool hasRoom = port.HasRoomFor(machine);
        if (!context.WebSockets.IsWebSocketRequest)
        {
            if (!origins.Any(origin => IsName(context.Request.Host.Value, origin)))
            {
                await RefuseNameAsync(context, origins);
                return;
            }

            if (!hasRoom)
            {
                await ConnectionGate.RefuseAsync(context);
                return;
            }

            context.Response.ContentType = "application/json";
            await context.Response.Body.WriteAsync(Describe(context.Request, origins), context.RequestAborted);
            return;
        }

        bool speaksOurs = context.WebSockets.WebSocketRequestedProtocols.Contains(WebSocketClientPort.Subprotocol);
        if (!speaksOurs)
        {
            context.Response.StatusCode = StatusCodes.Status400BadRequest;
            return;
        }

        if (!hasRoom)
        {
            await ConnectionGate.RefuseAsync(context);
            return;
        }

        using WebSocket socket = await context.WebSockets.AcceptWebSocketAsync(WebSocketClientPort.Subprotocol);
        ConnectionGate.LeaveToPort(context);
        await port.ServeAsync(socket, machine, CancellationToken.None);
    }

    private static bool IsName(string? name, string origin) =>
        string.Equals(name, new Uri(origin).Authority, StringComparison.OrdinalIgnoreCase);

    /// <summary>A page under a name that the host was not told of could not open the WebSocket either, and would not know why. It is told
    /// the name, which something on the way may have changed, and the address that it has reached; not those that it has not.</summary>
    private static Task RefuseNameAsync(HttpContext context, IReadOnlyList<string> origins)
    {
        IPAddress? local = context.Connection.LocalIpAddress;
        local = local?.IsIPv4MappedToIPv6 == true ? local.MapToIPv4() : local;
        string? reached = origins.FirstOrDefault(origin => IPAddress.TryParse(new Uri(origin).Host, out IPAddress? own) && own.Equals(local));
        context.Response.StatusCode = StatusCodes.Status421MisdirectedRequest;
        context.Response.ContentType = "application/json";
        return context.Response.Body.WriteAsync(JsonBytes.Of(json =>
        {
            json.WriteString("problem", $"The host does not know itself by the name '{context.Request.Host.Value}'.");
            json.WriteString("name", context.Request.Host.Value);
            json.WriteString("scheme", context.Request.Scheme);
            json.WriteString("address", reached is null ? null : $"{reached}/");
        })).AsTask();
    }
}
