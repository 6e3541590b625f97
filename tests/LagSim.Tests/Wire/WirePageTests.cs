using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Text;
using System.Text.RegularExpressions;
using FsCheck;
using FsCheck.Fluent;
using LagSim.Events;
using LagSim.Harness.Verification.Check;
using LagSim.Net.Protection;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Tests.Determinism;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;
using static LagSim.Tests.Wire.LayoutPage;

namespace LagSim.Tests.Wire;

/// <summary>docs/WIRE.md says what is true: datagrams and copies written from its tables, field by field in their order and types, are those of the library.</summary>
public sealed class WirePageTests
{
    private static readonly string[] Page = Read("WIRE.md");

    [Fact]
    public void Tables_WrittenFieldByField_AreTheDatagrams()
    {
        int checkedOnes = 0;
        foreach ((byte[] expected, Func<string[], byte[]> written) in Datagrams(60))
        {
            Assert.Equal(Convert.ToHexString(expected), Convert.ToHexString(written(Page)));
            checkedOnes++;
        }

        Assert.Equal(21 * 60, checkedOnes);
    }

    [Fact]
    public void Tables_OfCopyAndSnapshot_AreThoseOfWorlds()
    {
        int dense = 0, carried = 0, held = 0, inContact = 0;
        foreach (RandomWorld world in Enumerable.Range(1, 40).Select(seed => new RandomWorld(seed, hands: true, filters: seed % 4 < 2, sensors: seed % 2 == 0, rules: seed % 3 == 0)))
        {
            WorldSnapshot snapshot = world.OnTime().Snapshot(At(0.6));
            Assert.Equal(Convert.ToHexString(SnapshotFormat.Encode(snapshot)), Convert.ToHexString(Snapshot(Page, snapshot)));
            Assert.Equal(
                Convert.ToHexString(SessionSnapshot.Encode(world.Scene, snapshot)), Convert.ToHexString(Copy(Page, world.Scene, snapshot)));
            dense += snapshot.Bodies.Count(b => b.Law == MotionLaw.RungeKutta4);
            carried += snapshot.Bodies.Count(b => b.SupportCount > 0);
            held += snapshot.Bodies.Count(b => b.Law == MotionLaw.Held);
            inContact += snapshot.Bodies.Count(b => b.Contacts.Length > 0);
        }

        // Else nothing was shown.
        Assert.True(dense > 10 && carried > 3 && held > 5 && inContact > 3, $"{dense} {carried} {held} {inContact}");
    }

    [Fact]
    public void Tables_WithTwoRowsSwappedOrOneLess_AreSeenToFail()
    {
        (byte[] Expected, Func<string[], byte[]> Written)[] all = [.. Datagrams(25), .. Snapshots()];
        int rows = 0;
        for (int i = 0; i < Page.Length; i++)
        {
            if (IsField(Page, i))
            {
                string[] without = [.. Page[..i], .. Page[(i + 1)..]];
                Assert.True(all.Any(one => Differs(one, without)), $"without '{Page[i]}'");
                rows++;
            }

            if (IsField(Page, i) && IsField(Page, i + 1) && !Page[i].Contains("padding", StringComparison.Ordinal))
            {
                string[] swapped = [.. Page[..i], Page[i + 1], Page[i], .. Page[(i + 2)..]];
                Assert.True(all.Any(one => Differs(one, swapped)), $"with '{Page[i]}' below the next");
            }
        }

        Assert.Equal(3 + 2 + 6 + 2 + 17 + 4 + 6 + 4 + 3 + 7 + 5 + 3 + 6 + 13 + 4 + 3 + 2 + 3 + 2 + 2 + 3 + 4 + 3 + 34 + 6 + 5 + 4 + 10 + 3, rows);
    }

