using System;
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

    [Fact]
    public async Task Match_OnTwoPhones_HasOneScoreAndOneWorld()
    {
        await using ToolProcess host = new("host", "--scene", "air-hockey", "--per-address", "8", "--web", "0", "--seed", "5");
        string address = await host.AfterAsync("browsers join at ");
        await using IBrowserContext one = await served.Browser.NewContextAsync(Phone), other = await served.Browser.NewContextAsync(Phone);
        JoinedPage[] phones = [await JoinedPage.OpenAsync(one, address), await JoinedPage.OpenAsync(other, address)];
        await phones[0].AskAsync("Ann");
        await phones[1].AskAsync("Bob");
        await phones[0].RunningAsync();
        await phones[1].RunningAsync();
        Assert.True(await phones[0].Page.EvaluateAsync<bool>("() => document.documentElement.scrollWidth <= innerWidth"), "the page is wider than the phone");

        (double x, double y) before = await MalletAsync(phones[0].Page, 0, 0);
        await DragAsync(phones[0].Page);
        (double x, double y) after = await MalletAsync(phones[0].Page, 0, 0);
        Assert.True(Math.Abs(after.x - before.x) + Math.Abs(after.y - before.y) > 0.1, $"The mallet was at {before}, and is at {after}.");
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
        JoinedPage tab = await JoinedPage.OpenAsync(context, await host.AfterAsync("browsers join at "));
        await tab.AskAsync("Ann");
        await tab.Page.GetByText("waiting for the others").WaitForAsync();
        await tab.Page.GetByRole(AriaRole.Button, new() { Name = "A second player at this keyboard" }).ClickAsync();
        await tab.Page.WaitForFunctionAsync("() => document.querySelectorAll('.pane').length === 2 && lagsim.peers[1].status.state === 'Running'", null, new() { Timeout = 30_000 });
        (double x, double y) left = await MalletAsync(tab.Page, 1, 0), right = await MalletAsync(tab.Page, 0, 1);
        await tab.Page.Keyboard.DownAsync("w");
        await tab.Page.Keyboard.DownAsync("ArrowDown");
        await tab.Page.WaitForTimeoutAsync(300);
        await tab.Page.Keyboard.UpAsync("w");
        await tab.Page.Keyboard.UpAsync("ArrowDown");
        await tab.Page.WaitForTimeoutAsync(500);
        Assert.True((await MalletAsync(tab.Page, 1, 0)).Y > left.y + 0.1, "W did not move the first player up, as the second sees it.");
        Assert.True((await MalletAsync(tab.Page, 0, 1)).Y < right.y - 0.1, "The arrow did not move the second player down, as the first sees it.");

        await tab.Page.WaitForFunctionAsync("() => lagsim.peers.every(peer => peer.status.agreed >= 3)", null, new() { Timeout = 20_000 });
        JoinedPage.AssertSame(host.States, ToolProcess.StatesOf(await tab.Page.EvaluateAsync<string[]>("() => lagsim.peers[1].commits")), 3);
        JoinedPage.AssertSame(host.States, await tab.StatesAsync(), 3);

        await using IBrowserContext another = await served.Browser.NewContextAsync(JoinedPage.Screen);
        JoinedPage third = await JoinedPage.JoinAsync(another, await host.AfterAsync("browsers join at "), "Cas");
        Assert.False(await third.Page.Locator("#second").IsVisibleAsync(), "There is a second place for who has not even one.");
        await third.Page.GetByText("looking on: both mallets are taken").WaitForAsync();
        Assert.Empty(tab.Complaints);
        Assert.Empty(third.Complaints);
    }

    /// <summary>Where a peer of a page draws a mallet, in metres.</summary>
    private static async Task<(double X, double Y)> MalletAsync(IPage page, int peer, int mallet)
    {
        double[] at = await page.EvaluateAsync<double[]>(
            "([peer, mallet]) => { const at = 8 + 7 * (1 + mallet); return [...lagsim.peers[peer].frame.slice(at + 1, at + 3)] }", new[] { peer, mallet });
        return (at[0], at[1]);
    }

    /// <summary>A finger goes over the table, to the side of the first player.</summary>
    private static async Task DragAsync(IPage page)
    {
        LocatorBoundingBoxResult box = (await page.Locator(".pane canvas").First.BoundingBoxAsync())!;
        ICDPSession devices = await page.Context.NewCDPSessionAsync(page);
        for (int n = 0; n <= 30; n++)
        {
            object[] points = n == 30 ? [] : [new { x = box.X + (0.2 * box.Width), y = box.Y + (0.3 * box.Height) }];
            await devices.SendAsync(
                "Input.dispatchTouchEvent", new() { ["type"] = n == 0 ? "touchStart" : n == 30 ? "touchEnd" : "touchMove", ["touchPoints"] = points });
            await page.WaitForTimeoutAsync(25);
        }

        await page.WaitForTimeoutAsync(300);
    }
}
