using System;
using System.IO;
using System.Linq;
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

    /// <summary>
    /// A host changes its key. Who remembers it joins all the same, is told, and remembers the new one, by which it joins when the former is
    /// forgotten; who was given the former fingerprint by then does not.
    /// </summary>
    [Fact]
    public void Join_AHostThatChangedItsKey_IsToldAndRemembersTheNewOne()
    {
        using TemporaryFolder folder = new();
        string known = folder["known_hosts"], secret = folder["host.secret"], address, former;
        using (LiveTool first = LiveTool.Run(Hosting, secret))
        {
            address = first.Address;
            using LiveTool client = ComesIn($"join {address} --known-hosts", known);
            former = File.ReadAllText(known).Trim().Split(' ')[1];
        }

        Assert.Contains($"fingerprint {former}", Tool.Run("key", "--identity", secret).Done().Output, StringComparison.Ordinal);
        string[] said = Tool.Run("key", "--identity", secret, "--change", "--keep-days", "2").Done().Output.Split('\n');
        string changed = said[0].Split(' ')[1].Trim();
        Assert.NotEqual(former, changed);
        Assert.StartsWith($"former {former} until 20", said[1], StringComparison.Ordinal);
        using (LiveTool second = LiveTool.Run($"{Hosting} {secret} --port", address.Split(':')[1]))
        {
            Assert.NotNull(second.Output.WaitFor(line => line.StartsWith($"also known as {former} until 20", StringComparison.Ordinal), LiveTool.Deadline));
            using LiveTool given = ComesIn($"join lagsim://{address}#{former}");
            Assert.Contains($"its former one vouches for the new. Join it as lagsim://{address}#{changed} from now on.", given.Error.ToString(), StringComparison.Ordinal);
            using LiveTool client = ComesIn($"join {address} --known-hosts", known);
            Assert.Contains($"It is remembered in '{known}' in place of the former.", client.Error.ToString(), StringComparison.Ordinal);
            Assert.Equal($"{address} {changed}", File.ReadAllText(known).Trim());
        }

        Assert.DoesNotContain("former", Tool.Run("key", "--identity", secret, "--forget-former").Done().Output, StringComparison.Ordinal);
        using LiveTool third = LiveTool.Run($"{Hosting} {secret} --port", address.Split(':')[1]);
        Assert.Equal(address, third.Address);
        using LiveTool again = ComesIn($"join {address} --known-hosts", known);
        Assert.DoesNotContain("vouches", again.Error.ToString(), StringComparison.Ordinal);
        using LiveTool refused = LiveTool.Run($"join lagsim://{address}#{former} --timeout-s 1");
        refused.Ends(3);
    }

    /// <summary>Eight programs remember ten hosts each at once, over a symbolic link: none is lost, and the link stays a link.</summary>
    [Fact]
    public void Remember_ByManyAtOnceOverALink_LosesNothing()
    {
        using TemporaryFolder folder = new();
        using HostIdentity one = HostIdentity.Draw();
        string target = folder["elsewhere"], link = folder["known"];
        File.WriteAllText(target, "# mine\n");
        File.CreateSymbolicLink(link, target);
        System.Threading.Tasks.Parallel.For(0, 8, program =>
        {
            for (int n = 0; n < 10; n++)
            {
                new KnownHosts(link).Remember($"{program}:{n}", one.Fingerprint);
            }
        });
        Assert.Equal(81, File.ReadAllLines(target).Length);
        Assert.Equal(target, new FileInfo(link).LinkTarget);
        KnownHosts hosts = new(link);
        Assert.All(Enumerable.Range(0, 80), n => Assert.NotNull(hosts.Find($"{n / 10}:{n % 10}")));

        // The control: two that read before either writes, as they did without the lock.
        string[] mine = File.ReadAllLines(link), its = File.ReadAllLines(link);
        File.WriteAllLines(link, [.. mine, $"a:1 {one.Fingerprint}"]);
        File.WriteAllLines(link, [.. its, $"b:1 {one.Fingerprint}"]);
        Assert.Null(hosts.Find("a:1"));

        // A link that leads nowhere yet.
        File.CreateSymbolicLink(folder["new"], folder["not-there-yet"]);
        new KnownHosts(folder["new"]).Remember("c:1", one.Fingerprint);
        Assert.Single(File.ReadAllLines(folder["not-there-yet"]));
        Assert.Equal(folder["not-there-yet"], new FileInfo(folder["new"]).LinkTarget);
    }

    /// <summary>A folder in which nothing can be written is told as that. That another program holds the file is for where it does: the test of many at once waits for that.</summary>
    [Fact]
    public void Remember_WhereNothingCanBeWritten_SaysThatAtOnce()
    {
        Assert.SkipUnless(OperatingSystem.IsLinux(), "/proc is Linux's.");
        using HostIdentity one = HostIdentity.Draw();
        IOException told = Assert.Throws<IOException>(() => new KnownHosts("/proc/kh").Remember("a:1", one.Fingerprint));
        Assert.Equal("'/proc/kh' cannot be written. The file system at '/proc' lets nothing be made there.", told.Message);
    }

    /// <summary>An IPv4 address that is written as one of IPv6 is joined over IPv4, and remembered as that; who has no key is told to give one.</summary>
    [Fact]
    public void Join_AMappedAddress_ComesInAndIsRememberedAsIPv4()
    {
        using TemporaryFolder folder = new();
        using LiveTool host = LiveTool.Run($"{Hosting} {folder["secret"]} --key sesame");
        string address = host.Address, mapped = $"[::ffff:127.0.0.1]:{address.Split(':')[1]}", known = folder["known_hosts"];
        using LiveTool client = ComesIn($"join {mapped} --key sesame --known-hosts", known);
        string[] line = File.ReadAllText(known).Trim().Split(' ');
        Assert.Equal(address, line[0]);
        using LiveTool whole = ComesIn($"join lagsim://{mapped}#{line[1]} --key sesame");
        using LiveTool without = LiveTool.Run($"join {address}");
        without.Ends(3);
        Assert.Contains($"The host at {address} refused: it needs a key, and this peer has none.", without.Error.ToString(), StringComparison.Ordinal);
        Assert.Contains("This host needs a key: --key TEXT, or --key-file FILE.", without.Error.ToString(), StringComparison.Ordinal);
    }

    /// <summary>A key has the blanks that it is given, wherever it comes from: all but the end of the line.</summary>
    [Theory]
    [InlineData("  open sesame ")]
    [InlineData("\t")]
    public void Key_WithBlanks_IsTheSameFromEverywhere(string key)
    {
        using TemporaryFolder folder = new();
        foreach (string end in new[] { "", "\n", "\r\n" })
        {
            File.WriteAllText(folder["key"], key + end);
            Assert.Equal([key, key, key], new[] { Read("--key", key), Read("--key-file", folder["key"]), Read("--key", "-", key + end) });
        }

        static string Read(string option, string value, string input = "")
        {
            KeyOptions keys = new();
            System.CommandLine.Command command = new("any");
            keys.AddTo(command);
            return keys.Read(command.Parse([option, value]), new StringReader(input));
        }
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
        Tool.Refuses(3, ["key", "--identity", folder["none"]], "there is no such file");
        Tool.Refuses(3, ["key", "--identity", folder["long"]], "does not hold a host's identity");
        Tool.Refuses(2, ["key", "--identity", folder["none"], "--change", "--forget-former"], "--change contradicts --forget-former");
        Tool.Refuses(2, ["key", "--identity", folder["none"], "--keep-days", "3"], "--keep-days needs --change");
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
