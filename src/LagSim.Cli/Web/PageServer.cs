using System;
using System.Collections.Generic;
using System.IO;
using System.Net;
using System.Net.Sockets;
using System.Security.Cryptography.X509Certificates;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Cli.Output;
using Microsoft.AspNetCore.Builder;
using Microsoft.AspNetCore.Hosting;
using Microsoft.AspNetCore.Http;
using Microsoft.AspNetCore.Server.Kestrel.Core;
using Microsoft.AspNetCore.Server.Kestrel.Transport.Sockets;
using Microsoft.AspNetCore.StaticFiles;
using Microsoft.Extensions.DependencyInjection;
using Microsoft.Extensions.FileProviders;
using Microsoft.Extensions.Hosting;
using Microsoft.Extensions.Logging;

namespace LagSim.Cli.Web;

/// <summary>Serves the files of the page over HTTP, and a page that says so while they are being built; of a host's session, too, the way
/// into it.</summary>
/// <remarks>It gives away files of one folder, and takes nothing but WebSockets: every method but GET and HEAD is refused.</remarks>
internal sealed class PageServer : IAsyncDisposable
{
    // WebAssembly is compiled in the page, which needs a word of its own; nothing else may come from anywhere but here.
    private const string Policy = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline';"
        + " img-src 'self' data:; frame-ancestors 'none'; base-uri 'none'; form-action 'none'";

    /// <summary>How much may wait in the server and the system for a client that is slow: what waits is old when it arrives, and a newer
    /// datagram would have said the same. A megabit a second takes that in a quarter of one.</summary>
    private const int MaxWaitingBytes = 32 << 10;

    /// <summary>How long a connection may be silent, take for the head of a request, and take to agree on TLS.</summary>
    private static readonly TimeSpan Patience = TimeSpan.FromSeconds(5);

    private const string Compressed = ".br";

    private const string Waiting = """
        <!doctype html><html lang="en"><meta charset="utf-8"><meta http-equiv="refresh" content="1">
        <meta name="color-scheme" content="light dark"><title>LagSim</title>
        <p style="font: 1rem system-ui; margin: 4rem; text-align: center">The page is being built. The first time it takes about a minute.</p></html>
        """;

    private readonly WebApplication application;
    private readonly ConnectionGate gate;
    private readonly string firstPage;
    private volatile RequestDelegate? files;
    private volatile RequestDelegate? door;

    private PageServer(WebApplication application, ConnectionGate gate, string firstPage)
    {
        this.application = application;
        this.gate = gate;
        this.firstPage = firstPage;
    }

    /// <summary>The address of the page, as the server listens.</summary>
    internal string Address { get; private set; } = "";

    /// <summary>The port that it listens on.</summary>
    internal int Port => new Uri(Address).Port;

    /// <summary>How many connections there are.</summary>
    internal int Connections => gate.Connections;

    /// <summary>Begins to serve.</summary>
    /// <param name="local">Where to listen.</param>
    /// <param name="firstPage">The file that is served at <c>/</c>.</param>
    /// <param name="certificate">With it the page is served over HTTPS; null for HTTP.</param>
    /// <param name="stop">Gives up.</param>
    /// <exception cref="InputException">It cannot listen there.</exception>
    internal static async Task<PageServer> StartAsync(IPEndPoint local, string firstPage, X509Certificate2? certificate, CancellationToken stop)
    {
        ConnectionGate gate = new();
        WebApplicationBuilder builder = WebApplication.CreateSlimBuilder();
        builder.Logging.ClearProviders();
        builder.Services.AddSingleton<IHostLifetime, CallersLifetime>();
        builder.WebHost.ConfigureKestrel(kestrel =>
        {
            kestrel.AddServerHeader = false;
            kestrel.Limits.MaxRequestBodySize = 0;
            kestrel.Limits.KeepAliveTimeout = Patience;
            kestrel.Limits.RequestHeadersTimeout = Patience;
            kestrel.Listen(local, listening =>
            {
                listening.Protocols = HttpProtocols.Http1; // over HTTP/2 a WebSocket would be another method than GET
                listening.Use(next => connection => gate.PassAsync(connection, certificate is null, next));
                if (certificate is not null)
                {
                    listening.UseHttps(certificate, tls => tls.HandshakeTimeout = Patience);
                }
            });
        });
        builder.WebHost.UseSockets(sockets =>
        {
            sockets.MaxWriteBufferSize = MaxWaitingBytes;
            sockets.CreateBoundListenSocket = endPoint =>
            {
                Socket socket = SocketTransportOptions.CreateDefaultBoundListenSocket(endPoint);
                socket.SendBufferSize = MaxWaitingBytes; // inherited by what is accepted
                return socket;
            };
        });
        WebApplication application = builder.Build();
        PageServer server = new(application, gate, firstPage);
        application.Run(context => ConnectionGate.AnswerAsync(context, server.Answer));
        try
        {
            await application.StartAsync(stop);
        }
        catch (Exception failure) when (failure is IOException or SocketException)
        {
            await application.DisposeAsync();
            throw new InputException($"Cannot listen on {local}: {Sentence.Of(failure)}", failure);
        }

        foreach (string url in application.Urls)
        {
            server.Address = $"{url}/";
        }

        return server;
    }

