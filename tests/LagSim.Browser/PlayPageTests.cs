using System;
using System.Linq;
using System.Threading.Tasks;
using Microsoft.Playwright;
using Xunit;

namespace LagSim.Browser;

/// <summary>The page as a person uses it: with mouse, keys and fingers, in both themes and on a phone.</summary>
public sealed class PlayPageTests(ServedPage served)
{
    [Fact]
    public async Task Ball_ThrownInOnePane_AllHashesAreEqualOnceTheEventIsThere()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "panes=healing,healing,full-rollback,healing&delay=200");
        await page.AgreeAsync(4);
        (string before, _) = await page.HashAsync(0);
        await page.ThrowAsync(1, 5, 60, -90);
        await page.Page.WaitForFunctionAsync("() => [...document.querySelectorAll('dd[data-is=heals]')].filter(heals => Number(heals.textContent) > 0).length >= 3");
        await page.AgreeAsync(4);
        Assert.NotEqual(before, (await page.HashAsync(0)).Hash);
    }

    /// <summary>The control: with a strategy that promises nothing the page says that its world differs.</summary>
    [Fact]
    public async Task Ball_ThrownWithAStrategyThatPromisesNothing_Differs()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "scene=billiards&panes=healing,none&delay=300");
        await page.Page.WaitForTimeoutAsync(600);
        (string Hash, string Says) host, other;
        int throws = 0;
        do
        {
            await page.ThrowAsync(0, 0, -60, 40); // on a busy machine it may be let go at rest, which even that strategy gets right
            await page.Page.WaitForTimeoutAsync(2500);
            (host, other) = (await page.HashAsync(0), await page.HashAsync(1));
        }
        while (other.Says.StartsWith("agrees", StringComparison.Ordinal) && ++throws < 5);
        Assert.StartsWith("agrees", host.Says, StringComparison.Ordinal);
        Assert.StartsWith("differs", other.Says, StringComparison.Ordinal);
    }

    [Fact]
    public async Task Ball_TakenAndThrownByKeysAlone_ComesToAll()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "panes=healing,healing&delay=100");
        await page.TabToAsync("[aria-label='World of player 1']");
        await page.Page.Keyboard.PressAsync("ArrowRight");
        await page.Page.Keyboard.PressAsync("Enter");
        for (int n = 0; n < 8; n++)
        {
            await page.Page.Keyboard.PressAsync("ArrowUp");
            await page.Page.WaitForTimeoutAsync(20);
        }

        await page.Page.Keyboard.PressAsync("Enter");
        await page.Page.WaitForFunctionAsync("() => Number(document.querySelectorAll('dd[data-is=heals]')[1].textContent) > 0");
        await page.AgreeAsync(2);
        await page.Page.Keyboard.PressAsync("p");
        await page.Page.GetByRole(AriaRole.Button, new() { Name = "Go on" }).WaitForAsync();
        (string paused, _) = await page.HashAsync(0);
        await page.Page.WaitForTimeoutAsync(700);
        Assert.Equal(paused, (await page.HashAsync(0)).Hash);
    }

    [Fact]
    public async Task Ball_TakenWithAFingerOnAPhone_ComesToAll()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(
            served, "panes=healing,healing&delay=100", new() { ViewportSize = new() { Width = 390, Height = 844 }, HasTouch = true, IsMobile = true, DeviceScaleFactor = 2 });
        Assert.True(await page.Page.EvaluateAsync<bool>("() => document.documentElement.scrollWidth <= innerWidth"), "the page is wider than the phone");
        (float x, float y) = await page.BallAsync(0, 6);
        ICDPSession devices = await page.Page.Context.NewCDPSessionAsync(page.Page);
        for (int n = 0; n <= 10; n++)
        {
            object[] points = n == 10 ? [] : [new { x = x + (4 * n), y = y - (3 * n) }];
            await devices.SendAsync(
                "Input.dispatchTouchEvent", new() { ["type"] = n == 0 ? "touchStart" : n == 10 ? "touchEnd" : "touchMove", ["touchPoints"] = points });
            await page.Page.WaitForTimeoutAsync(25);
        }

        await page.Page.WaitForFunctionAsync("() => Number(document.querySelectorAll('dd[data-is=heals]')[1].textContent) > 0");
        await page.AgreeAsync(2);
    }

    [Theory]
    [InlineData("scene", "billiards", "scene=billiards")]
    [InlineData("count", "4", "panes=healing,healing,healing,healing")]
    [InlineData("link", "4g", "link=4g")]
    [InlineData("speed", "0.25", "speed=0.25")]
    public async Task Choice_Made_IsInTheAddressAndComesBackFromIt(string name, string value, string part)
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "");
        await page.Page.Locator($"select[name={name}]").SelectOptionAsync(value);
        Assert.Contains(part, Uri.UnescapeDataString(page.Page.Url), StringComparison.Ordinal);
        await page.Page.ReloadAsync();
        await page.Page.WaitForSelectorAsync("#panes:not([hidden])");
        Assert.Equal(value, await page.Page.Locator($"select[name={name}]").InputValueAsync());
    }

    [Theory]
    [InlineData("delay", "250")]
    [InlineData("jitter", "40")]
    [InlineData("loss", "10")]
    [InlineData("burst", "3")]
    [InlineData("asymmetry", "50")]
    [InlineData("clock", "500")]
    [InlineData("ahead", "400")]
    [InlineData("lag", "60")]
    public async Task Slider_Moved_IsInTheAddressAndComesBackFromIt(string name, string value)
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "");
        await page.Page.Locator($"input[name={name}]").FillAsync(value);
        Assert.Contains($"{name}={value}", page.Page.Url, StringComparison.Ordinal);
        await page.Page.ReloadAsync();
        await page.Page.WaitForSelectorAsync("#panes:not([hidden])");
        Assert.Equal(value, await page.Page.Locator($"input[name={name}]").InputValueAsync());
        await page.AgreeAsync(2);
    }

    /// <summary>A slider that starts the worlds again can still be pulled to its end, and keeps the focus.</summary>
    [Fact]
    public async Task Slider_OfTheWorlds_KeepsTheHandAndTheFocus()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "");
        ILocator ahead = page.Page.Locator("input[name=ahead]");
        await ahead.FocusAsync();
        for (int n = 0; n < 3; n++)
        {
            await page.Page.Keyboard.PressAsync("ArrowRight");
        }

        Assert.Equal("130", await ahead.InputValueAsync());
        Assert.Contains("ahead=130", page.Page.Url, StringComparison.Ordinal);
        LocatorBoundingBoxResult box = (await ahead.BoundingBoxAsync())!;
        await page.Page.Mouse.MoveAsync(box.X + (0.3f * box.Width), box.Y + (box.Height / 2));
        await page.Page.Mouse.DownAsync();
        await page.Page.Mouse.MoveAsync(box.X + (0.6f * box.Width), box.Y + (box.Height / 2), new() { Steps = 5 });
        await page.Page.Mouse.MoveAsync(box.X + box.Width + 5, box.Y + (box.Height / 2), new() { Steps = 5 });
        await page.Page.Mouse.UpAsync();
        Assert.Equal("1000", await ahead.InputValueAsync());
        ILocator strategy = page.Page.Locator(".pane").Nth(1).Locator("select");
        await strategy.FocusAsync();
        await page.Page.Keyboard.PressAsync("ArrowDown");
        Assert.Equal("What player 2 does with late events", await page.Page.EvaluateAsync<string>("() => document.activeElement.getAttribute('aria-label')"));
        await page.AgreeAsync(2);
    }

    [Fact]
    public async Task Strategy_ChosenInAPane_IsThatPanes()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "");
        await page.Page.Locator(".pane").Nth(1).Locator("select").SelectOptionAsync("none");
        Assert.Contains("panes=healing,none", Uri.UnescapeDataString(page.Page.Url), StringComparison.Ordinal);
        Assert.Equal("healing", await page.Page.Locator(".pane").Nth(0).Locator("select").InputValueAsync());
        Assert.Equal("none", await page.Page.Locator(".pane").Nth(1).Locator("select").InputValueAsync());
    }

    /// <summary>What in an address cannot be costs that alone, is named, and stays in the address until a person changes something.</summary>
    [Fact]
    public async Task SetUp_ThatCannotBe_IsNamedAndAllElseOfItIsShown()
    {
        const string Query = "scene=moon&delay=30&players=9&loss=2&loss=3&jitter=abc&ahead=300";
        await using OpenedPage page = await OpenedPage.OpenAsync(served, Query);
        string[] lines = (await page.Page.Locator("#problem").InnerTextAsync()).Split('\n');
        Assert.Equal(
            [
                "'loss' is there 2 times, as '2', '3'; once is allowed. 'loss=0' is shown instead.",
                "'scene' is 'moon'; it must be one of room, drop, billiards, break, cradle, orbits, air-hockey. 'scene=room' is shown instead.",
                "'players' is no part of a set-up; there are scene, link, panes, seed, delay, jitter, loss, burst, asymmetry, clock, ahead, lag, smooth, speed. It is left out.",
                "'jitter' is 'abc'; it must be a number from 0 to 500. 'jitter=0' is shown instead.",
                "All else is as the address has it.",
                "The address stays as it is until you change something.",
            ], lines);
        Assert.Equal(["30", "0", "0", "300"], await page.ValuesAsync("delay", "loss", "jitter", "ahead"));
        Assert.EndsWith($"?{Query}", page.Page.Url, StringComparison.Ordinal);
        await page.AgreeAsync(2);
        await page.Page.Locator("input[name=loss]").FillAsync("4");
        Assert.EndsWith("?scene=room&panes=healing,healing&delay=30&ahead=300&loss=4", page.Page.Url, StringComparison.Ordinal);
        Assert.False(await page.Page.Locator("#problem").IsVisibleAsync());
    }

    /// <summary>The sliders show what a profile is, and who moves one goes on from there.</summary>
    [Fact]
    public async Task Profile_Chosen_IsWhatTheSlidersShowAndAreMovedFrom()
    {
        string[] link = ["link", "delay", "jitter", "loss", "burst", "asymmetry", "clock"];
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "link=awful&delay=30&loss=1");
        Assert.StartsWith(
            "'link=awful' and 'delay=30', 'loss=1' disagree: a profile has its own delay, jitter, loss, burst, asymmetry, clock. The profile 'awful' is shown, as it is.",
            await page.Page.Locator("#problem").InnerTextAsync(), StringComparison.Ordinal);
        Assert.Equal(["awful", "200", "60", "10", "5", "0", "0"], await page.ValuesAsync(link));
        Assert.Contains("5 % reordered; 2 % twice", await page.Page.Locator(".besides").InnerTextAsync(), StringComparison.Ordinal);
        await page.Page.Locator("select[name=link]").SelectOptionAsync("5g");
        Assert.Equal(["5g", "12.5", "3", "0.1", "1.5", "11", "0"], await page.ValuesAsync(link));
        Assert.Equal("12.5 ms", await page.Page.Locator("label:has(input[name=delay]) output").InnerTextAsync());
        Assert.EndsWith("?scene=room&panes=healing,healing&link=5g", page.Page.Url, StringComparison.Ordinal);
        await page.Page.Locator("input[name=loss]").FocusAsync();
        await page.Page.Keyboard.PressAsync("End");
        Assert.Equal(["custom", "12.5", "3", "50", "1.5", "11", "0"], await page.ValuesAsync(link));
        Assert.False(await page.Page.Locator(".besides").IsVisibleAsync());
        Assert.EndsWith("&delay=12.5&jitter=3&loss=50&burst=1.5&asymmetry=11", page.Page.Url, StringComparison.Ordinal);
        await page.Page.ReloadAsync();
        await page.Page.WaitForSelectorAsync("#panes:not([hidden])");
        Assert.Equal(["custom", "12.5", "3", "50", "1.5", "11", "0"], await page.ValuesAsync(link));
        Assert.Equal("own figures", await page.Page.EvaluateAsync<string>("() => document.querySelector('select[name=link]').selectedOptions[0].text"));

        // Whatever the address may have the sliders show, to their ends and between their steps.
        foreach (string query in new[] { "delay=2000&asymmetry=-995&clock=10000&ahead=1000&lag=500&speed=0.3", "jitter=12.5&loss=50&burst=20&speed=2" })
        {
            await page.Page.GotoAsync($"{served.Address}?{query}");
            await page.Page.WaitForSelectorAsync("#panes:not([hidden])");
            foreach (string part in query.Split('&'))
            {
                Assert.Equal(part, $"{part.Split('=')[0]}={(await page.ValuesAsync(part.Split('=')[0]))[0]}");
            }

            Assert.False(await page.Page.Locator("#problem").IsVisibleAsync());
        }
    }

    [Theory]
    [InlineData(ColorScheme.Light, "room")]
    [InlineData(ColorScheme.Dark, "room")]
    [InlineData(ColorScheme.Light, "air-hockey")]
    [InlineData(ColorScheme.Dark, "air-hockey")]
    public async Task Text_InBothThemes_HasEnoughContrast(ColorScheme theme, string scene)
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(
            served, $"step=lift&scene={scene}&panes=healing,none", new() { ViewportSize = new() { Width = 1200, Height = 900 }, ColorScheme = theme, ReducedMotion = ReducedMotion.Reduce });
        await page.Page.WaitForSelectorAsync("[data-state=done]", new() { Timeout = 60_000 });
        Assert.Empty(await Pale(page));
        await page.Page.EvaluateAsync(
            "() => { document.querySelector('h1').style.color = getComputedStyle(document.documentElement).backgroundColor }");
        Assert.Equal(["H1 LagSim"], await Pale(page)); // the control
    }

    /// <summary>Whatever its width the page fits, with all that it may have to say, and figures side by side are at one height.</summary>
    [Fact]
    public async Task Page_OfAnyWidth_FitsAndHasItsFiguresInRows()
    {
        const string Complaints =
            """
            () => {
              const all = document.documentElement.scrollWidth > innerWidth ? [`the page is ${document.documentElement.scrollWidth} wide`] : []
              for (const list of document.querySelectorAll('.figures')) {
                const heights = new Set([...list.querySelectorAll('dd')].map(dd => Math.round(dd.getBoundingClientRect().bottom)))
                const rows = 6 / getComputedStyle(list).gridTemplateColumns.split(' ').length
                heights.size !== rows && all.push(`${heights.size} heights in ${rows} rows`)
              }
              for (const says of document.querySelectorAll('.agrees span')) {
                const box = says.getBoundingClientRect(), hash = says.parentElement.querySelector('code').getBoundingClientRect()
                box.left < hash.right && box.top < hash.bottom && all.push('the hash is written over')
              }
              return all
            }
            """;
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "step=loss&scene=break&panes=healing,healing&link=starlink&players=9");
        Assert.True(await page.Page.Locator("#problem").IsVisibleAsync() && await page.Page.Locator(".changed").IsVisibleAsync() && await page.Page.Locator(".besides").IsVisibleAsync());
        await page.AgreeAsync(2); // the hashes are there
        foreach (string scene in new[] { "break", "air-hockey" })
        {
            if (scene != "break")
            {
                await page.Page.Locator("select[name=scene]").SelectOptionAsync(scene); // after that the sentence is gone
            }

            foreach (int width in new[] { 1600, 1280, 1024, 700, 390, 320, 280, 240 })
            {
                await page.Page.SetViewportSizeAsync(width, 900);
                Assert.Equal([], (await page.Page.EvaluateAsync<string[]>(Complaints)).Select(complaint => $"{scene}, {width}: {complaint}"));
            }
        }

        // The control: as it was.
        await page.Page.AddStyleTagAsync(new() { Content = "#controls { grid-template-columns: auto } label { grid-template-columns: 6.5rem 1fr 4rem !important }" });
        Assert.StartsWith("the page is ", (await page.Page.EvaluateAsync<string[]>(Complaints))[0], StringComparison.Ordinal);
        await page.Page.SetViewportSizeAsync(1280, 900);
        await page.Page.AddStyleTagAsync(new() { Content = ".pane .figures { grid-template-columns: repeat(6, auto); align-items: stretch }" });
        Assert.Contains("2 heights in 1 rows", await page.Page.EvaluateAsync<string[]>(Complaints));
    }

    [Fact]
    public async Task Folder_ServedByAnotherServer_PlaysAsWell()
    {
        string folder = System.IO.Path.Combine(ServedPage.Root, "src/LagSim.Play.Browser/bin/page/wwwroot");
        await using OtherServer other = await OtherServer.StartAsync(folder);
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "scene=break&panes=healing,healing&delay=50", address: other.Address);
        await page.ThrowAsync(0, 0, 70, -10); // which rests until then
        await page.Page.WaitForFunctionAsync("() => Number(document.querySelectorAll('dd[data-is=heals]')[1].textContent) > 0");
        await page.AgreeAsync(2);
    }

    /// <summary>The texts that stand out too little from what is behind them: by less than 4.5 to 1, as WCAG 2 measures it.</summary>
    private static async Task<string[]> Pale(OpenedPage page)
    {
        string[] pale = await page.Page.EvaluateAsync<string[]>(
            """
            () => {
              const light = colour => {
                const canvas = new OffscreenCanvas(1, 1).getContext('2d')
                canvas.fillStyle = colour
                canvas.fillRect(0, 0, 1, 1)
                const [r, g, b] = [...canvas.getImageData(0, 0, 1, 1).data].map(v => v / 255).map(v => v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
                return 0.2126 * r + 0.7152 * g + 0.0722 * b
              }
              const back = element => {
                for (let at = element; at; at = at.parentElement) {
                  const colour = getComputedStyle(at).backgroundColor
                  if (colour !== 'rgba(0, 0, 0, 0)') return colour
                }
              }
              return [...document.querySelectorAll('h1, h2, h3, p, label, output, dt, dd, code, button:enabled, select, input, a, small, th, td, figcaption span, .agrees span, .board span, b, .how')].filter(e => e.innerText?.trim()).filter(e => {
                const [a, b] = [light(getComputedStyle(e).color), light(back(e))].sort((x, y) => y - x)
                return (a + 0.05) / (b + 0.05) < 4.5
              }).map(e => `${e.tagName} ${e.innerText.slice(0, 30)}`)
            }
            """);
        return [.. pale.Distinct()];
    }
}
