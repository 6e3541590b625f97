using System;
using System.Collections.Generic;
using System.Formats.Tar;
using System.IO;
using System.IO.Compression;
using System.Linq;
using System.Reflection.Metadata;
using System.Reflection.PortableExecutable;
using System.Text.Json;
using System.Text.RegularExpressions;
using Xunit;

namespace LagSim.Tests.Api;

/// <summary>The folder that Unity's package manager reads, as the build lays it out. What Unity itself does with it is not tried here.</summary>
public sealed class UnityPackageTests : IDisposable
{
    private readonly string copy = Directory.CreateTempSubdirectory("lagsim-upm").FullName;

    private static string Package => Path.Combine(
        RepositoryRoot.Path, "src", "LagSim.Unity", "bin", Path.GetFileName(Path.GetDirectoryName(AppContext.BaseDirectory.TrimEnd('/', '\\')))!, "package");

    [Fact]
    public void Package_AsBuilt_HasAManifestOfThisVersion()
    {
        using JsonDocument manifest = JsonDocument.Parse(File.ReadAllText(Path.Combine(Package, "package.json")));
        string props = File.ReadAllText(Path.Combine(RepositoryRoot.Path, "Directory.Build.props"));
        string version = Regex.Match(props, "<Version>(.*)</Version>").Groups[1].Value;

        Assert.Equal(version, manifest.RootElement.GetProperty("version").GetString());
        Assert.Matches("^com(\\.[a-z0-9-]+){2}$", manifest.RootElement.GetProperty("name").GetString());
        Assert.Matches("^[0-9]{4}\\.[0-9]$", manifest.RootElement.GetProperty("unity").GetString());
    }

    [Fact]
    public void Package_PackedAndUnpacked_IsWhole()
    {
        Pack(Package, copy);

        Assert.Equal(Files(Package), Files(Path.Combine(copy, "package")));
        Assert.Empty(Faults(Path.Combine(copy, "package")));
    }

    /// <summary>The controls: each fault that Unity would stumble over is seen.</summary>
    [Theory]
    [InlineData("Runtime/LagSim.dll.meta", "Runtime/LagSim.dll has no .meta")]
    [InlineData("Runtime/LagSim.dll", "Runtime/LagSim.dll.meta is of nothing")]
    public void Package_WithoutAFile_IsFound(string file, string fault)
    {
        Pack(Package, copy);
        string package = Path.Combine(copy, "package");
        File.Delete(Path.Combine(package, file));

        Assert.Contains(fault, Faults(package));
    }

    [Fact]
    public void Package_WithTwoOfOneIdentity_IsFound()
    {
        Pack(Package, copy);
        string package = Path.Combine(copy, "package");
        File.Copy(Path.Combine(package, "README.md.meta"), Path.Combine(package, "LICENSE.md.meta"), overwrite: true);

        Assert.Contains(Faults(package), fault => fault.Contains("the same guid", StringComparison.Ordinal));
    }

    [Fact]
    public void Package_WithALibraryOfAnotherRuntime_IsFound()
    {
        Pack(Package, copy);
        string package = Path.Combine(copy, "package");
        File.Copy(typeof(Simulation).Assembly.Location, Path.Combine(package, "Runtime", "LagSim.dll"), overwrite: true); // of .NET 10

        Assert.Contains(Faults(package), fault => fault.StartsWith("Runtime/LagSim.dll needs System.Runtime", StringComparison.Ordinal));
    }

    public void Dispose() => Directory.Delete(copy, recursive: true);

    /// <summary>Packs as the package manager's tarballs are, and unpacks again.</summary>
    private static void Pack(string package, string into)
    {
        string tarball = Path.Combine(into, "lagsim.tgz");
        using (GZipStream zip = new(File.Create(tarball), CompressionLevel.Fastest))
        {
            TarFile.CreateFromDirectory(package, zip, includeBaseDirectory: true);
        }

        using GZipStream read = new(File.OpenRead(tarball), CompressionMode.Decompress);
        TarFile.ExtractToDirectory(read, into, overwriteFiles: false);
    }

    private static List<string> Faults(string package)
    {
        List<string> faults = [];
        string[] all = [.. Directory.EnumerateFileSystemEntries(package, "*", SearchOption.AllDirectories)
            .Select(entry => Path.GetRelativePath(package, entry).Replace('\\', '/')).Order(StringComparer.Ordinal)];
        string[] metas = [.. all.Where(entry => entry.EndsWith(".meta", StringComparison.Ordinal))];
        faults.AddRange(all.Except(metas).Where(entry => !metas.Contains(entry + ".meta")).Select(entry => $"{entry} has no .meta"));
        faults.AddRange(metas.Where(meta => !all.Contains(meta[..^".meta".Length])).Select(meta => $"{meta} is of nothing"));
        faults.AddRange(metas.GroupBy(meta => Regex.Match(File.ReadAllText(Path.Combine(package, meta)), "^guid: ([0-9a-f]{32})$", RegexOptions.Multiline).Value)
            .Where(same => same.Key.Length == 0 || same.Count() > 1).Select(same => $"{string.Join(", ", same)} have the same guid, or none"));
        foreach (string library in all.Where(entry => entry.EndsWith(".dll", StringComparison.Ordinal)))
        {
            faults.AddRange(References(Path.Combine(package, library))
                .Where(needed => needed != "netstandard" && !all.Contains($"Runtime/{needed}.dll")).Select(needed => $"{library} needs {needed}"));
        }

        return faults;
    }

    private static List<string> References(string library)
    {
        using PEReader reader = new(File.OpenRead(library));
        MetadataReader metadata = reader.GetMetadataReader();
        return [.. metadata.AssemblyReferences.Select(handle => metadata.GetString(metadata.GetAssemblyReference(handle).Name))];
    }

    private static string[] Files(string folder) =>
        [.. Directory.EnumerateFiles(folder, "*", SearchOption.AllDirectories).Select(file => Path.GetRelativePath(folder, file)).Order(StringComparer.Ordinal)];
}
