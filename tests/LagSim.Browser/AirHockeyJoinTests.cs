using System;
using System.Linq;
using System.Threading.Tasks;
using Microsoft.Playwright;
using Xunit;

namespace LagSim.Browser;

/// <summary>Air hockey with a host that nobody plays at: on two phones, and by two people at one keyboard.</summary>
[Trait("Time", "real")]
public sealed class AirHockeyJoinTests(ServedPage served)
{
    private static readonly BrowserNewContextOptions Phone = new()
    {
        ViewportSize = new() { Width = 390, Height = 844 }, HasTouch = true, IsMobile = true, DeviceScaleFactor = 2,
    };

    /// <summary>Whether, left and right on the canvas, there are dots of the colour of either side: posts and mallets.</summary>
    private const string Drawn =
        """
        sides => {
          const canvas = document.querySelector('.pane canvas'), { width, height } = canvas
          const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true })
          context.drawImage(canvas, 0, 0)
          return sides.every((side, n) => {
            const wanted = [1, 3, 5].map(at => parseInt(side.slice(at, at + 2), 16)), dots = context.getImageData(n * (width >> 1), 0, width >> 1, height).data
            let found = 0
            for (let at = 0; at < dots.length; at += 4) {
              found += wanted.every((value, part) => Math.abs(dots[at + part] - value) < 3) ? 1 : 0
            }
            return found > 100
          })
        }
        """;

    [Fact]
    public async Task Match_OnTwoPhones_HasOneScoreAndOneWorld()
    {
        await using ToolProcess host = new("host", "--scene", "air-hockey", "--per-address", "8", "--web", "0", "--seed", "5");
        string address = await host.AfterAsync("browsers join at ");
        await using IBrowserContext one = await served.Browser.NewContextAsync(Phone), other = await served.Browser.NewContextAsync(Phone);
        JoinedPage[] phones = [await JoinedPage.OpenAsync(one, address), await JoinedPage.OpenAsync(other, address)];
        await phones[0].AskAsync("Ann");
        await phones[0].Page.GetByText("waiting for the others").WaitForAsync(); // so that the left side is hers
        await phones[1].AskAsync("Bob");
        await phones[0].RunningAsync();
        await phones[1].RunningAsync();
        Assert.True(await phones[0].Page.EvaluateAsync<bool>("() => document.documentElement.scrollWidth <= innerWidth"), "the page is wider than the phone");

        (double x, double y) before = await MalletAsync(phones[0].Page, 0, 0);
        (double x, double y) after = before;
        await DragAsync(phones[0].Page, async () =>
        {
            after = await MalletAsync(phones[0].Page, 0, 0);
            return Math.Abs(after.x - before.x) + Math.Abs(after.y - before.y) > 0.1;
        });
        Assert.True(Math.Abs(after.x - before.x) + Math.Abs(after.y - before.y) > 0.1, $"The mallet was at {before}, and is at {after}.");
        await phones[0].Page.WaitForTimeoutAsync(300);
        after = await MalletAsync(phones[0].Page, 0, 0);
        await phones[1].Page.WaitForFunctionAsync(
            "([x, y]) => { const f = lagsim.peers[0].frame; return Math.hypot(f[16] - x, f[17] - y) < 0.01 }", new[] { after.x, after.y }, new() { Timeout = 10_000 });

        foreach (JoinedPage phone in phones)
        {
            await phone.Page.Locator(".bot").ClickAsync();
        }

        await phones[0].Page.WaitForFunctionAsync("() => /[1-9]/.test(document.querySelector('.board b').textContent)", null, new() { Timeout = 90_000 });
        await phones[0].Page.Locator(".told[data-known=certain]").Filter(new() { HasText = "Goal" }).WaitForAsync(new() { Timeout = 20_000 });
        await phones[0].Page.WaitForTimeoutAsync(1500);
        for (int n = 0; n < 2; n++)
        {
            JoinedPage.AssertSame(host.States, await phones[n].StatesAsync(), 4);
            Assert.Equal(0, await phones[n].NumberAsync("differed"));
            Assert.Matches("[1-9]", await phones[n].Page.Locator(".board b").InnerTextAsync());
            Assert.Empty(phones[n].Complaints);
        }
    }

