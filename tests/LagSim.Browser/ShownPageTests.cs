using System;
using System.Linq;
using System.Threading.Tasks;
using Microsoft.Playwright;
using Xunit;

namespace LagSim.Browser;

/// <summary>What the panes show, and that it is there without colour, motion or sight.</summary>
public sealed class ShownPageTests(ServedPage served)
{
    /// <summary>With reduced motion a ring is steady as long as it is there; else it fades, which is the control.</summary>
    [Theory]
    [InlineData(ReducedMotion.Reduce)]
    [InlineData(ReducedMotion.NoPreference)]
    public async Task Rings_WithReducedMotion_DoNotFade(ReducedMotion motion)
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(
            served, "panes=healing,healing&delay=250", new() { ViewportSize = new() { Width = 1300, Height = 900 }, ReducedMotion = motion });
        await Strokes.SpyAsync(page);
        await page.ThrowAsync(0, 5, 40, -60);
        await page.Page.WaitForFunctionAsync("() => Number(document.querySelectorAll('dd[data-is=heals]')[1].textContent) > 0");
        await page.Page.WaitForTimeoutAsync(500);
        string glow = await Strokes.ColourAsync(page, "glow");
        double[] alphas = [.. (await Strokes.TakeAsync(page)).Where(s => s.Colour == glow && !s.IsDashed).Select(s => s.Alpha)];
        Assert.True(alphas.Length > 5, $"{alphas.Length} rings");
        Assert.Equal(motion == ReducedMotion.Reduce, alphas.All(alpha => alpha == 1));
    }

    [Theory]
    [InlineData(ColorScheme.Light)]
    [InlineData(ColorScheme.Dark)]
    public async Task Hashes_OfAPaneAndOfTheTruth_SayInWordsAndColourWhetherTheyAgree(ColorScheme theme)
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(
            served, "scene=break&panes=healing,none&delay=300", new() { ViewportSize = new() { Width = 1300, Height = 900 }, ColorScheme = theme });
        await page.AgreeAsync(2);
        await AssertLine(0, "agrees", "good");
        await AssertLine(1, "agrees", "good");
        await page.ThrowAsync(0, 0, 70, -10);
        await page.Page.WaitForFunctionAsync("() => document.querySelectorAll('.agrees span')[1].textContent.startsWith('differs')");
        await page.Page.WaitForTimeoutAsync(1000);
        await page.Page.Keyboard.PressAsync("p"); // both lines are read of one instant
        await AssertLine(0, "agrees", "good");
        await AssertLine(1, "differs", "bad");

        async Task AssertLine(int pane, string word, string colour)
        {
            ILocator line = page.Page.Locator(".agrees").Nth(pane);
            string[] codes = [.. await line.Locator("code").AllInnerTextsAsync()];
            Assert.Equal(2, codes.Length);
            Assert.All(codes, code => Assert.Matches("^[0-9a-f]{16}$", code));
            Assert.Equal(word == "agrees", codes[0] == codes[1]);
            Assert.StartsWith(word, await line.Locator("span").InnerTextAsync(), StringComparison.Ordinal);
            Assert.True(await line.EvaluateAsync<bool>(
                """
                (line, name) => {
                  const probe = document.createElement('i')
                  probe.style.color = `var(--${name})`
                  line.append(probe)
                  const same = getComputedStyle(probe).color === getComputedStyle(line).color
                  probe.remove()
                  return same
                }
                """, colour));
        }
    }

    [Fact]
    public async Task Figures_AfterAThrow_SayWhatItCostEachPeer()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "panes=healing,healing,full-rollback&delay=200");
        await page.Page.WaitForTimeoutAsync(1500);
        await page.ThrowAsync(0, 5, 50, -80);
        await page.Page.WaitForFunctionAsync("() => [...document.querySelectorAll('dd[data-is=heals]')].slice(1).every(heals => Number(heals.textContent) > 0)");
        await page.Page.WaitForTimeoutAsync(300);
        double sent = await page.FigureAsync(0, "bytes"), received = await page.FigureAsync(1, "received");
        await page.AgreeAsync(3);
        double healed = await page.FigureAsync(1, "bodies"), rolled = await page.FigureAsync(2, "bodies");
        Assert.True(healed > 0 && healed < rolled, $"{healed} bodies rewound by healing, {rolled} by full rollback");
        Assert.True(await page.FigureAsync(1, "events") > 0);
        Assert.True(sent > 0.2, $"{sent} kB/s sent");
        Assert.True(received > 0.2, $"{received} kB/s received");
    }

    /// <summary>The summary says how every player is, and nobody is talked over.</summary>
    [Fact]
    public async Task Summary_WhileMuchHappens_IsSaidAtMostOnceInTwoSeconds()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "scene=break&panes=healing,none&delay=300");
        ILocator summary = page.Page.Locator("#summary");
        Assert.Equal(("status", "polite"), (await summary.GetAttributeAsync("role"), await summary.GetAttributeAsync("aria-live")));
        await page.Page.EvaluateAsync(
            """
            () => {
              window.said = []
              new MutationObserver(() => window.said.push(performance.now())).observe(document.getElementById('summary'), { childList: true, characterData: true, subtree: true })
            }
            """);
        await page.ThrowAsync(0, 0, 70, -10);
        await page.Page.WaitForTimeoutAsync(9000);
        double[] said = await page.Page.EvaluateAsync<double[]>("() => window.said");
        Assert.True(said.Length >= 3, $"{said.Length} times"); // the worlds differ more and more, and it says so
        Assert.All(said.Zip(said.Skip(1)), pair => Assert.True(pair.Second - pair.First >= 1990, $"{pair.Second - pair.First} ms"));
        Assert.Matches(@"^Player 1: off by \d.*m, \d+ heals?, agrees\. Player 2: off by \d.*m, \d+ heals?, differs\.$", await summary.InnerTextAsync());
    }

    /// <summary>No two parts of the page are live but the summary and sentences on what went wrong.</summary>
    [Fact]
    public async Task Hashes_ThatChangeFourTimesASecond_AreNotReadAloud()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "");
        string[] live = await page.Page.EvaluateAsync<string[]>(
            "() => [...document.querySelectorAll('[aria-live], [role=status], [role=alert]')].filter(e => !e.hidden).map(e => e.id)");
        Assert.Equal(["summary"], live);
    }
}
