using System.Linq;
using LagSim.Harness.Verification.Check;
using LagSim.Tests.Faults;
using LagSim.Tests.Sessions;
using Xunit;
namespace LagSim.Tests.Checks;
public sealed class ScratchTests(ITestOutputHelper output)
{
    [Fact]
    public void FindOne()
    {
        CheckOptions options = new() { Sessions = 500, Seed = 1, ShrinkingPlays = 0, PrepareSession = (_, session) => session.Put(HealingFaultTests.Faulty(HealingFault.ForgetsBodiesMovedOn)) };
        output.WriteLine("one " + string.Join(" ", InvariantCheck.Run(options, null, TestContext.Current.CancellationToken).Failures.Select(f => f.Whole.Seed + (f.Whole.DifferingBits > 0 ? "!" : ""))));
    }
    [Fact]
    public void FindTwo()
    {
        CheckOptions options = new() { Sessions = 1500, Seed = 1, ShrinkingPlays = 0, PrepareSession = (_, session) => session.Put(SessionFault.NeverBacksOff) };
        output.WriteLine("two " + string.Join(" ", InvariantCheck.Run(options, null, TestContext.Current.CancellationToken).Failures.Select(f => f.Whole.Seed + " " + f.Whole.Failure + "\n")));
    }
}
