using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Text;
using FsCheck;
using FsCheck.Fluent;
using LagSim.Harness.Verification.Check;
using LagSim.Net.Recordings;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Tests.Determinism;
using LagSim.Tests.Scenes;
using LagSim.Tests.Wire;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.Recordings.Recorded;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Recordings;

/// <summary>docs/RECORDINGS.md says what is true: files written from its tables, field by field in their order and types, are those of the library.</summary>
public sealed class RecordingsPageTests
{
    private static readonly string[] Page = LayoutPage.Read("RECORDINGS.md");

    [Fact]
    public void Tables_WrittenFieldByField_AreTheFile()
    {
        Assert.Equal(Convert.ToHexString(Small(peer: 5)), Convert.ToHexString(FromPage(Page, Read(Small(peer: 5)))));

        byte[] late = Small(Log[3..], 3, joined: Joined(4, 1));
        Assert.Equal(Convert.ToHexString(late), Convert.ToHexString(FromPage(Page, Read(late))));
    }

    [Fact]
    public void Tables_OfTheScene_AreTheSceneWithAllItsParts()
    {
        foreach (Scene scene in Gen.Sample(SceneGen.Any, 20, new Rnd(20261121, 1), 10).Append(new RandomWorld(6).Scene).Append(new RandomWorld(7, sensors: true).Scene))
        {
            Assert.Equal(Convert.ToHexString(SceneFormat.Encode(scene)), Convert.ToHexString(SceneFromPage(Page, scene)));
        }
    }

    [Fact]
    public void Tables_WithTwoRowsSwappedOrOneLess_AreSeenToFail()
    {
        (byte[] bytes, Recording recording) = Everything();
        string whole = Convert.ToHexString(bytes);
        Assert.Equal(whole, Written(Page, recording));
        int rows = 0;
        for (int i = 0; i < Page.Length; i++)
        {
            if (LayoutPage.IsField(Page, i))
            {
                Assert.NotEqual(whole, Written([.. Page[..i], .. Page[(i + 1)..]], recording));
                rows++;
            }

            bool isSameEitherWay = Page[i].StartsWith("| u8 | version ", StringComparison.Ordinal) && RecordingFormat.Version == WireFormat.Version;
            if (LayoutPage.IsField(Page, i) && LayoutPage.IsField(Page, i + 1) && !isSameEitherWay)
            {
                Assert.NotEqual(whole, Written([.. Page[..i], Page[i + 1], Page[i], .. Page[(i + 2)..]], recording));
            }
        }

        Assert.Equal(3 + 4 + 5 + 53 + 2 + 3 + 3, rows); // of each table
    }

    [Fact]
    public void Limits_OfThePage_AreThoseOfTheCode()
    {
        string page = string.Join("\n", Page);
        foreach (int limit in new[]
        {
            SceneFormat.MaxBytes, SceneFormat.MaxBodies, SceneFormat.MaxStaticParts, RecordingFormat.MaxSnapshotBytes, RecordingFormat.MaxReasonBytes,
        })
        {
            Assert.Contains($" {limit.ToString("N0", CultureInfo.InvariantCulture)} ", page.Replace(';', ' '), StringComparison.Ordinal);
        }

        Assert.Equal(77, EventFormat.SpecBytes);
        Assert.Contains($"| event | event | {EventFormat.MinBytes} to {EventFormat.MaxBytes} bytes", page, StringComparison.Ordinal);
        Assert.StartsWith($"# Recordings, version {RecordingFormat.Version}", page, StringComparison.Ordinal);
        Assert.Contains($"`{RecordingFormat.Extension}`", page, StringComparison.Ordinal);
        foreach (Verdict verdict in Enum.GetValues<Verdict>())
        {
            string words = string.Concat(verdict.ToString().Select((c, i) => char.IsUpper(c) && i > 0 ? $" {char.ToLowerInvariant(c)}" : $"{char.ToLowerInvariant(c)}"));
            Assert.Contains($"{(int)verdict} {words}", page, StringComparison.Ordinal);
        }
    }

