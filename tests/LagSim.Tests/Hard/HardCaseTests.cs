using System;
using System.Linq;
using LagSim.Harness.Verification.Hard;
using Xunit;

namespace LagSim.Tests.Hard;

/// <summary>The hard cases at small sizes: within their bounds, and each check sees a wrong method fail.</summary>
public sealed class HardCaseTests
{
    /// <summary>What the engine is known not to do yet. A row that is here and passes fails the test, so that the list stays true.</summary>
    private static readonly (string Case, string Size)[] Shortfalls = [];

    public static TheoryData<string> Names => [.. HardCases.All.Select(c => c.Name)];

    [Theory]
    [MemberData(nameof(Names))]
    public void Case_AtItsSmallSizes_IsWithinItsBoundsAndWrongMethodsAreNot(string name)
    {
        HardRow[] rows = Run(name, areControls: false), controls = Run(name, areControls: true);
        Assert.NotEmpty(rows);
        Assert.All(rows, row =>
        {
            Assert.Equal(name, row.Case);
            Assert.True(row.Argument.Length > 10 && row.Reference.Length > 4 && double.IsFinite(row.Bound), $"{row}");
            Assert.True(row.Passed != Shortfalls.Contains((row.Case, row.Size)), $"{row}");
        });
        Assert.All(controls, row => Assert.True(!row.Passed && row.Note.Length > 0, $"{row}"));

        // A kind of error that no wrong method is seen to fail would be a check without teeth.
        Assert.Empty(rows.Select(row => row.ErrorKind).Except(controls.Select(row => row.ErrorKind)));
    }

    [Fact]
    public void Row_ThatIsNoNumberOrNotModelled_HasNotPassed()
    {
        HardRow row = new("case", "size", 1, "kind", 2, "argument", "reference");
        Assert.True(row.Passed);
        Assert.False((row with { Error = double.NaN }).Passed);
        Assert.False((row with { Error = 2.0000001 }).Passed);
        Assert.False((row with { IsModelled = false }).Passed);
    }

    [Fact]
    public void Names_AreEachTheirOwn() => Assert.Equal(HardCases.All.Count, HardCases.All.Select(c => c.Name).Distinct(StringComparer.Ordinal).Count());

    private static HardRow[] Run(string name, bool areControls)
    {
        Assert.True(HardCases.TryGet(name, out IHardCase? found));
        return [.. HardCases.Run([found], HardScale.Small, 1, areControls, cancellation: TestContext.Current.CancellationToken)];
    }
}
