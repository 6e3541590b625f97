using System;
using System.Linq;
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
        Assert.EndsWith("&delay=10&jitter=3&loss=0.1&burst=1.5&asymmetry=11", await CopyAsync(page), StringComparison.Ordinal);
        Assert.False(await page.Page.Locator("#problem").IsVisibleAsync());
    }

    /// <summary>Only a step, of one frame, moves paused worlds. Who restarts, or opens the copied link, has the same set-up.</summary>
    [Fact]
    public async Task StepRestartAndCopiedLink_Pressed_DoWhatTheySay()
    {
        const string Seconds =
            "() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(window.lagsim.seconds()))))";
        const string SetUp =
            """
            () => [...document.querySelectorAll('#controls :is(input, select), .pane select')]
              .map(one => `${one.name} ${one.type === 'checkbox' ? one.checked : one.value}`).join('; ')
            """;
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "scene=drop&panes=none,healing,healing&ahead=250", Clipboard);
        await page.Page.Locator("input[name=clock]").FillAsync("300");
        await page.Page.GetByLabel("Corrections glide").UncheckAsync();
        string setUp = await page.Page.EvaluateAsync<string>(SetUp);
        await page.Page.WaitForFunctionAsync("() => window.lagsim.seconds() > 0.5");
        ILocator step = page.Page.GetByRole(AriaRole.Button, new() { Name = "Step", Exact = true });
        await step.ClickAsync(); // which pauses, too
        double at = await page.Page.EvaluateAsync<double>(Seconds);
        Assert.Equal(at, await page.Page.EvaluateAsync<double>(Seconds)); // the control: no step, no time
        for (int n = 1; n <= 3; n++)
        {
            await step.ClickAsync();
            Assert.Equal(at + (n / 60.0), await page.Page.EvaluateAsync<double>(Seconds), 1e-9);
        }

        await page.Page.GetByRole(AriaRole.Button, new() { Name = "Restart" }).ClickAsync();
        double begun = await page.Page.EvaluateAsync<double>(Seconds);
        Assert.InRange(begun, 0, 0.25);
        await step.ClickAsync();
        Assert.Equal(begun + (1 / 60.0), await page.Page.EvaluateAsync<double>(Seconds), 1e-9);
        Assert.Equal(setUp, await page.Page.EvaluateAsync<string>(SetUp));

        await page.Page.EvaluateAsync("() => navigator.clipboard.writeText('something else')");
        string copied = await CopyAsync(page);
        await page.Page.GotoAsync("about:blank");
        string other = copied.Replace("clock=300", "clock=200", StringComparison.Ordinal); // the control
        foreach ((string address, bool isSame) in new[] { (copied, true), (other, false) })
        {
            await page.Page.GotoAsync(address);
            await page.Page.WaitForSelectorAsync("#panes:not([hidden])");
            Assert.Equal(isSame, setUp == await page.Page.EvaluateAsync<string>(SetUp));
        }
    }

    /// <summary>A correction that glides is drawn over several frames, one that does not in one.</summary>
    [Fact]
    public async Task Corrections_ThatGlide_AreDrawnOverMoreFrames()
    {
        const string Step =
            "const press = () => [...document.querySelectorAll('#controls button')].find(one => one.textContent === 'Step').click()";
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "panes=healing,healing&delay=200");
        double[] furthest = [0, 0]; // in pixels, from one frame to the next
        foreach (bool glides in new[] { true, false })
        {
            await page.Page.GetByLabel("Corrections glide").SetCheckedAsync(glides);
            Assert.Equal(!glides, page.Page.Url.Contains("smooth=0", StringComparison.Ordinal));
            await page.Page.GetByRole(AriaRole.Button, new() { Name = "Step", Exact = true }).ClickAsync();
            await page.Page.GetByRole(AriaRole.Button, new() { Name = "Restart" }).ClickAsync();
            await page.Page.EvaluateAsync($"() => {{ {Step}; for (let n = 0; n < 30; n++) press() }}");
            await page.Canvas(0).PressAsync("Enter"); // takes a ball, of which the other pane hears late
            furthest[glides ? 0 : 1] = await page.Page.EvaluateAsync<double>(
                $$"""
                () => {
                  {{Step}}
                  const places = Array.from({ length: 40 }, () => (press(), window.lagsim.placeOnScreen(1, 0)))
                  return Math.max(...places.slice(1).map((place, n) => Math.hypot(place.x - places[n].x, place.y - places[n].y)))
                }
                """);
        }

        Assert.True(furthest[1] > 2 * furthest[0], $"{furthest[1]} pixels at once, {furthest[0]} when it glides");
    }

    /// <summary>Copies the link to the set-up, and returns it from the clipboard.</summary>
    private static async Task<string> CopyAsync(OpenedPage page)
    {
        await page.Page.GetByRole(AriaRole.Button, new() { Name = "Copy a link to this set-up" }).ClickAsync();
        await page.Page.GetByRole(AriaRole.Button, new() { Name = "Copied" }).WaitForAsync();
        return await page.Page.EvaluateAsync<string>("() => navigator.clipboard.readText()");
    }
}
