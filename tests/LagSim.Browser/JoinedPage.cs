using System.Collections.Generic;
using System.Linq;
using System.Text.Json;
using System.Threading.Tasks;
using Microsoft.Playwright;
using Xunit;

namespace LagSim.Browser;

/// <summary>The page of a host in a tab, through which a person is in its session.</summary>
internal sealed class JoinedPage
{
    /// <summary>The screen of a computer.</summary>
    internal static readonly BrowserNewContextOptions Screen = new() { ViewportSize = new() { Width = 1200, Height = 800 } };

    private readonly List<string> complaints = [];

    private JoinedPage(IPage page)
    {
        Page = page;
        page.Console += (_, message) => complaints.AddRange(message.Type is "error" or "warning" ? [message.Text] : []);
        page.PageError += (_, error) => complaints.Add(error);
    }

    internal IPage Page { get; }

    /// <summary>What the page complained of to its console.</summary>
    internal IReadOnlyList<string> Complaints => complaints;

    /// <summary>Opens the page in a tab of its own.</summary>
    internal static async Task<JoinedPage> OpenAsync(IBrowserContext context, string address)
    {
        JoinedPage joined = new(await context.NewPageAsync());
        await joined.LoadAsync(address);
        return joined;
    }

    /// <summary>Opens the page, and joins.</summary>
    internal static async Task<JoinedPage> JoinAsync(IBrowserContext context, string address, string name, string? key = null)
    {
        JoinedPage joined = await OpenAsync(context, address);
        await joined.AskAsync(name, key);
        await joined.RunningAsync();
        return joined;
    }

    /// <summary>Loads the page, which a host may still be building.</summary>
    internal async Task LoadAsync(string address)
    {
        await Page.GotoAsync(address);
        await Page.WaitForSelectorAsync("#enter:not([hidden])", new() { Timeout = 120_000 });
        complaints.Clear(); // that it was being built
    }

    /// <summary>Asks to be let in.</summary>
    internal async Task AskAsync(string name, string? key = null)
    {
        await Page.FillAsync("#name", name);
        if (key is not null)
        {
            await Page.FillAsync("#key", key);
        }

        await Page.ClickAsync("#enter button");
    }

    /// <summary>Waits until it is in, and the world is there.</summary>
    internal Task RunningAsync() => Page.WaitForFunctionAsync(
        "() => window.lagsim.status?.state === 'Running' && document.querySelector('.pane')", null, new() { Timeout = 60_000 });

    /// <summary>Waits until so many of its states have agreed with the host's.</summary>
    internal Task AgreedAsync(double least, float withinMilliseconds = 20_000) => Page.WaitForFunctionAsync(
        "least => window.lagsim.status?.agreed >= least", least, new() { Timeout = withinMilliseconds });

    /// <summary>A figure of how the session stands.</summary>
    internal async Task<double> NumberAsync(string name) => await Page.EvaluateAsync<double>("name => window.lagsim.status[name]", name);

    /// <summary>The committed states that this peer has told, by their time.</summary>
    internal async Task<IReadOnlyDictionary<string, string>> StatesAsync() => ToolProcess.StatesOf(await Page.EvaluateAsync<string[]>("() => window.lagsim.commits"));

    /// <summary>Takes a ball with the mouse, drags it, and lets go while it moves.</summary>
    internal async Task ThrowAsync(int ball, float dx, float dy)
    {
        JsonElement at = await Page.EvaluateAsync<JsonElement>("ball => window.lagsim.placeOnScreen(ball)", ball);
        (float x, float y) = (at.GetProperty("x").GetSingle(), at.GetProperty("y").GetSingle());
        await Page.Mouse.MoveAsync(x, y);
        await Page.Mouse.DownAsync();
        for (int n = 1; n <= 8; n++)
        {
            await Page.Mouse.MoveAsync(x + (dx * n / 8), y + (dy * n / 8));
            await Page.WaitForTimeoutAsync(16);
        }

        await Page.Mouse.UpAsync();
    }

    /// <summary>Asserts that every state that two peers have committed is the same, and that there are at least so many.</summary>
    internal static void AssertSame(IReadOnlyDictionary<string, string> host, IReadOnlyDictionary<string, string> peer, int atLeast)
    {
        string[] both = [.. host.Keys.Where(peer.ContainsKey)];
        Assert.All(both, time => Assert.Equal(host[time], peer[time]));
        Assert.True(both.Length >= atLeast, $"Only {both.Length} states are of both; {host.Count} of the host, {peer.Count} of the peer.");
    }
}
