using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text.RegularExpressions;
using LagSim.Corpus;
using LagSim.Events;
using LagSim.Net.Recordings;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Tests.Api;
using LagSim.Tests.Recordings;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Corpus;

/// <summary>The recordings of <c>tests/corpus</c>, which <c>.ci/corpus</c> replays on every runtime there is, replayed on this one.</summary>
public sealed partial class CorpusTests
{
    private const string Update = "LAGSIM_UPDATE_CORPUS";

    private static readonly string Folder = Path.Combine(RepositoryRoot.Path, "tests", "corpus");

    /// <summary>What fixed keys make of fixed texts stands beside the recordings, so that every runtime is held to it.</summary>
    [Fact]
    public void Handshake_OfFixedKeys_IsTheOneOnRecord()
    {
        string path = Path.Combine(Folder, SecureTranscript.FileName);
        if (Environment.GetEnvironmentVariable(Update) == "1")
        {
            File.WriteAllLines(path, SecureTranscript.Lines());
        }

        Assert.Equal(File.ReadAllLines(path), SecureTranscript.Lines());
    }

    [Fact]
    public void Corpus_OfItsWorlds_IsTheOneOnRecord()
    {
        if (Environment.GetEnvironmentVariable(Update) == "1")
        {
            (string Path, byte[] Bytes)[] made = [.. CorpusWorlds.All.Select(world => (PathOf(world.Name), world.Record()))];
            foreach (string old in Files(Folder))
            {
                File.Delete(old);
            }

            foreach ((string path, byte[] bytes) in made)
            {
                File.WriteAllBytes(path, bytes);
            }
        }

        Assert.Equal(CorpusWorlds.All.Select(world => world.Name).Order(StringComparer.Ordinal), Names());
        foreach (CorpusWorld world in CorpusWorlds.All)
        {
            Recording now = Read(world.Record()), onRecord = Recording.Read(PathOf(world.Name), CorpusCheck.Known);
            RecordingComparison compared = RecordingComparison.Of(onRecord, now, cancellation: TestContext.Current.CancellationToken);
            Assert.True(
                compared.Outcome == ComparisonOutcome.Agrees && (compared.EntriesCompared, compared.StatesCompared) == (world.Log.Length, world.States + 1),
                $"tests/corpus/{world.Name} is not what its world gives now: {compared.Message}\n"
                + $"If that is meant, run the tests once with {Update}=1 in the environment, and say in the CHANGELOG which hashes moved and why.");
        }
    }

    [Fact]
    public void Check_OfTheCorpus_AgreesOnThisRuntime()
    {
        (int exit, string[] lines) = Check(Folder);
        Assert.True(exit == 0, string.Join("\n", lines));
        Assert.Matches("^CoreCLR .*, library (Debug|Release) net10[.]0$", lines[0]);
        Assert.All(lines[1..^2], line => Assert.Matches("^ok [a-z0-9-]+ [0-9a-f]{16}-[0-9a-f]{16}$", line));
        Assert.Equal(Names(), lines[1..^2].Select(line => line.Split(' ')[1]));
        Assert.Equal("ok handshake", lines[^2]);
        Assert.Equal($"{Names().Length + 1} agree, 0 differ", lines[^1]);
    }

    [Fact]
    public void Check_OneBitOfOneEventChanged_DiffersThereAlone()
    {
        using Copy copy = new();
        CorpusWorld world = CorpusWorlds.All.Single(w => w.Name == "pair");
        Recording was = Recording.Read(PathOf(world.Name));
        ExternalEvent set = world.Log[1].Event;
        ExternalEvent changed = ExternalEvent.SetVelocity(
            set.Time, set.Peer, set.Sequence, set.Body, V(set.Velocity.X, Math.BitIncrement(set.Velocity.Y), set.Velocity.Z));
        using (RecordingWriter writer = RecordingWriter.Create(Path.Combine(copy.Folder, "pair.lagsim"), 0, world.Scene, world.Start))
        {
            writer.WriteEntry(1, Verdict.Accepted, world.Log[0].Event);
            writer.WriteEntry(2, Verdict.Accepted, changed);
            foreach (CommittedState state in was.Committed)
            {
                writer.WriteCommitted(state.Time, state.StateHash, state.EventHash);
            }

            writer.WriteEnd("Spoiled.");
        }

        (int exit, string[] lines) = Check(copy.Folder);

        Assert.Equal((1, $"{Names().Length - 1} agree, 1 differ"), (exit, lines[^1]));
        Assert.Matches("^DIFFERS pair ([0-9a-f]{16}-[0-9a-f]{16}) (?!\\1)[0-9a-f]{16}-[0-9a-f]{16}$", Assert.Single(lines, line => line.StartsWith("DIFFERS", StringComparison.Ordinal)));
        Assert.Equal(Names().Length - 1, lines.Count(line => line.StartsWith("ok ", StringComparison.Ordinal)));
    }

