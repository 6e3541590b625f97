using System;
using System.IO;
using System.Linq;
using System.Text.Json;
using LagSim.Cli;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary><c>lagsim explain</c>.</summary>
public sealed class ExplainCommandTests
{
    [Fact]
    public void Explain_BuiltIn_SaysWhatIsModelledAndWhatNot()
    {
        (int code, string output, string error) = Run("explain", "billiards");
        Assert.Equal((0, ""), (code, error));
        Assert.Contains("parabola", output, StringComparison.Ordinal);
        Assert.Contains("and 13 more", output, StringComparison.Ordinal);
        Assert.Matches("spin and friction +no", output);
    }

    [Fact]
    public void Explain_Json_HasEveryBodyAndFeature()
    {
        (int code, string output, _) = Run("explain", "billiards", "--json");
        Assert.Equal(0, code);
        using JsonDocument json = JsonDocument.Parse(output);
        Assert.Equal(16, json.RootElement.GetProperty("bodies").GetArrayLength());
        Assert.Equal("ballistic", json.RootElement.GetProperty("bodies")[3].GetProperty("motion").GetString());
        Assert.False(json.RootElement.GetProperty("features").EnumerateArray().First(f => f.GetProperty("name").GetString() == "integrator").GetProperty("modelled").GetBoolean());
    }

    [Fact]
    public void Explain_NoScene_IsAnError() => Assert.Equal(3, Run("explain", "nowhere.json").Code);

    private static (int Code, string Output, string Error) Run(params string[] arguments)
    {
        using StringWriter output = new(), error = new();
        int code = Program.Run(arguments, output, error, default);
        return (code, output.ToString(), error.ToString());
    }
}
