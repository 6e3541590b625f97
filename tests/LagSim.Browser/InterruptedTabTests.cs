using System;
using System.Diagnostics;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Text.Json;
using System.Threading.Tasks;
using Microsoft.Playwright;
using Xunit;

namespace LagSim.Browser;

/// <summary>Tabs that stop for a while, and hosts that do: nobody waits for them, and they come back.</summary>
[Trait("Time", "real")]
public sealed class InterruptedTabTests(ServedPage served)
{
    private const int LongestSilence = 3; // seconds
    private const long MostGrowth = 24 << 20; // bytes: some seconds of play with their garbage. What bounds the queue of one that reads nothing is in SessionDoorTests

    /// <summary>A tab whose script hangs reads nothing, and answers nothing.</summary>
    [Fact]
    public async Task Tab_ThatHangs_CostsTheHostLittleAndThenLosesItsPlace()
    {
        await using ToolProcess host = new("host", "--scene", "billiards", "--per-address", "8", "--web", "0", "--rejoin-s", "1", "--timeout-s", $"{LongestSilence}");
        string page = await host.AfterAsync("browsers join at ");
        await using IBrowserContext context = await served.Browser.NewContextAsync(JoinedPage.Screen);
        JoinedPage ann = await JoinedPage.JoinAsync(context, page, "Ann"), bob = await JoinedPage.JoinAsync(context, page, "Bob");
        await bob.Page.BringToFrontAsync();
        await bob.ThrowAsync(0, 100, 40);
        long before = host.ResidentBytes;

        Task hanging = ann.Page.EvaluateAsync(
            "seconds => { const until = performance.now() + seconds * 1000; while (performance.now() < until) { /* nothing is read */ } }", LongestSilence + 6);
        Task<string> lost = host.SaysAsync(line => line.StartsWith("peer 1 at ", StringComparison.Ordinal) && line.EndsWith(" is gone", StringComparison.Ordinal));
        Random random = new(27);
        while (!lost.IsCompleted)
        {
            await bob.ThrowAsync(random.Next(16), random.Next(-120, 120), random.Next(-80, 80)); // the game goes on
        }

        await lost;
        Assert.False(hanging.IsCompleted, "It had come to itself before.");
        Assert.True(host.ResidentBytes - before < MostGrowth, $"The host has grown by {(host.ResidentBytes - before) >> 20} MiB.");
        await host.SaysAsync(line => line == "here: 0 player, 2 player Bob");
        await hanging;
        await ann.Page.WaitForFunctionAsync("() => window.lagsim.status?.state === 'Running' || window.lagsim.status?.end", null, new() { Timeout = 30_000 });
        await bob.AgreedAsync(5);
        Assert.Equal((0, 0), (await ann.NumberAsync("differed"), await bob.NumberAsync("differed")));
    }

    /// <summary>What a phone in a pocket does: nothing of its browser runs for longer than a host waits.</summary>
    [Fact]
    public async Task Tab_ThatSlept_ComesBackAsTheSamePlayer()
    {
        await using ToolProcess host = new("host", "--scene", "billiards", "--per-address", "8", "--web", "0", "--timeout-s", $"{LongestSilence}");
        string page = await host.AfterAsync("browsers join at ");
        await using IBrowserContext context = await served.Browser.NewContextAsync(JoinedPage.Screen);
        await using IBrowser phone = await served.LaunchAsync();
        await using IBrowserContext pocket = await phone.NewContextAsync(JoinedPage.Screen);
        JoinedPage bob = await JoinedPage.JoinAsync(context, page, "Bob"), ann = await JoinedPage.JoinAsync(pocket, page, "Ann");
        string[] processes = await ProcessesAsync(phone);
        await SignalAsync("-STOP", processes);
        try
        {
            await host.SaysAsync(line => line.StartsWith("peer 2 at ", StringComparison.Ordinal) && line.EndsWith(" is gone", StringComparison.Ordinal));
            await bob.ThrowAsync(3, -80, 60);
        }
        finally
        {
            await SignalAsync("-CONT", processes);
        }

        await ann.Page.WaitForFunctionAsync("() => window.lagsim.status.state !== 'Running'", null, new() { Timeout = 20_000, PollingInterval = 10 });
        await ann.RunningAsync();
        Assert.Equal(2, await ann.NumberAsync("player"));
        await AgreesFromNowOnAsync(ann);
    }

    /// <summary>A host that was started again has another session: who was in the one before comes into it as a new player, and plays.</summary>
    [Fact]
    public async Task Tab_WhoseHostIsStartedAgain_IsInItsNewSession()
    {
        const string Scene = "air-hockey";
        const int Seconds = 10; // so long that a hand which goes by the time of that session would stand still in the next
        string identity = Path.Combine(Directory.CreateTempSubdirectory("lagsim-host").FullName, "identity");
        await using IBrowserContext context = await served.Browser.NewContextAsync(JoinedPage.Screen);
        JoinedPage ann;
        string port;
        await using (ToolProcess host = new("host", "--scene", Scene, "--joiners", "1", "--web", "0", "--identity", identity, "--timeout-s", $"{LongestSilence}"))
        {
            string page = await host.AfterAsync("browsers join at ");
            port = new Uri(page).Port.ToString(CultureInfo.InvariantCulture);
            ann = await JoinedPage.JoinAsync(context, page, "Ann");
            await ann.AgreedAsync(Seconds, 30_000);
            await ActsAsync(ann, Scene);
        }

        await ann.Page.GetByText("There is no connection to the host").WaitForAsync(new() { Timeout = 20_000 });
        await using ToolProcess next = new("host", "--scene", Scene, "--joiners", "1", "--web", port, "--identity", identity, "--timeout-s", $"{LongestSilence}");
        await next.AfterAsync("browsers join at ");
        await next.SaysAsync(line => line == "here: 0 player, 1 player Ann");
        await ann.RunningAsync();
        Assert.False(await ann.Page.Locator("#again").IsVisibleAsync(), "It has to be pressed to go on, though it is the same host.");
        await ActsAsync(ann, Scene);
        Directory.Delete(Path.GetDirectoryName(identity)!, recursive: true);
    }

