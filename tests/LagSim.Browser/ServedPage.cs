using System;
using System.Diagnostics;
using System.IO;
using System.Linq;
using System.Threading.Tasks;
using Microsoft.Playwright;
using Xunit;

// Each page keeps a core busy, and pages look at the clock.
[assembly: CollectionBehavior(DisableTestParallelization = true)]
[assembly: AssemblyFixture(typeof(LagSim.Browser.ServedPage))]

namespace LagSim.Browser;

/// <summary>The page, served by <c>lagsim play</c> as a process, and a Chromium to open it in.</summary>
public sealed class ServedPage : IAsyncLifetime
{
    /// <summary>How long the page may take to be built and loaded, in milliseconds.</summary>
    private const float Deadline = 180_000;

    private Process? server;
    private IPlaywright? playwright;

    /// <summary>The browser.</summary>
    public IBrowser Browser { get; private set; } = null!;

    /// <summary>The address of the page.</summary>
    public string Address { get; private set; } = "";

    /// <summary>The folder of the repository.</summary>
    public static string Root { get; } = FindRoot();

    public async ValueTask InitializeAsync()
    {
        server = Process.Start(new ProcessStartInfo("dotnet") { ArgumentList = { Tool.Path, "play", "--port", "0", "--no-browser" }, RedirectStandardOutput = true })!;
        Address = await server.StandardOutput.ReadLineAsync() ?? throw new InvalidOperationException("lagsim play ended without an address.");
        playwright = await Playwright.CreateAsync();
        Browser = await LaunchAsync();
        IPage first = await Browser.NewPageAsync();
        await first.GotoAsync(Address); // may say for a while that it is being built
        await first.WaitForSelectorAsync("#panes:not([hidden])", new() { Timeout = Deadline });
        await first.CloseAsync();
    }

    /// <summary>Another browser, with processes of its own.</summary>
    internal Task<IBrowser> LaunchAsync() => playwright!.Chromium.LaunchAsync(new()
    {
        ExecutablePath = Environment.GetEnvironmentVariable("CHROMIUM") ?? "/usr/bin/chromium",
        Args = ["--no-sandbox"],
    });

    public async ValueTask DisposeAsync()
    {
        if (Browser is not null)
        {
            await Browser.CloseAsync();
        }

        playwright?.Dispose();
        if (server is not null)
        {
            server.Kill(entireProcessTree: true);
            await server.WaitForExitAsync();
            server.Dispose();
        }
    }

    private static string FindRoot()
    {
        DirectoryInfo? at = new(AppContext.BaseDirectory);
        while (at is not null && !at.EnumerateFiles("LagSim.sln").Any())
        {
            at = at.Parent;
        }

        return at?.FullName ?? throw new InvalidOperationException("This is not a clone of LagSim.");
    }
}
