using System;
using System.Buffers.Binary;
using System.Collections.Generic;
using System.IO;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Net.Recordings;

/// <summary>Reads the bytes of a recording, which may come from anyone, record by record up to the first invalid one.</summary>
/// <remarks>The buffer for a record grows with what has been read of it, never with its announced length.</remarks>
internal sealed class RecordingReader
{
    private const int FirstBufferBytes = 256;

    private readonly Stream stream;
    private readonly SceneCode known;
    private readonly List<LogEntry> entries = new();
    private readonly List<CommittedState> committed = new();
    private byte[] buffer = new byte[FirstBufferBytes];
    private long offset;
    private long recordAt;
    private long nextIndex = 1;
    private RecordingHeader? header;
    private bool hasScene;
    private Scene? scene;
    private string? sceneError;
    private JoinedState? joined;
    private string? endReason;
    private RecordingDamage? damage;

    internal RecordingReader(Stream stream, SceneCode known)
    {
        this.stream = new BufferedStream(stream, 1 << 16); // not disposed: the caller's stream stays open
        this.known = known;
    }

    internal Recording Read()
    {
        if (ReadPrefix())
        {
            while (damage is null && ReadRecord(out RecordKind kind, out int length))
            {
                Take(kind, buffer.AsSpan(0, length));
            }
        }

        if (!hasScene && damage is null)
        {
            recordAt = offset;
            Damaged($"The file ends where {RecordingFormat.NameOf(header is null ? RecordKind.Header : RecordKind.Scene)} is due.");
        }

        string? whyNoScene = hasScene ? sceneError : $"The file is damaged before its scene ends. {damage}";
        return new Recording(header, scene, whyNoScene, joined, entries.ToArray(), committed.ToArray(), endReason, damage);
    }

    private bool ReadPrefix()
    {
        int length = Fill(0, RecordingFormat.PrefixBytes);
        Span<byte> prefix = buffer.AsSpan(0, length);
        int magic = Math.Min(length, RecordingFormat.Magic.Length);
        if (length == 0)
        {
            Damaged("The file is empty.");
        }
        else if (!prefix.Slice(0, magic).SequenceEqual(RecordingFormat.Magic.Slice(0, magic)))
        {
            Damaged("This is no recording of LagSim: its first eight bytes are not those of one.");
        }
        else if (length < RecordingFormat.PrefixBytes)
        {
            Damaged("The file ends within its first ten bytes.");
        }
        else if (prefix[^2] != RecordingFormat.Version)
        {
            recordAt = RecordingFormat.PrefixBytes - 2;
            Damaged($"The recording is of version {prefix[^2]}; this library reads version {RecordingFormat.Version}.");
        }
        else if (prefix[^1] != WireFormat.Version)
        {
            recordAt = RecordingFormat.PrefixBytes - 1;
            Damaged(
                $"The recording holds scene and events in version {prefix[^1]} of the wire format; this library reads version {WireFormat.Version}.");
        }

        return damage is null;
    }

    /// <summary>Reads the next record into the buffer; false at the end of the file or at damage.</summary>
    private bool ReadRecord(out RecordKind kind, out int length)
    {
        recordAt = offset;
        length = 0;
        kind = default;
        if (Fill(0, 1) == 0)
        {
            return false;
        }

        kind = (RecordKind)buffer[0];
        if (kind is < RecordKind.Header or > RecordKind.End)
        {
            return Damaged($"There is no record of the kind {(byte)kind}.");
        }

        string name = RecordingFormat.NameOf(kind);
        if (endReason is not null)
        {
            return Damaged($"There is {name} after the recording's end.");
        }

        if (!ReadLength(name, RecordingFormat.MaxContentBytes(kind), out length, out uint crc))
        {
            return false;
        }

        // Content and checksum together; the buffer is doubled only once it is full.
        int whole = length + RecordingFormat.CrcBytes;
        int got = 0;
        while (got < whole)
        {
            if (got == buffer.Length)
            {
                Array.Resize(ref buffer, buffer.Length * 2);
            }

            int read = Fill(got, Math.Min(whole, buffer.Length) - got);
            if (read == 0)
            {
                return Damaged($"The file ends within {name} of {length} bytes.");
            }

            got += read;
        }

        uint sum = Crc32.Append(crc, buffer.AsSpan(0, length));
        return sum == BinaryPrimitives.ReadUInt32LittleEndian(buffer.AsSpan(length)) || Damaged($"The checksum of {name} is wrong.");
    }

    /// <summary>Reads the length of a record whose kind is in the buffer, and begins its checksum.</summary>
    private bool ReadLength(string name, int most, out int length, out uint crc)
    {
        const int longest = 4;
        length = 0;
        crc = 0;
        int at = 0;
        byte next;
        do
        {
            if (Fill(1 + at, 1) == 0)
            {
                return Damaged($"The file ends within the length of {name}.");
            }

            next = buffer[1 + at];
            length |= (next & 0x7F) << (7 * at);
            at++;
        }
        while (next >= 0x80 && at < longest);
        if (next >= 0x80 || (next == 0 && at > 1))
        {
            return Damaged($"The length of {name} has not the one form that it should have.");
        }

        if (length > most)
        {
            return Damaged($"The length of {name} is given as {length} bytes; at most {most} are allowed.");
        }

        crc = Crc32.Append(0, buffer.AsSpan(0, 1 + at));
        return true;
    }