    /// <summary>A recording with every kind of record and part, all of whose neighbouring values differ.</summary>
    private static (byte[] Bytes, Recording Recording) Everything()
    {
        IAcceleration force = new FunctionForce((_, _, v) => -v);
        Scene scene = new SceneBuilder("all").WithSmallestRadius(0.125).AddForce(Force.Supplied(force)).AddForce(Force.Spring("spring", V(8, 9, 10), 11, 12)).AddForce(Force.Central("pull", V(13, 14, 15), 16, -3))
            .AddPlane("floor", Vector3D.Up, -3.0, 0.5, 0.625, new CollisionFilter(3, 5))
            .AddStaticSphere("rock", V(5, 6, 7), 2, 0.25, 0.375, new CollisionFilter(9, 7)).AddBody("ball", new BodySpec(0.5, 3, 0.75, friction: 0.125, rollingResistance: 0.0625, filter: new CollisionFilter(6, 10), tag: 1234567890123), V(1, 2, 3), V(4), PeerSet.Of(1, 4), V(17, 18, 19)).WithSpawners(PeerSet.Of(0, 9))
            .AddSensorSphere("hole", V(20, 21, 22), 23, SensorCoverage.Whole, new CollisionFilter(11, 13), "ball").AddSensorPlane("goal", V(0, 0, 1), 24.0, SensorCoverage.Part)
            .WithRules(new DrawnRules(5)).WithSeed(77).Build();
        Simulation world = new(scene, new SimulationOptions(Start, SimDuration.MaxValue));
        world.AdvanceTo(Start + Seconds(1));
        byte[] bytes = Recorded.Bytes(
            writer =>
            {
                writer.WriteEntry(9, Verdict.TooEarly, Log[0].Event);
                writer.WriteCommitted(Start + Seconds(1), 1, 2);
                writer.WriteEnd("End.");
            },
            scene, peer: 3, joined: new JoinedState(9, world.Snapshot(Start + Seconds(0.5))));
        return (bytes, Recording.Read(new MemoryStream(bytes), [force], [new DrawnRules(5)]));
    }

    private static string Written(string[] page, Recording recording)
    {
        try
        {
            return Convert.ToHexString(FromPage(page, recording));
        }
        catch (Exception wrong) when (wrong is KeyNotFoundException or InvalidCastException)
        {
            return "a field that is not of this table";
        }
    }

    private static LayoutRow[] Table(string[] page, string heading) => LayoutPage.Table(page, "## " + heading);

    private static byte[] FromPage(string[] page, Recording recording)
    {
        MemoryStream file = new();
        LayoutPage.Write(file, Table(page, "The file"), new()
        {
            ["magic"] = (byte[])[0x4C, 0x61, 0x67, 0x53, 0x69, 0x6D, 0x0D, 0x0A],
            ["version"] = (int)RecordingFormat.Version,
            ["wire version"] = (int)WireFormat.Version,
        });
        RecordingHeader header = recording.Header!;
        Put(1, "1 Header", new() { ["peer"] = (int)header.Peer, ["start"] = header.Start, ["scene hash"] = header.SceneHash, ["fold version"] = header.FoldVersion, ["library version"] = header.LibraryVersion });
        PutBytes(2, SceneFromPage(page, recording.Scene!));
        if (recording.Joined is JoinedState joined)
        {
            Put(3, "3 Joined state", new() { ["first index"] = joined.FirstIndex, ["snapshot"] = SnapshotFormat.Encode(joined.Snapshot!) });
        }

        // Entries and states in the order in which Small writes them.
        int next = 0;
        foreach (CommittedState state in recording.Committed)
        {
            for (; next < recording.Entries.Count && recording.Entries[next].Event.Time <= state.Time + Seconds(0.5); next++)
            {
                LogEntry entry = recording.Entries[next];
                Put(4, "4 Log entry", new() { ["index"] = entry.Index, ["verdict"] = (int)entry.Verdict, ["event"] = entry.Event });
            }

            Put(5, "5 Committed state", new() { ["time"] = state.Time, ["state hash"] = state.StateHash, ["event hash"] = state.EventHash });
        }

        PutBytes(6, Encoding.UTF8.GetBytes(recording.EndReason!));
        return file.ToArray();

        void Put(int kind, string heading, Dictionary<string, object> values)
        {
            MemoryStream content = new();
            LayoutPage.Write(content, Table(page, heading), values);
            PutBytes(kind, content.ToArray());
        }

        void PutBytes(int kind, byte[] content)
        {
            MemoryStream record = new();
            foreach (LayoutRow row in Table(page, "A record"))
            {
                LayoutPage.Write(record, [row], new() { ["kind"] = kind, ["length"] = content.Length, ["content"] = content, ["checksum"] = Crc(record.ToArray()) });
            }

            file.Write(record.ToArray());
        }
    }

