using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Text;
using FsCheck;
using FsCheck.Fluent;
using LagSim.Events;
using LagSim.Net.Recordings;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Tests.Api;
using LagSim.Tests.Determinism;
using LagSim.Tests.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.Recordings.Recorded;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Recordings;

/// <summary>docs/RECORDINGS.md says what is true: files written from its tables, field by field in their order and types, are those of the library.</summary>
public sealed class RecordingsPageTests
{
    private static readonly string[] Page = File.ReadAllLines(Path.Combine(RepositoryRoot.Path, "docs", "RECORDINGS.md"));

    [Fact]
    public void Tables_WrittenFieldByField_AreTheFile()
    {
        Assert.Equal(Convert.ToHexString(Small(peer: 5)), Convert.ToHexString(FromPage(Page, Read(Small(peer: 5)))));

        JoinedState joined = new(4, Start + Seconds(1), Encoding.ASCII.GetBytes(new string('j', 20_000)));
        byte[] late = Small(Log[3..], 3, joined: joined);
        Assert.Equal(Convert.ToHexString(late), Convert.ToHexString(FromPage(Page, Read(late))));
    }

    [Fact]
    public void Tables_OfTheScene_AreTheSceneWithAllItsParts()
    {
        foreach (Scene scene in Gen.Sample(SceneGen.Any, 20, new Rnd(20261121, 1), 10).Append(new RandomWorld(6).Scene).Append(new RandomWorld(7).Scene))
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
            if (IsField(Page[i]))
            {
                Assert.NotEqual(whole, Written([.. Page[..i], .. Page[(i + 1)..]], recording));
                rows++;
            }

            bool isSameEitherWay = Page[i].StartsWith("| u8 | version ", StringComparison.Ordinal) && RecordingFormat.Version == WireFormat.Version;
            if (IsField(Page[i]) && IsField(Page[i + 1]) && !isSameEitherWay)
            {
                Assert.NotEqual(whole, Written([.. Page[..i], Page[i + 1], Page[i], .. Page[(i + 2)..]], recording));
            }
        }

