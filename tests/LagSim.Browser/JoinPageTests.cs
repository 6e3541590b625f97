using System;
using System.Collections.Generic;
using System.Globalization;
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

        await again.AgreedAsync(2);
        JoinedPage.AssertSame(host.States, await again.StatesAsync(), 2);
        await again.Page.GetByRole(AriaRole.Button, new() { Name = "Leave" }).ClickAsync();
        await again.Page.GetByText("You have left.").WaitForAsync();
        await host.SaysAsync(line => line.StartsWith("peer 1 at ", StringComparison.Ordinal) && line.EndsWith(" is gone", StringComparison.Ordinal));
        Assert.Empty(again.Complaints);
    }

    /// <summary>A tab takes a seat at a time. With it: for how many milliseconds the tab stood still at most, since it answers others only while it runs.</summary>
    private const string TakeSeat =
        """
        async at => {
          const { Seat } = await import('./seats.mjs')
          let last = Date.now(), stood = 0
          const watch = setInterval(() => { const now = Date.now(); stood = Math.max(stood, now - last - 10); last = now }, 10)
          await new Promise(resolve => setTimeout(resolve, at - Date.now()))
          const seat = await Seat.take('somewhere')
          await new Promise(resolve => setTimeout(resolve, 300))
          clearInterval(watch)
          setTimeout(() => seat.leave(), 700)
          return [seat.number, stood]
        }
        """;

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
            int[][] seats = [];
            for (int tries = 0; tries < 10 && (tries == 0 || seats.Any(seat => seat[1] > 50)); tries++)
            {
                long at = DateTimeOffset.UtcNow.ToUnixTimeMilliseconds() + 300;
                seats = await Task.WhenAll(pages.Select((page, n) => page.EvaluateAsync<int[]>(TakeSeat, at + (n * apart))));
                await pages[0].WaitForTimeoutAsync(1200);
            }

            Assert.Equal([0, 1], seats.Select(seat => seat[0]).Order());
        }
    }

    /// <summary>Who is not let in has the form still, with what was typed, and the reason below its field. What was left is given up.</summary>
    [Fact]
    public async Task Form_WithAWrongKeyOrName_StaysAndSaysSo()
    {
        await using ToolProcess host = new("host", "--scene", "billiards", "--web", "0", "--key", "open sesame");
        string address = await host.AfterAsync("browsers join at ");
        await using IBrowserContext context = await served.Browser.NewContextAsync(JoinedPage.Screen);
        JoinedPage joined = await JoinedPage.OpenAsync(context, address);
        IPage page = joined.Page;
        List<IWebSocket> sockets = [];
        page.WebSocket += (_, socket) => sockets.Add(socket);
        await joined.AskAsync("Ann");
        await IsWrongAsync(page, "key", "This session needs a key. Ask whoever started it.");
        Assert.Empty(sockets);
        await joined.AskAsync("Ann", "open rye");
        await IsWrongAsync(page, "key", "This key is wrong.");
        Assert.Equal("Ann", await page.InputValueAsync("#name"));
        Assert.False(await page.Locator("#session").IsVisibleAsync(), "What it says of a session replaces the form.");

        await page.EvaluateAsync("() => { localStorage.clear(); localStorage.setItem('lagsim name', 'W'.repeat(40)) }");
        await joined.LoadAsync(address);
        Assert.Equal(new string('W', 40), await page.InputValueAsync("#name")); // a name that was kept is not cut either
        await page.FillAsync("#key", "open sesame");
        await page.ClickAsync("#enter button");
        await IsWrongAsync(page, "name", "A name has at most 24 characters; this one has 40.");
        sockets.Clear();
        await joined.AskAsync("Ann", "open rye");
        await IsWrongAsync(page, "key", "This key is wrong.");
        await joined.AskAsync("Ann", "open sesame");
        await joined.RunningAsync();
        Assert.Equal("", await page.InnerTextAsync("#key-problem"));
        Assert.Equal((2, 1), (sockets.Count, sockets.Count(socket => !socket.IsClosed))); // else the one before would be opened again for ever
        Assert.Equal(1, await page.EvaluateAsync<int>("() => lagsim.held"));
        Assert.Empty(joined.Complaints);

        await host.EndInOrderAsync();
        await page.GetByText("The host ended the session. Once it is there again, you can join again.").WaitForAsync();
        Assert.True(await page.EvaluateAsync<bool>(
            """
            () => {
              const { activeElement } = document, { top, bottom } = activeElement.getBoundingClientRect()
              return activeElement.id === 'again' && top >= 0 && bottom <= innerHeight
            }
            """), "Who goes by keys, or looks at a phone, does not find the button.");
        Assert.Equal(0, await page.EvaluateAsync<int>("() => lagsim.held"));
        await using ToolProcess next = new("host", "--scene", "billiards", "--web", new Uri(address).Port.ToString(CultureInfo.InvariantCulture), "--key", "open sesame");
        await next.AfterAsync("browsers join at "); // another host, since it has no identity
        await page.GetByRole(AriaRole.Button, new() { Name = "Join again" }).ClickAsync();
        await joined.AskAsync("Ann", "open sesame");
        await page.GetByText("Another host answers at this address now").WaitForAsync();
        Assert.Equal("", await page.InputValueAsync("#key")); // what was typed for the one before is not for this one
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
            await ann.AgreedAsync(1);
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

    /// <summary>Only the page knows where it was opened: a server between it and the host may call the host something else.</summary>
    [Fact]
    public async Task Page_OpenedByANameThatTheHostDoesNotKnow_SaysWhatHelps()
    {
        await using ToolProcess host = new("host", "--scene", "drop", "--web", "0");
        string own = await host.AfterAsync("browsers join at "), named = own.Replace("127.0.0.1", "friend.localhost", StringComparison.Ordinal);
        string origin = named.TrimEnd('/'), authority = new Uri(own).Authority;
        await using IBrowserContext context = await served.Browser.NewContextAsync();
        await JoinedPage.OpenAsync(context, own); // the control: by a name that it knows
        IPage page = await context.NewPageAsync();
        string said = await ProblemAsync(page, named);
        Assert.Contains($"open {own} instead", said, StringComparison.Ordinal);
        Assert.Contains($"--web-origin {origin} the host would know it", said, StringComparison.Ordinal);

        string passedOn = "backend:8080";
        await page.RouteAsync("**/session?*", async route => await route.FulfillAsync(new()
        {
            Response = await route.FetchAsync(new() { Url = $"{own}session{new Uri(route.Request.Url).Query}", Headers = [new("Host", passedOn)] }),
        }));
        said = await ProblemAsync(page, named);
        Assert.Contains($"by the name '{passedOn}'", said, StringComparison.Ordinal);
        Assert.Contains($"--web-origin {origin} --web-origin http://{passedOn}", said, StringComparison.Ordinal);
        passedOn = authority; // as many servers do
        said = await ProblemAsync(page, named);
        Assert.Equal($"The host does not let in pages from {origin}. Started with --web-origin {origin} it does.", said);
    }

    private static async Task<string> ProblemAsync(IPage page, string address)
    {
        await page.GotoAsync(address);
        await page.Locator("#problem").WaitForAsync();
        return await page.InnerTextAsync("#problem");
    }

    /// <summary>Waits until a field of the form says what is wrong with it, and asserts that a person finds that, with whatever senses.</summary>
    private static async Task IsWrongAsync(IPage page, string field, string sentence)
    {
        await page.Locator($"#{field}-problem").Filter(new() { HasText = sentence }).WaitForAsync();
        await page.WaitForFunctionAsync("field => document.activeElement.id === field", field, new() { Timeout = 5_000 });
        Assert.Equal("true", await page.GetAttributeAsync($"#{field}", "aria-invalid"));
        Assert.Contains($"{field}-problem", await page.GetAttributeAsync($"#{field}", "aria-describedby"), StringComparison.Ordinal);
        Assert.True(await page.Locator("#enter button").IsEnabledAsync());
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
