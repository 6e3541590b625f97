using System;
using System.Buffers.Binary;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using LagSim.Net.Recordings;
using LagSim.Net.Wire;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.Recordings.Recorded;

namespace LagSim.Tests.Recordings;

/// <summary>A file that was cut or changed is read up to the damage, and the damage is named.</summary>
public sealed class DamageTests
{
    private const int Trials = 10_000;

    private static readonly byte[] Whole = Small();
    private static readonly List<int> At = Boundaries(Whole);

    [Fact]
    public void Read_CutAtEveryByte_HasAllRecordsBeforeTheCutAndNamesIt()
    {
        Assert.Equal(2 + Log.Length + 5 + 1 + 1, At.Count); // header, scene, entries, states, end; and where the last record ends
        for (int length = 0; length <= Whole.Length; length++)
        {
            Recording cut = Read(Whole[..length]);
            int records = At.FindLastIndex(at => at <= length);
            AssertBefore(cut, records);
            bool isBetween = At.Contains(length) && records >= 2;
            Assert.Equal(isBetween, cut.Damage is null);
            Assert.Equal(length == Whole.Length, cut.IsWhole);
            if (!isBetween)
            {
                Assert.Equal(length < 10 ? 0 : At[records], cut.Damage!.Offset);
                Assert.StartsWith(length == 0 ? "The file is empty." : "The file ends ", cut.Damage.Reason, StringComparison.Ordinal);
            }
        }
    }

    [Fact]
    public void Read_EveryBitFlipped_IsNoticedInItsRecordAndAllBeforeIsThere()
    {
        for (int bit = 0; bit < Whole.Length * 8; bit++)
        {
            byte[] bytes = (byte[])Whole.Clone();
            bytes[bit / 8] ^= (byte)(1 << (bit % 8));

            Recording read = Read(bytes);

            int records = At.FindLastIndex(at => at <= bit / 8);
            Assert.True(read.Damage is not null, $"bit {bit}");
            Assert.Equal(bit / 8 < 8 ? 0 : bit / 8 < 10 ? bit / 8 : At[records], read.Damage.Offset);
            AssertBefore(read, records);
        }
    }

    [Fact]
    public void Read_WithoutChecksums_WouldNotNoticeABit()
    {
        // The control of the test above: one bit of an event with the checksum put right is another recording, and no damage.
        int entry = At[2];
        byte[] bytes = (byte[])Whole.Clone();
        bytes[At[3] - 5] ^= 1;
        BinaryPrimitives.WriteUInt32LittleEndian(bytes.AsSpan(At[3] - 4), Crc(bytes[entry..(At[3] - 4)]));

        Recording read = Read(bytes);

        Assert.Null(read.Damage);
        Assert.NotEqual(Log[0], read.Entries[0]);
        Assert.Equal(Log[1..], read.Entries.Skip(1));
    }

    [Fact]
    public void Read_RandomBytes_NeverThrows()
    {
        Random random = new(5);
        byte[] buffer = new byte[3000];
        for (int i = 0; i < Trials; i++)
        {
            byte[] bytes = buffer[..random.Next(i % 2 == 0 ? 40 : buffer.Length)];
            random.NextBytes(bytes);
            int known = Math.Min(bytes.Length, i % 4 == 0 ? 0 : i % 4 == 1 ? 10 : random.Next(Whole.Length));
            Whole.AsSpan(0, known).CopyTo(bytes); // past the prefix, or it tests nothing else
            known = bytes.AsSpan().CommonPrefixLength(Whole); // chance may have hit the next byte too
            Recording read = Read(bytes);
            int records = At.FindLastIndex(at => at <= known);
            Assert.Equal(known == bytes.Length && records >= 2 && At[records] == known, read.Damage is null);
            AssertBefore(read, records);
        }
    }

