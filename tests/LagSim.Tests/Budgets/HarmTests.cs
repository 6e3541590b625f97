using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Verification.Harm;
using LagSim.Net.Sessions;
using Xunit;

namespace LagSim.Tests.Budgets;

/// <summary>Drawn attacks, and that the check finds what they do without a budget; and what honest players cost.</summary>
public sealed class HarmTests
{
    /// <summary>From seed 32 on are five kinds; a heap that is shot and a storm have their player sent away.</summary>
    [Fact]
    public void Run_AFewDrawnAttacks_WorldsStayInRealTime()
    {
        IReadOnlyList<HarmOutcome> outcomes = Play(new HarmOptions { Attacks = 8, Seed = 32 });
        Assert.All(outcomes, o => Assert.True(o.IsGood, $"{o.Case}: {string.Join(" ", o.Failures)} {o.Sentence}"));
        Assert.Contains(outcomes, o => o.IsExpelled && o.Sentence.Contains("of its bodies are removed", StringComparison.Ordinal));
        Assert.All(outcomes, o => Assert.True(o.HonestPart < 0.5, $"{o.Case}: {o.HonestPart}"));
    }

    /// <summary>A heap that is shaken, on seed 9.</summary>
    [Fact]
    public void Run_WithoutABudget_WhoHarmsIsFoundToStay()
    {
        HarmOutcome outcome = Assert.Single(Play(new HarmOptions { Attacks = 1, Seed = 9, Budget = null, WorkPerSecond = 3e5 }));
        Assert.True(outcome.LateSeconds > 0.25, $"{outcome.LateSeconds}");
        Assert.Contains("The player stayed.", outcome.Failures);
    }

    /// <summary>An elastic heap that a hand squeezes has an instant without end: its owner is sent away, and nobody else's session ends.</summary>
    [Fact]
    public void Run_InstantWithoutEnd_EndsNobodysSession()
    {
        HarmOutcome outcome = Assert.Single(Play(new HarmOptions { Attacks = 1, Seed = 50_225 }));
        Assert.True(outcome.IsGood && outcome.IsExpelled && outcome.LateSeconds < 0.25, $"{outcome.LateSeconds} {string.Join(" ", outcome.Failures)}");
    }

    [Fact]
    public void Run_TheSameSeedOnAnyNumberOfThreads_IsTheSameToTheLastFigure()
    {
        HarmOptions options = new() { Attacks = 4, Seed = 5, Workers = 1 };
        Assert.Equal(Play(options).Select(Figures), Play(options with { Workers = 3 }).Select(Figures));

        static string Figures(HarmOutcome o) => $"{o.Case} {o.LateSeconds:R} {o.OutSeconds} {o.BackSeconds} {o.IsExpelled} {o.HonestPart:R} {o.Sentence}";
    }

    [Theory]
    [InlineData("billiards", 0.25)]
    [InlineData("cradle", 0.25)]
    [InlineData("heap", 0.75)] // 0.06 to 0.58 with eight seeds
    public void Play_HonestPlayers_StayWithinTheirBudgets(string scene, double most)
    {
        HonestCost cost = HonestPlay.Play(scene, 1, 5, PlayerBudget.Default, TestContext.Current.CancellationToken);
        Assert.Equal(0, cost.Expelled);
        Assert.InRange(cost.Part, 1e-6, most);
        Assert.True(cost.Events > 50);
        Assert.True(HonestPlay.Play(scene, 1, 5, new PlayerBudget(10, 10), TestContext.Current.CancellationToken).Expelled > 0); // it is they who are counted
    }

    [Fact]
    public void Draw_ManySeeds_EveryKindIsThereWithinTheLimits()
    {
        HarmCase[] cases = [.. Enumerable.Range(1, 200).Select(seed => new HarmCase((ulong)seed))];
        Assert.Equal(Enum.GetValues<HarmKind>().Length, cases.Select(c => c.Kind).Distinct().Count());
        Assert.All(cases, c => Assert.True(c.Actions.All(d => d.Velocity.Length <= 1000 && d.AtSeconds < HarmCase.Seconds)));
    }

    private static IReadOnlyList<HarmOutcome> Play(HarmOptions options) => HarmTest.Run(options, null, TestContext.Current.CancellationToken);
}
