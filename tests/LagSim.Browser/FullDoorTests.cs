using System;
using System.Linq;
using System.Net.WebSockets;
using System.Threading;
using System.Threading.Tasks;
using Microsoft.Playwright;
using Xunit;

namespace LagSim.Browser;

/// <summary>A host that has no room for another connection of a machine: its page says so, and goes on by itself once there is.</summary>
[Trait("Time", "real")]
public sealed class FullDoorTests(ServedPage served)
{
    private const string NoRoom = "The host has no room for another connection now.";
    private const int MostOfOneMachine = 32;

    [Fact]
    public async Task Page_WhileThereIsNoRoom_SaysSoAndGoesOnOnceThereIs()
    {
        await using ToolProcess host = new("host", "--scene", "billiards", "--web", "0");
        string address = await host.AfterAsync("browsers join at ");
        await using IBrowserContext context = await served.Browser.NewContextAsync(JoinedPage.Screen);
        JoinedPage ann = await JoinedPage.OpenAsync(context, address); // once it is built

        ClientWebSocket[] crowd = await FillAsync(address);
        await ann.Page.ReloadAsync();
        await ann.Page.GetByText(NoRoom).WaitForAsync();
        Assert.False(await ann.Page.Locator("#enter").IsVisibleAsync(), "The form is there, though nobody can join.");
        Array.ForEach(crowd, one => one.Dispose());
        await ann.Page.WaitForSelectorAsync("#enter:not([hidden])");
        Assert.False(await ann.Page.GetByText(NoRoom).IsVisibleAsync());

        crowd = await FillAsync(address);
        await ann.AskAsync("Ann");
        await ann.Page.GetByText(NoRoom).WaitForAsync();
        Array.ForEach(crowd, one => one.Dispose());
        await ann.AskAsync("Ann");
        await ann.RunningAsync();
        Assert.False(await ann.Page.GetByText(NoRoom).IsVisibleAsync());
    }

    /// <summary>Opens all WebSockets that this machine may have. They are safe for ten seconds.</summary>
    private static Task<ClientWebSocket[]> FillAsync(string address) => Task.WhenAll(Enumerable.Range(0, MostOfOneMachine).Select(async _ =>
    {
        ClientWebSocket socket = new();
        socket.Options.AddSubProtocol("lagsim");
        await socket.ConnectAsync(new Uri(address.Replace("http:", "ws:", StringComparison.Ordinal) + "session"), CancellationToken.None);
        return socket;
    }));
}
