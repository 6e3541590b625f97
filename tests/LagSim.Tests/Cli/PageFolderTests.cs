using System;
using System.IO;
using LagSim.Cli.Output;
using LagSim.Cli.Web;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>A page is built again when something that it is made of has changed, and only then.</summary>
public sealed class PageFolderTests : IDisposable
{
    private static readonly DateTime Built = new(2026, 1, 2, 3, 4, 5, DateTimeKind.Utc);

    private readonly DirectoryInfo root = Directory.CreateTempSubdirectory("lagsim").CreateSubdirectory("bin"); // a clone may lie in any folder

    public PageFolderTests()
    {
        foreach (string file in new[] { "src/Play/Page.cs", "src/Play/bin/Page.dll", "src/Play/obj/cache", "samples/AirHockey/Rules.cs", "props" })
        {
            Write(file, Built.AddMinutes(-1));
        }
    }

    public void Dispose() => root.Parent!.Delete(recursive: true);

    [Theory]
    [InlineData("src/Play/bin/Page.dll", true)] // what a build has made
    [InlineData("src/Play/obj/cache", true)]
    [InlineData("src/Play/Page.cs", false)]
    [InlineData("src/Play/New.cs", false)]
    [InlineData("samples/AirHockey/Rules.cs", false)]
    [InlineData("props", false)]
    public void Page_AfterAFileHasChanged_IsNewerOrNot(string file, bool isNewer)
    {
        Write("bin/stamp", Built);
        string stamp = Path.Combine(root.FullName, "bin/stamp");
        Assert.True(PageFolder.IsNewerThanSources(stamp, root.FullName));
        Write(file, Built.AddMinutes(1));
        Assert.Equal(isNewer, PageFolder.IsNewerThanSources(stamp, root.FullName));
        File.Delete(stamp);
        Assert.False(PageFolder.IsNewerThanSources(stamp, root.FullName)); // it was never built
    }

    /// <summary>A build that was cut off leaves nothing that the next one could take for done, and what is empty all the same is told.</summary>
    [Fact]
    public void Page_WhoseBuildWasCutOff_IsBuiltFromNothing()
    {
        string At(string file) => Path.Combine(root.FullName, file);
        foreach (string file in new[] { "page.built", "page/wwwroot/a.wasm", "obj/Release/net10.0/compressed/publish/a.wasm.br", "obj/Release/net10.0/a.dll" })
        {
            Write(file, Built);
        }

        Assert.Contains("a.wasm' is empty", Assert.Throws<InputException>(() => PageFolder.ThrowIfEmpty(At("page"))).Message, StringComparison.Ordinal);
        File.WriteAllText(At("page/wwwroot/a.wasm"), "x");
        PageFolder.ThrowIfEmpty(At("page"));
        PageFolder.Clear(At("page.built"), At("page"), At("obj"));
        Assert.Equal((false, false, false, true), (
            File.Exists(At("page.built")), Directory.Exists(At("page")), File.Exists(At("obj/Release/net10.0/compressed/publish/a.wasm.br")),
            File.Exists(At("obj/Release/net10.0/a.dll"))));
        PageFolder.Clear(At("page.built"), At("page"), At("obj")); // of a fresh clone
    }

    private void Write(string file, DateTime at)
    {
        string path = Path.Combine(root.FullName, file);
        Directory.CreateDirectory(Path.GetDirectoryName(path)!);
        File.WriteAllText(path, "");
        File.SetLastWriteTimeUtc(path, at);
    }
}
