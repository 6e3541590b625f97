using System.IO;
using System.Threading.Tasks;
using Microsoft.Playwright;
using Xunit;

namespace LagSim.Browser;

/// <summary>
/// The picture of the page in the README, in both themes: three balls were thrown in one world, and the other has healed a moment ago. It writes
/// the files, so it runs only when it is asked for.
/// </summary>
/// <remarks>The test passes time itself, a sixtieth of a second for each frame, so that the worlds are the same to the bit each time.</remarks>
public sealed class PlayPictureTests(ServedPage served)
{
    private const int MostBytes = 150_000;

    [Theory(Explicit = true)]
    [InlineData(ColorScheme.Light, "light")]
    [InlineData(ColorScheme.Dark, "dark")]
    public async Task Picture_OfAHealInTheRoom_IsTaken(ColorScheme theme, string name)
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(
            served, "scene=room&panes=healing,healing&delay=150",
            new() { ViewportSize = new() { Width = 1460, Height = 1000 }, ColorScheme = theme, DeviceScaleFactor = 1 });
        byte[] picture = await TakeAsync(page);
        Assert.InRange(picture.Length, 1, MostBytes);
        await File.WriteAllBytesAsync(Path.Combine(ServedPage.Root, "docs", "images", $"play-{name}.png"), picture, TestContext.Current.CancellationToken);
    }

    /// <summary>Restarts the worlds, lets half a second pass, throws three balls, and takes the picture once the other player knows.</summary>
    private static async Task<byte[]> TakeAsync(OpenedPage page)
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
        await page.Page.EvaluateAsync("() => window.passFrames(30)");
        Assert.True(await page.Page.EvaluateAsync<bool>("() => window.act('loss', 0)"));
        await page.Page.EvaluateAsync("() => window.passFrames(14)"); // five after the throws are known
        return await page.Page.Locator("#panes").ScreenshotAsync(new() { Type = ScreenshotType.Png });
    }
}