    [Fact]
    public void Numbers_OfThePage_AreThoseOfTheCode()
    {
        string page = string.Join("\n", Page);
        Assert.StartsWith($"# The wire format, version {WireFormat.Version}\n", page, StringComparison.Ordinal);
        Dictionary<DatagramType, int> lengths = new()
        {
            [DatagramType.ConnectRequest] = WireFormat.ConnectRequestBytes,
            [DatagramType.Welcome] = WireFormat.WelcomeBytes,
            [DatagramType.Refusal] = WireFormat.RefusalBytes,
            [DatagramType.Update] = WireFormat.EmptyUpdateBytes,
            [DatagramType.Leave] = WireFormat.LeaveBytes,
            [DatagramType.Challenge] = WireFormat.ChallengeBytes,
            [DatagramType.Join] = WireFormat.JoinBytes,
            [DatagramType.SnapshotRequest] = WireFormat.SnapshotRequestBytes,
            [DatagramType.SnapshotChunk] = WireFormat.EmptySnapshotChunkBytes + 1,
            [DatagramType.DesyncQuery] = WireFormat.DesyncQueryBytes,
            [DatagramType.DesyncReport] = WireFormat.EmptyDesyncReportBytes,
            [DatagramType.Seat] = WireFormat.SeatBytes,
            [DatagramType.Move] = WireFormat.MoveBytes,
            [DatagramType.MoveChallenge] = WireFormat.MoveChallengeBytes,
            [DatagramType.SecureJoin] = WireFormat.SecureJoinBytes,
            [DatagramType.SecureWelcome] = WireFormat.SecureWelcomeBytes,
            [DatagramType.SecureRefusal] = WireFormat.SecureRefusalBytes,
            [DatagramType.Reset] = WireFormat.ResetBytes,
            [DatagramType.Roster] = WireFormat.EmptyRosterBytes + RosterEntry.GoneBytes,
            [DatagramType.RosterReceived] = WireFormat.RosterReceivedBytes,
            [DatagramType.Sealed] = SealedDatagram.PrologueBytes + 1 + IDatagramCipher.TagBytes,
        };
        Assert.Equal($"{WireFormat.Version}", HeaderVersion(Page));
        Assert.NotEqual($"{WireFormat.Version}", HeaderVersion([.. Page.Select(line => line == $"| u8 | version | {WireFormat.Version} |" ? "| u8 | version | 10 |" : line)])); // the control
        foreach (DatagramType type in Enum.GetValues<DatagramType>().Where(type => type != DatagramType.None))
        {
            Assert.Contains($"{(int)type} {type}", Table(Page, "## Header")[2].Value, StringComparison.Ordinal);
            Assert.Single(Page, line => line.StartsWith($"## {(int)type} {type}, {lengths[type]} ", StringComparison.Ordinal));
        }

        AssertWords<RefusalReason>(Table(Page, "## 3 Refusal")[1].Value);
        AssertWords<Verdict>(Table(Page, "## 4 Update").Single(row => row.Field == "entry verdict").Value);
        Assert.Contains($"0 to {UpdateDatagram.MaxEntries};", page, StringComparison.Ordinal);
        Assert.Contains($"{SnapshotChunkDatagram.MaxData.ToString("N0", CultureInfo.InvariantCulture)} bytes", page, StringComparison.Ordinal);
        Assert.Contains($"1 to {SessionSnapshot.MaxBytes.ToString("N0", CultureInfo.InvariantCulture)} |", page, StringComparison.Ordinal);
        Assert.Contains($"0 to {BodySnapshot.MaxSupports} |", page, StringComparison.Ordinal);
        foreach (string refusal in Enum.GetNames<WireRefusal>().Where(name => name != nameof(WireRefusal.None)))
        {
            Assert.Matches($@"\| ([A-Za-z, ]*, )?{refusal}(, [A-Za-z]*)? \|", page);
        }
    }

    private static string HeaderVersion(string[] page) => Table(page, "## Header").Single(row => row.Field == "version").Value;

    private static void AssertWords<T>(string value)
        where T : struct, Enum
    {
        foreach (T one in Enum.GetValues<T>())
        {
            string words = Regex.Replace(one.ToString(), "(?<!^)([A-Z])", " $1").ToLowerInvariant();
            Assert.Contains(string.Create(CultureInfo.InvariantCulture, $"{Convert.ToInt32(one, CultureInfo.InvariantCulture)} {words}"), value, StringComparison.Ordinal);
        }
    }