    [Fact]
    public async Task Match_OfTwoPeopleAtOneKeyboard_IsThatOfTwoPeers()
    {
        await using ToolProcess host = new("host", "--scene", "air-hockey", "--per-address", "8", "--web", "0");
        await using IBrowserContext context = await served.Browser.NewContextAsync(JoinedPage.Screen);
        string address = await host.AfterAsync("browsers join at ");
        JoinedPage tab = await JoinedPage.OpenAsync(context, address);
        await tab.AskAsync("Ann");
        await tab.Page.GetByText("waiting for the others").WaitForAsync();
        string waiting = await tab.Page.InnerTextAsync("#waiting");
        Assert.All(new[] { "One more player is needed.", "another tab or browser on this computer", address, "at this keyboard" }, part => Assert.Contains(part, waiting, StringComparison.Ordinal));
        Assert.StartsWith("air hockey", waiting, StringComparison.OrdinalIgnoreCase);
        await tab.Page.GetByRole(AriaRole.Button, new() { Name = "A second player at this keyboard" }).ClickAsync();
        await tab.Page.WaitForFunctionAsync("() => document.querySelectorAll('.pane').length === 2 && lagsim.peers[1].status?.state === 'Running'", null, new() { Timeout = 30_000 });
        Assert.False(await tab.Page.Locator("#waiting").IsVisibleAsync(), "Nobody is waited for any more.");
        (double x, double y) left = await MalletAsync(tab.Page, 1, 0), right = await MalletAsync(tab.Page, 0, 1);
        await tab.Page.Keyboard.DownAsync("w");
        await tab.Page.Keyboard.DownAsync("ArrowDown");
        await MovedAsync(tab.Page, peer: 1, mallet: 0, $"y > {left.y:R} + 0.1"); // W moves the first player up, as the second sees it
        await MovedAsync(tab.Page, peer: 0, mallet: 1, $"y < {right.y:R} - 0.1"); // the arrow moves the second player down, as the first sees it
        await tab.Page.Keyboard.UpAsync("w");
        await tab.Page.Keyboard.UpAsync("ArrowDown");

        await tab.Page.WaitForFunctionAsync("() => lagsim.peers.every(peer => peer.status?.agreed >= 3)", null, new() { Timeout = 20_000 });
        JoinedPage.AssertSame(host.States, ToolProcess.StatesOf(await tab.Page.EvaluateAsync<string[]>("() => lagsim.peers[1].commits")), 3);
        JoinedPage.AssertSame(host.States, await tab.StatesAsync(), 3);

        await using IBrowserContext another = await served.Browser.NewContextAsync(JoinedPage.Screen);
        JoinedPage third = await JoinedPage.JoinAsync(another, address, "Cas");
        Assert.False(await third.Page.Locator("#second").IsVisibleAsync(), "There is a second place for who has not even one.");
        await third.Page.GetByText("looking on: both mallets are taken").WaitForAsync();
        await SeesTheMatchAsync(third.Page, "You look on");
        Assert.Equal("Ann, Ann-2", await SidesAsync(third.Page));
        Assert.Equal(["Ann", "Ann-2"], (await tab.Page.Locator(".pane h2").AllInnerTextsAsync()).Select(title => title.Trim()));
        Assert.Empty(third.Complaints);

        await tab.Page.Keyboard.DownAsync("w");
        await host.EndInOrderAsync();
        await tab.Page.GetByRole(AriaRole.Button, new() { Name = "Join again" }).WaitForAsync(); // whatever keys are down
        Assert.Empty(tab.Complaints);
    }

    /// <summary>Where the second of two at one keyboard is not let in, that is told, and the first plays on.</summary>
    [Fact]
    public async Task SecondPlayer_WhoIsRefused_IsToldSoAndTheFirstStays()
    {
        await using ToolProcess host = new("host", "--scene", "air-hockey", "--per-address", "1", "--web", "0");
        await using IBrowserContext context = await served.Browser.NewContextAsync(JoinedPage.Screen);
        JoinedPage tab = await JoinedPage.OpenAsync(context, await host.AfterAsync("browsers join at "));
        await tab.AskAsync("Ann");
        ILocator second = tab.Page.GetByRole(AriaRole.Button, new() { Name = "A second player at this keyboard" });
        await second.ClickAsync();
        await tab.Page.GetByText("A player at this keyboard is not in the session any more: ").WaitForAsync();
        await second.WaitForAsync(); // it may be tried again
        Assert.Equal(1, await tab.Page.EvaluateAsync<int>("() => lagsim.held"));
        await tab.Page.GetByText("waiting for the others").WaitForAsync();
    }

