using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text.RegularExpressions;
using LagSim.Tests.Api;
using Xunit;

namespace LagSim.Tests.Docs;

/// <summary>Links between pages lead somewhere, and the pages stay as short as their readers' patience.</summary>
public sealed partial class PageLinkTests
{
    [Fact]
    public void Pages_EveryRelativeLink_LeadsToAFileOrFolder()
    {
        string[] broken = [.. Pages().SelectMany(page => Broken(page, File.ReadAllText(page)))];
        Assert.True(broken.Length == 0, string.Join('\n', broken));
        Assert.Single(Broken(Path.Combine(RepositoryRoot.Path, "README.md"), "[no page](docs/NO-SUCH-PAGE.md)")); // the control
    }

    [Fact]
    public void Pages_EveryAnchorOfALink_IsAHeadingThere()
    {
        string[] broken = [.. Pages().SelectMany(page => WithoutHeading(page, File.ReadAllText(page)))];
        Assert.True(broken.Length == 0, string.Join('\n', broken));
        Assert.Equal(2, WithoutHeading(Path.Combine(RepositoryRoot.Path, "README.md"), "[a](docs/TUNING.md#no-such-heading) [b](#nor-this)").Count()); // the control
    }

    /// <summary>Who looks for a rule's code finds it: <c>Contacts/ContactStep.cs</c> on a page is a file of the core.</summary>
    [Fact]
    public void Pages_EveryFileOfTheCoreThatTheyName_IsThere()
    {
        string[] gone = [.. Pages().SelectMany(page => Gone(File.ReadAllText(page)).Select(file => $"{page}: {file}"))];
        Assert.True(gone.Length == 0, string.Join('\n', gone));
        Assert.Equal(["Contacts/NoSuchFile.cs"], Gone("`Contacts/NoSuchFile.cs` and `Contacts/ContactStep.cs`")); // the control
    }

    [Fact]
    public void Index_NamesEveryPage()
    {
        string index = SnippetTests.Read("docs/README.md");
        string[] missing = [.. Directory.GetFiles(Path.Combine(RepositoryRoot.Path, "docs"), "*.md").Select(file => Path.GetFileName(file)!)
            .Where(name => name != "README.md" && !index.Contains($"({name})", StringComparison.Ordinal))];
        Assert.True(missing.Length == 0, $"docs/README.md does not name {string.Join(", ", missing)}.");
    }

    [Theory]
    [InlineData("README.md", 120)]
    [InlineData("docs/ARCHITECTURE.md", 250)]
    public void Page_HasAtMostSoManyLines(string page, int lines) => Assert.InRange(SnippetTests.Read(page).Count(c => c == '\n'), 1, lines);

    private static IEnumerable<string> Pages() => Directory.GetFiles(RepositoryRoot.Path, "*.md")
        .Concat(new[] { "docs", "src", "bench", "samples", "tests" }
            .SelectMany(folder => Directory.EnumerateFiles(Path.Combine(RepositoryRoot.Path, folder), "*.md", SearchOption.AllDirectories)))
        .Where(file => !file.Replace('\\', '/').Split('/').Any(part => part is "bin" or "obj"));

    private static IEnumerable<string> Broken(string page, string text) => Link().Matches(text)
        .Select(match => match.Groups[1].Value is { Length: > 0 } link ? link : match.Groups[2].Value)
        .Where(target => !target.Contains("://", StringComparison.Ordinal) && !target.StartsWith('#') && !target.StartsWith("mailto:", StringComparison.Ordinal))
        .Select(target => Path.Combine(Path.GetDirectoryName(page)!, target.Split('#')[0]))
        .Where(path => !File.Exists(path) && !Directory.Exists(path))
        .Select(path => $"{page}: {path}");

    private static IEnumerable<string> WithoutHeading(string page, string text) => Link().Matches(text)
        .Select(match => match.Groups[1].Value.Split('#'))
        .Where(link => link.Length == 2 && !link[0].Contains("://", StringComparison.Ordinal))
        .Select(link => (File: link[0].Length == 0 ? page : Path.Combine(Path.GetDirectoryName(page)!, link[0]), Anchor: link[1]))
        .Where(link => link.File.EndsWith(".md", StringComparison.Ordinal) && !Anchors(File.ReadAllText(link.File)).Contains(link.Anchor))
        .Select(link => $"{page}: {link.File} has no heading for #{link.Anchor}");

    /// <summary>The anchors that a page's headings get: in small letters, without punctuation, with a dash for each space.</summary>
    private static IEnumerable<string> Anchors(string text) => Heading().Matches(text)
        .Select(match => string.Concat(match.Groups[1].Value.ToLowerInvariant().Where(c => char.IsLetterOrDigit(c) || c is ' ' or '-' or '_')).Replace(' ', '-'));

    private static IEnumerable<string> Gone(string text)
    {
        string core = Path.Combine(RepositoryRoot.Path, "src", "LagSim");
        return CoreFile().Matches(text).Select(match => match.Groups[1].Value)
            .Where(file => Directory.Exists(Path.Combine(core, Path.GetDirectoryName(file)!)) && !File.Exists(Path.Combine(core, file)));
    }

    [GeneratedRegex(@"^#+ +(.+?)\s*$", RegexOptions.Multiline)]
    private static partial Regex Heading();

    [GeneratedRegex("`(\\w+/\\w+\\.cs)`")]
    private static partial Regex CoreFile();

    [GeneratedRegex("""\]\(([^)\s]+)\)|(?:src|srcset)="([^"]+)""")]
    private static partial Regex Link();
}
