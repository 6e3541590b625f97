using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text.RegularExpressions;
using Xunit;

namespace LagSim.Tests.Api;

/// <summary>The map of the code in docs/ARCHITECTURE.md is true.</summary>
public sealed partial class CodeMapTests
{
    private static readonly string[] Page = File.ReadAllLines(Path.Combine(RepositoryRoot.Path, "docs", "ARCHITECTURE.md"));

    [Fact]
    public void Map_EveryFolderItNames_Exists()
    {
        string[] named = Named(Page);
        Assert.True(named.Length > 20, $"Only {named.Length} folders were found in the table of 'The map' of docs/ARCHITECTURE.md.");
        Assert.True(
            named.All(folder => Directory.Exists(Path.Combine(RepositoryRoot.Path, folder))),
            $"The map in docs/ARCHITECTURE.md names what is not there: {string.Join(", ", named.Where(f => !Directory.Exists(Path.Combine(RepositoryRoot.Path, f))))}.");
        Assert.Equal(named.Distinct(), named);
    }

    [Fact]
    public void Map_EveryFolderOfTheSource_IsNamed() => Assert.True(
        Missing(Page).Length == 0, $"The map in docs/ARCHITECTURE.md does not name: {string.Join(", ", Missing(Page))}. Add a row that says what is in it.");

    [Fact]
    public void Map_WithOneRowLess_IsSeenToFail()
    {
        foreach (string folder in Source())
        {
            Assert.Equal([folder], Missing(Page.Where(line => !line.StartsWith($"| `{folder}` |", StringComparison.Ordinal))));
        }
    }

    private static string[] Missing(IEnumerable<string> page) => Source().Except(Named(page)).ToArray();

    private static string[] Named(IEnumerable<string> page) => page
        .SkipWhile(line => line != "## The map").Skip(1).TakeWhile(line => !line.StartsWith("## ", StringComparison.Ordinal))
        .Select(line => Row().Match(line)).Where(match => match.Success).Select(match => match.Groups[1].Value).ToArray();

    private static string[] Source() => new[] { "*.cs", "*.csproj" }
        .SelectMany(what => Directory.EnumerateFiles(Path.Combine(RepositoryRoot.Path, "src"), what, SearchOption.AllDirectories))
        .Select(file => Path.GetRelativePath(RepositoryRoot.Path, Path.GetDirectoryName(file)!).Replace('\\', '/'))
        .Where(folder => !folder.Split('/').Any(part => part is "bin" or "obj"))
        .Distinct().Order(StringComparer.Ordinal).ToArray();

    [GeneratedRegex(@"^\| `([^`]+)` \|")]
    private static partial Regex Row();
}
