using System;
using System.Collections.Generic;
using System.CommandLine;
using System.IO;
using System.Linq;
using System.Text.Json;
using LagSim.Cli;
using LagSim.Cli.Commands;
using LagSim.Cli.Output;
using LagSim.Net.Protection;
using LagSim.Tests.Api;
using LagSim.Tests.Cli;
using Xunit;

namespace LagSim.Tests.Docs;

/// <summary>docs/OUTPUT.md names every key of the JSON that the tool prints.</summary>
public sealed class OutputPageTests : IDisposable
{
    /// <summary>Commands whose JSON takes long to get, or another process or a real port.</summary>
    private static readonly string[] NotCalled = ["accuracy", "fuzz", "harm", "host", "join", "relay", "sweep"];

    private readonly TemporaryFolder folder = new();

    public void Dispose() => folder.Dispose();

    [Theory]
    [InlineData("drop --time virtual --motion ballistic --case teleport")]
    [InlineData("run pair --until-s 1")]
    [InlineData("run goals --until-s 2")]
    [InlineData("scenes")]
    [InlineData("explain pair")]
    [InlineData("check --sessions 1")]
    [InlineData("check --worlds 14")]
    [InlineData("compare --scene pair --profile lan --strategy healing")]
    [InlineData("hold --time virtual --delay-ms 25 --hold-s 1")]
    [InlineData("hard drop --scale small")]
    [InlineData("stalls --sessions 1")]
    [InlineData("key --identity {identity} --change")]
    [InlineData("token --secret {secret} --player ada --host lagsim://192.0.2.1:5000#{fingerprint}")]
    [InlineData("replay {corpus}/pair.lagsim")]
    [InlineData("diff {corpus}/pair.lagsim {corpus}/pair.lagsim")]
    public void Page_NamesEveryKeyOf(string call)
    {
        using HostIdentity identity = HostIdentity.Draw();
        SecretFile.Write(folder["identity"], identity.ToSecretText());
        string[] words = [.. call.Split(' ').Select(word => word.Replace("{identity}", folder["identity"], StringComparison.Ordinal)
            .Replace("{secret}", folder["secret"], StringComparison.Ordinal).Replace("{fingerprint}", identity.Fingerprint.ToString(), StringComparison.Ordinal)
            .Replace("{corpus}", Path.Combine(RepositoryRoot.Path, "tests", "corpus"), StringComparison.Ordinal))];
        using JsonDocument document = JsonDocument.Parse(Tool.Run([.. words, "--json"]).Done().Output);
        HashSet<string> keys = [.. Keys(document.RootElement)];
        string page = SnippetTests.Read("docs/OUTPUT.md");
        Assert.Equal([], Missing(keys));
        Assert.Equal(["no_such_key"], Missing([.. keys, "no_such_key"])); // the control

        string[] Missing(IEnumerable<string> all) => [.. all.Where(key => !page.Contains($"`{key}`", StringComparison.Ordinal))];
    }

    /// <summary>No command that prints JSON is left out but those named above.</summary>
    [Fact]
    public void Calls_AreOfEveryCommandWithJson()
    {
        using StringWriter nothing = new();
        Command tool = Program.Root(new ToolConsole(nothing, nothing, TestContext.Current.CancellationToken));
        string[] calls = [.. GetType().GetMethod(nameof(Page_NamesEveryKeyOf))!.GetCustomAttributes(inherit: false).OfType<InlineDataAttribute>()
            .Select(call => ((string)call.Data[0]!).Split(' ')[0])];
        Assert.Equal(
            tool.Subcommands.Where(command => command.Options.Any(option => option.Name == "--json")).Select(command => command.Name).Order(),
            calls.Concat(NotCalled).Distinct().Order());
    }

    private static IEnumerable<string> Keys(JsonElement value) => value.ValueKind switch
    {
        JsonValueKind.Object => value.EnumerateObject().SelectMany(property => Keys(property.Value).Prepend(property.Name)),
        JsonValueKind.Array => value.EnumerateArray().SelectMany(Keys),
        _ => [],
    };
}
