using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Text.Json;
using System.Threading.Tasks;
using Microsoft.Playwright;
using Xunit;

namespace LagSim.Browser;

/// <summary>What the page keeps while balls are thrown for ten minutes. That takes ten minutes, so it runs only when it is asked for.</summary>
public sealed class KeptMemoryTests(ServedPage served, ITestOutputHelper output)
{
    private const int Panes = 4, Balls = 16;

    /// <summary>Until then what is kept grows: histories fill, code is compiled, and the strip of errors gets its six seconds.</summary>
    private const int SettledAfterMinutes = 2;

    /// <summary>How much more than before may be kept of what does not depend on where balls are.</summary>
    private const double Slack = 0.05;

    /// <summary>By how much the memory of WebAssembly grows at a time; it never shrinks. Where balls meet as never before, it may by one.</summary>
    private const double Step = 0.21;

    [Fact(Explicit = true)]
    [Trait("Time", "real")]
    public async Task Memory_OfFourPanesOverTenMinutes_IsFlat()
    {
        int minutes = int.Parse(Environment.GetEnvironmentVariable("LAGSIM_MINUTES") ?? "10", CultureInfo.InvariantCulture);
        await using OpenedPage page = await OpenedPage.OpenAsync(
            served, "scene=room&panes=healing,healing,healing,healing&delay=100", new() { ViewportSize = new() { Width = 1400, Height = 1500 } });
        ICDPSession devices = await page.Page.Context.NewCDPSessionAsync(page.Page);
        await devices.SendAsync("HeapProfiler.enable");
        await devices.SendAsync("Performance.enable");
        SteadyThrows throws = new(page, Panes, Balls);
        List<Kept> all = [];
        output.WriteLine("| minute | throws | heals | JavaScript, MB | .NET, MB | WebAssembly memory, MB | nodes | listeners |");
        output.WriteLine("|---|---|---|---|---|---|---|---|");
        await throws.GoOnAsync(5);
        await BeginAnewAsync(page);
        Kept first = await KeptAsync(page, devices);
        Tell("begun", first);
        for (int minute = 1; minute <= minutes; minute++)
        {
            await throws.GoOnAsync(60);
            double heals = (await Task.WhenAll(Enumerable.Range(0, Panes).Select(pane => page.FigureAsync(pane, "heals")))).Sum();
            all.Add(await KeptAsync(page, devices));
            Tell(FormattableString.Invariant($"{minute} | {throws.Count} | {heals}"), all[^1]);
        }

        await page.AgreeAsync(Panes);
        await BeginAnewAsync(page);
        Kept last = await KeptAsync(page, devices);
        Tell("begun again", last);
        Assert.Multiple(
            () => Assert.True(IsFlat([.. all.Select(kept => kept.Script)], Slack), "what scripts keep grows"),
            () => Assert.True(last.Runtime <= first.Runtime * (1 + Slack), "what .NET keeps of former worlds grows"),
            () => Assert.True(IsFlat([.. all.Select(kept => kept.WebAssembly)], Step), "the memory of WebAssembly grows"),
            () => Assert.True(IsFlat([.. all.Select(kept => kept.Nodes)], Slack), "the document grows"),
            () => Assert.True(IsFlat([.. all.Select(kept => kept.Listeners)], Slack), "listeners pile up"));

        void Tell(string when, Kept kept) => output.WriteLine(FormattableString.Invariant(
            $"| {when} | {(when[0] == 'b' ? "| | " : "")}{kept.Script / 1e6:F2} | {kept.Runtime / 1e6:F2} | {kept.WebAssembly / 1e6:F1} | {kept.Nodes} | {kept.Listeners} |"));
    }

    /// <summary>Starts the worlds again: what they keep then does not depend on where the balls were.</summary>
    private static async Task BeginAnewAsync(OpenedPage page)
    {
        foreach (string scene in new[] { "cradle", "room" })
        {
            await page.Page.Locator("select[name=scene]").SelectOptionAsync(scene);
            await page.AgreeAsync(Panes);
        }
    }

    /// <summary>The control of the verdict: a fiftieth more each minute is not flat, a fiftieth up and down is.</summary>
    [Fact]
    public void Verdict_OnWhatGrowsByAFiftiethAMinute_IsNotFlat()
    {
        double[] minutes = [.. Enumerable.Range(0, 11).Select(minute => (double)minute)];
        Assert.False(IsFlat([.. minutes.Select(minute => 100 + (2 * minute))], Slack));
        Assert.True(IsFlat([.. minutes.Select(minute => minute % 2 == 0 ? 100 : 102.0)], Slack));
        Assert.False(IsFlat([.. minutes.Select(minute => minute < 7 ? 100 : 144.0)], Step));
        Assert.True(IsFlat([.. minutes.Select(minute => minute < 7 ? 100 : 120.0)], Step));
    }

    /// <summary>Whether the most in the second half of the time, from when it has settled, is no more than the most in the first half.</summary>
    private static bool IsFlat(double[] values, double slack)
    {
        double[] settled = values[Math.Min(SettledAfterMinutes, values.Length - 2)..];
        int half = settled.Length / 2;
        return settled[half..].Max() <= settled[..half].Max() * (1 + slack);
    }

    private static async Task<Kept> KeptAsync(OpenedPage page, ICDPSession devices)
    {
        JsonElement runtime = await page.Page.EvaluateAsync<JsonElement>(
            """
            async () => {
              const runtime = globalThis.getDotnetRuntime(0)
              const exports = await runtime.getAssemblyExports(runtime.getConfig().mainAssemblyName)
              return [exports.LagSim.Play.Browser.MemoryExports.KeptBytes(), runtime.localHeapViewU8().length]
            }
            """);
        await devices.SendAsync("HeapProfiler.collectGarbage");
        JsonElement script = (await devices.SendAsync("Runtime.getHeapUsage"))!.Value;
        JsonElement metrics = (await devices.SendAsync("Performance.getMetrics"))!.Value.GetProperty("metrics");
        return new Kept(script.GetProperty("usedSize").GetDouble(), runtime[0].GetDouble(), runtime[1].GetDouble(), Metric("Nodes"), Metric("JSEventListeners"));

        double Metric(string name) => metrics.EnumerateArray().Single(metric => metric.GetProperty("name").GetString() == name).GetProperty("value").GetDouble();
    }

    /// <summary>What is kept after everything that nothing refers to has been collected, in bytes, nodes and listeners.</summary>
    private readonly record struct Kept(double Script, double Runtime, double WebAssembly, double Nodes, double Listeners);
}
