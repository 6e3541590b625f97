using System;
using System.Linq;
using System.Threading.Tasks;
using Microsoft.Playwright;

namespace LagSim.Corpus.Chromium;

/// <summary>
/// Replays a folder of recordings in a page of Chromium: <c>LagSim.Corpus.Chromium PAGE FOLDER</c>, where PAGE is what
/// <c>LagSim.Corpus.Wasm</c> was built to. Then the page replays them with one event left out, and must see it.
/// </summary>
/// <remarks>The browser is at <c>CHROMIUM</c>, or on the path. Its lines are those of <c>LagSim.Corpus</c>.</remarks>
internal static class Program
{
    private const float Deadline = 240_000; // milliseconds

    private static async Task<int> Main(string[] arguments)
    {
        if (arguments is not [string folderOfPage, string corpus])
        {
            await Console.Error.WriteLineAsync("usage: LagSim.Corpus.Chromium PAGE FOLDER, a build of LagSim.Corpus.Wasm and a folder of recordings");
            return 2;
        }

        using SpoiledCorpus spoiled = new(corpus);
        await using CorpusServer server = await CorpusServer.StartAsync(folderOfPage, corpus, spoiled.Folder);
        using IPlaywright playwright = await Playwright.CreateAsync();
        await using IBrowser browser = await playwright.Chromium.LaunchAsync(new()
        {
            ExecutablePath = Environment.GetEnvironmentVariable("CHROMIUM") ?? "/usr/bin/chromium",
            Args = ["--no-sandbox"],
        });
        (int exit, string[] lines) = await ReplayAsync(browser, server, CorpusServer.Corpus);
        lines[0] = $"Chromium {browser.Version}, {lines[0]}";
        foreach (string line in lines[..^1])
        {
            Console.WriteLine(line);
        }

        (int spoiledExit, string[] seen) = await ReplayAsync(browser, server, CorpusServer.Spoiled);
        bool isSeen = spoiledExit == 1 && seen.Count(line => line.StartsWith("DIFFERS ", StringComparison.Ordinal)) == 1
            && seen.Count(line => line.StartsWith($"DIFFERS {SpoiledCorpus.Name} ", StringComparison.Ordinal)) == 1;
        Console.WriteLine(isSeen
            ? $"{lines[^1]}; without its last event '{SpoiledCorpus.Name}' differs"
            : $"{lines[^1]}\nNOT SEEN: without its last event '{SpoiledCorpus.Name}' does not differ. The page says:\n{string.Join('\n', seen)}");
        return exit == 0 && isSeen ? 0 : 1;
    }

    /// <summary>Opens the page, which fetches the recordings and replays them.</summary>
    private static async Task<(int Exit, string[] Lines)> ReplayAsync(IBrowser browser, CorpusServer server, string what)
    {
        IPage page = await browser.NewPageAsync();
        await page.GotoAsync($"{server.Address}browser.html?{what}");
        await page.WaitForFunctionAsync("() => window.replayed !== undefined", null, new() { Timeout = Deadline });
        string[] lines = await page.EvaluateAsync<string[]>("() => window.replayed.lines");
        int exit = await page.EvaluateAsync<int>("() => window.replayed.exit");
        await page.CloseAsync();
        return (exit, lines);
    }
}