    private static bool Differs((byte[] Expected, Func<string[], byte[]> Written) one, string[] page)
    {
        try
        {
            return !one.Expected.AsSpan().SequenceEqual(one.Written(page));
        }
        catch (Exception wrong) when (wrong is KeyNotFoundException or InvalidCastException or IndexOutOfRangeException or FormatException or OverflowException)
        {
            return true; // a field that is not of this table
        }
    }

    private static IEnumerable<(byte[] Expected, Func<string[], byte[]> Written)> Snapshots() => Enumerable.Range(1, 8).Select(seed =>
    {
        RandomWorld world = new(seed);
        WorldSnapshot snapshot = world.OnTime().Snapshot(At(0.6));
        if (seed == 1)
        {
            // No body of a world is carried and integrated at a time, but a layout has room for both.
            BodySnapshot b = snapshot.Bodies[0];
            BodySnapshot both = new(
                b.Id, b.Spec, b.Opened, MotionLaw.RungeKutta4, b.Epoch, b.End, b.Position, b.Velocity, b.Acceleration, [7, 8, 9], V(1, 2, 3), V(4, 5, 6), V(7, 8, 9));
            snapshot = new WorldSnapshot(snapshot.Start, snapshot.Time, snapshot.EventHash, [both]);
        }
        else if (seed == 3)
        {
            BodySnapshot b = snapshot.Bodies[0];
            BodySnapshot controlled = new(
                b.Id, b.Spec.With(new CollisionFilter(2, 3)).WithTag(77), b.Opened, MotionLaw.DormandPrince54, b.Epoch, b.End, b.Position, b.Velocity, b.Acceleration, [], V(1, 2, 3), V(4, 5, 6), V(7, 8, 9),
                nextStep: SimDuration.FromSeconds(0.25), spin: V(10, 11, 12), spinRate: V(13, 14, 15), filter: new CollisionFilter(5, 9), players: PeerSet.Of(1, 4));
            snapshot = new WorldSnapshot(snapshot.Start, snapshot.Time, snapshot.EventHash, [controlled]);
        }
        else if (seed == 2)
        {
            BodySnapshot b = snapshot.Bodies[0];
            BodySnapshot held = new(
                b.Id, b.Spec, b.Opened, MotionLaw.Held, b.Epoch, b.End, b.Position, b.Velocity, b.Acceleration, [7], V(1, 2, 3), hold: new Hold(3, V(4, 5, 6), At(7), 8, 9, At(10)),
                filter: new CollisionFilter(5, 9), players: PeerSet.Of(2));
            snapshot = new WorldSnapshot(snapshot.Start, snapshot.Time, snapshot.EventHash, [held]);
        }

        else if (seed == 4)
        {
            BodySnapshot b = snapshot.Bodies[0];
            PersistentContact[] contacts =
                [new(Second, PersistentContact.NoSurface, true, V(1, 2, 3), V(4, 5, 6)), new(First, 7, false, V(7, 8, 9), V(-1, -2, -0.0))];
            BodySnapshot member = new(
                b.Id, b.Spec, b.Opened, MotionLaw.Constrained, b.Epoch, b.End, b.Position, b.Velocity, b.Acceleration, spin: V(10, 11, 12),
                centre: At(0.125), stillSince: At(0.25), contacts: contacts, filter: new CollisionFilter(6, 10), inside: [3, 7],
                crossings: [new Crossing(new EventKey(At(0.5), 2, EventKind.Crossing, b.Id, b.Id, 0, 7), true)], players: PeerSet.Of(2));
            BodySnapshot sleeper = new(
                Second, b.Spec, b.Opened, MotionLaw.Resting, b.Epoch, b.End, b.Position, default, default, centre: At(0.375),
                contacts: contacts.AsSpan(0, 1));
            BodySnapshot carried = new(Third, b.Spec, b.Opened, MotionLaw.Resting, b.Epoch, b.End, b.Position, default, default, [3]);
            snapshot = new WorldSnapshot(snapshot.Start, snapshot.Time, snapshot.EventHash, [member, sleeper, carried], new RandomWorld(5, rules: true).OnTime().Snapshot(At(0.6)).RuleState);
        }

        return (SessionSnapshot.Encode(world.Scene, snapshot), (Func<string[], byte[]>)(page => Copy(page, world.Scene, snapshot)));
    });

