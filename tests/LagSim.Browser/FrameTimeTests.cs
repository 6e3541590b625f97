using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Text.Json;
using System.Threading.Tasks;
using Xunit;

namespace LagSim.Browser;

/// <summary>How long the frames of the page take, as a table. It tells of the machine it runs on, so it runs only when it is asked for.</summary>
public sealed class FrameTimeTests(ServedPage served, ITestOutputHelper output)
{
    private const int Panes = 4, Balls = 16;
    private const double WarmupSeconds = 10, Seconds = 60;
    private const int QuietSeconds = 20;

    [Fact(Explicit = true)]
    [Trait("Time", "real")]
    public async Task Frames_OfFourPanesWithSixteenBallsEach_TakeWhatTheTableSays()
    {
        await using OpenedPage page = await OpenedPage.OpenAsync(
            served, "scene=room&panes=healing,healing,healing,healing&delay=100", new() { ViewportSize = new() { Width = 1400, Height = 1500 } });
        SteadyThrows throws = new(page, Panes, Balls);
        await throws.GoOnAsync(WarmupSeconds);
        string before = Load();
        await WatchAsync(page);
        await page.Page.WaitForTimeoutAsync(QuietSeconds * 1000);
        Say($"{RateOf(await TakeAsync(page)):F1} frames a second while nobody throws");
        int thrown = throws.Count;
        await throws.GoOnAsync(Seconds);
        Frame[] frames = await TakeAsync(page);
        await page.AgreeAsync(Panes);

        Say($"{RateOf(frames):F1} frames a second, {throws.Count - thrown} throws, {frames[^1].Heals - frames[0].Heals} heals");
        Say($"load: {before} before, {Load()} after, on {Environment.ProcessorCount} cores");
        Say("");
        Say("| ms | frames | p50 | p99 | max |");
        Say("|---|---|---|---|---|");
        (Frame Before, Frame Now)[] pairs = [.. frames.Zip(frames.Skip(1))];
        Row("between frames", pairs.Select(pair => pair.Now.Began - pair.Before.Began));
        Row("work in a frame", pairs.Select(pair => pair.Now.Work));
        Row("of it before the first pane is drawn", pairs.Select(pair => pair.Now.UntilDrawn));
        Row("work where a world was healed", pairs.Where(pair => pair.Now.Heals > pair.Before.Heals).Select(pair => pair.Now.Work));
        Row("work where none was", pairs.Where(pair => pair.Now.Heals == pair.Before.Heals).Select(pair => pair.Now.Work));
    }

    /// <summary>From now on each frame is timed: the call of the page's function, which lets time pass and draws.</summary>
    private static Task WatchAsync(OpenedPage page) => page.Page.EvaluateAsync(
        """
        () => {
          window.frameTimes = []
          const request = window.requestAnimationFrame, clear = CanvasRenderingContext2D.prototype.clearRect
          let drawn = 0
          CanvasRenderingContext2D.prototype.clearRect = function (...box) {
            drawn ||= performance.now()
            clear.apply(this, box)
          }
          window.requestAnimationFrame = callback => request.call(window, now => {
            drawn = 0
            const began = performance.now()
            callback(now)
            const ended = performance.now()
            const heals = [...document.querySelectorAll('dd[data-is=heals]')].reduce((sum, dd) => sum + Number(dd.textContent), 0)
            window.frameTimes.push([began, ended - began, drawn - began, heals])
          })
        }
        """);

    private static async Task<Frame[]> TakeAsync(OpenedPage page)
    {
        JsonElement frames = await page.Page.EvaluateAsync<JsonElement>("() => window.frameTimes.splice(0)");
        return [.. frames.EnumerateArray().Select(f => new Frame(f[0].GetDouble(), f[1].GetDouble(), f[2].GetDouble(), f[3].GetInt64()))];
    }

    private static double RateOf(Frame[] frames) => (frames.Length - 1) / (frames[^1].Began - frames[0].Began) * 1000;

    private static string Load() => File.Exists("/proc/loadavg") ? File.ReadAllText("/proc/loadavg").Split(' ')[0] : "unknown";

    private void Row(string name, IEnumerable<double> values)
    {
        double[] sorted = [.. values.Order()];
        Assert.NotEmpty(sorted);
        Say($"| {name} | {sorted.Length} | {At(0.5)} | {At(0.99)} | {At(1)} |");

        string At(double share) => sorted[(int)Math.Ceiling(share * sorted.Length) - 1].ToString("F1", CultureInfo.InvariantCulture);
    }

    private void Say(FormattableString line) => output.WriteLine(line.ToString(CultureInfo.InvariantCulture));

    private void Say(string line) => output.WriteLine(line);

    /// <summary>One frame: when it began, what it took, what of that before anything was drawn, in ms; and the heals so far.</summary>
    private readonly record struct Frame(double Began, double Work, double UntilDrawn, long Heals);
}
