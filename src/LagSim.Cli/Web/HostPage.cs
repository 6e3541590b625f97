using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Net;
using System.Security.Cryptography.X509Certificates;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Cli.Output;
using QRCoder;

namespace LagSim.Cli.Web;

/// <summary>The page of a host, at which browsers join its session, and the address that people open.</summary>
internal sealed class HostPage : IDisposable
{
    private readonly SessionDoor door;
    private readonly PageServer server;
    private readonly CancellationTokenSource stopping;
    private readonly Task building;

    private HostPage(SessionDoor door, PageServer server, string address, CancellationTokenSource stopping, Task building)
    {
        this.door = door;
        this.server = server;
        Address = address;
        this.stopping = stopping;
        this.building = building;
    }

    /// <summary>The address of the page, as others reach it.</summary>
    internal string Address { get; }

    /// <summary>Begins to serve. The page itself may come later: in a clone it has to be built first.</summary>
    /// <param name="door">The way into the session; closed with the page.</param>
    /// <param name="local">Where to listen.</param>
    /// <param name="reachable">The addresses at which others reach that.</param>
    /// <param name="origins">Where other pages may come from.</param>
    /// <param name="certificate">For HTTPS; null for HTTP.</param>
    /// <param name="log">Receives what is being done.</param>
    /// <param name="stop">Gives up.</param>
    /// <exception cref="InputException">It cannot listen there.</exception>
    internal static HostPage Start(
        SessionDoor door, IPEndPoint local, IReadOnlyList<IPAddress> reachable, IEnumerable<string> origins, X509Certificate2? certificate, TextWriter log,
        CancellationToken stop)
    {
        PageServer server = PageServer.StartAsync(local, "/join.html", certificate, stop).GetAwaiter().GetResult();
        string scheme = certificate is null ? "http" : "https";
        string[] own = [.. reachable.Append(IPAddress.Loopback).Append(IPAddress.IPv6Loopback)
            .Select(address => Origin(scheme, address.ToString(), server.Port)).Append(Origin(scheme, "localhost", server.Port)).Distinct()];
        server.Open(door, [.. own, .. origins]);
        CancellationTokenSource stopping = CancellationTokenSource.CreateLinkedTokenSource(stop);
        return new HostPage(door, server, own[0] + "/", stopping, ServeAsync(server, log, stopping.Token));
    }

    /// <summary>The address as a picture that a phone reads, in lines of text, or none if only this machine reaches it.</summary>
    internal IReadOnlyList<string> Picture()
    {
        if (IPAddress.TryParse(new Uri(Address).Host, out IPAddress? at) && IPAddress.IsLoopback(at))
        {
            return [];
        }

        using QRCodeData code = QRCodeGenerator.GenerateQrCode(Address, QRCodeGenerator.ECCLevel.L);
        using AsciiQRCode picture = new(code);
        return picture.GetGraphicSmall().Split('\n');
    }

    public void Dispose()
    {
        door.Dispose(); // the server would wait for those who are connected
        stopping.Cancel();
        building.GetAwaiter().GetResult();
        server.DisposeAsync().AsTask().GetAwaiter().GetResult();
        stopping.Dispose();
    }

    private static string Origin(string scheme, string host, int port) =>
        new UriBuilder(scheme, host, port).Uri.GetLeftPart(UriPartial.Authority); // without a port that is the usual one, as browsers write it

    private static async Task ServeAsync(PageServer server, TextWriter log, CancellationToken stop)
    {
        try
        {
            server.Serve(await PageFolder.FindAsync(log, stop));
        }
        catch (OperationCanceledException)
        {
            // As asked.
        }
        catch (InputException failure)
        {
            await log.WriteLineAsync(failure.Message); // the session goes on; native peers need no page
        }
    }
}