    /// <summary>A host that cannot prove to be the one before is another: the person is told, and decides. Meanwhile nothing agrees.</summary>
    [Fact]
    public async Task Tab_AtWhoseAddressAnotherHostAnswers_SaysSoAndIsInWhenAsked()
    {
        await using IBrowserContext context = await served.Browser.NewContextAsync(JoinedPage.Screen);
        JoinedPage ann;
        ILocator agrees;
        string port;
        await using (ToolProcess host = new("host", "--scene", "billiards", "--web", "0", "--key", "open sesame", "--timeout-s", $"{LongestSilence}"))
        {
            string page = await host.AfterAsync("browsers join at ");
            port = new Uri(page).Port.ToString(CultureInfo.InvariantCulture);
            ann = await JoinedPage.JoinAsync(context, page, "Ann", "open sesame");
            await ann.AgreedAsync(1, 30_000);
            agrees = ann.Page.Locator(".agrees");
            Assert.Contains("the host's", await agrees.InnerTextAsync(), StringComparison.Ordinal);
            Assert.False(await IsStaleAsync(ann.Page));
        }

        await ann.Page.GetByText("There is no connection to the host. Trying again.").WaitForAsync(new() { Timeout = 20_000 });
        Assert.Equal((true, true), (await IsStaleAsync(ann.Page), (await agrees.InnerTextAsync()).EndsWith("not compared now", StringComparison.Ordinal)));
        await using ToolProcess next = new("host", "--scene", "billiards", "--web", port, "--key", "open sesame", "--timeout-s", $"{LongestSilence}");
        await next.AfterAsync("browsers join at ");
        await ann.Page.GetByText("Another host answers at this address now").WaitForAsync(new() { Timeout = 30_000 });
        Assert.Equal("again", await ann.Page.EvaluateAsync<string>("() => document.activeElement.id"));
        Assert.True(await IsStaleAsync(ann.Page));
        Assert.DoesNotContain("Ann", string.Join('\n', next.Lines), StringComparison.Ordinal); // not unasked
        await ann.Page.GetByRole(AriaRole.Button, new() { Name = "Join the other host" }).ClickAsync();
        await ann.Page.GetByText("This session needs a key").WaitForAsync(); // that of the host before is not sent
        await ann.AskAsync("Ann", "open sesame");
        await next.SaysAsync(line => line == "here: 0 player, 1 player Ann");
        await ann.RunningAsync();
        await ActsAsync(ann, "billiards");
        Assert.Equal((1, false), (await ann.Page.EvaluateAsync<int>("() => lagsim.held"), await IsStaleAsync(ann.Page)));
    }

    /// <summary>Whether the hashes are shown in grey, as not known now.</summary>
    private static Task<bool> IsStaleAsync(IPage page) => page.EvaluateAsync<bool>(
        "() => getComputedStyle(document.querySelector('.agrees')).color === getComputedStyle(document.querySelector('#session dt')).color");

    /// <summary>What the person does is seen: a key moves the mallet up, or a ball flies to the right that was thrown there.</summary>
    private static async Task ActsAsync(JoinedPage joined, string scene)
    {
        (string acts, string seen) = scene == "air-hockey" ? ("w", "frame[17] - frame[10]") : ("", "frame[9]"); // over the puck, which nobody has struck
        double before = await joined.Page.EvaluateAsync<double>($"() => {{ const {{ frame }} = lagsim.peers[0]; return {seen} }}");
        if (scene == "air-hockey")
        {
            await joined.Page.Keyboard.DownAsync(acts);
        }
        else
        {
            await joined.ThrowAsync(0, 100, 0);
        }

        await joined.Page.WaitForFunctionAsync($"before => {{ const {{ frame }} = lagsim.peers[0]; return {seen} > before + 0.1 }}", before, new() { Timeout = 5_000 });
        if (acts.Length > 0)
        {
            await joined.Page.Keyboard.UpAsync(acts);
        }

        await AgreesFromNowOnAsync(joined);
    }

    private static async Task AgreesFromNowOnAsync(JoinedPage joined)
    {
        double agreed = await joined.NumberAsync("agreed");
        await joined.AgreedAsync(agreed + 2);
        Assert.Equal(0, await joined.NumberAsync("differed"));
    }

    private static async Task<string[]> ProcessesAsync(IBrowser browser)
    {
        ICDPSession all = await browser.NewBrowserCDPSessionAsync();
        JsonElement? told = await all.SendAsync("SystemInfo.getProcessInfo");
        return [.. told!.Value.GetProperty("processInfo").EnumerateArray().Select(one => one.GetProperty("id").GetInt32().ToString(CultureInfo.InvariantCulture))];
    }

    private static async Task SignalAsync(string signal, string[] processes)
    {
        using Process kill = Process.Start("kill", [signal, .. processes]);
        await kill.WaitForExitAsync();
        Assert.Equal(0, kill.ExitCode);
    }
}