        Assert.Equal(3 + 4 + 4 + 23 + 3 + 3 + 3, rows); // of each table
    }

    [Fact]
    public void Limits_OfThePage_AreThoseOfTheCode()
    {
        string page = string.Join("\n", Page);
        foreach (int limit in new[]
        {
            SceneFormat.MaxBytes, SceneFormat.MaxBodies, SceneFormat.MaxStaticParts, RecordingFormat.MaxJoinedBytes, RecordingFormat.MaxReasonBytes,
        })
        {
            Assert.Contains($" {limit.ToString("N0", CultureInfo.InvariantCulture)} ", page.Replace(';', ' '), StringComparison.Ordinal);
        }

        Assert.Equal(34, EventFormat.SpecBytes);
        Assert.Contains($"| event | event | {EventFormat.MinBytes} to {EventFormat.MaxBytes} bytes", page, StringComparison.Ordinal);
        Assert.StartsWith($"# Recordings, version {RecordingFormat.Version}", page, StringComparison.Ordinal);
        Assert.Contains($"`{RecordingFormat.Extension}`", page, StringComparison.Ordinal);
        foreach (Verdict verdict in Enum.GetValues<Verdict>())
        {
            string words = string.Concat(verdict.ToString().Select((c, i) => char.IsUpper(c) && i > 0 ? $" {char.ToLowerInvariant(c)}" : $"{char.ToLowerInvariant(c)}"));
            Assert.Contains($"{(int)verdict} {words}", page, StringComparison.Ordinal);
        }
    }

    /// <summary>A row of a table of fields: type, field, value.</summary>
    private static bool IsField(string line) => line.StartsWith("| ", StringComparison.Ordinal) && !line.StartsWith("| type ", StringComparison.Ordinal);

    /// <summary>A recording with every kind of record and part, all of whose neighbouring values differ.</summary>
    private static (byte[] Bytes, Recording Recording) Everything()
    {
        IAcceleration force = new Force((_, _, v) => -v);
        Scene scene = new SceneBuilder("all").WithSmallestRadius(0.125).AddAcceleration(force).AddPlane("floor", Vector3D.Up, -3.0, 0.5)
            .AddStaticSphere("rock", V(5, 6, 7), 2, 0.25).AddBody("ball", Ball(0.5, 3, 0.75), V(1, 2, 3), V(4)).Build();
        byte[] bytes = Recorded.Bytes(
            writer =>
            {
                writer.WriteEntry(9, Verdict.TooEarly, Log[0].Event);
                writer.WriteCommitted(Start + Seconds(1), 1, 2);
                writer.WriteEnd("End.");
            },
            scene, peer: 3, joined: new JoinedState(9, Start + Seconds(0.5), [1, 2, 3]));
        return (bytes, Read(bytes, [force]));
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

    private static (string Type, string Field, string Value)[] Table(string[] page, string heading) => page
        .SkipWhile(line => line != "## " + heading).Skip(1).TakeWhile(line => !line.StartsWith("## ", StringComparison.Ordinal))
        .Where(IsField).Select(line => line.Split('|', 5)).Select(cells => (cells[1].Trim(), cells[2].Trim(), cells[3].Trim())).ToArray();

    private static byte[] FromPage(string[] page, Recording recording)
    {
        MemoryStream file = new();
        Fields(file, Table(page, "The file"), new()
        {
            ["magic"] = (byte[])[0x4C, 0x61, 0x67, 0x53, 0x69, 0x6D, 0x0D, 0x0A],
            ["version"] = 1,
            ["wire version"] = (int)WireFormat.Version,
        });
        RecordingHeader header = recording.Header!;
        Put(1, "1 Header", new() { ["peer"] = (int)header.Peer, ["start"] = header.Start, ["scene hash"] = header.SceneHash, ["library version"] = header.LibraryVersion });
        PutBytes(2, SceneFromPage(page, recording.Scene!));
        if (recording.Joined is JoinedState joined)
        {
            Put(3, "3 Joined state", new() { ["first index"] = joined.FirstIndex, ["time"] = joined.Time, ["state"] = joined.State.ToArray() });
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
            Fields(content, Table(page, heading), values);
            PutBytes(kind, content.ToArray());
        }

        void PutBytes(int kind, byte[] content)
        {
            MemoryStream record = new();
            foreach ((string Type, string Field, string Value) row in Table(page, "A record"))
            {
                Fields(record, [row], new() { ["kind"] = kind, ["length"] = content.Length, ["content"] = content, ["checksum"] = Crc(record.ToArray()) });
            }

            file.Write(record.ToArray());
        }
    }

    private static byte[] SceneFromPage(string[] page, Scene scene)
    {
        MemoryStream bytes = new();
        (string Type, string Field, string Value)[] rows = Table(page, "2 Scene");
        Dictionary<string, object> head = new()
        {
            ["wire version"] = (int)WireFormat.Version,
            ["name"] = scene.Name,
            ["gravity"] = scene.Gravity,
            ["resolution"] = scene.Resolution,
            ["smallest radius"] = scene.SmallestRadius,
            ["accelerations"] = scene.Accelerations.Count,
            ["planes"] = scene.Planes.Count,
            ["static spheres"] = scene.StaticSpheres.Count,
            ["bodies"] = scene.Bodies.Count,
        };
        Dictionary<string, (string Prefix, IEnumerable<Dictionary<string, object>> Items)> lists = new()
        {
            ["accelerations"] = ("acceleration ", scene.Accelerations.Select(a => Values(("acceleration name", a.Name), ("acceleration version", a.Version)))),
            ["planes"] = ("plane ", scene.Planes.Select(p => Values(
                ("plane name", p.Name), ("plane normal", p.Normal), ("plane offset", p.Offset), ("plane restitution", p.Restitution)))),
            ["static spheres"] = ("sphere ", scene.StaticSpheres.Select(s => Values(
                ("sphere name", s.Name), ("sphere centre", s.Centre), ("sphere radius", s.Radius), ("sphere restitution", s.Restitution)))),
            ["bodies"] = ("body ", scene.Bodies.Select(b => Values(
                ("body name", b.Name), ("body spec", b.Spec), ("body position", b.Position), ("body velocity", b.Velocity)))),
        };
        for (int i = 0; i < rows.Length; i++)
        {
            Fields(bytes, [rows[i]], head);
            if (rows[i].Value.EndsWith("then for each:", StringComparison.Ordinal))
            {
                (string prefix, IEnumerable<Dictionary<string, object>> items) = lists[rows[i].Field];
                (string Type, string Field, string Value)[] each = rows.Skip(i + 1).TakeWhile(row => row.Field.StartsWith(prefix, StringComparison.Ordinal)).ToArray();
                foreach (Dictionary<string, object> item in items)
                {
                    Fields(bytes, each, item);
                }

                i += each.Length;
            }
        }

        return bytes.ToArray();

        static Dictionary<string, object> Values(params (string Field, object Value)[] values) => values.ToDictionary(v => v.Field, v => v.Value);
    }

    private static void Fields(Stream to, IEnumerable<(string Type, string Field, string Value)> rows, Dictionary<string, object> values)
    {
        foreach ((string type, string field, _) in rows)
        {
            to.Write(Bytes(type, values[field]));
        }
    }

    private static byte[] Bytes(string type, object value)
    {
        switch (type)
        {
            case "u8":
                return [Convert.ToByte(value, CultureInfo.InvariantCulture)];
            case "u16":
                return BitConverter.GetBytes(Convert.ToUInt16(value, CultureInfo.InvariantCulture));
            case "u32":
                return BitConverter.GetBytes(Convert.ToUInt32(value, CultureInfo.InvariantCulture));
            case "u64":
                return BitConverter.GetBytes((ulong)value);
            case "i32":
                return BitConverter.GetBytes((int)value);
            case "f64":
                return BitConverter.GetBytes((double)value + 0.0);
            case "vector":
                Vector3D v = (Vector3D)value;
                return [.. Bytes("f64", v.X), .. Bytes("f64", v.Y), .. Bytes("f64", v.Z)];
            case "time":
                return BitConverter.GetBytes(((SimTime)value).Ticks);
            case "text":
                byte[] utf8 = Encoding.UTF8.GetBytes((string)value);
                return [(byte)utf8.Length, .. utf8];
            case "length":
                int length = (int)value;
                return length < 128 ? [(byte)length] : [(byte)(128 + (length % 128)), .. Bytes("length", length / 128)];
            case "bytes" or "8 bytes":
                return (byte[])value;
            case "spec":
                BodySpec spec = (BodySpec)value;
                return
                [
                    .. Bytes("f64", spec.Radius), .. Bytes("f64", spec.Mass), .. Bytes("f64", spec.Restitution),
                    (byte)spec.Flight, .. BitConverter.GetBytes(spec.Step.Ticks), spec.Acceleration,
                ];
            case "event":
                ExternalEvent what = (ExternalEvent)value;
                byte[] bytes = new byte[EventFormat.EncodedLength(what.Kind)];
                WireWriter writer = new(bytes);
                EventFormat.Write(ref writer, what);
                return bytes;
            default:
                throw new NotSupportedException($"The page has a type '{type}' that no list of it explains.");
        }
    }
}
