using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Security.Cryptography;
using System.Text;
using LagSim.Corpus;
using LagSim.Net.Recordings;
using LagSim.Net.Sessions;
using LagSim.Tests.Api;
using LagSim.Tests.Corpus;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Determinism;

/// <summary>
/// No pinned hash and none of the corpus moves without <see cref="Simulation.FoldVersion"/>: <c>fold-versions.txt</c> has, of every version there was, a digest of
/// each world's hashes, and what this code gives must be what stands there of its version.
/// </summary>
public sealed class FoldVersionTests
{
    private const string Update = "LAGSIM_UPDATE_CORPUS";

    private static readonly string Path = System.IO.Path.Combine(RepositoryRoot.Path, "tests", "LagSim.Tests", "Determinism", "fold-versions.txt");

    [Fact]
    public void FoldVersion_OfWhatThisCodeGives_IsTheOneOnRecord()
    {
        SortedDictionary<string, string> now = Now();
        if (Environment.GetEnvironmentVariable(Update) == "1")
        {
            // Lines are added and never changed: what a version gave stays what it gave.
            HashSet<string> there = [.. Lines().Select(line => string.Join(' ', line.Split(' ')[..2]))];
            File.AppendAllText(
                Path, string.Concat(now.Where(world => !there.Contains($"{Simulation.FoldVersion} {world.Key}")).Select(world => $"{Simulation.FoldVersion} {world.Key} {world.Value}\n")));
        }

        string[] complaints = [.. Complaints(Lines(), Simulation.FoldVersion, now)];
        Assert.True(complaints.Length == 0, $"{Path}:\n{string.Join('\n', complaints)}");
    }

    [Fact]
    public void Digests_OfAllWorlds_AreDifferentOnes() => Assert.Equal(Now().Count, Now().Values.Distinct().Count());

    [Fact]
    public void Digest_OfOneBitOfOneHash_IsAnother()
    {
        CommittedState[] states = [new(SimTime.Zero, 1, 2), new(SimTime.Zero + SimDuration.OneTick, 3, 4)];
        string digest = Digest(states);
        Assert.Equal(digest, Digest([states[0], new(states[1].Time, 3, 4)]));
        Assert.NotEqual(digest, Digest([states[0], new(states[1].Time, 3, 5)]));
        Assert.NotEqual(digest, Digest([states[0], new(states[1].Time, 2, 4)]));
        Assert.NotEqual(digest, Digest([states[0]]));
    }

    [Fact]
    public void Complaints_OfAHashThatMoved_DemandANewVersionAndItsLines()
    {
        string[] lines = ["1 a 00000000000000aa", "1 b 00000000000000bb"];
        SortedDictionary<string, string> was = Worlds(("a", "00000000000000aa"), ("b", "00000000000000bb")), moved = Worlds(("a", "00000000000000aa"), ("b", "00000000000000cc"));
        Assert.Empty(Complaints(lines, 1, was));

        Assert.Equal(
            "b gives 00000000000000cc; fold version 1 gave 00000000000000bb. If a hash is meant to move, raise Simulation.FoldVersion to 2 and run the tests once with"
            + " LAGSIM_UPDATE_CORPUS=1, which adds the lines of that version. If its scene or its events are others now, put this digest into its line.",
            Assert.Single(Complaints(lines, 1, moved)));
        Assert.Equal(
            ["There is no line '2 a 00000000000000aa'.", "There is no line '2 b 00000000000000cc'."], Complaints(lines, 2, moved).Select(said => said.Split(" Run ")[0]));
        Assert.Empty(Complaints([.. lines, "2 a 00000000000000aa", "2 b 00000000000000cc"], 2, moved));

        // Going back to what was before is a move as well, and no version counts down.
        Assert.StartsWith("b gives ", Assert.Single(Complaints([.. lines, "2 a 00000000000000aa", "2 b 00000000000000cc"], 2, was)), StringComparison.Ordinal);
        Assert.Equal(
            "Fold version 2 has lines; Simulation.FoldVersion is 1, and is never lowered.",
            Assert.Single(Complaints([.. lines, "2 a 00000000000000aa", "2 b 00000000000000cc"], 1, was)));
    }