    private static IEnumerable<(byte[] Expected, Func<string[], byte[]> Written)> Datagrams(int each)
    {
        foreach (ConnectRequestDatagram d in Sample(WireGen.ConnectRequest, each))
        {
            yield return (AnyDatagram.Bytes(d.Encode), page => Datagram(page, DatagramType.ConnectRequest, ("nonce", d.Nonce), ("padding", new byte[48])));
        }

        foreach (WelcomeDatagram d in Sample(WireGen.Welcome, each))
        {
            yield return (AnyDatagram.Bytes(d.Encode), page => Datagram(
                page, DatagramType.Welcome, ("nonce", d.Nonce), ("session id", d.SessionId),
                ("history", d.History.Ticks), ("copy length", d.CopyLength), ("copy hash", d.CopyHash), ("log index", d.LogIndex)));
        }

        foreach (RefusalDatagram d in Sample(WireGen.Refusal, each))
        {
            yield return (AnyDatagram.Bytes(d.Encode), page => Datagram(page, DatagramType.Refusal, ("nonce", d.Nonce), ("reason", (byte)d.Reason)));
        }

        foreach (UpdateDatagram d in Sample(WireGen.Update, each))
        {
            yield return (AnyDatagram.Bytes(d.Encode), page => Update(page, d));
        }

        foreach (LeaveDatagram d in Sample(WireGen.Leave, each))
        {
            yield return (AnyDatagram.Bytes(d.Encode), page => Datagram(
                page, DatagramType.Leave, ("session id", d.SessionId), ("peer", d.Peer), ("reason", (byte)d.Reason), ("sentence", d.Reason == LeaveReason.HostFailed
                    ? [.. LayoutPage.Bytes("u16", Encoding.UTF8.GetByteCount(d.Sentence)), .. Encoding.UTF8.GetBytes(d.Sentence)] : Array.Empty<byte>())));
        }

        foreach ((ulong nonce, byte[] cookie) in Sample(from n in WireGen.Bits64 from c in Gen.ArrayOf(WireGen.Byte, 16) select (n, c), each))
        {
            byte[] identity = [.. cookie.Reverse(), .. cookie];
            WireReader reader = new(identity);
            yield return (AnyDatagram.Bytes(new ChallengeDatagram(nonce, new Token128(cookie), PublicIdentity.Read(ref reader)).Encode), page => Datagram(
                page, DatagramType.Challenge, ("nonce", nonce), ("cookie", cookie), ("identity", identity)));
            yield return (AnyDatagram.Bytes(new MoveChallengeDatagram(nonce, new Token128(cookie)).Encode), page => Datagram(
                page, DatagramType.MoveChallenge, ("session id", nonce), ("cookie", cookie)));
            yield return (AnyDatagram.Bytes(new ResetDatagram(nonce, LeaveReason.NotJoined, new Token128(cookie)).Encode), page => Datagram(
                page, DatagramType.Reset, ("session id", nonce), ("reason", (byte)LeaveReason.NotJoined), ("proof", cookie)));
            foreach (DatagramType answer in new[] { DatagramType.SecureWelcome, DatagramType.SecureRefusal })
            {
                yield return (AnyDatagram.SecureAnswerBytes(answer, nonce, cookie), page => Datagram(page, answer, ("nonce", nonce), ("message", cookie)));
            }

            byte[] prologue = AnyDatagram.Bytes(to => JoinDatagram.WritePrologue(to, DatagramType.SecureJoin, nonce, new Token128(cookie)));
            yield return ([.. prologue, .. identity], page => Datagram(
                page, DatagramType.SecureJoin, ("nonce", nonce), ("cookie", cookie), ("message", identity)));
            yield return (AnyDatagram.SealedBytes(nonce, nonce >> 16, cookie), page => Datagram(
                page, DatagramType.Sealed, ("session id", nonce), ("number", (uint)(nonce >> 16)), ("more number", (ushort)(nonce >> 48)), ("body", cookie)));
            yield return (AnyDatagram.Bytes(new JoinDatagram(nonce, new Token128(cookie), new Token128([.. cookie.Reverse()]), ~nonce, (uint)nonce, 7, new Token128(cookie), 3, "Zoë").Encode), page => Datagram(
                page, DatagramType.Join, ("nonce", nonce), ("cookie", cookie), ("proof", (byte[])[.. cookie.Reverse()]), ("scene hash", ~nonce),
                ("fold version", (uint)nonce), ("player", 7), ("player proof", cookie), ("role", 3), ("name", "Zoë")));
            yield return (AnyDatagram.ChunkBytes(nonce, 77, cookie), page => Datagram(
                page, DatagramType.SnapshotChunk, ("session id", nonce), ("index", 77), ("data", cookie)));
        }

        foreach (SeatDatagram d in Sample(WireGen.Seat, each))
        {
            byte[] bytes = AnyDatagram.Bytes(d.Encode);
            yield return (bytes, page => Datagram(
                page, DatagramType.Seat, ("session id", d.SessionId), ("peer", d.Peer), ("last sequence", d.LastSequence), ("pass", bytes[17..33]),
                ("earliest", d.Earliest), ("promise", d.PromiseMilliseconds)));
        }

        foreach (RosterDatagram d in Sample(WireGen.Roster, each))
        {
            yield return (AnyDatagram.Bytes(d.Encode), page => Roster(page, d));
        }

        foreach (RosterReceivedDatagram d in Sample(WireGen.RosterReceived, each))
        {
            yield return (AnyDatagram.Bytes(d.Encode), page => Datagram(
                page, DatagramType.RosterReceived, ("session id", d.SessionId), ("peer", d.Peer), ("revision", d.Revision)));
        }

        foreach (MoveDatagram d in Sample(WireGen.Move, each))
        {
            byte[] bytes = AnyDatagram.Bytes(d.Encode);
            yield return (bytes, page => Datagram(page, DatagramType.Move, ("session id", d.SessionId), ("peer", d.Peer), ("cookie", bytes[^16..])));
        }

        foreach (SnapshotRequestDatagram d in Sample(WireGen.SnapshotRequest, each))
        {
            yield return (AnyDatagram.Bytes(d.Encode), page => Datagram(
                page, DatagramType.SnapshotRequest, ("session id", d.SessionId), ("peer", d.Peer), ("number", d.Number), ("first", d.First), ("wanted", d.Wanted)));
        }

        foreach (DesyncQueryDatagram d in Sample(WireGen.DesyncQuery, each))
        {
            yield return (AnyDatagram.Bytes(d.Encode), page => Datagram(
                page, DatagramType.DesyncQuery, ("session id", d.SessionId), ("peer", d.Peer), ("number", d.Number), ("after", d.After), ("up to", d.UpTo), ("first", d.First)));
        }

        foreach (DesyncReportDatagram d in Sample(WireGen.DesyncReport, each))
        {
            yield return (AnyDatagram.Bytes(d.Encode), page => DesyncReport(page, d));
        }
    }