    [Fact]
    public void Read_ChangedContentWithTheRightChecksum_NeverThrowsAndKeepsTheOrder()
    {
        Random random = new(6);
        byte[][] records = Enumerable.Range(0, At.Count - 1).Select(i => Whole[At[i]..At[i + 1]]).ToArray();
        int sound = 0, damaged = 0, undecodable = 0;
        for (int i = 0; i < Trials; i++)
        {
            List<byte> bytes = [.. Whole[..10]];
            foreach (byte[] record in records)
            {
                int head = record.Length < 0x80 + 6 ? 2 : 3; // kind, and a length of one byte or two
                byte[] content = record[head..^4];
                byte kind = record[0];
                switch (random.Next(20))
                {
                    case 0 when content.Length > 0:
                        content[random.Next(content.Length)] ^= (byte)(1 << random.Next(8));
                        break;
                    case 1 when i % 5 == 0:
                        random.NextBytes(content);
                        break;
                    case 2 when i % 5 == 0:
                        content = content[..random.Next(content.Length + 1)];
                        break;
                    case 3 when i % 5 == 0:
                        kind = (byte)random.Next(8);
                        break;
                    case 4 when i % 5 == 0:
                        bytes.AddRange(Recorded.Record(kind, content)); // twice
                        break;
                }

                bytes.AddRange(Recorded.Record(kind, content));
            }

            Recording read = Read([.. bytes]);
            sound += read.Damage is null ? 1 : 0;
            damaged += read.Damage is null ? 0 : 1;
            undecodable += read.Damage is null && read.Scene is null ? 1 : 0;
            Assert.Equal(read.Scene is null, read.SceneError is not null);
            Assert.Equal(Enumerable.Range((int)(read.Joined?.FirstIndex ?? 1), read.Entries.Count).Select(n => (uint)n), read.Entries.Select(e => e.Index));
            Assert.Equal(read.Committed.OrderBy(c => c.Time).Select(c => c.Time).Distinct(), read.Committed.Select(c => c.Time));
            Compared(Read(Whole), read);
        }

        Assert.True(sound > Trials / 20 && damaged > Trials / 20 && undecodable > 100, $"{sound} sound, {damaged} damaged, {undecodable} without a scene.");
    }

    [Fact]
    public void Read_RecordsInAnotherOrder_AreDamage()
    {
        byte[][] r = Enumerable.Range(0, At.Count - 1).Select(i => Whole[At[i]..At[i + 1]]).ToArray();
        byte[] joined = Recorded.Record(3, JoinedBytes(1, Start));
        Damaged("There is a scene where a header is due.", 10, r[1]);
        Damaged("There is a log entry where a scene is due.", At[1], r[0], r[2]);
        Damaged("There is a header out of place.", At[2], r[0], r[1], r[0]);
        Damaged("There is a scene out of place.", At[2], r[0], r[1], r[1]);
        Damaged("There is a joined state out of place.", At[2] + joined.Length, r[0], r[1], joined, joined);
        Damaged("There is a joined state out of place.", At[3], r[0], r[1], r[2], joined);
        Damaged("There is entry 2 of the log where entry 1 is due.", At[2], r[0], r[1], r[3]);
        Damaged("There is entry 1 of the log where entry 2 is due.", At[3], r[0], r[1], r[2], r[2]);
        byte[] state = r.First(record => record[0] == 5);
        Damaged("The committed state is of 100.25s, which does not come after", At[2] + state.Length, r[0], r[1], state, state);
        Damaged("There is a log entry after the recording's end.", At[2] + r[^1].Length, r[0], r[1], r[^1], r[2]);
        Damaged("There is no record of the kind 7.", At[2], r[0], r[1], [7]);
        Damaged("There is no record of the kind 0.", At[2], r[0], r[1], [0]);
    }

    [Fact]
    public void Read_FieldOutOfRange_IsDamage()
    {
        byte[][] r = Enumerable.Range(0, At.Count - 1).Select(i => Whole[At[i]..At[i + 1]]).ToArray();
        Damaged("The header holds a value out of its range.", 10, Recorded.Record(1, [0, .. BitConverter.GetBytes(long.MaxValue), .. new byte[8], 1, 0, 0]));
        Damaged("The header holds a value out of its range.", 10, Recorded.Record(1, new byte[20])); // fold version 0
        Damaged("The header ends before its last field.", 10, Recorded.Record(1, [.. new byte[17], 1, 0]));
        Damaged("The header goes on after its last field.", 10, Recorded.Record(1, [.. new byte[17], 1, 0, 0, 0]));
        Damaged("The joined state holds a value out of its range.", At[2], r[0], r[1], Recorded.Record(3, JoinedBytes(0, Start)));
        Damaged("The joined state holds a value out of its range.", At[2], r[0], r[1], Recorded.Record(3, JoinedBytes(1, Start - SimDuration.OneTick)));
        Damaged("The joined state ends before its last field.", At[2], r[0], r[1], Recorded.Record(3, JoinedBytes(1, Start)[..^1]));
        Damaged("The joined state goes on after its last field.", At[2], r[0], r[1], Recorded.Record(3, [.. JoinedBytes(1, Start), 0]));
        byte[] entry = r[2][2..^4];
        entry[4] = 0;
        Damaged("The log entry holds a value out of its range.", At[2], r[0], r[1], Recorded.Record(4, entry));
        Damaged("The committed state holds a value out of its range.", At[2], r[0], r[1], Recorded.Record(5, [.. BitConverter.GetBytes(long.MinValue), .. new byte[16]]));
        Damaged("The reason of the end is not UTF-8.", At[2], r[0], r[1], Recorded.Record(6, [0xFF]));
        Damaged("The length of a committed state is given as 25 bytes; at most 24 are allowed.", At[2], r[0], r[1], Recorded.Record(5, new byte[25]));
        Damaged("The length of a committed state has not the one form", At[2], r[0], r[1], [5, 0x98, 0]);
        Damaged("The length of a joined state has not the one form", At[2], r[0], r[1], [3, 0xFF, 0xFF, 0xFF, 0xFF, 1]);
    }