    [Fact]
    public void Complaints_OfALineThatIsNoneOrTwiceOrOfNoWorld_NameIt()
    {
        SortedDictionary<string, string> a = Worlds(("a", "00000000000000aa"));
        Assert.Equal("'1 b 00000000000000bb' is of no world that there is.", Assert.Single(Complaints(["1 a 00000000000000aa", "1 b 00000000000000bb"], 1, a)));
        Assert.Equal("'1 a 00000000000000aa' is of a version and world that have a line.", Assert.Single(Complaints(["1 a 00000000000000aa", "1 a 00000000000000aa"], 1, a)));
        Assert.StartsWith("'one a' is not VERSION NAME DIGEST", Assert.Single(Complaints(["one a", "1 a 00000000000000aa"], 1, a)), StringComparison.Ordinal);
        Assert.StartsWith("'1 a aa' is not VERSION NAME DIGEST", Complaints(["1 a aa"], 1, a).First(), StringComparison.Ordinal);
    }

    /// <summary>What is wrong with the file, a sentence each.</summary>
    private static IEnumerable<string> Complaints(IEnumerable<string> lines, int version, SortedDictionary<string, string> worlds)
    {
        Dictionary<(int Version, string Name), string> onRecord = [];
        foreach (string line in lines)
        {
            string[] parts = line.Split(' ');
            if (parts.Length != 3 || !int.TryParse(parts[0], NumberStyles.None, CultureInfo.InvariantCulture, out int of) || parts[2].Length != 16)
            {
                yield return $"'{line}' is not VERSION NAME DIGEST, a number, a word and 16 hexadecimal digits.";
            }
            else if (!onRecord.TryAdd((of, parts[1]), parts[2]))
            {
                yield return $"'{line}' is of a version and world that have a line.";
            }
            else if (of == version && !worlds.ContainsKey(parts[1]))
            {
                yield return $"'{line}' is of no world that there is.";
            }
        }

        int last = onRecord.Keys.Select(key => key.Version).DefaultIfEmpty().Max();
        if (last > version)
        {
            yield return $"Fold version {last} has lines; Simulation.FoldVersion is {version}, and is never lowered.";
        }

        foreach ((string name, string digest) in worlds)
        {
            if (!onRecord.TryGetValue((version, name), out string? was))
            {
                yield return $"There is no line '{version} {name} {digest}'. Run the tests once with {Update}=1, which adds it.";
            }
            else if (was != digest)
            {
                yield return $"{name} gives {digest}; fold version {version} gave {was}. If a hash is meant to move, raise Simulation.FoldVersion to {version + 1} and run the tests once with"
                    + $" {Update}=1, which adds the lines of that version. If its scene or its events are others now, put this digest into its line.";
            }
        }
    }

    private static IEnumerable<string> Lines() => File.ReadAllLines(Path).Where(line => !line.StartsWith('#'));

    private static SortedDictionary<string, string> Now() => Worlds(
    [
        .. PinnedHashTests.Names.Select(name => ($"pinned/{name}", Digest([LastOf(PinnedHashTests.World(name))]))),
        .. CorpusWorlds.All.Select(world => ($"corpus/{world.Name}", Digest(Recording.Read(new MemoryStream(world.Record(), false), CorpusCheck.Known).Committed))),
    ]);

    private static SortedDictionary<string, string> Worlds(params (string Name, string Digest)[] worlds) =>
        new(worlds.ToDictionary(world => world.Name, world => world.Digest), StringComparer.Ordinal);

    private static CommittedState LastOf(Simulation simulation) =>
        new(simulation.SimulatedTo, simulation.StateHash(simulation.SimulatedTo), simulation.EventHash(simulation.SimulatedTo));

    private static string Digest(IEnumerable<CommittedState> states) => Convert.ToHexStringLower(SHA256.HashData(Encoding.ASCII.GetBytes(
        string.Concat(states.Select(state => $"{state.StateHash:x16} {state.EventHash:x16}\n")))))[..16];
}
