using System;
using System.Globalization;
using System.Linq;
using System.Text.Json;
using System.Text.RegularExpressions;
using System.Threading.Tasks;
using Microsoft.Playwright;
using Xunit;

namespace LagSim.Browser;

/// <summary>The things to try: their figures are the tool's, and a person opens them with mouse, keys and fingers.</summary>
public sealed class GuidedStepPageTests(ServedPage served)
{
    private const string Done = "[data-state=done]";

    /// <summary>What sticks out of the page, of the table that it is in, or of its own cell; and cells whose column's name cannot be seen.</summary>
    private const string Hidden =
        """
        () => {
          const complaints = document.documentElement.scrollWidth > innerWidth ? [`the page is ${document.documentElement.scrollWidth} wide`] : []
          for (const part of document.querySelectorAll('.test .table tbody th, .test .table td, .test .table [data-key], .test .table small, .notes p')) {
            if (part.offsetParent === null) {
              continue // the second of two equal hashes
            }
            const box = part.getBoundingClientRect(), within = part.closest('.step').getBoundingClientRect()
            if (box.right > within.right || box.left < within.left || box.width === 0 || part.scrollWidth > part.clientWidth + 1 && part.clientWidth > 0) {
              complaints.push(`${part.textContent} from ${box.left} to ${box.right}`)
            }
          }
          for (const cell of document.querySelectorAll('.test .table td')) {
            const name = getComputedStyle(cell, '::before').content, head = cell.closest('table').querySelectorAll('thead th')[cell.cellIndex].getBoundingClientRect()
            if (name === 'none' && !(head.width > 1 && head.right >= cell.getBoundingClientRect().right - 1)) {
              complaints.push(`${cell.textContent} has no name`)
            }
          }
          return complaints
        }
        """;

