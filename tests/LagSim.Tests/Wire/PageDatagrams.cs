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
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.Wire.LayoutPage;

namespace LagSim.Tests.Wire;

/// <summary>Drawn datagrams: of each, the bytes that the library writes and those that the tables of docs/WIRE.md give.</summary>
internal static class PageDatagrams
{
    internal static IEnumerable<(byte[] Expected, Func<string[], byte[]> Written)> Datagrams(int each)
    {
        foreach (ConnectRequestDatagram d in Sample(WireGen.ConnectRequest, each))
        {
            byte[] bytes = AnyDatagram.Bytes(d.Encode);
            yield return (bytes, page => Datagram(page, DatagramType.ConnectRequest, ("nonce", d.Nonce), ("wanted", bytes[12..28]), ("padding", new byte[32])));
        }

        foreach (WelcomeDatagram d in Sample(WireGen.Welcome, each))
        {
            yield return (AnyDatagram.Bytes(d.Encode), page => Datagram(
                page, DatagramType.Welcome, ("nonce", d.Nonce), ("session id", d.SessionId),
                ("history", d.History.Ticks), ("longest history", d.LongestHistory.Ticks), ("copy length", d.CopyLength), ("copy hash", d.CopyHash), ("log index", d.LogIndex)));
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
                page, DatagramType.Leave, ("session id", d.SessionId), ("peer", d.Peer), ("reason", (byte)d.Reason), ("sentence", d.Reason is LeaveReason.HostFailed or LeaveReason.Kicked
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
            yield return (AnyDatagram.SealedBytes(nonce, nonce >> 24, cookie, (byte)nonce), page => Datagram(
                page, DatagramType.Sealed, ("session id", nonce), ("number", (uint)(nonce >> 24)), ("more number", (byte)(nonce >> 56)),
                ("generation", (byte)nonce), ("body", cookie)));
            foreach (DatagramType keys in new[] { DatagramType.KeyExchange, DatagramType.KeyExchangeReply })
            {
                byte[] message = [.. identity, .. cookie];
                yield return (AnyDatagram.KeyExchangeBytes(keys, nonce, (uint)nonce, message), page => Datagram(
                    page, keys, ("session id", nonce), ("generation", (uint)nonce), ("message", message)));
            }

            yield return (AnyDatagram.Bytes(new JoinDatagram(nonce, new Token128(cookie), new Token128([.. cookie.Reverse()]), ~nonce, (uint)nonce, 7, new Token128(cookie), 3, "Zoë").Encode), page => Datagram(
                page, DatagramType.Join, ("nonce", nonce), ("cookie", cookie), ("proof", (byte[])[.. cookie.Reverse()]), ("scene hash", ~nonce),
                ("fold version", (uint)nonce), ("player", 7), ("player proof", cookie), ("role", 3), ("name", "Zoë")));
            yield return (AnyDatagram.ChunkBytes(nonce, 77, cookie), page => Datagram(
                page, DatagramType.SnapshotChunk, ("session id", nonce), ("offset", 77), ("data", cookie)));
        }

        foreach (SeatDatagram d in Sample(WireGen.Seat, each))
        {
            byte[] bytes = AnyDatagram.Bytes(d.Encode);
            yield return (bytes, page => Datagram(
                page, DatagramType.Seat, ("session id", d.SessionId), ("peer", d.Peer), ("last sequence", d.LastSequence), ("pass", bytes[17..33]),
                ("earliest", d.Earliest), ("promise", d.PromiseMilliseconds), ("promised for", d.PromiseSeconds)));
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
                page, DatagramType.SnapshotRequest, ("session id", d.SessionId), ("shorter", d.Shorter), ("number", d.Number), ("first", d.First), ("wanted", d.Wanted)));
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
                "u8 what" => [(byte)what.PlayerEvent!.Kind],
                "u8 who" => [what.PlayerEvent!.Number],
                "u8 role" => [(byte)what.PlayerEvent!.Role],
                "u64 identity" => Bytes("u64", what.PlayerEvent!.Identity),
                "name" => [(byte)Name(what).Length, .. Name(what)],
                "velocity" or "impulse" => Bytes("vector", what.Velocity),
                _ => throw new KeyNotFoundException(field),
            });
        }

        byte[] more = what.Kind == EventKind.Spawn ? More(page, what) : what.Kind == EventKind.Player ? Name(what) : what.Command?.Data.ToArray() ?? Strength(what);
        Assert.Equal(int.Parse(row[2].Split(' ', StringSplitOptions.RemoveEmptyEntries)[0], CultureInfo.InvariantCulture) + more.Length, EventFormat.EncodedLength(what));
        return bytes.ToArray();
    }

    private static byte[] Name(ExternalEvent player) => Encoding.UTF8.GetBytes(player.PlayerEvent!.Name);

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
}
