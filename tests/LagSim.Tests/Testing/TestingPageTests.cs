using System;
using System.Linq;
using System.Text.RegularExpressions;
using LagSim.Testing.Links;
using LagSim.Tests.Docs;
using Xunit;

namespace LagSim.Tests.Testing;

/// <summary>What the pages about tests under lag show stands in the sample, which runs.</summary>
public sealed partial class TestingPageTests
{
    private static readonly string Sample = string.Join('\n', Lines(SnippetTests.Read("samples/GameTests/PitchTests.cs")));

    [Theory]
    [InlineData("docs/TESTING.md", 5)]
    [InlineData("src/LagSim.Testing/README.md", 1)]
    public void Page_EachOfItsSnippets_StandsInTheSample(string page, int count)
    {
        string[] snippets = [.. Fence().Matches(SnippetTests.Read(page)).Select(match => string.Join('\n', Lines(match.Groups[1].Value)))];
        Assert.Equal(count, snippets.Length);
        Assert.All(snippets, snippet => Assert.Contains(snippet, Sample, StringComparison.Ordinal));
        Assert.All(snippets, snippet => Assert.DoesNotContain(snippet.Replace(";", ";;", StringComparison.Ordinal), Sample)); // the control
    }

    [Theory]
    [InlineData("docs/TESTING.md", "on {0} links")]
    [InlineData("src/LagSim.Testing/README.md", "{0} profiles by name")]
    public void Page_NumberOfLinks_IsTheirs(string page, string sentence) =>
        Assert.Contains(string.Format(null, sentence, LinkProfiles.Names.Count), SnippetTests.Read(page), StringComparison.Ordinal);

    [Fact]
    public void Page_IsShort() => Assert.True(SnippetTests.Read("docs/TESTING.md").Count(c => c == '\n') < 120);

    private static string[] Lines(string text) => text.Split('\n', StringSplitOptions.TrimEntries | StringSplitOptions.RemoveEmptyEntries);

    [GeneratedRegex("```csharp\n(.*?)```", RegexOptions.Singleline)]
    private static partial Regex Fence();
}
