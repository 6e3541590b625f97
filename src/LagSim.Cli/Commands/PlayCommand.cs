using System;
using System.CommandLine;
using System.ComponentModel;
using System.Diagnostics;
using System.Net;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Cli.Output;
using LagSim.Cli.Web;

namespace LagSim.Cli.Commands;

/// <summary><c>lagsim play</c>: serves a page with several worlds side by side, joined by links that a person makes worse.</summary>
internal static class PlayCommand
{
    internal static Command Create(ToolConsole console)
    {
        Option<int> port = CommonOptions.Whole("--port", "The TCP port; 0 picks a free one", 0, 0, 65535);
        Option<string> address = new("--address")
        {
            Description = "The address of this machine to listen on.",
            DefaultValueFactory = _ => IPAddress.Loopback.ToString(),
            HelpName = "ADDRESS",
        };
        Option<bool> quiet = new("--no-browser") { Description = "Only print the address; do not open it." };
        Command command = new("play", "Opens a page in which you throw a ball in one of several worlds, and see what lag does to the others.")
        {
            port, address, quiet,
        };
        command.SetAction(parsed =>
        {
            IPEndPoint local = new(EndPointText.ParseLocal("--address", parsed.GetValue(address)!), parsed.GetValue(port));
            return RunAsync(console, local, !parsed.GetValue(quiet)).GetAwaiter().GetResult();
        });
        return command;
    }

    private static async Task<int> RunAsync(ToolConsole console, IPEndPoint local, bool opens)
    {
        try
        {
            await using PageServer server = await PageServer.StartAsync(local, "/index.html", null, console.Stop);
            console.Output.WriteLine(server.Address);
            console.Output.Flush();
            server.Serve(await PageFolder.FindAsync(console.Error, console.Stop));
            console.Error.WriteLine($"the page is there: {server.Address} Ctrl-C ends it");
            if (opens)
            {
                Open(server.Address, console);
            }

            await Task.Delay(Timeout.Infinite, console.Stop);
        }
        catch (OperationCanceledException) when (console.Stop.IsCancellationRequested)
        {
            // As asked.
        }

        return ExitCode.Interrupted;
    }

    private static void Open(string address, ToolConsole console)
    {
        try
        {
            using Process? browser = Process.Start(new ProcessStartInfo(address) { UseShellExecute = true });
        }
        catch (Exception failure) when (failure is Win32Exception or InvalidOperationException or PlatformNotSupportedException)
        {
            console.Error.WriteLine("no browser could be opened; open the address yourself");
        }
    }
}