    private static IEnumerable<T> Sample<T>(Gen<T> gen, int count) => Gen.Sample(gen, count, new Rnd(20261121, 1), 30);

    private static byte[] Datagram(string[] page, DatagramType type, params (string Field, object Value)[] values)
    {
        MemoryStream bytes = new();
        Header(bytes, page, type);
        Write(bytes, Table(page, $"## {(int)type} {type}"), Values(values));
        return bytes.ToArray();
    }

    private static void Header(Stream to, string[] page, DatagramType type) => Write(
        to, Table(page, "## Header"), Values(("magic", 0x4C53), ("version", WireFormat.Version), ("type", (byte)type)));

    private static byte[] DesyncReport(string[] page, DesyncReportDatagram d)
    {
        LayoutRow[] rows = Table(page, "## 11 DesyncReport");
        rows = d.Total > 0 ? rows : [.. rows.Where(row => !row.Value.Contains("only with an event", StringComparison.Ordinal))];
        MemoryStream bytes = new();
        Header(bytes, page, DatagramType.DesyncReport);
        Write(bytes, rows, Values(
            ("session id", d.SessionId), ("whole", d.IsWhole ? 1 : 0), ("total", d.Total), ("index", d.Index), ("log index", d.LogIndex),
            ("event", d.Total > 0 ? Event(page, d.Event) : [])));
        return bytes.ToArray();
    }

