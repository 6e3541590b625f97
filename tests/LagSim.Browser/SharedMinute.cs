using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading.Tasks;
using Microsoft.Playwright;
using Xunit;

namespace LagSim.Browser;

/// <summary>A minute of play by a native host, a native peer over UDP and two tabs, and the same committed hash at every time in all
/// four.</summary>
internal static class SharedMinute
{
    private const int Seconds = 60;

    /// <summary>Plays it.</summary>
    /// <param name="served">Has the browser.</param>
    /// <param name="webPort">The port of the page; 0 for any.</param>
    /// <param name="worsen">Makes the network worse, once the host is there.</param>
    internal static async Task PlayAsync(ServedPage served, int webPort, Action worsen)
    {
        await using ToolProcess host = new(
            "host", "--scene", "billiards", "--joiners", "3", "--per-address", "8", "--history-s", "1.5", "--for-s", $"{Seconds}", "--web", $"{webPort}");
        string page = await host.AfterAsync("browsers join at ");
        string address = $"lagsim://{await host.AfterAsync("lagsim://")}";
        worsen();
        await using IBrowserContext context = await served.Browser.NewContextAsync(JoinedPage.Screen);
        JoinedPage[] tabs = [await JoinEarlyAsync(context, page, "Ann"), await JoinEarlyAsync(context, page, "Bob")];
        IEnumerable<string> deeds = Enumerable.Range(2, Seconds - 4).SelectMany(t => new[] { "--do", $"impulse@{t}.3:0.{1 + (t % 7)},0,-0.{1 + (t % 5)}" });
        await using ToolProcess native = new(["join", address, "--for-s", $"{Seconds}", .. deeds]);
        await tabs[0].RunningAsync();
        await tabs[1].RunningAsync();
        Random random = new(27);
        Dictionary<string, string>[] told = [[], []];
        while (!native.HasEnded)
        {
            JoinedPage tab = tabs[random.Next(2)];
            await tab.Page.BringToFrontAsync();
            await tab.ThrowAsync(random.Next(16), random.Next(-120, 120), random.Next(-80, 80));
            await Task.Delay(random.Next(300));
            for (int n = 0; n < 2; n++)
            {
                foreach ((string time, string state) in await tabs[n].StatesAsync())
                {
                    told[n][time] = state;
                }
            }
        }

        Assert.Equal((0, 0), (await native.EndAsync(), await host.EndAsync()));
        IReadOnlyDictionary<string, string> states = host.States;
        Assert.True(states.Values.Select(state => state.Split(' ')[4]).Distinct().Count() > Seconds / 2, "The world stood still.");
        JoinedPage.AssertSame(states, native.States, Seconds - 2);
        for (int n = 0; n < 2; n++)
        {
            JoinedPage.AssertSame(states, told[n], Seconds - 6);
            Assert.Equal(0, await tabs[n].NumberAsync("differed"));
            Assert.True(await tabs[n].NumberAsync("heals") > 10, "Nothing arrived late, so nothing was shown.");
            Assert.Empty(tabs[n].Complaints);
        }

        TestContext.Current.SendDiagnosticMessage($"{states.Count} states, heals {await tabs[0].NumberAsync("heals")} and {await tabs[1].NumberAsync("heals")}, round trip {await tabs[0].NumberAsync("round_trip_ms")} ms");
    }

    /// <summary>Opens the page and asks to be let in; the world may begin only once others are there.</summary>
    private static async Task<JoinedPage> JoinEarlyAsync(IBrowserContext context, string address, string name)
    {
        JoinedPage joined = await JoinedPage.OpenAsync(context, address);
        await joined.AskAsync(name);
        return joined;
    }
}