    private static byte[] SceneFromPage(string[] page, Scene scene)
    {
        MemoryStream bytes = new();
        Dictionary<string, object> head = new()
        {
            ["wire version"] = (int)WireFormat.Version,
            ["name"] = scene.Name,
            ["gravity"] = scene.Gravity,
            ["restitution threshold"] = scene.RestitutionThreshold,
            ["contact tolerance"] = scene.ContactTolerance,
            ["smallest radius"] = scene.SmallestRadius,
            ["spawners"] = scene.Spawners.Mask,
            ["forces"] = scene.Forces.Count,
            ["planes"] = scene.Planes.Count,
            ["static spheres"] = scene.StaticSpheres.Count,
            ["bodies"] = scene.Bodies.Count,
            ["seed"] = scene.Seed,
            ["rules"] = scene.Rules is null ? 0 : 1,
            ["sensors"] = scene.Sensors.Count,
        };
        Dictionary<string, (string Prefix, IEnumerable<Dictionary<string, object>> Items)> lists = new()
        {
            ["forces"] = ("force ", scene.Forces.Select(f => LayoutPage.Values(
                ("force name", f.Name), ("force kind", (byte)f.Kind), ("force version", f.Acceleration?.Version ?? 0), ("force strength", f.Strength),
                ("force damping", f.Damping), ("force vector", f.Vector), ("force power", f.Power)))),
            ["planes"] = ("plane ", scene.Planes.Select(p => LayoutPage.Values(
                ("plane name", p.Name), ("plane normal", p.Normal), ("plane offset", p.Offset), ("plane restitution", p.Restitution), ("plane friction", p.Friction),
                ("plane category", p.Filter.Category), ("plane mask", p.Filter.Mask)))),
            ["static spheres"] = ("sphere ", scene.StaticSpheres.Select(s => LayoutPage.Values(
                ("sphere name", s.Name), ("sphere centre", s.Centre), ("sphere radius", s.Radius), ("sphere restitution", s.Restitution), ("sphere friction", s.Friction),
                ("sphere category", s.Filter.Category), ("sphere mask", s.Filter.Mask)))),
            ["bodies"] = ("body ", scene.Bodies.Select(b => LayoutPage.Values(
                ("body name", b.Name), ("body spec", b.Spec), ("body position", b.Position), ("body velocity", b.Velocity), ("body players", b.Players.Mask), ("body spin", b.Spin)))),
            ["rules"] = ("rules ", new[] { scene.Rules }.OfType<SceneRules>().Select(r => LayoutPage.Values(
                ("rules name", r.Name), ("rules version", r.Version), ("rules world bytes", SceneFormat.WorldBytes(r)), ("rules body bytes", r.BodyBytes)))),
            ["sensors"] = ("sensor ", scene.Sensors.Select(s => LayoutPage.Values(
                ("sensor name", s.Name), ("sensor shape", (byte)s.Shape), ("sensor coverage", (byte)s.Coverage), ("sensor vector", s.Shape == SensorShape.Plane ? s.Normal : s.Centre), ("sensor measure", s.Shape == SensorShape.Plane ? s.Offset : s.Radius),
                ("sensor category", s.Filter.Category), ("sensor mask", s.Filter.Mask), ("sensor carrier", (uint)(s.Carrier?.Index + 1 ?? 0))))),
        };
        LayoutPage.Write(bytes, Table(page, "2 Scene"), head, lists);
        return bytes.ToArray();
    }
}