    /// <summary>Every figure of the thesis's tests that the page shows is the tool's, to the last bit; another seed has others.</summary>
    [Theory]
    [InlineData("lift", 20_261)]
    [InlineData("hand", 77)]
    public async Task Figures_OfAThesissTest_AreThoseOfTheToolAndSeenWhole(string step, int seed)
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, $"step={step}&panes=healing,healing&seed={seed}");
        await page.Page.WaitForSelectorAsync(Done, new() { Timeout = 240_000 });
        Figure[] figures = await FiguresAsync(page);
        Assert.Equal(step == "lift" ? 69 : 174, figures.Length);

        JsonElement own = await ToolAsync(step, seed);
        foreach (IGrouping<string, Figure> list in figures.GroupBy(figure => figure.List))
        {
            Assert.Equal(own.GetProperty(list.Key).GetArrayLength(), list.Max(figure => figure.Run) + 1);
        }

        Assert.All(figures, figure => Assert.Null(Difference(figure, own)));
        JsonElement other = await ToolAsync(step, seed + 1);
        Assert.Contains(figures, figure => Difference(figure, other) is not null);

        // What the adaptive predictor's error is of the best one's is in no JSON: it is of two figures of it.
        Assert.Equal(step == "lift" ? [] : own.GetProperty("prediction_error_m").EnumerateArray().Select(OfBest), await page.Page.Locator(".test .small tbody td:nth-child(3) > span").AllInnerTextsAsync());
        await AssertSeenWholeAsync(page);
    }

    /// <summary>Whatever the width of the screen, no figure is cut off and each stands below a name, which is what the columns are for.</summary>
    private static async Task AssertSeenWholeAsync(OpenedPage page)
    {
        foreach (int width in new[] { 1500, 1400, 1280, 1024, 768, 390, 320 })
        {
            await page.Page.SetViewportSizeAsync(width, 900);
            Assert.Empty(await page.Page.EvaluateAsync<string[]>(Hidden));
            Assert.Equal(width < 1280, await page.Page.EvaluateAsync<bool>("() => getComputedStyle(document.querySelector('.wide tbody tr')).display === 'grid'"));
        }

        await page.Page.AddStyleTagAsync(new() { Content = ":root { font-size: 200% }" });
        await page.Page.SetViewportSizeAsync(1280, 900);
        Assert.Empty(await page.Page.EvaluateAsync<string[]>(Hidden));

        // The control: as it was before there were blocks.
        await page.Page.AddStyleTagAsync(new() { Content = ".test .table { container-type: normal; overflow: hidden }" });
        await page.Page.SetViewportSizeAsync(390, 844);
        Assert.NotEmpty(await page.Page.EvaluateAsync<string[]>(Hidden));
    }

    [Fact]
    public async Task Rows_OfOneStrategy_SayWhatDiffers()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "step=lift&panes=healing,healing");
        await page.Page.WaitForSelectorAsync(Done, new() { Timeout = 120_000 });
        string[] names = [.. await page.Page.Locator(".test tbody th").AllInnerTextsAsync()];
        Assert.Equal(names.Distinct(), names);
        Assert.Equal(["healing, after a fall", "healing, from rest"], names.Where(name => name.StartsWith("healing", StringComparison.Ordinal)));
        ILocator forward = page.Page.Locator(".test tbody tr").Filter(new() { HasText = "latency-forward" });
        string row = await forward.InnerTextAsync();
        Assert.Matches(@"(?s)([1-9]\d*) of \1 on the way.*\b0 of \d+ after.*≠ not the same", row); // the two figures that look like a contradiction
        Assert.Contains("‘latency-forward’: once the news is there", await page.Page.Locator(".notes").First.InnerTextAsync(), StringComparison.Ordinal);
    }

    [Fact]
    public async Task Worlds_WhileATestRuns_GoOn()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "step=hand&panes=healing,healing");
        await page.Page.WaitForSelectorAsync("[data-state=running]");
        (_, string before) = await page.HashAsync(0);
        await page.Page.WaitForTimeoutAsync(1500);
        Assert.NotEqual(before, (await page.HashAsync(0)).Says);
        Assert.Equal("running", await page.Page.Locator(".test").GetAttributeAsync("data-state"));
        await page.Page.GetByRole(AriaRole.Button, new() { Name = "Stop" }).ClickAsync();
        Assert.Equal("stopped", await page.Page.Locator(".test").GetAttributeAsync("data-state"));
        int rows = await page.Page.Locator(".test tbody tr").CountAsync();
        await page.Page.WaitForTimeoutAsync(4000);
        Assert.Equal(rows, await page.Page.Locator(".test tbody tr").CountAsync()); // nothing goes on behind the page
    }

    [Fact]
    public async Task Seed_ChosenInATest_IsInTheAddressAndOfTheTest()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "step=lift");
        await page.Page.GetByRole(AriaRole.Button, new() { Name = "Stop" }).ClickAsync();
        await page.Page.Locator("input[name=seed]").FillAsync("12");
        await page.Page.GetByRole(AriaRole.Button, new() { Name = "Run again" }).ClickAsync();
        Assert.Contains("seed=12", page.Page.Url, StringComparison.Ordinal);
        Assert.Contains("step=lift", page.Page.Url, StringComparison.Ordinal);
        await page.Page.WaitForSelectorAsync(Done, new() { Timeout = 120_000 });
        JsonElement own = await ToolAsync("lift", 12);
        Assert.All(await FiguresAsync(page), figure => Assert.Null(Difference(figure, own)));
    }

    [Fact]
    public async Task Strategy_ChosenForTheChart_IsDrawn()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "step=lift");
        await page.Page.WaitForSelectorAsync(Done, new() { Timeout = 120_000 });
        ILocator apart = page.Page.Locator(".charts figure").Nth(1).Locator("path.line").First;
        Assert.True((await apart.GetAttributeAsync("d"))!.Split('L').Length > 100); // apart for good
        await page.Page.Locator(".charts select").SelectOptionAsync("healing");
        Assert.True((await apart.GetAttributeAsync("d"))!.Split('L').Length < 10); // until the event is there
    }

    [Fact]
    public async Task Steps_FollowedWithAMouse_SetThePageUpAndComeBack()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "");
        foreach ((string step, string part) in new[] { ("break", "scene=break"), ("loss", "loss=40"), ("later", "lag=100") })
        {
            ILocator link = page.Page.Locator($"#steps ol a[data-step={step}]");
            await link.ClickAsync();
            Assert.Equal("step", await link.GetAttributeAsync("aria-current"));
            Assert.Equal(1, await page.Page.Locator("#steps ol a[aria-current]").CountAsync());
            Assert.Contains($"step={step}", page.Page.Url, StringComparison.Ordinal);
            Assert.Contains(part, page.Page.Url, StringComparison.Ordinal);
            Assert.True(await page.Page.Locator("#step").IsVisibleAsync());
        }

        await page.Page.GoBackAsync();
        Assert.Equal("step", await page.Page.Locator("#steps ol a[data-step=loss]").GetAttributeAsync("aria-current"));
        Assert.Equal("40", await page.Page.Locator("input[name=loss]").InputValueAsync());
        await page.Page.ReloadAsync();
        await page.Page.WaitForSelectorAsync("#panes:not([hidden])");
        Assert.Equal("step", await page.Page.Locator("#steps ol a[data-step=loss]").GetAttributeAsync("aria-current"));
        Assert.Equal("40", await page.Page.Locator("input[name=loss]").InputValueAsync());

        // Another set-up than the step's is said to be one, until it is the step's again; seed and speed may be any.
        ILocator changed = page.Page.Locator(".changed"), deed = page.Page.Locator("#step .deeds button");
        await page.Page.Locator("select[name=speed]").SelectOptionAsync("0.5");
        Assert.False(await changed.IsVisibleAsync());
        await page.Page.Locator("input[name=delay]").FillAsync("300");
        Assert.StartsWith(
            "The worlds are not set up as this step says: delay is 300, not 60. What it says need not be so here.", await changed.InnerTextAsync(), StringComparison.Ordinal);
        Assert.True(await deed.IsEnabledAsync());
        await page.Page.Locator("select[name=scene]").SelectOptionAsync("drop");
        Assert.Contains("says: scene is drop, not room; delay is 300, not 60.", await changed.InnerTextAsync(), StringComparison.Ordinal);
        Assert.False(await deed.IsEnabledAsync()); // it throws balls that are not there
        await changed.GetByRole(AriaRole.Button).ClickAsync();
        Assert.False(await changed.IsVisibleAsync());
        Assert.True(await deed.IsEnabledAsync());
        Assert.EndsWith("?step=loss&scene=room&panes=healing,healing,none&delay=60&jitter=20&loss=40&burst=10&speed=0.5", page.Page.Url, StringComparison.Ordinal);
        Assert.Equal("60", await page.Page.Locator("input[name=delay]").InputValueAsync());
        await page.Page.GetByRole(AriaRole.Link, new() { Name = "The same without loss" }).ClickAsync();
        Assert.Equal("0", await page.Page.Locator("input[name=loss]").InputValueAsync());
        Assert.False(await changed.IsVisibleAsync()); // the step itself offers this one
    }

    [Fact]
    public async Task Break_ByKeysAlone_IsAnotherGameForThoseWhoPromiseNothing()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "");
        await page.TabToAsync("#steps ol a[data-step=break]");
        await page.Page.Keyboard.PressAsync("Enter");
        await page.Page.WaitForSelectorAsync("#step:not([hidden])");
        await page.Page.WaitForTimeoutAsync(600);
        await page.TabToAsync("#step .deeds button");
        await page.Page.Keyboard.PressAsync("Enter");
        await page.Page.WaitForFunctionAsync("() => Number(document.querySelectorAll('dd[data-is=heals]')[1].textContent) > 0");
        await page.Page.WaitForFunctionAsync(
            """
            () => [...document.querySelectorAll('.agrees span')].map(span => span.textContent.split(' ')[0]).join() === 'agrees,agrees,differs,differs'
              && Number(document.querySelectorAll('.agrees span')[0].textContent.split(' ')[2]) > 2.5
            """);
        await page.TabToAsync("#step .close");
        await page.Page.Keyboard.PressAsync("Enter");
        Assert.False(await page.Page.Locator("#step").IsVisibleAsync());
        Assert.DoesNotContain("step=", page.Page.Url, StringComparison.Ordinal);
        Assert.Equal("break", await page.Page.EvaluateAsync<string>("() => document.activeElement.dataset.step")); // where the person came from
    }

    /// <summary>A link of a step is an ordinary one: opened elsewhere it is the same step and set-up.</summary>
    [Theory]
    [InlineData("lift")]
    [InlineData("hand")]
    [InlineData("break")]
    [InlineData("loss")]
    [InlineData("later")]
    public async Task Link_OfAStepOpenedElsewhere_IsThatStepOnAPhoneToo(string step)
    {
        string href;
        await using (OpenedPage page = await OpenedPage.OpenAsync(served, ""))
        {
            href = (await page.Page.Locator($"#steps ol a[data-step={step}]").GetAttributeAsync("href"))!;
        }

        await using OpenedPage phone = await OpenedPage.OpenAsync(
            served, href[1..], new() { ViewportSize = new() { Width = 390, Height = 844 }, HasTouch = true, IsMobile = true, DeviceScaleFactor = 2 });
        Assert.Equal("step", await phone.Page.Locator($"#steps ol a[data-step={step}]").GetAttributeAsync("aria-current"));
        Assert.Equal(href[1..], Uri.UnescapeDataString(new Uri(phone.Page.Url).Query[1..]));
        foreach (ILocator deed in await phone.Page.Locator("#step .deeds button").AllAsync())
        {
            await deed.TapAsync();
        }

        if (step is "lift" or "hand")
        {
            await phone.Page.WaitForSelectorAsync(".test tbody tr", new() { Timeout = 60_000 });
        }
        else
        {
            await phone.Page.WaitForFunctionAsync("() => Number(document.querySelectorAll('dd[data-is=heals]')[1].textContent) > 0");
        }

        Assert.True(await phone.Page.EvaluateAsync<bool>("() => document.documentElement.scrollWidth <= innerWidth"), "the page is wider than the phone");
    }

    [Fact]
    public async Task Step_ThatThereIsNot_IsNamed()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "step=moon");
        Assert.StartsWith(
            "There is no step 'moon'; there are lift, hand, break, loss, later. No step is shown.\n", await page.Page.Locator("#problem").InnerTextAsync(), StringComparison.Ordinal);
        Assert.EndsWith("?step=moon", page.Page.Url, StringComparison.Ordinal);
        Assert.False(await page.Page.Locator("#step").IsVisibleAsync());
        await page.AgreeAsync(2);
        await page.Page.GotoAsync($"{served.Address}?step=loss&step=later");
        await page.Page.WaitForSelectorAsync("#panes:not([hidden])");
        Assert.StartsWith(
            "'step' is there 2 times, as 'loss', 'later'; once is allowed. No step is shown.\n", await page.Page.Locator("#problem").InnerTextAsync(), StringComparison.Ordinal);
    }

    private static string OfBest(JsonElement prediction)
    {
        double best = prediction.GetProperty("best_in_hindsight_m").GetDouble();
        return best == 0 ? "–" : (prediction.GetProperty("adaptive_m").GetDouble() / best).ToString("0.000", CultureInfo.InvariantCulture);
    }

    private static Task<JsonElement> ToolAsync(string step, int seed)
    {
        string text = seed.ToString(CultureInfo.InvariantCulture);
        return step == "lift"
            ? Tool.JsonAsync("drop", "--time", "virtual", "--strategy", "all", "--seed", text)
            : Tool.JsonAsync("hold", "--time", "virtual", "--seed", text);
    }

    private static async Task<Figure[]> FiguresAsync(OpenedPage page)
    {
        JsonElement all = await page.Page.EvaluateAsync<JsonElement>(
            """
            () => [...document.querySelectorAll('.test [data-key]')].map(e => ({ list: e.dataset.of, run: Number(e.dataset.run), key: e.dataset.key, text: e.textContent, value: e.getAttribute('value') ?? '' }))
            """);
        return [.. all.EnumerateArray().Select(one => new Figure(
            one.GetProperty("list").GetString()!, one.GetProperty("run").GetInt32(), one.GetProperty("key").GetString()!, one.GetProperty("text").GetString()!, one.GetProperty("value").GetString()!))];
    }

    /// <summary>How a figure differs from that in the tool's JSON, in words; null if it does not.</summary>
    private static string? Difference(Figure figure, JsonElement tool)
    {
        JsonElement at = tool.GetProperty(figure.List)[figure.Run];
        foreach (string part in figure.Key.Split('.'))
        {
            at = at.ValueKind == JsonValueKind.Array ? at[int.Parse(part, CultureInfo.InvariantCulture)] : at.GetProperty(part);
        }

        if (at.ValueKind == JsonValueKind.String)
        {
            return at.GetString() == figure.Text ? null : $"run {figure.Run}, {figure.Key}: {figure.Text} against {at}";
        }

        if (at.ValueKind == JsonValueKind.Null)
        {
            return figure.Value.Length == 0 && figure.Text == "–" ? null : $"run {figure.Run}, {figure.Key}: {figure.Text} against nothing";
        }

        double exact = double.Parse(figure.Value, CultureInfo.InvariantCulture);
        Match shown = Regex.Match(figure.Text, @"^([-0-9.e+]+)( mm)?");
        double text = double.Parse(shown.Groups[1].Value, CultureInfo.InvariantCulture) / (shown.Groups[2].Success ? 1000 : 1);
        return exact != at.GetDouble() ? $"run {figure.Run}, {figure.Key}: {exact:R} against {at}"
            : Math.Abs(text - exact) > 6e-3 * Math.Abs(exact) ? $"run {figure.Run}, {figure.Key}: shown as {figure.Text}, and is {exact:R}"
            : null;
    }

    private sealed record Figure(string List, int Run, string Key, string Text, string Value);
}
