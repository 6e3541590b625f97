using System;
using System.ComponentModel;
using System.Diagnostics;
using System.Text.RegularExpressions;
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
        try
        {
            Process process = Process.Start(new ProcessStartInfo("python3")
            {
                ArgumentList = { "-u", "-m", "http.server", "0", "--bind", "127.0.0.1", "--directory", folder },
                RedirectStandardOutput = true,
                RedirectStandardError = true,
            })!;
            process.BeginErrorReadLine(); // each request that it answers
            string said = await process.StandardOutput.ReadLineAsync() ?? ""; // "Serving HTTP on 127.0.0.1 port N (http://127.0.0.1:N/) ..."
            return new OtherServer(process, Regex.Match(said, @"\((http:[^)]+)\)").Groups[1].Value);
        }
        catch (Win32Exception)
        {
            Assert.Skip("There is no python3 here.");
            throw;
        }
    }

    public async ValueTask DisposeAsync()
    {
        process.Kill();
        await process.WaitForExitAsync();
        process.Dispose();
    }
}
