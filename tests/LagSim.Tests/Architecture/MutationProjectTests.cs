using System;
using System.IO;
using System.Linq;
using System.Text.RegularExpressions;
using LagSim.Tests.Api;
using Xunit;

namespace LagSim.Tests.Architecture;

/// <summary>The files that the project for mutation testing takes from here are there. It is in no solution, so no build says so.</summary>
public sealed class MutationProjectTests
{
    private static readonly string Folder = Path.Combine(RepositoryRoot.Path, "tests", "LagSim.Mutation");

    private static string[] Named { get; } =
        [.. Regex.Matches(File.ReadAllText(Path.Combine(Folder, "LagSim.Mutation.csproj")), "Include=\"([^\"]+\\.cs)\"")
            .SelectMany(include => include.Groups[1].Value.Split(';'))];

    [Fact]
    public void Files_ThatAreNamed_AreThere()
    {
        Assert.True(Named.Length > 10);
        Assert.Equal([], Named.Where(IsMissing));
    }

    [Fact]
    public void Files_OfAnotherName_AreSeenToBeMissing() =>
        Assert.All(Named, named => Assert.True(IsMissing(named.Replace("Tests/", "Tests/Old", StringComparison.Ordinal)), named));

    private static bool IsMissing(string named)
    {
        string path = Path.Combine(Folder, named);
        string folder = Path.GetDirectoryName(path)!;
        return !Directory.Exists(folder) || Directory.GetFiles(folder, Path.GetFileName(path)).Length == 0;
    }
}