    /// <summary>Who looks on sees the table of the players, with the same score, and has nothing to play with.</summary>
    [Fact]
    public async Task Onlooker_OnAPhone_SeesTheTableAndTheNamesAndCannotPlay()
    {
        await using ToolProcess host = new("host", "--scene", "air-hockey", "--per-address", "8", "--web", "0", "--seed", "5", "--timeout-s", "6");
        string address = await host.AfterAsync("browsers join at ");
        await using IBrowserContext one = await served.Browser.NewContextAsync(JoinedPage.Screen), other = await served.Browser.NewContextAsync(Phone);
        await using IBrowserContext third = await served.Browser.NewContextAsync(Phone);
        JoinedPage[] players = [await JoinedPage.OpenAsync(one, address), await JoinedPage.OpenAsync(other, address)];
        await players[0].AskAsync("Ann");
        await players[0].Page.GetByText("waiting for the others").WaitForAsync(); // so that the left side is hers
        await players[1].AskAsync("<b>WWWWWWWWWWWWWWWWW</b>"); // as wide as names are, and not a part of the page
        await players[0].RunningAsync();
        await players[1].RunningAsync();
        JoinedPage onlooker = await JoinedPage.JoinAsync(third, address, "Cas");
        await players[0].Page.WaitForFunctionAsync("() => lagsim.status.here.length === 4");
        Assert.False(await players[0].Page.Locator("#second").IsVisibleAsync(), "A second place is offered, and both mallets are taken.");
        await onlooker.Page.GetByText("looking on: both mallets are taken").WaitForAsync();
        await SeesTheMatchAsync(onlooker.Page, "You look on");
        await SeesTheMatchAsync(players[0].Page, "Ann"); // the control: a player has the same, and a hand
        Assert.Equal((0, 1), (await onlooker.Page.Locator(".hand").CountAsync(), await players[0].Page.Locator(".hand").CountAsync()));
        foreach ((JoinedPage phone, bool plays) in new[] { (players[1], true), (onlooker, false) })
        {
            Assert.Equal(plays, await phone.Page.GetByText("Your mallet follows your finger").IsVisibleAsync());
        }

        foreach (IPage page in new[] { players[0].Page, players[1].Page, onlooker.Page })
        {
            Assert.Equal("Ann, <b>WWWWWWWWWWWWWWWWW</b>", await SidesAsync(page));
            Assert.True(await page.EvaluateAsync<bool>(
                "() => document.documentElement.scrollWidth <= innerWidth && [...document.querySelectorAll('.board *')].every(part => part.scrollWidth <= part.clientWidth + 1 || part.clientWidth === 0)"),
                "A name does not fit.");
        }

        await DragAsync(onlooker.Page);
        await onlooker.Page.Keyboard.PressAsync("d");
        foreach (JoinedPage player in players)
        {
            await player.Page.Locator(".bot").ClickAsync();
        }

        await onlooker.Page.WaitForFunctionAsync("() => /[1-9]/.test(document.querySelector('.board b').textContent)", null, new() { Timeout = 90_000 });
        await onlooker.Page.Locator(".told[data-known=certain]").Filter(new() { HasText = "Goal for" }).WaitForAsync(new() { Timeout = 20_000 });
        string told = await onlooker.Page.Locator(".told").InnerTextAsync();
        Assert.Matches("Goal for (Ann|<b>W+</b>)", told);
        JoinedPage.AssertSame(host.States, await onlooker.StatesAsync(), 3);
        Assert.Equal(["", ""], await onlooker.Page.Locator(".side em").AllTextContentsAsync()); // the control: both are there
        await players[1].Page.CloseAsync();
        foreach (string presence in new[] { "not answering", "away" })
        {
            foreach (IPage page in new[] { onlooker.Page, players[0].Page })
            {
                await page.Locator(".side.second em").Filter(new() { HasText = presence }).WaitForAsync(new() { Timeout = 20_000 });
                Assert.Equal("Ann, <b>WWWWWWWWWWWWWWWWW</b>", string.Join(", ", await page.Locator(".board bdi").AllInnerTextsAsync())); // whose place it is
            }
        }

        Assert.Equal("", await onlooker.Page.Locator(".side.first em").TextContentAsync());
        await onlooker.Page.GetByText("A mallet may be free").WaitForAsync();
        Assert.Empty(onlooker.Complaints);
    }

