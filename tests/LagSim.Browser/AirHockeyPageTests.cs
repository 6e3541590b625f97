using System;
using System.Threading.Tasks;
using Microsoft.Playwright;
using Xunit;

namespace LagSim.Browser;

/// <summary>Air hockey in the page: two people on one keyboard, a mouse, a finger; goals that are told, and one score.</summary>
public sealed class AirHockeyPageTests(ServedPage served)
{
    private const string Scene = "scene=air-hockey";

    /// <summary>The scene is chosen in its list, and the keys play at once: nothing is clicked in between.</summary>
    [Fact]
    public async Task Keys_OfTwoPeopleAtOnce_MoveBothMalletsAndNotThePage()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(
            served, "panes=healing,healing&delay=100", new() { ViewportSize = new() { Width = 1300, Height = 420 } });
        await page.Page.Locator("select[name=scene]").SelectOptionAsync("air-hockey");
        await page.Page.Keyboard.PressAsync("p");
        await page.Page.Keyboard.PressAsync("p"); // pauses and goes on, as in every scene
        await page.Page.WaitForFunctionAsync("() => document.querySelector('.board small').textContent !== ''");
        Assert.True(await page.Page.EvaluateAsync<bool>("() => document.documentElement.scrollHeight > innerHeight + 100"), "the page could not scroll");
        (float X, float Y)[] before = [await page.BallAsync(0, 1), await page.BallAsync(1, 2)];
        await page.Page.Keyboard.DownAsync("d");
        await page.Page.Keyboard.DownAsync("ArrowDown");
        await page.Page.WaitForTimeoutAsync(250);
        await page.Page.Keyboard.UpAsync("ArrowDown");
        await page.Page.Keyboard.UpAsync("d");
        (float X, float Y)[] after = [await page.BallAsync(0, 1), await page.BallAsync(1, 2)];
        Assert.True(after[0].X > before[0].X + 20, $"player 1 went from {before[0]} to {after[0]}");
        Assert.Equal(before[0].Y, after[0].Y, 0.5f);
        Assert.True(after[1].Y > before[1].Y + 20, $"player 2 went from {before[1]} to {after[1]}");
        Assert.Equal(before[1].X, after[1].X, 0.5f);
        await page.Page.WaitForTimeoutAsync(300);
        (float X, float Y) still = await page.BallAsync(0, 1);
        await page.Page.WaitForTimeoutAsync(300);
        Assert.Equal(still, await page.BallAsync(0, 1));
        Assert.Equal(0, await page.Page.EvaluateAsync<double>("() => scrollY"));
        await page.AgreeAsync(2);
    }

    /// <summary>As long as a key is down a mallet is at every frame where a constant speed has it, in the time of the worlds.</summary>
    [Theory]
    [InlineData("a", 0, 1)]
    [InlineData("ArrowUp", 1, 2)]
    public async Task Key_HeldDown_MovesTheMalletAtOneSpeed(string key, int pane, int ball)
    {
        // So slow that a frame of a tenth of a second, the longest that counts, is two pixels: there are frames enough on any machine before
        // the mallet slows down at the edge.
        await using OpenedPage page = await OpenedPage.OpenAsync(served, $"{Scene}&panes=healing,healing&delay=150&speed=0.05");
        await page.Page.WaitForFunctionAsync("() => document.querySelector('.board small').textContent !== ''");
        Task<double[]> look = page.Page.EvaluateAsync<double[]>(
            """
            ([pane, ball]) => new Promise(done => {
              const place = () => { const { x, y } = window.lagsim.placeOnScreen(pane, ball); return x + y }
              const start = place(), begun = window.lagsim.seconds(), seen = []
              const look = () => {
                const time = window.lagsim.seconds(), way = place() - start
                Math.abs(way) > 3 && seen.push({ time, way }) // it moves
                if (Math.abs(way) < 18 && time < begun + 1) return requestAnimationFrame(look)
                const first = seen[0], last = seen.at(-1), speed = seen.length < 2 ? 0 : (last.way - first.way) / (last.time - first.time)
                done([speed, ...seen.map(one => one.way - first.way - speed * (one.time - first.time))])
              }
              requestAnimationFrame(look)
            })
            """, new[] { pane, ball });
        await page.Page.Keyboard.DownAsync(key);
        double[] off = await look;
        await page.Page.Keyboard.UpAsync(key);
        Assert.True(Math.Abs(off[0]) > 120, $"it goes at {off[0]} pixels a second");
        Assert.True(off.Length > 6, $"{off.Length - 1} frames");
        Assert.All(off[1..], pixels => Assert.InRange(pixels, -0.5, 0.5));
    }

    /// <summary>Who goes through the controls by Tab has the arrows there; who clicked on one plays on.</summary>
    [Fact]
    public async Task Arrows_InAControlThatWasReachedByTab_TurnIt()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, $"{Scene}&panes=healing,healing&delay=100");
        ILocator delay = page.Page.Locator("input[name=delay]");
        await delay.ClickAsync();
        string clicked = await delay.InputValueAsync();
        (float X, float Y) before = await page.BallAsync(1, 2);
        await page.Page.Keyboard.DownAsync("ArrowUp");
        await page.Page.WaitForTimeoutAsync(200);
        await page.Page.Keyboard.UpAsync("ArrowUp");
        Assert.Equal(clicked, await delay.InputValueAsync());
        Assert.True((await page.BallAsync(1, 2)).Y < before.Y - 10);
        await page.Page.Keyboard.PressAsync("Tab"); // the next one
        string jitter = await page.Page.Locator("input[name=jitter]").InputValueAsync();
        before = await page.BallAsync(1, 2);
        await page.Page.Keyboard.PressAsync("ArrowRight");
        Assert.NotEqual(jitter, await page.Page.Locator("input[name=jitter]").InputValueAsync());
        Assert.Equal(before, await page.BallAsync(1, 2));
    }

    [Fact]
    public async Task Mallet_DraggedWithTheMouse_IsWhereTheMouseIsWhileItIsDown()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, $"{Scene}&panes=healing,full-rollback&delay=200");
        (float x, float y) = await page.BallAsync(1, 2);
        await page.Page.Mouse.MoveAsync(x, y);
        await page.Page.Mouse.DownAsync();
        await page.Page.Mouse.MoveAsync(x - 60, y + 30, new() { Steps = 10 });
        await page.Page.WaitForTimeoutAsync(700);
        (float X, float Y) there = await page.BallAsync(1, 2);
        Assert.Equal(x - 60, there.X, 2f);
        Assert.Equal(y + 30, there.Y, 2f);
        await page.Page.Mouse.UpAsync();
        await page.Page.Mouse.MoveAsync(x, y);
        await page.Page.WaitForTimeoutAsync(300);
        Assert.Equal(there, await page.BallAsync(1, 2));
        await page.AgreeAsync(2);
    }

    [Fact]
    public async Task Mallet_MovedWithAFingerOnAPhone_ComesToAll()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(
            served, $"{Scene}&panes=healing,healing&delay=100",
            new() { ViewportSize = new() { Width = 390, Height = 844 }, HasTouch = true, IsMobile = true, DeviceScaleFactor = 2 });
        Assert.True(await page.Page.EvaluateAsync<bool>("() => document.documentElement.scrollWidth <= innerWidth"), "the page is wider than the phone");
        (float x, float y) = await page.BallAsync(0, 1);
        (float otherX, float otherY) = await page.BallAsync(1, 1);
        ICDPSession devices = await page.Page.Context.NewCDPSessionAsync(page.Page);
        for (int n = 0; n <= 10; n++)
        {
            object[] points = n == 10 ? [] : [new { x = x + (3 * n), y = y - (3 * n) }];
            await devices.SendAsync(
                "Input.dispatchTouchEvent", new() { ["type"] = n == 0 ? "touchStart" : n == 10 ? "touchEnd" : "touchMove", ["touchPoints"] = points });
            await page.Page.WaitForTimeoutAsync(n == 9 ? 400 : 25);
        }

        Assert.Equal((x + 27, y - 27), await page.BallAsync(0, 1), Close);
        await page.Page.WaitForTimeoutAsync(600);
        Assert.Equal((otherX + 27, otherY - 27), await page.BallAsync(1, 1), Close);
        await page.AgreeAsync(2);

        static bool Close((float X, float Y) a, (float X, float Y) b) => Math.Abs(a.X - b.X) < 2 && Math.Abs(a.Y - b.Y) < 2;
    }

    /// <summary>Bots play until one has scored; then a person takes over by a key.</summary>
    [Fact]
    public async Task Goal_OverALink_IsToldProvisionallyThenForCertainAndBothHaveItsScore()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, $"{Scene}&panes=healing,healing&delay=150&speed=2&seed=3");
        ILocator bots = page.Page.Locator("button.bot");
        await bots.First.ClickAsync();
        await bots.Last.ClickAsync();
        await page.Page.EvaluateAsync(
            """
            () => {
              window.said = [[], []]
              const look = () => {
                document.querySelectorAll('.told').forEach((told, n) => {
                  const text = told.dataset.known + ': ' + told.textContent
                  window.said[n].at(-1) !== text && window.said[n].push(text)
                })
                document.querySelector('.again:not([hidden])')?.click() // a match in which nobody has scored
                requestAnimationFrame(look)
              }
              look()
            }
            """);
        await page.Page.WaitForFunctionAsync(
            "() => window.said.every(said => said.some(text => text.startsWith('certain: Goal for player ')))", null, new() { Timeout = 90_000 });
        string[][] said = await page.Page.EvaluateAsync<string[][]>("() => window.said");
        Assert.All(said, one =>
        {
            int certain = Array.FindIndex(one, text => text.StartsWith("certain: Goal", StringComparison.Ordinal));
            int provisional = Array.IndexOf(one, one[certain].Replace("certain", "provisional", StringComparison.Ordinal));
            Assert.True(provisional >= 0 && provisional < certain, string.Join('\n', one));
        });
        await page.Page.Keyboard.PressAsync("w", new() { Delay = 100 });
        await page.Page.Keyboard.PressAsync("ArrowUp", new() { Delay = 100 });
        Assert.Equal("Let a bot play", await bots.First.InnerTextAsync());
        Assert.Equal("Let a bot play", await bots.Last.InnerTextAsync());
        await page.Page.WaitForFunctionAsync(
            """
            () => {
              const [a, b] = [...document.querySelectorAll('.board b')].map(one => one.textContent)
              return a === b && a !== '0 : 0' && /^[0-9] : [0-9]$/.test(a)
            }
            """);
        await page.AgreeAsync(2);
    }

    /// <summary>The control: with a strategy that promises nothing the pane has another match, and the page says so.</summary>
    [Fact]
    public async Task Match_WithAStrategyThatPromisesNothing_Differs()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, $"{Scene}&panes=healing,none&delay=300&speed=2");
        await page.Page.Locator("button.bot").First.ClickAsync();
        await page.Page.Locator("button.bot").Last.ClickAsync();
        await page.Page.WaitForFunctionAsync(
            """
            () => {
              const [host, other] = [...document.querySelectorAll('.agrees')]
              return host.textContent.includes('agrees') && other.textContent.includes('differs') && parseFloat(other.textContent.match(/at ([0-9.]+) s/)[1]) > 8
            }
            """, null, new() { Timeout = 60_000 });
    }
}
