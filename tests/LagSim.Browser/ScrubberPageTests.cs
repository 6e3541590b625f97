using System;
using System.Threading.Tasks;
using Microsoft.Playwright;
using Xunit;

namespace LagSim.Browser;

/// <summary>The slider over the window of the worlds, and the paths.</summary>
public sealed class ScrubberPageTests(ServedPage served)
{
    [Fact]
    public async Task Slider_PulledWithAMouse_ShowsAnotherInstantAndComesBack()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "panes=healing,healing");
        await page.Page.WaitForTimeoutAsync(1500);
        ILocator slider = page.Page.Locator("input[name=instant]");
        LocatorBoundingBoxResult box = (await slider.BoundingBoxAsync())!;
        await page.Page.Mouse.ClickAsync(box.X + (0.4f * box.Width), box.Y + (box.Height / 2));
        Assert.EndsWith("s ago", await Output(page), StringComparison.Ordinal);
        await page.Page.GetByRole(AriaRole.Button, new() { Name = "Go on" }).WaitForAsync(); // it is paused
        await Settled(page);
        (float X, float Y) then = await page.BallAsync(0, 3);
        await slider.FillAsync("0");
        await Settled(page);
        Assert.Equal("now", await Output(page));
        (float X, float Y) now = await page.BallAsync(0, 3);
        Assert.NotEqual(then, now);
        await slider.FillAsync("-0.2");
        await page.Page.GetByRole(AriaRole.Button, new() { Name = "Back to now" }).ClickAsync();
        Assert.Equal("now", await Output(page));
        (_, string before) = await page.HashAsync(0);
        await page.Page.WaitForTimeoutAsync(800);
        Assert.NotEqual(before, (await page.HashAsync(0)).Says); // and time goes on
    }

    [Fact]
    public async Task Slider_MovedByKeysAlone_ComesToThePastAndToTheFuture()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "ahead=400");
        await page.Page.WaitForTimeoutAsync(1000);
        await page.TabToAsync("input[name=instant]");
        await page.Page.Keyboard.PressAsync("ArrowLeft");
        await page.Page.Keyboard.PressAsync("ArrowLeft");
        Assert.Equal("0.02 s ago", await Output(page));
        await page.Page.Keyboard.PressAsync("End");
        Assert.Matches("^in 0\\.[123][0-9] s$", await Output(page));
        Assert.EndsWith(", precomputed", await page.Page.Locator("input[name=instant]").GetAttributeAsync("aria-valuetext"), StringComparison.Ordinal);
        await Settled(page);
        Assert.Equal("–", await page.Page.Locator("dd[data-is=error]").First.InnerTextAsync()); // of what is to come nobody knows the truth
        await page.TabToAsync("#scrubber button");
        await page.Page.Keyboard.PressAsync("Enter");
        Assert.Equal("now", await Output(page));
    }

    /// <summary>A person who had paused stays so.</summary>
    [Fact]
    public async Task BackToNow_AfterAPauseOfThePersons_StaysPaused()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "");
        await page.Page.WaitForTimeoutAsync(600);
        await page.Page.Keyboard.PressAsync("p");
        await page.Page.Locator("input[name=instant]").FillAsync("-0.3");
        await page.Page.GetByRole(AriaRole.Button, new() { Name = "Back to now" }).ClickAsync();
        await page.Page.GetByRole(AriaRole.Button, new() { Name = "Go on" }).WaitForAsync();
        await page.Page.Locator("input[name=instant]").FillAsync("-0.3");
        await page.Page.GetByRole(AriaRole.Button, new() { Name = "Go on" }).ClickAsync();
        Assert.Equal("now", await Output(page));
    }

    [Fact]
    public async Task Hand_ThatTakesABallWhileAnotherInstantIsShown_IsInThePresent()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "scene=break&delay=50");
        await page.Page.WaitForTimeoutAsync(600);
        await page.Page.Locator("input[name=instant]").FillAsync("-0.3");
        await page.ThrowAsync(0, 0, 50, -30);
        Assert.Equal("now", await Output(page));
        await page.Page.WaitForFunctionAsync("() => Number(document.querySelectorAll('dd[data-is=heals]')[1].textContent) > 0");
        await page.AgreeAsync(2);
    }

    /// <summary>Paths are drawn while paused, or where they are asked for; what is past as lines, what is to come with dashes.</summary>
    [Fact]
    public async Task Paths_WhilePausedOrAskedFor_AreDrawn()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(served, "ahead=400");
        await Strokes.SpyAsync(page);
        await page.Page.WaitForTimeoutAsync(1000);
        Assert.Equal((0, 0), await PathsAsync(page));
        await page.TabToAsync("input[name=paths]");
        await page.Page.Keyboard.PressAsync("Space");
        await page.Page.WaitForTimeoutAsync(400);
        (int past, int future) = await PathsAsync(page);
        Assert.True(past > 2 && future > 2, $"{past} lines, {future} dashed ones");
        await page.Page.Locator("input[name=paths]").ClickAsync();
        await page.Page.WaitForTimeoutAsync(200);
        await PathsAsync(page);
        await page.Page.WaitForTimeoutAsync(400);
        Assert.Equal((0, 0), await PathsAsync(page));
        await page.Page.Keyboard.PressAsync("Tab"); // away from the tick box
        await page.Page.GetByRole(AriaRole.Button, new() { Name = "Pause" }).ClickAsync();
        await page.Page.WaitForTimeoutAsync(400);
        (past, future) = await PathsAsync(page);
        Assert.True(past > 2 && future > 2, $"{past} lines, {future} dashed ones");
    }

    private static async Task<(int Past, int Future)> PathsAsync(OpenedPage page)
    {
        Stroke[] strokes = await Strokes.TakeAsync(page);
        string past = await Strokes.ColourAsync(page, "path"), future = await Strokes.ColourAsync(page, "future");
        return (Array.FindAll(strokes, s => s.Colour == past && !s.IsDashed).Length, Array.FindAll(strokes, s => s.Colour == future && s.IsDashed).Length);
    }

    private static Task<string> Output(OpenedPage page) => page.Page.Locator("#scrubber output").InnerTextAsync();

    /// <summary>Two frames: what was asked for is drawn.</summary>
    private static Task Settled(OpenedPage page) =>
        page.Page.EvaluateAsync("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done))))");
}
