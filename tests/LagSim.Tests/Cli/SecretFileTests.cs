using System.IO;
using LagSim.Cli.Commands;
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
