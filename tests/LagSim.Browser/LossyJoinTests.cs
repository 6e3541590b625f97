using System;
using System.Diagnostics;
using System.Globalization;
using System.Threading.Tasks;
using Xunit;

namespace LagSim.Browser;

/// <summary>Browsers in a real session while packets of the page are lost: TCP sends them again, and what is old by then is not sent.</summary>
[Trait("Time", "real")]
public sealed class LossyJoinTests(ServedPage served)
{
    private const int Port = 8199;
    private const int Percent = 5; // each way

    [Fact]
    public async Task World_WhilePacketsOfThePageAreLost_IsTheSameAtEveryTime()
    {
        Assert.SkipUnless(
            Environment.GetEnvironmentVariable("LAGSIM_OWN_NETWORK") == "1",
            "Packets are lost by nftables only in a network namespace, which .ci/browser makes as root.");
        await SharedMinute.PlayAsync(served, Port, Lose);
    }

    private static void Lose()
    {
        string rules = string.Create(CultureInfo.InvariantCulture, $$"""
            add table inet lagsim
            add chain inet lagsim page { type filter hook input priority 0; }
            add rule inet lagsim page tcp dport {{Port}} numgen random mod 100 < {{Percent}} drop
            add rule inet lagsim page tcp sport {{Port}} numgen random mod 100 < {{Percent}} drop
            """);
        using Process nft = Process.Start(new ProcessStartInfo("nft", ["-f", "-"]) { RedirectStandardInput = true })!;
        nft.StandardInput.Write(rules);
        nft.StandardInput.Close();
        nft.WaitForExit();
        Assert.Equal(0, nft.ExitCode);
    }
}
