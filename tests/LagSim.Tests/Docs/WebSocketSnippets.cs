using System;
using System.Net;
using System.Net.WebSockets;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using Microsoft.AspNetCore.Builder;
using Microsoft.AspNetCore.Http;

namespace LagSim.Tests.Docs;

/// <summary>The code of the page of LagSim.Net.WebSockets, compiled.</summary>
internal static class WebSocketSnippets
{
    internal static void Share(Scene scene, WebApplication app)
    {
        using WebSocketHostPort sockets = new();
        UdpPort udp = new(new IPEndPoint(IPAddress.Any, 5000));
        using PeerThread host = PeerThread.Host(scene, new MultiplexPort(udp, sockets), new HostOptions { Unprotected = true });

        WebSocketOptions options = new();
        options.AllowedOrigins.Add("https://game.example");
        app.UseWebSockets(options);
        app.Map("/session", async (HttpContext context) =>
        {
            if (!sockets.HasRoomFor(context.Connection.RemoteIpAddress!))
            {
                context.Response.StatusCode = StatusCodes.Status503ServiceUnavailable;
                return;
            }

            using WebSocket socket = await context.WebSockets.AcceptWebSocketAsync(WebSocketClientPort.Subprotocol);
            await sockets.ServeAsync(socket, context.Connection.RemoteIpAddress!);
        });
    }

    internal static void Join()
    {
        WebSocketClientPort port = new(new Uri("wss://game.example/session"));
        using PeerThread client = PeerThread.Join(port, WebSocketClientPort.Host);
    }
}
