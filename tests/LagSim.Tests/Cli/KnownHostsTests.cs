using System;
using System.IO;
using LagSim.Cli.Commands;
using LagSim.Cli.Output;
using LagSim.Net.Protection;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>Hosts that were trusted once are remembered by address, and another one there is refused; keys come from elsewhere than the command line.</summary>
[Collection(RealTime.Name)]
[Trait("Time", "real")]
public sealed class KnownHostsTests
{
    private const string Hosting = "host --scene drop --history-s 0.2 --for-s 60 --identity";

    /// <summary>
    /// Another host takes the address of one that was joined before. Where it is not remembered it is joined all the same: the attack. Where it
    /// is, it is refused with file and line, until one says otherwise.
    /// </summary>
    [Fact]
    public void Join_AnotherHostAtAKnownAddress_IsRefusedUntilOneSaysOtherwise()
    {
        using TemporaryFolder folder = new();
        string known = folder["settings/known_hosts"], address;
        using (LiveTool first = LiveTool.Run(Hosting, folder["one.secret"]))
        {
            address = first.Address;
            using LiveTool client = ComesIn($"join {address} --known-hosts", known);
            Assert.Contains($"It is remembered in '{known}'; another one at {address} will be refused.", client.Error.ToString(), StringComparison.Ordinal);
            using LiveTool again = ComesIn($"join {address} --known-hosts", known);
            Assert.DoesNotContain("Trusting", again.Error.ToString(), StringComparison.Ordinal);
        }

        string line = File.ReadAllText(known).Trim();
        Assert.StartsWith($"{address} ", line, StringComparison.Ordinal);
        using LiveTool other = LiveTool.Run($"{Hosting} {folder["two.secret"]} --port", address.Split(':')[1]);
        Assert.Equal(address, other.Address);
        using LiveTool unaware = ComesIn($"join {address}"); // the control
        Assert.Contains("Trusting the host that answered first.", unaware.Error.ToString(), StringComparison.Ordinal);
        Assert.DoesNotContain("remembered", unaware.Error.ToString(), StringComparison.Ordinal); // this machine's own
        using LiveTool refused = LiveTool.Run($"join {address} --timeout-s 1 --known-hosts", known);
        refused.Ends(3);
        Assert.Contains($"Line 1 of '{known}' says that the host at {address} has the fingerprint {line[(address.Length + 1)..]}; the one that answers shows ", refused.Error.ToString(), StringComparison.Ordinal);
        Assert.Equal(line, File.ReadAllText(known).Trim());
        using LiveTool anew = ComesIn($"join {address} --trust-new --known-hosts", known);
        Assert.NotEqual(line, File.ReadAllText(known).Trim());
        Assert.Single(File.ReadAllLines(known));
    }

    [Fact]
    public void File_WithOtherHostsAndComments_KeepsThemAndNamesABadLine()
    {
        using TemporaryFolder folder = new();
        using HostIdentity one = HostIdentity.Draw(), two = HostIdentity.Draw();
        KnownHosts hosts = new(folder["known"]);
        Assert.Null(hosts.Find("a:1"));
        File.WriteAllText(folder["known"], $"# mine\n\n  b:2   {two.Fingerprint}"); // no end of line
        hosts.Remember("a:1", one.Fingerprint);
        Assert.Equal((two.Fingerprint, 3), hosts.Find("b:2"));
        Assert.Equal((one.Fingerprint, 4), hosts.Find("a:1"));
        hosts.Remember("b:2", one.Fingerprint);
        Assert.Equal((one.Fingerprint, 4), hosts.Find("b:2"));
        Assert.Equal("# mine", File.ReadAllLines(folder["known"])[0]);
        File.AppendAllText(folder["known"], "c:3 12345");
        InputException bad = Assert.Throws<InputException>(() => hosts.Find("d:4"));
        Assert.Contains($"Line 5 of '{folder["known"]}' is 'c:3 12345'", bad.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Key_FromAFileOrStandardInput_IsThatOfTheCommandLine()
    {
        using TemporaryFolder folder = new();
        File.WriteAllText(folder["key"], "open sesame\n");
        using LiveTool host = new([.. Hosting.Split(' '), folder["secret"], "--key", "open sesame"]);
        string address = host.Address;
        using LiveTool byFile = ComesIn($"join {address} --key-file", folder["key"]);
        using ToolProcess byInput = ToolProcess.Start($"join {address} --key -");
        byInput.Types("open sesame");
        byInput.Says("here: ");
        using ToolProcess wrong = ToolProcess.Start($"join {address} --key -");
        wrong.Types("open says me");
        wrong.Ends(3);
        Assert.Contains("the key is wrong", wrong.Error.ToString(), StringComparison.Ordinal);
        Assert.NotNull(host.Error.WaitFor(line => line.StartsWith("A wrong key came from 127.0.0.1:", StringComparison.Ordinal), LiveTool.Deadline)); // the operator is told
    }

    [Fact]
    public void Options_ThatCannotBe_AreRefusedWithWhatIsWrong()
    {
        using TemporaryFolder folder = new();
        string fingerprint = new('a', HostFingerprint.TextLength);
        File.WriteAllText(folder["empty"], "\n");
        File.WriteAllText(folder["long"], new string('k', 257));
        Tool.Refuses(2, ["join", "127.0.0.1:9", "--key", "a", "--key-file", "b"], "--key contradicts --key-file");
        Tool.Refuses(2, ["join", $"lagsim://127.0.0.1:9#{fingerprint}", "--key", "-", "--token", "-"], "--key and --token are both '-'");
        Tool.Refuses(2, ["join", "127.0.0.1:9", "--unprotected", "--trust-new"], "--unprotected contradicts --trust-new");
        Tool.Refuses(2, ["join", $"lagsim://127.0.0.1:9#{fingerprint}", "--trust-new"], "--trust-new contradicts an address with a fingerprint");
        Tool.Refuses(3, ["join", "127.0.0.1:9", "--key-file", folder["none"]], "there is no such file");
        Tool.Refuses(3, ["host", "--scene", "drop", "--key-file", folder["empty"]], "does not hold a key: a line of 1 to 256 characters");
        Tool.Refuses(3, ["host", "--scene", "drop", "--key-file", folder["long"]], "does not hold a key: a line of 1 to 256 characters");
    }

    /// <summary>Runs a client until it is in, and interrupts it.</summary>
    private static LiveTool ComesIn(string line, params string[] more)
    {
        LiveTool client = LiveTool.Run(line, more);
        Assert.True(client.Output.WaitFor(said => said.StartsWith("here: ", StringComparison.Ordinal), LiveTool.Deadline) is not null, client.ToString());
        client.Stop();
        return client.Ends(130);
    }
}
