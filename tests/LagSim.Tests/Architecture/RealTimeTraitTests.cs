using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text.RegularExpressions;
using LagSim.Tests.Api;
using Xunit;

namespace LagSim.Tests.Architecture;

/// <summary>
/// Tests that open sockets, start threads or processes, or read a real clock have the trait by which they can be left out.
/// </summary>
public sealed partial class RealTimeTraitTests
{
    private const string Trait = "[Trait(\"Time\", \"real\")]";

    [Fact]
    public void Tests_ThatNeedRealTime_HaveTheTrait() => Assert.Empty(WithoutTrait(Files()));

    [Fact]
    public void Tests_OfWhichOneLostTheTrait_AreSeen()
    {
        foreach ((string name, string text) in Files().Where(file => file.Text.Contains(Trait, StringComparison.Ordinal)))
        {
            Assert.Equal([name], WithoutTrait([(name, text.Replace(Trait, "", StringComparison.Ordinal))]));
        }
    }

    private static IEnumerable<(string Name, string Text)> Files() =>
        Directory.EnumerateFiles(Path.Combine(RepositoryRoot.Path, "tests", "LagSim.Tests"), "*Tests.cs", SearchOption.AllDirectories)
            .Where(file => Path.GetFileName(file) != "RealTimeTraitTests.cs")
            .Select(file => (Path.GetFileName(file), File.ReadAllText(file)));

    private static IEnumerable<string> WithoutTrait(IEnumerable<(string Name, string Text)> files) => files
        .Where(file => Real().IsMatch(file.Text) && !file.Text.Contains(Trait, StringComparison.Ordinal)).Select(file => file.Name);

    [GeneratedRegex(
        @"UdpPort\(|PeerThread[.(]|new UdpRelay|Process\.Start|StopwatchClock\(|ToolProcess|KernelLink|LiteNetLibPort|WorldThread\(|RealPeers|new Thread\("
        + @"|SimulationHost\(|Stopwatch\.|Environment\.TickCount|DateTime\.(Utc)?Now")]
    private static partial Regex Real();
}