    /// <summary>From now on the files of a folder are served.</summary>
    internal void Serve(string folder)
    {
        FileExtensionContentTypeProvider types = new();
        types.Mappings[".mjs"] = "text/javascript";
        types.Mappings[Compressed] = "application/octet-stream"; // replaced by what is inside
        PhysicalFileProvider provider = new(folder);
        ApplicationBuilder pipeline = new(application.Services);
        pipeline.Use((context, next) => TakeCompressed(context, next, provider, types));
        pipeline.UseStaticFiles(new StaticFileOptions { FileProvider = provider, ContentTypeProvider = types });
        pipeline.Run(context =>
        {
            context.Response.StatusCode = StatusCodes.Status404NotFound;
            return Task.CompletedTask;
        });
        files = pipeline.Build();
    }

    /// <summary>From now on browsers join a session.</summary>
    /// <param name="session">The way in.</param>
    /// <param name="origins">Where pages may come from.</param>
    internal void Open(SessionDoor session, IReadOnlyList<string> origins) => door = session.Build(application.Services, origins);

    public ValueTask DisposeAsync() => application.DisposeAsync();

    private Task Answer(HttpContext context)
    {
        context.Response.Headers.ContentSecurityPolicy = Policy;
        context.Response.Headers.XContentTypeOptions = "nosniff";
        context.Response.Headers["Referrer-Policy"] = "no-referrer";
        if (!HttpMethods.IsGet(context.Request.Method) && !HttpMethods.IsHead(context.Request.Method))
        {
            context.Response.StatusCode = StatusCodes.Status405MethodNotAllowed;
            context.Response.Headers.Allow = "GET, HEAD";
            return Task.CompletedTask;
        }

        context.Response.Headers.CacheControl = "no-cache"; // a page that was built again is seen at once
        if (context.Request.Path == SessionDoor.Path && door is RequestDelegate enter)
        {
            return enter(context);
        }

        if (context.Request.Path == "/")
        {
            context.Request.Path = firstPage;
        }

        if (files is RequestDelegate serve)
        {
            return serve(context);
        }

        context.Response.StatusCode = StatusCodes.Status503ServiceUnavailable;
        context.Response.Headers.RetryAfter = "1";
        context.Response.ContentType = "text/html; charset=utf-8";
        return context.Response.WriteAsync(Waiting);
    }

    /// <summary>Files were compressed when the page was built: who takes them so gets them so.</summary>
    private static Task TakeCompressed(HttpContext context, RequestDelegate next, IFileProvider provider, IContentTypeProvider types)
    {
        string path = context.Request.Path.Value ?? "";
        bool isTaken = context.Request.Headers.AcceptEncoding.ToString().Contains("br", StringComparison.Ordinal);
        if (isTaken && types.TryGetContentType(path, out string? type) && provider.GetFileInfo(path + Compressed).Exists)
        {
            context.Request.Path = path + Compressed;
            context.Response.OnStarting(() =>
            {
                context.Response.ContentType = type;
                context.Response.Headers.ContentEncoding = "br";
                context.Response.Headers.Vary = "Accept-Encoding";
                return Task.CompletedTask;
            });
        }

        return next(context);
    }

    /// <summary>Signals are the tool's own to handle.</summary>
    private sealed class CallersLifetime : IHostLifetime
    {
        public Task WaitForStartAsync(CancellationToken cancellationToken) => Task.CompletedTask;

        public Task StopAsync(CancellationToken cancellationToken) => Task.CompletedTask;
    }
}