    /// <summary>Nobody without keys is told of keys; who has them is, which is the control.</summary>
    [Fact]
    public async Task Keys_OnAPhone_AreNotSpokenOf()
    {
        foreach (BrowserNewContextOptions device in new[] { Phone, JoinedPage.Screen })
        {
            await using ToolProcess host = new("host", "--scene", "air-hockey", "--per-address", "8", "--web", "0");
            string address = await host.AfterAsync("browsers join at ");
            await using IBrowserContext first = await served.Browser.NewContextAsync(device), second = await served.Browser.NewContextAsync(device);
            JoinedPage page = await JoinedPage.OpenAsync(first, address), rival = await JoinedPage.OpenAsync(second, address);
            await page.AskAsync("Ann");
            await page.Page.GetByText("waiting for the others").WaitForAsync();
            string text = await page.Page.InnerTextAsync("body");
            Assert.Equal(device == Phone, !text.Contains("at this keyboard", StringComparison.Ordinal));
            await rival.AskAsync("Bob");
            await page.RunningAsync();
            await page.Page.Locator(".hand").WaitForAsync();
            text = await page.Page.InnerTextAsync("body");
            Assert.Equal(device == Phone, !text.Contains("arrow keys", StringComparison.Ordinal));
            Assert.Equal(device == Phone, text.Contains("follows your finger", StringComparison.Ordinal));
        }
    }

    /// <summary>Waits until a page shows the table: with goals and mallets, the score, and over it whose it is.</summary>
    private static async Task SeesTheMatchAsync(IPage page, string title)
    {
        await page.WaitForFunctionAsync("title => document.querySelector('.pane h2').textContent.trim() === title", title, new() { Timeout = 10_000 });
        Assert.Matches(@"^\d : \d$", await page.Locator(".board b").InnerTextAsync());
        Assert.Equal("air-hockey", await page.EvaluateAsync<string>("() => document.documentElement.dataset.scene"));
        string[] sides = await page.EvaluateAsync<string[]>("() => ['first', 'second'].map(name => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim())");
        Assert.All(sides, side => Assert.NotEmpty(side));
        await page.WaitForFunctionAsync(Drawn, sides, new() { Timeout = 10_000 });
    }

    /// <summary>The names at the score.</summary>
    private static async Task<string> SidesAsync(IPage page)
    {
        await page.WaitForFunctionAsync("() => [...document.querySelectorAll('.board bdi')].every(side => !side.textContent.startsWith('Player '))", null, new() { Timeout = 10_000 });
        return string.Join(", ", await page.Locator(".board bdi").AllInnerTextsAsync());
    }

    /// <summary>Waits until a peer of a page draws a mallet where a condition on x and y, in metres, is met.</summary>
    private static Task MovedAsync(IPage page, int peer, int mallet, FormattableString condition) => page.WaitForFunctionAsync(
        $"([peer, mallet]) => {{ const at = 8 + 7 * (1 + mallet), [x, y] = lagsim.peers[peer].frame.slice(at + 1, at + 3); return {FormattableString.Invariant(condition)} }}",
        new[] { peer, mallet }, new() { Timeout = 20_000 });

    /// <summary>Where a peer of a page draws a mallet, in metres.</summary>
    private static async Task<(double X, double Y)> MalletAsync(IPage page, int peer, int mallet)
    {
        double[] at = await page.EvaluateAsync<double[]>(
            "([peer, mallet]) => { const at = 8 + 7 * (1 + mallet); return [...lagsim.peers[peer].frame.slice(at + 1, at + 3)] }", new[] { peer, mallet });
        return (at[0], at[1]);
    }

    /// <summary>
    /// A finger lies on the table, on the side of the first player, until something has come of it, or for long enough that something could: a
    /// hand whose first grab the host has refused takes the mallet again a second later, from where it is, on a busy machine perhaps again.
    /// </summary>
    private static async Task DragAsync(IPage page, Func<Task<bool>>? until = null)
    {
        int steps = until is null ? 70 : 800; // of 25 ms
        await page.Locator("#waiting").WaitForAsync(new() { State = WaitForSelectorState.Hidden }); // the table moves up into its place
        LocatorBoundingBoxResult box = (await page.Locator(".pane canvas").First.BoundingBoxAsync())!;
        ICDPSession devices = await page.Context.NewCDPSessionAsync(page);
        Task TouchAsync(string type, params object[] points) => devices.SendAsync("Input.dispatchTouchEvent", new() { ["type"] = type, ["touchPoints"] = points });
        object Finger(int n) => new { x = box.X + (0.2 * box.Width) + (n % 2), y = box.Y + (0.3 * box.Height) }; // a finger that lies still trembles
        await TouchAsync("touchStart", Finger(0));
        for (int n = 1; n < steps && !(until is not null && await until()); n++)
        {
            await page.WaitForTimeoutAsync(25);
            await TouchAsync("touchMove", Finger(n));
        }

        await TouchAsync("touchEnd");
    }
}
