using System;
using System.Threading.Tasks;
using Microsoft.Playwright;
using Xunit;

namespace LagSim.Browser;

/// <summary>The buttons and the tick box beside the worlds, and what the controls show when something cannot be.</summary>
public sealed class ControlsPageTests(ServedPage served)
{
    private static BrowserNewContextOptions Clipboard =>
        new() { ViewportSize = new() { Width = 1400, Height = 1000 }, Permissions = ["clipboard-read", "clipboard-write"] };

    /// <summary>What the engine refuses of a link is said, and the controls show the link that the worlds still have.</summary>
    [Fact]
    public async Task Link_ThatCannotBe_IsSaidAndTheControlsShowTheOneThereIs()
    {
        string[] link = ["link", "delay", "jitter", "loss", "burst", "asymmetry", "clock", "speed"];
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "speed=0.5", Clipboard);
        await page.Page.Locator("select[name=speed]").SelectOptionAsync("1");
        await page.Page.Locator("select[name=link]").SelectOptionAsync("5g");
        await page.Page.Locator("input[name=delay]").FillAsync("0");
        Assert.Equal(
            "'asymmetry' is 11 ms; with a delay of 0 ms it can be 0 ms at most, either way.",
            await page.Page.Locator("#problem").InnerTextAsync());
        Assert.Equal(["5g", "12.5", "3", "0.1", "1.5", "11", "0", "1"], await page.ValuesAsync(link));
        Assert.Equal("12.5 ms", await page.Page.Locator("label:has(input[name=delay]) output").InnerTextAsync());
        Assert.EndsWith("?scene=room&panes=healing,healing&link=5g", page.Page.Url, StringComparison.Ordinal);
        Assert.Equal(page.Page.Url, Uri.UnescapeDataString(await CopyAsync(page)));
        await page.Page.Locator("input[name=delay]").FillAsync("10"); // the control: what can be is taken
        Assert.Equal(["custom", "10", "3", "0.1", "1.5", "11", "0", "1"], await page.ValuesAsync(link));
        Assert.EndsWith("&delay=10&jitter=3&loss=0.1&burst=1.5&asymmetry=11", page.Page.Url, StringComparison.Ordinal);
        Assert.False(await page.Page.Locator("#problem").IsVisibleAsync());
    }

    /// <summary>A correction glides over frames or is drawn in one. Only a step, of one frame, moves paused worlds; who restarts, or opens
    /// the copied link, has the same set-up.</summary>
    [Fact]
    public async Task TickBoxAndButtons_Pressed_DoWhatTheySay()
    {
        const string Seconds =
            "() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(window.lagsim.seconds()))))";
        const string SetUp =
            """
            () => [...document.querySelectorAll('#controls :is(input, select), .pane select')]
              .map(one => `${one.name} ${one.type === 'checkbox' ? one.checked : one.value}`).join('; ')
            """;
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "panes=healing,healing&delay=200&ahead=250", Clipboard);
        ILocator step = page.Page.GetByRole(AriaRole.Button, new() { Name = "Step", Exact = true });
        ILocator restart = page.Page.GetByRole(AriaRole.Button, new() { Name = "Restart" });
        await step.ClickAsync(); // which pauses, too
        double at = await page.Page.EvaluateAsync<double>(Seconds);
        Assert.Equal(at, await page.Page.EvaluateAsync<double>(Seconds)); // the control: no step, no time
        await step.ClickAsync();
        Assert.Equal(at + (1 / 60.0), await page.Page.EvaluateAsync<double>(Seconds), 1e-9);
        double gliding = await FurthestAsync(page);
        Assert.DoesNotContain("smooth", page.Page.Url, StringComparison.Ordinal);
        await page.Page.GetByLabel("Corrections glide").UncheckAsync();
        Assert.EndsWith("&smooth=0", page.Page.Url, StringComparison.Ordinal);
        double sudden = await FurthestAsync(page);
        Assert.True(sudden > 2 * gliding, $"{sudden} pixels at once, {gliding} when it glides");

        string setUp = await page.Page.EvaluateAsync<string>(SetUp);
        Assert.True(await page.Page.EvaluateAsync<double>(Seconds) > 1);
        await restart.ClickAsync();
        double begun = await page.Page.EvaluateAsync<double>(Seconds);
        Assert.InRange(begun, 0, 0.25);
        await step.ClickAsync();
        Assert.Equal(begun + (1 / 60.0), await page.Page.EvaluateAsync<double>(Seconds), 1e-9);
        Assert.Equal(setUp, await page.Page.EvaluateAsync<string>(SetUp));

        await page.Page.EvaluateAsync("() => navigator.clipboard.writeText('something else')");
        string copied = await CopyAsync(page);
        await page.Page.GetByLabel("Clock ahead").FillAsync("300");
        Assert.NotEqual(setUp, await page.Page.EvaluateAsync<string>(SetUp)); // the control
        await page.Page.GotoAsync(copied);
        await page.Page.WaitForSelectorAsync("#panes:not([hidden])");
        Assert.Equal(setUp, await page.Page.EvaluateAsync<string>(SetUp));
    }

    /// <summary>How many pixels a ball goes at most in one frame in the second pane, which hears late that the first has taken it. Every
    /// frame is a step from the beginning on, so the clock does not matter.</summary>
    private static async Task<double> FurthestAsync(OpenedPage page)
    {
        const string Press =
            """
            const buttons = [...document.querySelectorAll('#controls button')]
            const press = text => buttons.find(one => one.textContent === text).click()
            """;
        await page.Page.EvaluateAsync($"() => {{ {Press}\n press('Restart') }}");
        await page.Page.EvaluateAsync($"() => {{ {Press}\n for (let n = 0; n < 30; n++) press('Step') }}");
        await page.Canvas(0).PressAsync("Enter");
        return await page.Page.EvaluateAsync<double>(
            $$"""
            () => {
              {{Press}}
              const places = Array.from({ length: 40 }, () => (press('Step'), window.lagsim.placeOnScreen(1, 0)))
              return Math.max(...places.slice(1).map((place, n) => Math.hypot(place.x - places[n].x, place.y - places[n].y)))
            }
            """);
    }

    /// <summary>Copies the link to the set-up, and returns it from the clipboard.</summary>
    private static async Task<string> CopyAsync(OpenedPage page)
    {
        await page.Page.GetByRole(AriaRole.Button, new() { Name = "Copy a link to this set-up" }).ClickAsync();
        await page.Page.GetByRole(AriaRole.Button, new() { Name = "Copied" }).WaitForAsync();
        return await page.Page.EvaluateAsync<string>("() => navigator.clipboard.readText()");
    }
}
