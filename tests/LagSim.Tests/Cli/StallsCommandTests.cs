using System.Linq;
using System.Text.Json;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary><c>lagsim stalls</c>: what it prints, and what it refuses.</summary>
public sealed class StallsCommandTests
{
    [Theory]
    [InlineData("--sessions", "0", "between 1 and 1000000")]
    [InlineData("--sessions", "many", "between 1 and 1000000")]
    [InlineData("--worst", "-1", "between 0 and 1000")]
    [InlineData("--processes", "1001", "between 0 and 1000")]
    [InlineData("--processes", "1.5", "between 0 and 1000")]
    [InlineData("--seed", "-1", "between 0 and 18446744073709551615")]
    public void Stalls_NumberOutOfRange_IsRefusedWithOptionValueAndRange(string option, string value, string range) =>
        Tool.Refuses(2, ["stalls", option, value], option, $"'{value}'", range);

    [Theory]
    [InlineData("0")]
    [InlineData("3601")]
    public void Relay_ChangeOfPortsOutOfRange_IsRefused(string seconds) =>
        Tool.Refuses(2, ["relay", "127.0.0.1:5000", "--profile", "lan", "--change-port-s", seconds], "--change-port-s", $"'{seconds}'", "between 0.5 and 3600");

    [Fact]
    public void Stalls_TwoSessions_AreToldAsJsonAndPlayOneByOneWithTheSameFigures()
    {
        using JsonDocument both = JsonDocument.Parse(Tool.Run("stalls", "--sessions", "2", "--seed", "9", "--json").Done().Output);
        JsonElement root = both.RootElement;
        Assert.Equal(("stalls", 2, 0L, 0L), (
            root.GetProperty("command").GetString(), root.GetProperty("sessions").GetInt32(), root.GetProperty("states_differed").GetInt64(), root.GetProperty("events_lost").GetInt64()));
        Assert.Empty(root.GetProperty("failing_seeds").EnumerateArray());
        JsonElement worst = root.GetProperty("worst").EnumerateArray().First();
        string replay = worst.GetProperty("replay").GetString()!;
        Assert.StartsWith("lagsim stalls --sessions 1 --seed ", replay);

        using JsonDocument alone = JsonDocument.Parse(Tool.Run([.. replay.Split(' ').Skip(1), "--json"]).Done().Output);
        Assert.Equal(worst.GetRawText(), alone.RootElement.GetProperty("worst")[0].GetRawText());
        Assert.Equal(worst.GetProperty("recovery_s").GetDouble(), alone.RootElement.GetProperty("recovery_s").GetProperty("max").GetDouble());
    }

    [Fact]
    public void Stalls_AsText_NamesTheWorstWithItsCommand()
    {
        Tool tool = Tool.Run("stalls", "--sessions", "1", "--seed", "9").Done();
        Assert.Contains("states compared, 0 differ;", tool.Output);
        Assert.Contains("lagsim stalls --sessions 1 --seed 9", tool.Output);
        Assert.Contains("All of them are as they should be.", tool.Output);
    }
}
