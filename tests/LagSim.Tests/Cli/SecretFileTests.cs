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
}