    private static byte[] Roster(string[] page, RosterDatagram d)
    {
        LayoutRow[] rows = Table(page, "## 20 Roster");
        int head = Array.FindIndex(rows, row => row.Field == "count") + 1;
        MemoryStream bytes = new();
        Header(bytes, page, DatagramType.Roster);
        Write(bytes, rows[..head], Values(
            ("session id", d.SessionId), ("after", d.After), ("up to", d.UpTo), ("newest", d.Newest), ("count", d.Entries.Length)));
        foreach (RosterEntry entry in d.Entries)
        {
            Write(
                bytes,
                rows[head..].Where(row => entry.Role != RosterEntry.NoRole || !row.Value.Contains("only with a role", StringComparison.Ordinal)),
                Values(
                    ("entry number", entry.Number), ("entry role", entry.Role), ("entry visit", entry.Visit),
                    ("entry silent since", entry.SilentSince), ("entry name", entry.Name)));
        }

        return bytes.ToArray();
    }

    private static byte[] Update(string[] page, UpdateDatagram d)
    {
        List<Dictionary<string, object>> entries = [];
        foreach (UpdateEntry entry in d.Entries)
        {
            entries.Add(Values(
                ("entry verdict", (byte)entry.Verdict + (entry.IsOwn ? 128 : 0)),
                ("entry event", entry.IsOwn ? BitConverter.GetBytes(entry.Sequence) : Event(page, entry.Event))));
        }

        LayoutRow[] rows = Table(page, "## 4 Update");
        if (!d.HasStateHash)
        {
            rows = [.. rows.Where(row => !row.Value.Contains("only with flag bit 0", StringComparison.Ordinal))];
        }

        if (d.Start == SimTime.MinValue)
        {
            rows = [.. rows.Where(row => !row.Value.Contains("only with flag bit 2", StringComparison.Ordinal))];
        }

        MemoryStream bytes = new();
        Header(bytes, page, DatagramType.Update);
        Write(
            bytes,
            rows,
            Values(
                ("session id", d.SessionId), ("peer", d.Peer), ("number", d.Number), ("sent", d.Sent), ("echo number", d.EchoNumber), ("echo bits", d.EchoBits), ("echo received", d.EchoReceived),
                ("start", d.Start), ("watermark", d.Watermark), ("events received", d.EventsReceived), ("flags", (d.HasStateHash ? 1 + ((d.StateHashes.Length - 1) << 3) : 0) + (d.Ready ? 2 : 0) + (d.Start == SimTime.MinValue ? 0 : 4)),
                ("hash time", d.HashTime), ("state hashes", d.StateHashes.ToArray().SelectMany(BitConverter.GetBytes).ToArray()), ("first index", d.FirstIndex), ("count", d.Entries.Length)),
            new() { ["count"] = ("entry ", entries) });
        return bytes.ToArray();
    }

    /// <summary>An event from the table of what all have and the table of what each kind has.</summary>
    private static byte[] Event(string[] page, ExternalEvent what)
    {
        MemoryStream bytes = new();
        Write(bytes, Table(page, "### Event"), Values(("kind", (byte)((int)what.Kind + (((int)what.WhenOccupied + (Strength(what).Length > 0 ? 1 : 0)) * 64))), ("peer", what.Peer), ("sequence", what.Sequence), ("time", what.Time)));
        string words = Regex.Replace(what.Kind.ToString(), "(?<!^)([A-Z])", " $1").ToLowerInvariant();
        string[] row = page.Single(line => line.StartsWith($"| {words} |", StringComparison.Ordinal)).Split('|');
        foreach (string field in row[3].Split(';')[0].Split(',', StringSplitOptions.TrimEntries))
        {
            bytes.Write(field switch
            {
                "spec without filter and tag" => Spec(page, what.Spec)[..^16],
                "u8 has" => Bytes("u8", (byte)((what.Players == PeerSet.Everyone ? 0 : 1) + (what.Spec.Filter.IsDefault ? 0 : 2) + (what.Spec.Tag == 0 ? 0 : 4))),
                "what it has" => More(page, what),
                "u64 body" => Bytes("u64", what.Body.Packed),
                "position" => Bytes("vector", what.Position),
                "strength" => Strength(what),
                "offset" => Bytes("vector", what.Position),
                "spin" => Bytes("vector", what.Spin),
                "filter" => Bytes("filter", what.Filter),
                "u16 number" => Bytes("u16", what.Command!.Number),
                "u8 length" => [(byte)what.Command!.Length],
                "data" => what.Command!.Data.ToArray(),
                "velocity" or "impulse" => Bytes("vector", what.Velocity),
                _ => throw new KeyNotFoundException(field),
            });
        }

        byte[] more = what.Kind == EventKind.Spawn ? More(page, what) : what.Command?.Data.ToArray() ?? Strength(what);
        Assert.Equal(int.Parse(row[2].Split(' ', StringSplitOptions.RemoveEmptyEntries)[0], CultureInfo.InvariantCulture) + more.Length, EventFormat.EncodedLength(what));
        return bytes.ToArray();
    }

