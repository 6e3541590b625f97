using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text.RegularExpressions;
using LagSim.Cli;
using LagSim.Cli.Output;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Docs;

/// <summary>The code of the front pages compiles, line by line as it stands there, and what needs no second machine runs; the tool understands the calls of it that pages show.</summary>
public sealed partial class SnippetTests
{
    private static readonly string Compiled = Read("tests/LagSim.Tests/Docs/Snippets.cs");

    [Theory]
    [InlineData("README.md", 6)]
    [InlineData("src/LagSim/README.md", 1)]
    [InlineData("src/LagSim.Net/README.md", 1)]
    public void Page_EachOfItsSnippets_IsCompiledAsItStands(string page, int count)
    {
        string[] snippets = [.. Fence().Matches(Read(page)).Select(match => match.Groups[1].Value)];
        Assert.Equal(count, snippets.Length);
        Assert.All(snippets, snippet => Assert.True(IsCompiled(snippet), $"{page} has code that Snippets.cs has not:\n{snippet}"));
        Assert.All(snippets, snippet => Assert.False(IsCompiled(snippet.Replace(".", "..", StringComparison.Ordinal)))); // the control
    }

    [Fact]
    public void Bounce_AndContacts_Run()
    {
        List<Vector3D> shown = [];
        Snippets snippets = new(Drop(3.5, 0.7), shown.Add);
        snippets.Bounce();
        snippets.Contacts();
        Assert.All(shown, place => Assert.True(place.Y is > 3 and <= 4, $"{place}")); // nothing has fallen far yet
    }

    [Theory]
    [InlineData("README.md", 12)]
    [InlineData("docs/ACCURACY.md", 8)]
    [InlineData("docs/SCENES.md", 3)]
    [InlineData("CONTRIBUTING.md", 1)]
    [InlineData("src/LagSim.Cli/README.md", 2)]
    public void Page_EachOfItsCallsOfTheTool_IsOneThatTheToolUnderstands(string page, int atLeast)
    {
        string[] calls = [.. Call().Matches(Read(page)).Select(match => match.Groups[1].Value.Trim())];
        Assert.True(calls.Length >= atLeast, $"{calls.Length} calls");
        Assert.All(calls, call => Assert.True(Mistakes(call).Length == 0, $"{page}: '{call}': {string.Join(' ', Mistakes(call))}"));
        Assert.All(calls.Where(call => call != "--help"), call => Assert.NotEmpty(Mistakes(call + " --no such option"))); // the control
    }

    private static string[] Mistakes(string call)
    {
        ToolConsole console = new(TextWriter.Null, TextWriter.Null, TestContext.Current.CancellationToken);
        return [.. Program.Root(console).Parse(call.Split(' ', StringSplitOptions.RemoveEmptyEntries)).Errors.Select(error => error.Message)];
    }

    /// <summary>Whether its lines, apart from indentation and empty ones, stand there one after the other, and all that it uses is used.</summary>
    private static bool IsCompiled(string snippet)
    {
        string[] lines = Lines(snippet), uses = [.. lines.Where(line => Use().IsMatch(line))];
        string[] there = Lines(Compiled), code = [.. lines.Where(line => !Use().IsMatch(line))];
        return Enumerable.Range(0, Math.Max(0, there.Length - code.Length)).Any(at => there.AsSpan(at, code.Length).SequenceEqual(code))
            && uses.All(use => there.Contains(use) || use == "using LagSim;"); // in which the test's own namespace lies
    }

    private static string[] Lines(string text) => text.Split('\n', StringSplitOptions.TrimEntries | StringSplitOptions.RemoveEmptyEntries);

    private static string Read(string file)
    {
        DirectoryInfo? folder = new(AppContext.BaseDirectory);
        while (folder is not null && !File.Exists(Path.Combine(folder.FullName, "LagSim.sln")))
        {
            folder = folder.Parent;
        }

        return File.ReadAllText(Path.Combine(folder!.FullName, file)).ReplaceLineEndings("\n");
    }

    [GeneratedRegex("```csharp\n(.*?)```", RegexOptions.Singleline)]
    private static partial Regex Fence();

    /// <summary>An indented line that calls the tool, without what the shell makes of its end.</summary>
    [GeneratedRegex("^    (?:lagsim|dotnet run .*?--project src/LagSim.Cli.*? --) ([^#>|\n]+)", RegexOptions.Multiline)]
    private static partial Regex Call();

    [GeneratedRegex("^using [A-Za-z.]+;$")]
    private static partial Regex Use();
}
