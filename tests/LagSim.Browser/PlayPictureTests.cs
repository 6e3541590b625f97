using System;
using System.IO;
using System.Threading.Tasks;
using Microsoft.Playwright;
using Xunit;

namespace LagSim.Browser;

/// <summary>
/// The picture of the page in the README, in both themes: a break at pool, a moment after the other player's world has healed. It writes the
/// files, so it runs only when it is asked for.
/// </summary>
/// <remarks>The test passes time itself, a sixtieth of a second for each frame, so that the worlds are the same to the bit each time.</remarks>
public sealed class PlayPictureTests(ServedPage served)
{
    private const int MostBytes = 150_000;

    [Theory(Explicit = true)]
    [InlineData(ColorScheme.Light, "light")]
    [InlineData(ColorScheme.Dark, "dark")]
    public async Task Picture_OfAHealAtPool_IsTaken(ColorScheme theme, string name)
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(
            served, "scene=break&panes=healing,healing&delay=200",
            new() { ViewportSize = new() { Width = 1460, Height = 1000 }, ColorScheme = theme, DeviceScaleFactor = 1 });
        byte[] picture = await TakeAsync(page, Environment.GetEnvironmentVariable("LAGSIM_FRAMES") is string text ? int.Parse(text, System.Globalization.CultureInfo.InvariantCulture) : 20);
        Assert.InRange(picture.Length, 1, MostBytes);
        await File.WriteAllBytesAsync(Path.Combine(ServedPage.Root, "docs", "images", $"play-{name}.png"), picture, TestContext.Current.CancellationToken);
    }

    private static async Task<byte[]> TakeAsync(OpenedPage page, int frames)
    {
        await page.Page.EvaluateAsync(
            """
            async () => {
              let next
              window.requestAnimationFrame = callback => { next = callback }
              while (!next) {
                await new Promise(done => setTimeout(done, 5))
              }
              let now = performance.now() + 1e6
              const pass = count => {
                for (let n = 0; n < count; n++) {
                  now += 1000 / 60
                  next(now)
                }
              }
              pass(1)
              const restart = [...document.querySelectorAll('#controls button')].find(button => button.textContent === 'Restart')
              restart.click()
              const runtime = globalThis.getDotnetRuntime(0)
              const exports = await runtime.getAssemblyExports(runtime.getConfig().mainAssemblyName)
              window.passFrames = pass
              window.act = exports.LagSim.Play.Browser.PlaygroundExports.Act
            }
            """);
        await page.Page.EvaluateAsync("() => window.passFrames(60)");
        Assert.True(await page.Page.EvaluateAsync<bool>("() => window.act('break', 0)"));
        await page.Page.EvaluateAsync("frames => window.passFrames(frames)", frames);
        return await page.Page.Locator("#panes").ScreenshotAsync(new() { Type = ScreenshotType.Png });
    }
}
