using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Text.RegularExpressions;
using ArchUnitNET.Loader;
using LagSim.Tests.Api;
using LagSim.Tests.Architecture.Samples;
using Xunit;

namespace LagSim.Tests.Architecture;

/// <summary>The folders of the source know each other one way only: the one that <see cref="Layers.Order"/> says.</summary>
public sealed partial class LayerTests
{
    private static readonly string Source = Path.Combine(RepositoryRoot.Path, "src");
    private static readonly Lazy<Arrow[]> OfSource = new(() => Arrows.Between(new ArchLoader().LoadAssemblies(SourceAssemblies.All)));

    [Fact]
    public void Folders_KnowOnlyLowerLayers()
    {
        string[] broken = new LayerRules(Layers.Order, Layers.Placed).Broken(OfSource.Value);
        Assert.True(broken.Length == 0, $"{broken.Length} arrows point up or to the side in Architecture/Layers.cs:\n{string.Join("\n", broken)}");
    }

    /// <summary>Nothing of the source is left out: all projects but that which only lays out a package for Unity, and the page, which only a browser loads.</summary>
    [Fact]
    public void Assemblies_AreThoseOfAllProjects() => Assert.Equal([], ProjectsWithout(SourceAssemblies.All));

    [Fact]
    public void Assemblies_OfWhichOneIsLeftOut_AreSeenToLackIt() => Assert.All(
        SourceAssemblies.All,
        left => Assert.Equal([left.GetName().Name!], ProjectsWithout(SourceAssemblies.All.Where(assembly => assembly != left))));

    [Fact]
    public void Folders_WithTwoLayersExchanged_AreSeenToFail()
    {
        for (int lower = 0; lower + 1 < Layers.Order.Length; lower++)
        {
            string[][] wrong = [.. Layers.Order];
            (wrong[lower], wrong[lower + 1]) = (wrong[lower + 1], wrong[lower]);
            bool isUsed = OfSource.Value.Any(arrow => Layers.Order[lower + 1].Contains(LayerOf(arrow.FromFolder, arrow.From))
                && Layers.Order[lower].Contains(LayerOf(arrow.ToFolder, arrow.To)));
            Assert.True(
                isUsed == new LayerRules(wrong, Layers.Placed).Broken(OfSource.Value).Length > 0,
                $"With {string.Join(", ", Layers.Order[lower])} above {string.Join(", ", Layers.Order[lower + 1])}");
        }

        string[] reversed = new LayerRules(Layers.Order.Reverse(), Layers.Placed).Broken(OfSource.Value);
        Assert.Contains("LagSim.Scenes.BodySpec uses LagSim.Time.SimDuration, but LagSim/Scenes must not know LagSim/Time", reversed);
    }

    [Fact]
    public void Folders_OfWhichOneIsNotInTheTable_AreSeenToFail()
    {
        string[][] wrong = Layers.Order.Select(layer => layer.Where(folder => folder != "LagSim/Rollback").ToArray()).ToArray();
        Assert.Contains(new LayerRules(wrong, Layers.Placed).Broken(OfSource.Value), line => line.EndsWith("must not know LagSim/Rollback", StringComparison.Ordinal));
    }

    [Fact]
    public void Table_HasEveryFolderOnce_AndNoOther()
    {
        string[] folders = FilesOfSource().Select(FolderOf).Distinct().Order(StringComparer.Ordinal).ToArray();
        string[] table = Layers.Order.SelectMany(layer => layer).Where(name => !name.EndsWith(" (words)", StringComparison.Ordinal)).Order(StringComparer.Ordinal).ToArray();
        Assert.Equal(folders, table);
    }

    [Fact]
    public void Namespaces_AreThoseOfTheFolders()
    {
        // The arrows take the namespace for the folder. LagSim.Net.LiteNetLib and LagSim.Net.WebSockets are one folder each, and their namespace that of the other carriers;
        // LagSim.Net.Secure is one, and its namespace that of what it implements. What an older target lacks has the namespace of the newer.
        string[] wrong = FilesOfSource().Where(file => FolderOf(file) is not ("LagSim.Net.LiteNetLib" or "LagSim.Net.WebSockets" or "LagSim.Net.Secure"))
            .SelectMany(file => File.ReadLines(file).Select(line => NamespaceLine().Match(line)).Where(match => match.Success)
                .Where(match => match.Groups[1].Value != "System.Diagnostics.CodeAnalysis" && match.Groups[1].Value != FolderOf(file).Replace('/', '.')).Select(match => $"{file}: {match.Value}"))
            .ToArray();
        Assert.Empty(wrong);
    }

    [Fact]
    public void PlacedTypes_AreStillNeeded_AndThere()
    {
        foreach (PlacedType placed in Layers.Placed)
        {
            Assert.Contains(Layers.Order, layer => layer.Contains(placed.Layer));
            Assert.Contains(SourceAssemblies.All, assembly => assembly.GetType(placed.Type) is not null);
            string[] without = new LayerRules(Layers.Order, Layers.Placed.Where(other => other != placed)).Broken(OfSource.Value);
            Assert.True(without.Length > 0, $"{placed.Type} need not be in Layers.Placed any more: without it no arrow is wrong. Delete the entry.");
        }
    }

    [Theory]
    [InlineData(typeof(InABody))]
    [InlineData(typeof(InALambda))]
    [InlineData(typeof(InAnIterator))]
    [InlineData(typeof(InAnAsyncMethod))]
    public void Arrows_OfCodeWithinMethods_AreSeen(System.Type user)
    {
        ArchLoader loader = new ArchLoader().LoadNamespacesWithinAssembly(user.Assembly, user.Namespace!);
        Assert.Contains(Arrows.Between(loader), arrow => arrow.From == user.FullName && arrow.To == typeof(Used).FullName);
    }

    private static IEnumerable<string> ProjectsWithout(IEnumerable<Assembly> assemblies) =>
        Directory.EnumerateFiles(Source, "*.csproj", SearchOption.AllDirectories)
            .Select(file => Path.GetFileNameWithoutExtension(file))
            .Where(name => name is not ("LagSim.Unity" or "LagSim.Play.Browser"))
            .Except(assemblies.Select(assembly => assembly.GetName().Name!));

    private static string LayerOf(string folder, string type) => Layers.Placed.FirstOrDefault(placed => placed.Type == type)?.Layer ?? folder;

    // What compilers ask for by its name, and .NET Standard 2.1 has not, is no part of any layer.
    private static IEnumerable<string> FilesOfSource() => Directory.EnumerateFiles(Source, "*.cs", SearchOption.AllDirectories)
        .Where(file => Path.GetFileName(file) != "IsExternalInit.cs" && !FolderOf(file).Split('/').Any(part => part is "bin" or "obj"));

    private static string FolderOf(string file) => Path.GetRelativePath(Source, Path.GetDirectoryName(file)!).Replace('\\', '/');

    [GeneratedRegex(@"^namespace ([\w.]+);")]
    private static partial Regex NamespaceLine();
}