    [Fact]
    public void Read_OtherVersion_IsRefusedWithBoth()
    {
        byte[] bytes = (byte[])Whole.Clone();
        foreach (byte version in new byte[] { 3, 9 })
        {
            bytes[8] = version;
            Assert.Equal(
                $"Damaged at byte 8: The recording is of version {version}; this library reads version 6.", Read(bytes).Damage!.ToString());
        }

        bytes[8] = RecordingFormat.Version;
        bytes[9] = 200;
        Assert.Equal(
            $"The recording holds scene and events in version 200 of the wire format; this library reads version {WireFormat.Version}.",
            Read(bytes).Damage!.Reason);
        Assert.Contains("This is no recording of LagSim", Read([1, 2, 3]).SceneError, StringComparison.Ordinal);
    }

    [Fact]
    public void Read_SceneOfAnotherHash_IsNotTaken()
    {
        byte[] header = Whole[(At[0] + 2)..(At[1] - 4)];
        header[9] ^= 1;
        Recording read = Read([.. Whole[..10], .. Recorded.Record(1, header), .. Whole[At[1]..]]);
        Assert.Null(read.Damage);
        Assert.Null(read.Scene);
        Assert.Contains("the header says", read.SceneError, StringComparison.Ordinal);
    }

    [Fact]
    public void Read_RecordThatAnnouncesMuch_AllocatesByWhatIsThere()
    {
        // 64 MiB of state are announced, 100 bytes are there.
        byte[] announced = [.. Whole[..At[2]], 3, 0x84, 0x80, 0x80, 0x20, .. new byte[100]];
        Recording read = Read(announced);
        Assert.Contains("The file ends within a joined state of 67108868 bytes.", read.Damage!.Reason, StringComparison.Ordinal);
        Assert.InRange(Allocated(announced), 1, 100_000);

        // The control: what is really there takes room.
        BodySnapshot body = World(Log).Snapshot(Start + Seconds(1)).Bodies[0];
        byte[] real = Small(joined: new JoinedState(1, new WorldSnapshot(Start, Start + Seconds(1), 0, Enumerable.Repeat(body, 5000).ToArray())));
        Assert.InRange(Allocated(real), 1_000_000, 10_000_000);
    }

    private static long Allocated(byte[] bytes)
    {
        MemoryStream stream = new(bytes);
        Recording.Read(stream);
        stream.Position = 0;
        long before = GC.GetAllocatedBytesForCurrentThread();
        Recording.Read(stream);
        return GC.GetAllocatedBytesForCurrentThread() - before;
    }

    private static byte[] JoinedBytes(uint first, SimTime start) =>
        [.. BitConverter.GetBytes(first), .. SnapshotFormat.Encode(new WorldSnapshot(start, start + Seconds(1), 7, []))];

    private static void Damaged(string reason, int offset, params byte[][] records)
    {
        Recording read = Read([.. Whole[..10], .. records.SelectMany(record => record)]);
        Assert.StartsWith(reason, read.Damage?.Reason, StringComparison.Ordinal);
        Assert.Equal(offset, read.Damage!.Offset);
    }

    /// <summary>That the recording has exactly the first so many records of the whole one.</summary>
    private static void AssertBefore(Recording read, int records)
    {
        Recording whole = Read(Whole);
        byte[] kinds = At.Take(Math.Max(0, records)).Where(at => at < Whole.Length).Select(at => Whole[at]).ToArray();
        Assert.Equal(kinds.Contains((byte)1), read.Header is not null);
        Assert.Equal(kinds.Contains((byte)2) ? whole.Scene!.Hash : null, read.Scene?.Hash);
        Assert.Equal(whole.Entries.Take(kinds.Count(kind => kind == 4)), read.Entries);
        Assert.Equal(whole.Committed.Take(kinds.Count(kind => kind == 5)), read.Committed);
        Assert.Equal(kinds.Contains((byte)6) ? whole.EndReason : null, read.EndReason);
    }
}
