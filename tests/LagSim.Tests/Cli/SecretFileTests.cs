using System.IO;
using LagSim.Cli.Commands;
using LagSim.Cli.Output;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>Files of secrets, where two processes begin at once.</summary>
public sealed class SecretFileTests
{
    /// <summary>While one process draws a secret, another has kept its own: both have that one.</summary>
    [Fact]
    public void ReadOrDraw_WhileAnotherProcessKeepsOne_GivesThatOne()
    {
        using TemporaryFolder folder = new();
        string file = folder["secret"];
        string got = SecretFile.ReadOrDraw<string>("--identity", file, "a secret", text => text, () =>
        {
            File.WriteAllText(file, "the other's");
            return ("mine", "mine");
        });
        Assert.Equal("the other's", got);
        Assert.Equal("the other's", File.ReadAllText(file));
        Assert.Equal([file], Directory.GetFiles(Path.GetDirectoryName(file)!));
    }

    /// <summary>A disk that is full in the middle of a secret leaves the old file, and nothing beside it.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Replace_WhileTheDiskIsFull_LeavesTheOldFileAlone(bool isThere)
    {
        using TemporaryFolder folder = new();
        string file = folder["secret"];
        if (isThere)
        {
            File.WriteAllText(file, "of yesterday");
        }

        string? half = null;
        IOException failure = Assert.Throws<IOException>(() => SecretFile.Replace(file, draft =>
        {
            File.WriteAllText(draft, "ha");
            half = draft;
            throw new IOException("No space left on device");
        }));
        Assert.Equal("No space left on device", failure.Message);
        Assert.False(File.Exists(half));
        Assert.Equal(isThere ? [file] : [], Directory.GetFiles(folder.Path));
        Assert.Equal(isThere ? "of yesterday" : "", isThere ? File.ReadAllText(file) : "");

        // The control: with room it is replaced.
        SecretFile.Write(file, "of today");
        Assert.Equal([file], Directory.GetFiles(folder.Path));
        Assert.Equal("of today", File.ReadAllText(file).Trim());
    }

    /// <summary>Two keys of bytes that are no text were one key, with U+FFFD for each byte.</summary>
    [Fact]
    public void ReadLine_OfBytesThatAreNoText_IsRefused()
    {
        using TemporaryFolder folder = new();
        File.WriteAllBytes(folder["one"], [0x61, 0xFF, 0x0A]);
        File.WriteAllBytes(folder["two"], [0x61, 0xFE, 0x0A]);
        Assert.Equal(File.ReadAllText(folder["one"]), File.ReadAllText(folder["two"])); // the control: a decoder that is not strict
        Tool.Refuses(3, ["host", "--scene", "drop", "--key-file", folder["one"]], $"'{folder["one"]}' is not valid UTF-8");
        Tool.Refuses(3, ["join", "127.0.0.1:9", "--key-file", folder["two"]], $"'{folder["two"]}' is not valid UTF-8");
        Tool.Refuses(3, ["key", "--identity", folder["one"]], "is not valid UTF-8");
        Tool.Refuses(3, ["join", "127.0.0.1:9", "--pass", folder["one"]], "is not valid UTF-8");
        Tool.Refuses(3, ["token", "--secret", folder["one"]], "is not valid UTF-8");
        File.WriteAllText(folder["two"], "ä\n");
        Assert.Equal("ä", SecretFile.ReadLine(folder["two"]));
        Assert.Equal("it is not valid UTF-8.", Assert.Throws<InputException>(() => ReadKey("a\uFFFD")).Message[^22..]);
        Assert.Equal("ä", ReadKey("ä"));

        static string ReadKey(string input)
        {
            KeyOptions keys = new();
            System.CommandLine.Command command = new("any");
            keys.AddTo(command);
            return keys.Read(command.Parse(["--key", "-"]), new StringReader(input));
        }
    }

    [Fact]
    public void Tell_OfAFullDisk_NamesOptionFileCauseAndWhatComesOfIt()
    {
        using TemporaryFolder folder = new();
        IOException told = Assert.Throws<IOException>(() => SecretFile.Tell(
            "--identity", folder["id"], () => throw new IOException($"No space left on device : '{folder["id"]}.7.new'"), "The host's key is what it was."));
        Assert.Equal(
            $"--identity is '{folder["id"]}'; it must be a file that can be written. No space left on device : '{folder["id"]}.7.new'. The host's key is what it was.", told.Message);
    }

    [Fact]
    public void KeepFormer_OfAPass_ReplacesAnOlderCopy()
    {
        using TemporaryFolder folder = new();
        File.WriteAllText(folder["pass"], "former");
        File.WriteAllText(folder["pass.old"], "older");
        Assert.Equal(folder["pass.old"], PassFile.KeepFormer(folder["pass"]));
        Assert.Equal("former", File.ReadAllText(folder["pass.old"]));
        Assert.Null(PassFile.KeepFormer(folder["never-made"]));
        Assert.Equal("former", File.ReadAllText(folder["pass.old"]));
        Assert.Equal(2, Directory.GetFiles(folder.Path).Length);
    }
}