    [Fact]
    public void Check_DamagedOrEmptyOrNothing_IsNotAgreement()
    {
        using Copy copy = new();
        string path = Path.Combine(copy.Folder, "drop-rk4.lagsim");
        byte[] bytes = File.ReadAllBytes(path);
        File.WriteAllBytes(path, bytes[..^1]); // all its states are there, and agree
        (int exit, string[] lines) = Check(copy.Folder);
        Assert.Equal((1, $"{Names().Length - 1} agree, 1 differ"), (exit, lines[^1]));
        Assert.Matches("^CANNOT drop-rk4 .*The file ends within an end", Assert.Single(lines, line => line.StartsWith("CANNOT", StringComparison.Ordinal)));

        File.WriteAllBytes(path, bytes[..Recorded.Boundaries(bytes)[^2]]); // the same without a trace of the end
        (exit, lines) = Check(copy.Folder);
        Assert.Equal((1, $"{Names().Length - 1} agree, 1 differ"), (exit, lines[^1]));
        Assert.Matches("^CANNOT drop-rk4 It has no end record: .* 21 committed states up to T ", Assert.Single(lines, line => line.StartsWith("CANNOT", StringComparison.Ordinal)));

        File.WriteAllBytes(path, Recorded.OfFold(bytes, Recorded.OtherFold));
        (exit, lines) = Check(copy.Folder);
        Assert.Equal((1, $"{Names().Length - 1} agree, 1 differ"), (exit, lines[^1]));
        Assert.Matches(
            $"^CANNOT drop-rk4 .* are of fold version {Recorded.OtherFold}, ",
            Assert.Single(lines, line => line.StartsWith("CANNOT", StringComparison.Ordinal)));

        foreach (string file in Directory.GetFiles(copy.Folder))
        {
            File.Delete(file);
        }

        (exit, lines) = Check(copy.Folder);
        Assert.Equal((1, "0 agree, 0 differ"), (exit, lines[^1]));

        using (RecordingWriter nothing = RecordingWriter.Create(path, 0, Drop(1, 1), SimTime.Zero))
        {
            nothing.WriteEnd("A recording of nothing.");
        }

        (exit, lines) = Check(copy.Folder);
        Assert.Equal((1, "0 agree, 1 differ"), (exit, lines[^1]));
        Assert.StartsWith("CANNOT drop-rk4 The recording holds no committed state", lines[1], StringComparison.Ordinal);
    }

    [Fact]
    public void Worlds_Together_CoverWhatTheReadmeSays()
    {
        SortedSet<string> covered = [.. CorpusWorlds.All.SelectMany(Covered)];
        Assert.Equal(Needed.Order(StringComparer.Ordinal), covered.Order(StringComparer.Ordinal));

        // The control: no world covers it all, and without the one that has it each of these is seen to be missing.
        foreach ((string name, string only) in new[] { ("supplied", "a supplied acceleration"), ("far-and-late", "a late start"), ("subnormal", "a subnormal speed") })
        {
            Assert.DoesNotContain(only, CorpusWorlds.All.Where(world => world.Name != name).SelectMany(Covered));
        }
    }

    [Fact]
    public void Readme_HasARowForEachRecording_AndTheyAreSmall()
    {
        string[] rows = File.ReadAllLines(Path.Combine(Folder, "README.md")).Select(line => Row().Match(line)).Where(match => match.Success)
            .Select(match => match.Groups[1].Value).ToArray();
        Assert.Equal(Names(), rows.Order(StringComparer.Ordinal));
        Assert.All(Names(), name => Assert.InRange(new FileInfo(PathOf(name)).Length, 500, 10_000));
    }

    private static IEnumerable<string> Needed =>
    [
        .. Enum.GetNames<MotionLaw>().Where(law => law != nameof(MotionLaw.Automatic)).Select(law => $"law {law}"),
        .. Enum.GetNames<ForceKind>().Select(kind => $"force {kind}"),
        .. new[] { "Spawn", "Teleport", "SetVelocity", "Impulse", "Grab", "HoldKeyframe", "Release", "Remove" }.Select(kind => $"event {kind}"),
        "a step's end", "an impact of two", "an impact of many", "a wake by impact", "sliding in a groove", "sliding on a plane", "a persistent contact", "a late round",
        "masses sixty decades apart", "a supplied acceleration", "a late start", "a place far from the origin", "a subnormal speed", "a refused event", "two events at a tick",
    ];

