using System;
using System.Collections.Generic;
using System.Linq;
using System.Text.Json;
using LagSim.Tests.Cli;
using Xunit;

namespace LagSim.Tests.Docs;

/// <summary>docs/OUTPUT.md names every key of the JSON that the tool prints.</summary>
public sealed class OutputPageTests
{
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
    public void Page_NamesEveryKeyOf(string call)
    {
        using JsonDocument document = JsonDocument.Parse(Tool.Run([.. call.Split(' '), "--json"]).Done().Output);
        HashSet<string> keys = [.. Keys(document.RootElement)];
        string page = SnippetTests.Read("docs/OUTPUT.md");
        Assert.Equal([], Missing(keys));
        Assert.Equal(["no_such_key"], Missing([.. keys, "no_such_key"])); // the control

        string[] Missing(IEnumerable<string> all) => [.. all.Where(key => !page.Contains($"`{key}`", StringComparison.Ordinal))];
    }

    private static IEnumerable<string> Keys(JsonElement value) => value.ValueKind switch
    {
        JsonValueKind.Object => value.EnumerateObject().SelectMany(property => Keys(property.Value).Prepend(property.Name)),
        JsonValueKind.Array => value.EnumerateArray().SelectMany(Keys),
        _ => [],
    };
}
