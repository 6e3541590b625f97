using System;
using System.IO;
using System.Linq;
using System.Security.Cryptography;
using System.Security.Cryptography.X509Certificates;
using System.Threading.Tasks;
using Microsoft.Playwright;
using Xunit;

namespace LagSim.Browser;

/// <summary>Browsers in a real session: a native host, a native peer over UDP, and tabs over WebSockets.</summary>
[Trait("Time", "real")]
public sealed class JoinPageTests(ServedPage served)
{
    [Fact]
    public async Task Tab_ClosedAndOpenedAgain_GoesOnAsTheSamePlayer()
    {
        await using ToolProcess host = new("host", "--scene", "billiards", "--per-address", "8", "--web", "0", "--key", "open sesame");
        string page = await host.AfterAsync("browsers join at ");
        await using IBrowserContext context = await served.Browser.NewContextAsync(JoinedPage.Screen);
        JoinedPage ann = await JoinedPage.JoinAsync(context, page, "Ann", "open sesame"), bob = await JoinedPage.JoinAsync(context, page, "Bob", "open sesame");
        Assert.Equal((1, 2), (await ann.NumberAsync("player"), await bob.NumberAsync("player"))); // two tabs of one browser are two players
        await ann.ThrowAsync(0, 100, 40);

        await ann.Page.CloseAsync();
        await bob.Page.ReloadAsync(); // though Ann's seat is free now
        await bob.RunningAsync();
        Assert.Equal(2, await bob.NumberAsync("player"));
        JoinedPage again = await JoinedPage.OpenAsync(context, page);
        Assert.Equal("Ann", await again.Page.InputValueAsync("#name")); // though Bob was here last
        await again.AskAsync("Ann", "open sesame");
        await again.RunningAsync();
        Assert.Equal(1, await again.NumberAsync("player"));
        await again.ThrowAsync(3, -80, 60);
        await again.Page.ReloadAsync(); // goes in by itself, with the key
        await again.RunningAsync();
        Assert.Equal((1, 2), (await again.NumberAsync("player"), await bob.NumberAsync("player")));

        await again.Page.WaitForFunctionAsync("() => window.lagsim.status.agreed >= 2", null, new() { Timeout = 20_000 });
        JoinedPage.AssertSame(host.States, await again.StatesAsync(), 2);
        await again.Page.GetByRole(AriaRole.Button, new() { Name = "Leave" }).ClickAsync();
        await again.Page.GetByText("This peer left.").WaitForAsync();
        await host.SaysAsync(line => line.StartsWith("peer 1 at ", StringComparison.Ordinal) && line.EndsWith(" is gone", StringComparison.Ordinal));
        Assert.Empty(again.Complaints);
    }

    /// <summary>However close to each other tabs are opened, each has a seat of its own, by what they say to each other alone.</summary>
    [Fact]
    public async Task Seats_TakenAtTheSameTime_AreNotTheSame()
    {
        await using IBrowserContext context = await served.Browser.NewContextAsync();
        await context.AddInitScriptAsync(
            "Object.defineProperty(window, 'localStorage', { get() { throw new DOMException('Access is denied') } })");
        IPage[] pages = [await context.NewPageAsync(), await context.NewPageAsync()];
        await Task.WhenAll(pages.Select(page => page.GotoAsync(served.Address)));
        foreach (int apart in new[] { 0, 1, 30, 100, 100, 100, 100, 100, 100, 190, 210 })
        {
            long at = DateTimeOffset.UtcNow.ToUnixTimeMilliseconds() + 300;
            int[] seats = await Task.WhenAll(pages.Select((page, n) => page.EvaluateAsync<int>(
                """
                async at => {
                  const { Seat } = await import('./seats.mjs')
                  await new Promise(resolve => setTimeout(resolve, at - Date.now()))
                  const seat = await Seat.take('somewhere')
                  setTimeout(() => seat.leave(), 1000)
                  return seat.number
                }
                """, at + (n * apart))));
            Assert.Equal([0, 1], seats.Order());
            await pages[0].WaitForTimeoutAsync(1200);
        }
    }

