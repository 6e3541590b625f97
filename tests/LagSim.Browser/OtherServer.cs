using System;
using System.Diagnostics;
using System.Net;
using System.Net.Sockets;
using System.Threading.Tasks;
using Xunit;

namespace LagSim.Browser;

/// <summary>A static host that has nothing to do with LagSim: that of Python.</summary>
internal sealed class OtherServer : IAsyncDisposable
{
    private readonly Process process;

    private OtherServer(Process process, string address)
    {
        this.process = process;
        Address = address;
    }

    internal string Address { get; }

    internal static async Task<OtherServer> StartAsync(string folder)
    {
        int port = FreePort();
        Process process;
        try
        {
            process = Process.Start(new ProcessStartInfo("python3")
            {
                ArgumentList = { "-m", "http.server", $"{port}", "--bind", "127.0.0.1", "--directory", folder },
                RedirectStandardError = true,
                RedirectStandardOutput = true,
            })!;
        }
        catch (System.ComponentModel.Win32Exception)
        {
            Assert.Skip("There is no python3 here.");
            throw;
        }

        for (int n = 0; n < 100; n++)
        {
            try
            {
                using TcpClient asks = new();
                await asks.ConnectAsync(IPAddress.Loopback, port);
                break;
            }
            catch (SocketException)
            {
                await Task.Delay(100);
            }
        }

        return new OtherServer(process, $"http://127.0.0.1:{port}/");
    }

    public async ValueTask DisposeAsync()
    {
        process.Kill();
        await process.WaitForExitAsync();
        process.Dispose();
    }

    private static int FreePort()
    {
        using TcpListener free = new(IPAddress.Loopback, 0);
        free.Start();
        return ((IPEndPoint)free.LocalEndpoint).Port;
    }
}
