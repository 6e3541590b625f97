using System.Linq;
using LagSim.Harness.Verification.Check;
using LagSim.Tests.Faults;
using LagSim.Tests.Sessions;
using Xunit;

namespace LagSim.Tests.Checks;

/// <summary>
/// Ways to keep a session together that are known to be wrong: <c>check</c> catches each, and lets the same session pass without it. That a
/// session never backs off is caught by the sweep (<see cref="Sweep.LinkSweepTests"/>).
/// </summary>
public sealed class SessionFaultTests
{
    [Theory]
    [InlineData(SessionFault.ForgetsTooEarly, 49u)]
    [InlineData(SessionFault.DropsWhenMerging, 3u)]
    [InlineData(SessionFault.DropsWhenMerging, 18u)]
    [InlineData(SessionFault.DropsWhenMerging, 37u)]
    internal void Run_KeptTogetherInAWayKnownToBeWrong_IsCaught(SessionFault fault, uint seed)
    {
        CheckOptions options = new() { Sessions = 1, Seed = seed, ShrinkingPlays = 0, PrepareSession = (_, session) => session.Put(fault) };
        string? failure = Assert.Single(Run(options).Failures).Whole.Failure;
        string[] signs = ["differ", "was not the host's", "lost"]; // by what it is there for
        Assert.True(signs.Any(failure!.Contains), failure);
        Assert.Empty(Run(options with { PrepareSession = null }).Failures);
    }

    /// <summary>
    /// What is said of a player that comes late is heard where it belongs, also by who heard of others first. The controls: sessions without the
    /// fault, and one whose rules hear of no players, in which it does nothing.
    /// </summary>
    [Theory]
    [InlineData(10u, 1)]
    [InlineData(29u, 1)]
    [InlineData(30u, 1)]
    [InlineData(8u, 0)]
    public void Run_PlayersHeardInTheOrderInWhichNewsCame_IsCaught(uint seed, int failures)
    {
        CheckOptions options = new() { Sessions = 1, Seed = seed, Rules = RulesOfSessions.All, ShrinkingPlays = 0 };
        CheckReport right = Run(options);
        Assert.Empty(right.Failures);
        Assert.Equal(failures, right.SessionsThatMet(met => met.PlayersHeard));
        CheckReport wrong = Run(options with { PrepareSession = static (peer, session) => session.Put(new FaultyRules(peer > 0 ? RuleFault.OrdersPlayersByArrival : RuleFault.None)) });
        Assert.Equal(failures, wrong.Failures.Count);
        Assert.All(wrong.Failures, f => Assert.True(f.Whole.DifferingBits > 0, f.Whole.Failure));
    }

    private static CheckReport Run(CheckOptions options) => InvariantCheck.Run(options, null, TestContext.Current.CancellationToken);
}