    /// <summary>What a world was seen to have, in the words above.</summary>
    private static IEnumerable<string> Covered(CorpusWorld world)
    {
        Simulation simulation = world.Run();
        TimelineEntry[][] paths = Bodies(simulation).Select(body => simulation.Timeline(body).ToArray()).ToArray();
        TimelineEntry[] all = paths.SelectMany(path => path).ToArray();
        BodySnapshot[] snapshots = Enumerable.Range(1, 40)
            .SelectMany(i => simulation.Snapshot(world.Start + SimDuration.FromSeconds(world.Seconds * i / 40)).Bodies.ToArray()).ToArray();
        int[] struck = all.Where(entry => entry.Key.Kind == EventKind.Impact).GroupBy(entry => entry.Key).Select(group => group.Count()).ToArray();
        double[] masses = world.Scene.Bodies.Select(body => body.Spec.Mass).ToArray();
        bool wakes = paths.Any(path => path.Zip(path.Skip(1)).Any(pair =>
            pair.First.State.Motion == MotionLaw.Resting && pair.Second.State.Motion != MotionLaw.Resting && pair.Second.Key.Kind == EventKind.Impact));
        (string What, bool Is)[] facts =
        [
            .. Enum.GetValues<MotionLaw>().Select(law => ($"law {law}", all.Any(entry => entry.State.Motion == law))),
            .. Enum.GetValues<ForceKind>().Select(kind => ($"force {kind}", world.Scene.Forces.Any(force => force.Kind == kind))),
            .. Enum.GetValues<EventKind>().Where(kind => kind is >= EventKind.Spawn and <= EventKind.Remove)
                .Select(kind => ($"event {kind}", all.Any(entry => entry.Key.Kind == kind))),
            ("a step's end", all.Any(entry => entry.Key.Kind == EventKind.StepEnd)),
            ("an impact of two", struck.Contains(2)),
            ("an impact of many", struck.Any(count => count > 4)),
            ("a wake by impact", wakes),
            ("sliding in a groove", snapshots.Any(body => body is { Law: MotionLaw.Sliding, SupportCount: 2 })),
            ("sliding on a plane", snapshots.Any(body => body is { Law: MotionLaw.Sliding, SupportCount: 1 })),
            ("a persistent contact", snapshots.Any(body => body.Contacts.Length > 0)),
            ("a late round", all.Any(entry => entry.Key.Round >= 4)),
            ("masses sixty decades apart", masses.Max() / masses.Min() >= 1e60),
            ("a supplied acceleration", world.Scene.Accelerations.Count > 0),
            ("a late start", world.Start > At(30 * 86_400.0)),
            ("a place far from the origin", all.Any(entry => entry.State.Position.Length > 1e6)),
            ("a subnormal speed", all.Any(entry => double.IsSubnormal(entry.State.Velocity.X))),
            ("a refused event", world.Log.Any(entry => entry.Verdict != Verdict.Accepted)),
            ("two events at a tick", world.Log.GroupBy(entry => entry.Event.Time).Any(group => group.Count() > 1)),
        ];
        return facts.Where(fact => fact.Is).Select(fact => fact.What);
    }

    private static (int Exit, string[] Lines) Check(string folder)
    {
        StringWriter output = new();
        int exit = CorpusCheck.Run(folder, output);
        return (exit, output.ToString().Split(Environment.NewLine, StringSplitOptions.RemoveEmptyEntries));
    }

    private static Recording Read(byte[] bytes) => Recording.Read(new MemoryStream(bytes, false), CorpusCheck.Known);

    private static string PathOf(string name) => Path.Combine(Folder, name + RecordingFormat.Extension);

    private static string[] Files(string folder) =>
        Directory.GetFiles(folder, "*" + RecordingFormat.Extension).Order(StringComparer.Ordinal).ToArray();

    private static string[] Names() => Files(Folder).Select(Path.GetFileNameWithoutExtension).OfType<string>().ToArray();

    [GeneratedRegex(@"^\| `([^`]+)` \|")]
    private static partial Regex Row();

    /// <summary>A copy of the corpus that a test may spoil.</summary>
    private sealed class Copy : IDisposable
    {
        internal Copy()
        {
            foreach (string file in Files(CorpusTests.Folder))
            {
                File.Copy(file, Path.Combine(Folder, Path.GetFileName(file)));
            }
        }

        internal string Folder { get; } = Directory.CreateTempSubdirectory("lagsim-corpus-").FullName;

        public void Dispose() => Directory.Delete(Folder, true);
    }
}
