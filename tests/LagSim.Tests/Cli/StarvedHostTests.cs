using System;
using System.Linq;
using System.Text.Json;
using LagSim.Harness.Verification.Harm;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>Honest players stay with a host that gets little time, with real processes.</summary>
/// <remarks>Alone: what takes its time from the host would take it from every test beside it.</remarks>
[Collection(RealTime.Name)]
[Trait("Time", "real")]
public sealed class StarvedHostTests
{
    /// <summary>
    /// A host at a tenth of a core, and one beside sixteen spinning programs, each of another scene. The third has next to no budget, so
    /// players are sent away: the run must say so, or it would not be seen in the others either.
    /// </summary>
    /// <remarks>
    /// At a tenth of a core a host stands still for 90 ms at a time, so its world, 33 ms ahead, is 57 ms late at least. How much the system
    /// gives a host beside programs that spin is the system's affair, and a world whose players are gone is at rest, and late in nothing.
    /// </remarks>
    [Theory]
    [InlineData("--seed 0", true, 57)]
    [InlineData("--seed 8", true, 0)]
    [InlineData("--seed 4 --budget 0.0001", false, 0)]
    public void Harm_OfHonestPlayersWithAStarvedHost_SeesWhetherTheyStay(string options, bool stay, double leastLate)
    {
        Assert.SkipWhen(OperatingSystem.IsWindows(), "Windows has no signals by which a process is stopped.");
        using ToolProcess harm = ToolProcess.Start($"harm --attacks 0 --starved 1 {options} --json");
        harm.Ends(stay ? 0 : 1);
        using JsonDocument result = JsonDocument.Parse(string.Join("\n", harm.Output.Lines));
        JsonElement session = Assert.Single(result.RootElement.GetProperty("starved").EnumerateArray());
        string failures = string.Join(" ", session.GetProperty("failures").EnumerateArray().Select(failure => failure.GetString()));
        Assert.True(session.GetProperty("late_ms").GetDouble() >= leastLate, $"{session}");
        Assert.Equal(stay, failures.Length == 0);
        Assert.True(stay || failures.Contains("is disconnected: what it did took", StringComparison.Ordinal), failures);
    }

    [Fact]
    public void Draw_ManySeeds_HaveEverySceneAndKind()
    {
        StarvedCase[] cases = [.. Enumerable.Range(0, 18).Select(seed => new StarvedCase((ulong)seed))];
        Assert.Equal(18, cases.Select(one => one.ToString()).Distinct().Count());
        Assert.All(cases, one => Assert.All(one.Actions, actions => Assert.InRange(actions.Length, 10, 200)));
        Assert.Equal(cases[5].Actions, new StarvedCase(5).Actions); // the seed is all there is to it
    }
}