    private void Take(RecordKind kind, ReadOnlySpan<byte> content)
    {
        RecordKind? due = header is null ? RecordKind.Header : !hasScene ? RecordKind.Scene : null;
        bool isMisplaced = due is null
            ? kind is RecordKind.Header or RecordKind.Scene
                || (kind == RecordKind.Joined && (joined is not null || entries.Count > 0 || committed.Count > 0))
            : kind != due;
        if (isMisplaced)
        {
            string where = due is RecordKind missing ? $" where {RecordingFormat.NameOf(missing)} is due" : " out of place";
            Damaged($"There is {RecordingFormat.NameOf(kind)}{where}.");
            return;
        }

        WireReader reader = new(content, content.Length);
        switch (kind)
        {
            case RecordKind.Header:
                TakeHeader(ref reader);
                break;
            case RecordKind.Scene:
                TakeScene(content);
                break;
            case RecordKind.Joined:
                TakeJoined(ref reader);
                break;
            case RecordKind.Entry:
                TakeEntry(ref reader);
                break;
            case RecordKind.Committed:
                TakeCommitted(ref reader);
                break;
            default:
                TakeEnd(content);
                break;
        }
    }

    private void TakeHeader(ref WireReader reader)
    {
        byte peer = reader.ReadByte();
        SimTime start = reader.ReadTime();
        ulong hash = reader.ReadUInt64();
        int fold = reader.ReadUInt16();
        reader.Require(fold > 0);
        string version = WireText.Read(ref reader);
        if (IsSound(ref reader, "The header"))
        {
            header = new RecordingHeader(peer, start, hash, fold, version);
        }
    }

    private void TakeScene(ReadOnlySpan<byte> content)
    {
        hasScene = true;
        if (SceneFormat.TryDecode(content, known, out scene, out sceneError) && scene.Hash != header!.SceneHash)
        {
            sceneError = $"The scene's hash is {scene.Hash:x16}; the header says {header.SceneHash:x16}.";
            scene = null;
        }
    }

    private void TakeJoined(ref WireReader reader)
    {
        uint first = reader.ReadUInt32();
        reader.Require(first > 0);
        ReadOnlySpan<byte> bytes = reader.ReadBytes(reader.Remaining);
        WorldSnapshot? snapshot = null;
        if (bytes.Length > 0)
        {
            SnapshotFormat.TryDecode(bytes, out snapshot, out WireRefusal refusal);
            reader.Require(snapshot is not null, refusal);
            reader.Require(snapshot is null || (snapshot.Start == header!.Start && SnapshotFormat.IsInRange(snapshot)));
        }

        if (IsSound(ref reader, "The joined state"))
        {
            joined = new JoinedState(first, snapshot);
            nextIndex = first;
        }
    }

    private void TakeEntry(ref WireReader reader)
    {
        uint index = reader.ReadUInt32();
        Verdict verdict = (Verdict)reader.ReadByte();
        reader.Require(verdict is > Verdict.Pending and <= Verdicts.Last);
        ExternalEvent what = EventFormat.Read(ref reader);
        if (!IsSound(ref reader, "The log entry"))
        {
            return;
        }

        if (index != nextIndex)
        {
            Damaged($"There is entry {index} of the log where entry {nextIndex} is due.");
            return;
        }

        entries.Add(new LogEntry(index, verdict, what));
        nextIndex++;
    }

    private void TakeCommitted(ref WireReader reader)
    {
        SimTime time = reader.ReadTime();
        CommittedState state = new(time, reader.ReadUInt64(), reader.ReadUInt64());
        if (!IsSound(ref reader, "The committed state"))
        {
            return;
        }

        bool isInOrder = committed.Count > 0 ? time > committed[^1].Time : time >= (joined?.Time ?? header!.Start);
        if (isInOrder)
        {
            committed.Add(state);
        }
        else
        {
            Damaged($"The committed state is of {time.ToShortString()}, which does not come after what stands before it.");
        }
    }

    private void TakeEnd(ReadOnlySpan<byte> content)
    {
        if (WireText.TryDecode(content, out string reason))
        {
            endReason = reason;
        }
        else
        {
            Damaged("The reason of the end is not UTF-8.");
        }
    }

    /// <summary>Whether all fields of a record are there, in range, and followed by nothing.</summary>
    private bool IsSound(ref WireReader reader, string what) => reader.Finish(out WireRefusal refusal) || Damaged(refusal switch
    {
        WireRefusal.TooShort => $"{what} ends before its last field.",
        WireRefusal.TrailingBytes => $"{what} goes on after its last field.",
        _ => $"{what} holds a value out of its range.",
    });

    /// <summary>Reads up to that many bytes into the buffer; fewer at the end of the file only.</summary>
    private int Fill(int at, int count)
    {
        int got = 0;
        int read;
        do
        {
            read = stream.Read(buffer, at + got, count - got);
            got += read;
        }
        while (read > 0 && got < count);
        offset += got;
        return got;
    }

    private bool Damaged(string reason)
    {
        damage ??= new RecordingDamage(recordAt, reason);
        return false;
    }
}