    private static byte[] Strength(ExternalEvent grab) =>
        grab.MaxForce == 0 && grab.MaxPower == 0 ? [] : [.. BitConverter.GetBytes(grab.MaxForce), .. BitConverter.GetBytes(grab.MaxPower)];

    /// <summary>What a spawn has besides: players, filter, tag.</summary>
    private static byte[] More(string[] page, ExternalEvent spawn) =>
    [
        .. spawn.Players == PeerSet.Everyone ? [] : Bytes("u32", spawn.Players.Mask),
        .. spawn.Spec.Filter.IsDefault ? [] : Spec(page, spawn.Spec)[^16..^8], .. spawn.Spec.Tag == 0 ? [] : Spec(page, spawn.Spec)[^8..],
    ];

    private static byte[] Spec(string[] page, BodySpec spec)
    {
        MemoryStream bytes = new();
        Write(bytes, Table(page, "### Spec"), Values(
            ("radius", spec.Radius), ("mass", spec.Mass), ("restitution", spec.Restitution), ("flight", (byte)spec.Flight), ("step", spec.Step.Ticks),
            ("forces", spec.Forces.Mask), ("tolerance", spec.Tolerance), ("friction", spec.Friction), ("rolling resistance", spec.RollingResistance),
            ("category", spec.Filter.Category), ("mask", spec.Filter.Mask), ("tag", spec.Tag)));
        return bytes.ToArray();
    }

    private static byte[] Copy(string[] page, Scene scene, WorldSnapshot snapshot)
    {
        byte[] first = SceneFormat.Encode(scene);
        MemoryStream bytes = new();
        Write(bytes, Table(page, "## The copy"), Values(("scene length", first.Length), ("scene", first), ("snapshot", Snapshot(page, snapshot))));
        return bytes.ToArray();
    }

    private static byte[] Snapshot(string[] page, WorldSnapshot snapshot)
    {
        MemoryStream bytes = new();
        Write(
            bytes,
            Table(page, "## Snapshot"),
            Values(("start", snapshot.Start), ("time", snapshot.Time), ("event hash", snapshot.EventHash), ("rule state length", snapshot.RuleState.Length), ("rule state", RuleState(page, snapshot.RuleState)),
                ("bodies", snapshot.Bodies.Count)),
            new() { ["bodies"] = ("", snapshot.Bodies.Select(body => Body(page, body))) });
        return bytes.ToArray();
    }

    private static byte[] RuleState(string[] page, ReadOnlySpan<byte> state)
    {
        if (state.IsEmpty)
        {
            return [];
        }

        int timers = BitConverter.ToInt32(state[8..]) * 16;
        int world = new DrawnRules(0).WorldBytes;
        MemoryStream bytes = new();
        Write(bytes, Table(page, "### State of rules"), Values(
            ("spawned", BitConverter.ToUInt64(state)), ("timers", BitConverter.ToInt32(state[8..])), ("body states", BitConverter.ToInt32(state[12..])),
            ("timer list", state[16..(16 + timers)].ToArray()), ("world state", state.Slice(16 + timers, world).ToArray()), ("body list", state[(16 + timers + world)..].ToArray())));
        return bytes.ToArray();
    }

