using System;
using System.Collections.Generic;
using System.Text.Json;
using System.Threading.Tasks;
using Microsoft.Playwright;
using Xunit;

namespace LagSim.Browser;

/// <summary>A page that is open, and what a person does in it. It ends with a failure if the page complained to its console.</summary>
internal sealed class OpenedPage : IAsyncDisposable
{
    private readonly IBrowserContext context;
    private readonly List<string> complaints = [];

    private OpenedPage(IBrowserContext context, IPage page)
    {
        this.context = context;
        Page = page;
        page.Console += (_, message) => Note(message.Type is "error" or "warning", message.Text);
        page.PageError += (_, error) => Note(true, error);
    }

    internal IPage Page { get; }

    /// <summary>Opens the page with a set-up, and waits for its worlds.</summary>
    internal static async Task<OpenedPage> OpenAsync(ServedPage served, string query, BrowserNewContextOptions? options = null, string? address = null)
    {
        IBrowserContext context = await served.Browser.NewContextAsync(options ?? new() { ViewportSize = new() { Width = 1400, Height = 1000 } });
        OpenedPage opened = new(context, await context.NewPageAsync());
        await opened.Page.GotoAsync($"{address ?? served.Address}?{query}");
        await opened.Page.WaitForSelectorAsync("#panes:not([hidden])", new() { Timeout = 60_000 });
        return opened;
    }

    public async ValueTask DisposeAsync()
    {
        await context.CloseAsync();
        Assert.Empty(complaints);
    }

    /// <summary>Presses Tab until an element has the focus, as a person without a mouse does.</summary>
    internal async Task TabToAsync(string selector)
    {
        for (int n = 0; n < 60; n++)
        {
            await Page.Keyboard.PressAsync("Tab");
            if (await Page.EvaluateAsync<bool>("selector => document.activeElement.matches(selector)", selector))
            {
                return;
            }
        }

        Assert.Fail($"Tab does not come to {selector}.");
    }

    /// <summary>The canvas of a pane.</summary>
    internal ILocator Canvas(int pane) => Page.Locator(".pane").Nth(pane).Locator("canvas").First;

    /// <summary>What a pane says about its hash.</summary>
    internal async Task<(string Hash, string Says)> HashAsync(int pane)
    {
        ILocator line = Page.Locator(".agrees").Nth(pane);
        return (await line.Locator("code").First.InnerTextAsync(), await line.Locator("span").InnerTextAsync());
    }

    /// <summary>Waits until every pane says the same hash of the same instant, and that it agrees.</summary>
    internal Task AgreeAsync(int panes) => Page.WaitForFunctionAsync(
        """
        panes => {
          const lines = [...document.querySelectorAll('.agrees')].map(line => [line.querySelector('code').textContent, line.querySelector('span').textContent])
          return lines.length === panes && lines.every(([hash, says]) => /^[0-9a-f]{16}$/.test(hash) && hash === lines[0][0] && says.startsWith('agrees'))
        }
        """, panes, new() { Timeout = 20_000 });

    /// <summary>The number that a pane shows under a name.</summary>
    internal async Task<double> FigureAsync(int pane, string name)
    {
        string text = await Page.Locator(".pane").Nth(pane).Locator($"dd[data-is={name}]").InnerTextAsync();
        return double.Parse(text.Split(' ')[0], System.Globalization.CultureInfo.InvariantCulture);
    }

    /// <summary>The values of controls, by their names.</summary>
    internal Task<string[]> ValuesAsync(params string[] names) =>
        Page.EvaluateAsync<string[]>("names => names.map(name => document.getElementById('controls').elements[name].value)", names);

    /// <summary>Where a ball is on the screen, as a pane draws it.</summary>
    internal async Task<(float X, float Y)> BallAsync(int pane, int ball)
    {
        JsonElement at = await Page.EvaluateAsync<JsonElement>("([pane, ball]) => window.lagsim.placeOnScreen(pane, ball)", new[] { pane, ball });
        return (at.GetProperty("x").GetSingle(), at.GetProperty("y").GetSingle());
    }

    /// <summary>Takes a ball with the mouse, drags it, and lets go while it moves.</summary>
    internal async Task ThrowAsync(int pane, int ball, float dx, float dy)
    {
        (float x, float y) = await TakeAsync(pane, ball);
        for (int n = 1; n <= 12; n++)
        {
            await Page.Mouse.MoveAsync(x + (dx * n / 12), y + (dy * n / 12));
            await Page.WaitForTimeoutAsync(16);
        }

        await Page.Mouse.UpAsync();
    }

    /// <summary>Takes a ball with the mouse, which stays down, and returns where. A ball that has gone on meanwhile is gone after.</summary>
    private async Task<(float X, float Y)> TakeAsync(int pane, int ball)
    {
        for (int n = 0; n < 20; n++)
        {
            (float x, float y) = await BallAsync(pane, ball);
            await Page.Mouse.MoveAsync(x, y);
            await Page.Mouse.DownAsync();
            if (await Canvas(pane).EvaluateAsync<bool>("canvas => canvas.classList.contains('holding')"))
            {
                return (x, y);
            }

            await Page.Mouse.UpAsync();
        }

        Assert.Fail($"Ball {ball} of pane {pane} cannot be taken.");
        return default;
    }

    private void Note(bool isComplaint, string text)
    {
        if (isComplaint)
        {
            complaints.Add(text);
        }
    }
}
