using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Globalization;
using System.Linq;
using System.Text.RegularExpressions;
using System.Threading.Tasks;
using Microsoft.Playwright;
using Xunit;

namespace LagSim.Browser;

/// <summary>A minute of play by a native host, a native peer over UDP and two tabs, and the same committed hash at every time in all
/// four; at the same time in another session while packets of its page are lost, where TCP sends them again, and what is old by then is not
/// sent.</summary>
[Trait("Time", "real")]
public sealed class SharedMinuteTests(ServedPage served)
{
    private const int Seconds = 60;
    private const int LossyPort = 8199;
    private const int LostPercent = 5; // each way

    [Fact]
    public async Task World_OfAHostAPeerOverUdpAndTwoTabs_IsTheSameAtEveryTime()
    {
        bool isOwnNetwork = Environment.GetEnvironmentVariable("LAGSIM_OWN_NETWORK") == "1";
        TestContext.Current.TestOutputHelper?.WriteLine(
            isOwnNetwork ? "with a second session whose packets are lost by nftables" : "without losses: .ci/browser makes a network of its own for them, as root");
        await Task.WhenAll(PlayAsync(webPort: 0, () => { }), isOwnNetwork ? PlayLossyAsync() : Task.CompletedTask);
    }

    private async Task PlayLossyAsync()
    {
        await PlayAsync(LossyPort, () => Nft("-f", "-"));
        int[] lost = [.. Regex.Matches(Nft("list", "table", "inet", "lagsim"), @"counter packets (\d+)").Select(match => int.Parse(match.Groups[1].Value, CultureInfo.InvariantCulture))];
        Assert.True(lost.Length == 2 && lost.Min() > 10, $"Lost were only {string.Join(" and ", lost)} packets.");
    }

    private async Task PlayAsync(int webPort, Action worsen)
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
        string[][] complaints = [[], []]; // before the host ended, which breaks the connections
        while (!native.HasEnded)
        {
            JoinedPage tab = tabs[random.Next(2)];
            await tab.Page.BringToFrontAsync();
            await tab.ThrowAsync(random.Next(16), random.Next(-120, 120), random.Next(-80, 80));
            await Task.Delay(random.Next(300));
            for (int n = 0; n < 2; n++)
            {
                complaints[n] = told[n].Count < Seconds - 4 ? [.. tabs[n].Complaints] : complaints[n];
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
            Assert.Empty(complaints[n]);
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

    private static string Nft(params string[] arguments)
    {
        using Process nft = Process.Start(new ProcessStartInfo("nft", arguments) { RedirectStandardInput = true, RedirectStandardOutput = true })!;
        if (arguments is ["-f", "-"])
        {
            nft.StandardInput.Write(string.Create(CultureInfo.InvariantCulture, $$"""
                add table inet lagsim
                add chain inet lagsim page { type filter hook input priority 0; }
                add rule inet lagsim page tcp dport {{LossyPort}} numgen random mod 100 < {{LostPercent}} counter drop
                add rule inet lagsim page tcp sport {{LossyPort}} numgen random mod 100 < {{LostPercent}} counter drop
                """));
        }

        nft.StandardInput.Close();
        string said = nft.StandardOutput.ReadToEnd();
        nft.WaitForExit();
        Assert.Equal(0, nft.ExitCode);
        return said;
    }
}