    private static Dictionary<string, object> Body(string[] page, BodySnapshot b) => Values(
        ("body id", b.Id.Packed), ("body spec", b.Spec), ("opened at", b.Opened.Time), ("opened round", b.Opened.Round), ("opened kind", (byte)b.Opened.Kind),
        ("opened body", b.Opened.Body.Packed), ("opened other", b.Opened.Other.Packed), ("opened peer", b.Opened.Peer), ("opened sequence", b.Opened.Sequence),
        ("law", (byte)b.Law), ("epoch", b.Epoch), ("end", b.End), ("position", b.Position), ("velocity", b.Velocity), ("acceleration", b.Acceleration),
        ("supports", (byte)b.SupportCount), ("carried by", Enumerable.Range(0, b.SupportCount).Select(b.Support).ToArray()),
        ("dense output", b.Law is MotionLaw.RungeKutta4 or MotionLaw.ClosedForm or MotionLaw.DormandPrince54
            ? new[] { b.Cubic, b.Quartic, b.Quintic } : []),
        ("next step", b.Law == MotionLaw.DormandPrince54 ? new[] { b.NextStep.Ticks } : []),
        ("has", (b.Spin != Vector3D.Zero || b.SpinRate != Vector3D.Zero ? 1 : 0) + (b.Filter != b.Spec.Filter ? 2 : 0)
            + (b.Players != PeerSet.Everyone ? 4 : 0) + (b.Inside.Length + b.Crossings.Length > 0 ? 8 : 0)
            + (b.Hold.MaxForce != 0 || b.Hold.MaxPower != 0 ? 16 : 0) + (b.Hold.BusyUntil != default ? 32 : 0)),
        ("strength", b.Hold.MaxForce != 0 || b.Hold.MaxPower != 0 ? [.. BitConverter.GetBytes(b.Hold.MaxForce), .. BitConverter.GetBytes(b.Hold.MaxPower)] : Array.Empty<byte>()),
        ("busy", b.Hold.BusyUntil != default ? BitConverter.GetBytes(b.Hold.BusyUntil.Ticks) : []),
        ("players", b.Players != PeerSet.Everyone ? BitConverter.GetBytes(b.Players.Mask) : []),
        ("filter", b.Filter != b.Spec.Filter ? b.Filter : null!),
        ("sensors", Sensors(b)),
        ("spin", b.Spin != Vector3D.Zero || b.SpinRate != Vector3D.Zero ? new[] { b.Spin, b.SpinRate } : []),
        ("hold", b.Law == MotionLaw.Held ? (b.Hold, b.Cubic) : null!),
        ("member", IsMember(b) ? (b.Centre, b.StillSince, b.Contacts.Length) : null!),
        ("contacts", IsMember(b) ? b.Contacts.ToArray().SelectMany(contact => Contact(page, contact)).ToArray() : []));

    private static byte[] Sensors(BodySnapshot b) => b.Inside.Length + b.Crossings.Length == 0 ? [] :
    [
        .. LayoutPage.Bytes("u16", b.Inside.Length), .. b.Inside.ToArray().SelectMany(sensor => LayoutPage.Bytes("u16", sensor)), .. LayoutPage.Bytes("u16", b.Crossings.Length),
        .. b.Crossings.ToArray().SelectMany(c => (byte[])[.. LayoutPage.Bytes("ticks", c.Time), .. LayoutPage.Bytes("u32", c.Key.Round), .. LayoutPage.Bytes("u16", c.Sensor), (byte)(c.Entered ? 1 : 0)]),
    ];

    private static bool IsMember(BodySnapshot b) => b.Law == MotionLaw.Constrained || (b.Law == MotionLaw.Resting && b.SupportCount == 0);

    private static byte[] Contact(string[] page, PersistentContact contact)
    {
        MemoryStream bytes = new();
        uint surface = contact.Surface == PersistentContact.NoSurface ? 0xFFFFFFFF : (uint)contact.Surface;
        Write(bytes, Table(page, "### Persistent contact"), Values(
            ("partner", contact.Partner.Packed), ("surface", surface), ("holds", contact.Holds ? 1 : 0), ("push", contact.Push),
            ("turn", contact.Turn)));
        return bytes.ToArray();
    }
}
