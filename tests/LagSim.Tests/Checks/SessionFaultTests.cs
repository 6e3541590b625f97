using System.Linq;
using LagSim.Harness.Verification.Check;
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

    private static CheckReport Run(CheckOptions options) => InvariantCheck.Run(options, null, TestContext.Current.CancellationToken);
}
