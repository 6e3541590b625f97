using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Verification.Stalls;
using LagSim.Tests.Sessions;
using Xunit;

namespace LagSim.Tests.Stalls;

/// <summary>Drawn sessions in which peers stand still, are killed and started again, and move; and that the check finds what it is to find.</summary>
public sealed class StallTests
{
    [Fact]
    public void Run_AFewDrawnSessions_PlayGoesOnInAll()
    {
        IReadOnlyList<StallOutcome> outcomes = Play(new StallOptions { Sessions = 12, Seed = 500 });
        Assert.All(outcomes, o => Assert.True(o.IsGood, $"{o.Case}: {o.Differed} differ, {o.Lost} lost. {string.Join(" ", o.Failures)}"));
        Assert.All(outcomes, o => Assert.True(o.Compared > 20 && o.RecoverySeconds.Count > 0, $"{o.Case}: {o.Compared} compared"));
    }

    [Fact]
    public void Run_TheSameSeedOnAnyNumberOfThreads_IsTheSameToTheLastFigure()
    {
        StallOptions options = new() { Sessions = 4, Seed = 77, Workers = 1 };
        IReadOnlyList<StallOutcome> once = Play(options), again = Play(options with { Workers = 3 });
        Assert.Equal(once.Select(Figures), again.Select(Figures));
        Assert.NotEqual(once.Select(Figures), Play(options with { Seed = 78 }).Select(Figures));

        static string Figures(StallOutcome o) => $"{o.Case} {o.Compared} {o.Accepted} {o.Copies} {o.Regained} {string.Join(",", o.RecoverySeconds)}";
    }

    [Fact]
    public void Run_PeersThatDoNotHeal_StatesThatDifferAreFound() =>
        Assert.Contains(Play(new StallOptions { Sessions = 4, Strategy = "none" }), o => o.Differed > 0 && !o.IsGood);

    [Fact]
    public void Run_AClientThatMissesAnEvent_ItIsFound() =>
        Assert.All(Play(new StallOptions { Sessions = 3, Seed = SeedWith(StallKind.PortChanges), Overlooked = 8 }).Take(1), o => Assert.True(o.Lost > 0 && !o.IsGood));

    /// <summary>What comes too late for a client's world is lost, though it is in its log, and though a fresh copy makes up for it.</summary>
    [Fact]
    public void Run_ClientsThatForgetTooEarly_AreFoundToLoseEvents()
    {
        StallOptions options = new() { Sessions = 6, Seed = 1000, PrepareClient = session => session.Put(SessionFault.ForgetsTooEarly) };
        Assert.Contains(Play(options), o => o.Lost > 0 && !o.IsGood);
        Assert.All(Play(options with { PrepareClient = null }), o => Assert.Equal(0, o.Lost));
    }

    [Fact]
    public void Run_AKilledClientWithoutItsPass_IsFoundToBeAnotherPlayer()
    {
        StallOutcome outcome = Play(new StallOptions { Sessions = 1, Seed = SeedWith(StallKind.ClientKilled), KeepsPasses = false })[0];
        Assert.False(outcome.IsGood);
        Assert.Contains(outcome.Failures, why => why.Contains("came back as player", System.StringComparison.Ordinal));
    }

    [Fact]
    public void Run_PeersThatDoNotAskAgain_AreFoundNotToBeBack()
    {
        StallOutcome outcome = Play(new StallOptions { Sessions = 1, Seed = SeedWith(StallKind.HostKilled), RejoinSeconds = 0 })[0];
        Assert.Contains(outcome.Failures, why => why.Contains("is not back", System.StringComparison.Ordinal));
    }

    [Fact]
    public void Draw_ManySeeds_EveryKindOfStallIsThereWithinItsBounds()
    {
        Stall[] stalls = [.. Enumerable.Range(1, 400).SelectMany(seed => new StallCase((ulong)seed).Stalls)];
        Assert.Equal(5, stalls.Select(s => s.Kind).Distinct().Count());
        Assert.All(stalls, s => Assert.InRange(s.Seconds, 1, 60));
        Assert.Contains(stalls, s => s.Seconds > 50 && s.Kind == StallKind.HostFrozen);
        Assert.Contains(stalls, s => s.Seconds < 2 && s.Kind == StallKind.ClientFrozen);
    }

    /// <summary>The first seed that draws that kind alone.</summary>
    private static ulong SeedWith(StallKind kind) =>
        Enumerable.Range(1, 1000).Select(n => (ulong)n).First(seed => new StallCase(seed).Stalls is [Stall only] && only.Kind == kind && only.Seconds > 5);

    private static IReadOnlyList<StallOutcome> Play(StallOptions options) => StallTest.Run(options, null, TestContext.Current.CancellationToken);
}
