using System;
using System.IO.Pipelines;
using System.Net;
using System.Text;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Time;
using Microsoft.AspNetCore.Connections;
using Microsoft.AspNetCore.Http;

namespace LagSim.Cli.Web;

/// <summary>Counts the connections to the page's server by machine, before anything is read of them.</summary>
/// <remarks>A connection over which nothing is being answered gives way to the next at once, as HTTP lets any server close one that is idle.
/// One with a request is safe for some seconds, a WebSocket for good: of those the port has limits of its own.</remarks>
internal sealed class ConnectionGate
{
    /// <summary>What is told to whom there is no room for.</summary>
    internal const string Full = "The host has no room for another connection now. There may be in a few seconds.";

    /// <summary>When it is worth trying again, in seconds, for the header of that name.</summary>
    internal const string RetryAfter = "5";

    /// <summary>How many connections there may be: as many WebSockets as a session takes, and two more for each, since a browser opens six for
    /// the files of the page, for a moment.</summary>
    internal const int MaxConnections = 3 * WebSocketHostPort.DefaultMaxConnections;

    /// <summary>How many may be told at a time that there is no room. Others are closed without a word.</summary>
    private const int MaxFarewells = 16;

    private static readonly SimDuration Answering = SimDuration.FromSeconds(10); // how long one with a request is safe
    private static readonly TimeSpan Farewell = TimeSpan.FromSeconds(1);

    private readonly ConnectionLimiter limiter = new(MaxConnections, new StopwatchClock());
    private readonly SemaphoreSlim farewells = new(MaxFarewells);

    /// <summary>How many connections there are.</summary>
    internal int Connections => limiter.Taken;

    /// <summary>Lets a connection in, or not.</summary>
    /// <param name="connection">The connection.</param>
    /// <param name="isPlain">Whether it can be told why not: over TLS it would have to be taken in first.</param>
    /// <param name="next">Serves it.</param>
    internal async Task PassAsync(ConnectionContext connection, bool isPlain, ConnectionDelegate next)
    {
        PeerAddress from = connection.RemoteEndPoint is IPEndPoint machine ? PeerAddress.From(machine) : default;
        using ConnectionPlace? place = limiter.TryEnter(from, SimDuration.Zero, connection.Abort);
        if (place is not null)
        {
            connection.Features.Set(place);
            await next(connection);
        }
        else if (isPlain && await farewells.WaitAsync(TimeSpan.Zero))
        {
            try
            {
                await RefuseAsync(connection);
            }
            finally
            {
                farewells.Release();
            }
        }
        else
        {
            connection.Abort();
        }
    }

    /// <summary>Answers a request over a connection that was let in.</summary>
    internal static async Task AnswerAsync(HttpContext context, RequestDelegate answer)
    {
        ConnectionPlace? place = context.Features.Get<ConnectionPlace>();
        place?.KeepSafe(Answering);
        try
        {
            await answer(context);
        }
        finally
        {
            place?.KeepSafe(SimDuration.Zero);
        }
    }

    /// <summary>Leaves a connection that has become a WebSocket to the limits of its port.</summary>
    internal static void LeaveToPort(HttpContext context) => context.Features.Get<ConnectionPlace>()?.Hold();

    /// <summary>Answers a request: there is no room for what it asks.</summary>
    internal static Task RefuseAsync(HttpContext context)
    {
        context.Response.StatusCode = StatusCodes.Status503ServiceUnavailable;
        context.Response.Headers.RetryAfter = RetryAfter;
        context.Response.ContentType = "text/plain; charset=utf-8";
        return context.Response.WriteAsync(Full);
    }

    /// <summary>Answers the first that comes over a connection, whatever it is: if nothing of it were read, the system would discard the
    /// answer with it.</summary>
    private static async Task RefuseAsync(ConnectionContext connection)
    {
        using CancellationTokenSource patience = new(Farewell);
        try
        {
            ReadResult request = await connection.Transport.Input.ReadAsync(patience.Token);
            connection.Transport.Input.AdvanceTo(request.Buffer.End);
            await connection.Transport.Output.WriteAsync(Encoding.ASCII.GetBytes(
                $"HTTP/1.1 503 Service Unavailable\r\nContent-Type: text/plain; charset=utf-8\r\nContent-Length: {Full.Length}\r\n"
                + $"Retry-After: {RetryAfter}\r\nConnection: close\r\n\r\n{Full}"), patience.Token);
        }
        catch (Exception gone) when (gone is OperationCanceledException or System.IO.IOException)
        {
            connection.Abort(); // it has said nothing, or does not listen
        }
    }
}