    [Fact]
    public async Task Key_ThatIsWrong_IsRefusedWithTheReason()
    {
        await using ToolProcess host = new("host", "--scene", "billiards", "--web", "0", "--key", "open sesame");
        string address = await host.AfterAsync("browsers join at ");
        await using IBrowserContext context = await served.Browser.NewContextAsync(JoinedPage.Screen);
        JoinedPage joined = await JoinedPage.OpenAsync(context, address);
        await joined.AskAsync("Ann", "open rye");
        IPage page = joined.Page;
        await page.GetByRole(AriaRole.Button, new() { Name = "Join again" }).WaitForAsync();
        Assert.Contains("key", await page.Locator("#state").InnerTextAsync(), StringComparison.Ordinal);
        await page.GetByRole(AriaRole.Button, new() { Name = "Join again" }).ClickAsync();
        Assert.Equal("key", await page.EvaluateAsync<string>("() => document.activeElement.id"));
        await joined.AskAsync("Ann", "open sesame");
        await joined.RunningAsync();
    }

    /// <summary>A page in a browser that keeps nothing, and over HTTPS.</summary>
    [Fact]
    public async Task Page_OverHttpsInABrowserThatKeepsNothing_Joins()
    {
        using RSA key = RSA.Create(2048);
        CertificateRequest request = new("CN=localhost", key, HashAlgorithmName.SHA256, RSASignaturePadding.Pkcs1);
        using X509Certificate2 certificate = request.CreateSelfSigned(DateTimeOffset.UtcNow.AddDays(-1), DateTimeOffset.UtcNow.AddDays(1));
        string file = Path.GetTempFileName();
        try
        {
            await File.WriteAllTextAsync(file, $"{certificate.ExportCertificatePem()}\n{key.ExportPkcs8PrivateKeyPem()}", TestContext.Current.CancellationToken);
            await using ToolProcess host = new("host", "--scene", "billiards", "--web", "0", "--web-certificate", file);
            string address = await host.AfterAsync("browsers join at ");
            Assert.StartsWith("https://", address, StringComparison.Ordinal);
            await using IBrowserContext context = await served.Browser.NewContextAsync(new() { IgnoreHTTPSErrors = true });
            await context.AddInitScriptAsync(
                "Object.defineProperty(window, 'localStorage', { get() { throw new DOMException('Access is denied') } })");
            JoinedPage ann = await JoinedPage.JoinAsync(context, address, "Ann");
            await ann.Page.WaitForFunctionAsync("() => window.lagsim.status.agreed >= 1", null, new() { Timeout = 20_000 });
            Assert.Contains("the host's", await ann.Page.Locator(".agrees span").InnerTextAsync(), StringComparison.Ordinal);
            Assert.Empty(ann.Complaints);
        }
        finally
        {
            File.Delete(file);
        }
    }

    [Fact]
    public async Task Page_OfAnotherOrigin_IsRefusedUnlessItIsNamed()
    {
        await using OtherServer other = await OtherServer.StartAsync(AppContext.BaseDirectory);
        string origin = new Uri(other.Address).GetLeftPart(UriPartial.Authority);
        await using ToolProcess strict = new("host", "--scene", "drop", "--web", "0"), open = new("host", "--scene", "drop", "--web", "0", "--web-origin", origin);
        string own = await strict.AfterAsync("browsers join at "), theirs = await open.AfterAsync("browsers join at ");
        await using IBrowserContext context = await served.Browser.NewContextAsync();
        IPage foreign = await context.NewPageAsync();
        await foreign.GotoAsync(other.Address);
        Assert.Equal("refused", await ConnectAsync(foreign, own));
        Assert.Equal("open", await ConnectAsync(foreign, theirs));
        Assert.Equal("refused", await ConnectAsync(foreign, own.Replace("127.0.0.1", "localhost", StringComparison.Ordinal))); // another name of it

        IPage at = await context.NewPageAsync();
        await at.GotoAsync(own); // the control: its own page is let in, whatever it is called
        Assert.Equal("open", await ConnectAsync(at, own));
        await at.GotoAsync(own.Replace("127.0.0.1", "localhost", StringComparison.Ordinal));
        Assert.Equal("open", await ConnectAsync(at, own.Replace("127.0.0.1", "localhost", StringComparison.Ordinal)));
    }

    private static async Task<string> ConnectAsync(IPage page, string host) => await page.EvaluateAsync<string>(
        """
        address => new Promise(resolve => {
          const socket = new WebSocket(address, 'lagsim')
          socket.onopen = () => { resolve('open'); socket.close() }
          socket.onerror = () => resolve('refused')
        })
        """, host.Replace("http:", "ws:", StringComparison.Ordinal) + "session");
}
