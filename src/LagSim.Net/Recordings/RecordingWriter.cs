using System;
using System.IO;
using System.Text;
using LagSim.Events;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Net.Recordings;

/// <summary>Writes a recording while its peer takes part in a session.</summary>
/// <remarks>
/// <para>Every committed state is flushed to the operating system, so that a killed process leaves a file that is readable up to
/// there.</para>
/// <para>For one thread at a time. Writing entries and states allocates nothing. Exceptions from the stream reach the caller; a record may
/// then be half written, so nothing more can be.</para>
/// </remarks>
internal sealed class RecordingWriter : IDisposable
{
    private readonly Stream stream;
    private readonly bool leaveOpen;
    private readonly byte[] content = new byte[RecordingFormat.EntryHeadBytes + EventFormat.MaxBytes];
    private readonly byte[] frame = new byte[8];
    private long nextIndex;
    private SimTime lastCommitted;
    private bool hasCommitted;
    private bool isEnded;
    private bool isFailed;
    private bool isDisposed;

    /// <summary>Begins a recording, and writes header, scene and any joined state at once.</summary>
    /// <param name="stream">The stream to write to; the writer owns it, unless <paramref name="leaveOpen"/> says otherwise.</param>
    /// <param name="peer">The number of the peer that records; 0 is the host.</param>
    /// <param name="scene">The session's scene.</param>
    /// <param name="start">The shared time at which the session started, within 48 days of the origin.</param>
    /// <param name="joined">The initial state of a peer that joined late; null for one that has the log from entry 1 on.</param>
    /// <param name="leaveOpen">Whether the stream stays open when the writer is disposed.</param>
    /// <exception cref="ArgumentException">
    /// The scene or the start cannot be encoded, or the joined state is of a world with another start.
    /// </exception>
    /// <exception cref="IOException">The stream cannot be written.</exception>
    public RecordingWriter(Stream stream, byte peer, Scene scene, SimTime start, JoinedState? joined = null, bool leaveOpen = false)
    {
        this.stream = stream ?? throw new ArgumentNullException(nameof(stream));
        this.leaveOpen = leaveOpen;
        if (joined?.Snapshot is WorldSnapshot snapshot && snapshot.Start != start)
        {
            throw new ArgumentException(
                $"The joined state is of a world that began at {snapshot.Start.ToShortString()}; this one began at {start.ToShortString()}.", nameof(joined));
        }

        byte[] sceneBytes = SceneFormat.Encode(scene);
        byte[] header = Header(peer, scene, start);
        byte[] joinedBytes = joined is null ? Array.Empty<byte>() : Joined(joined);
        nextIndex = joined?.FirstIndex ?? 1;
        lastCommitted = joined?.Time ?? start;
        byte[] prefix = new byte[RecordingFormat.PrefixBytes];
        RecordingFormat.Magic.CopyTo(prefix);
        prefix[^2] = RecordingFormat.Version;
        prefix[^1] = WireFormat.Version;
        stream.Write(prefix);
        Write(RecordKind.Header, header);
        Write(RecordKind.Scene, sceneBytes);
        if (joined is not null)
        {
            Write(RecordKind.Joined, joinedBytes);
        }

        stream.Flush();
    }

    /// <summary>Begins a recording in a file, which is created or replaced.</summary>
    /// <param name="path">The file; its name should end with <see cref="RecordingFormat.Extension"/>. Others may read it meanwhile.</param>
    /// <param name="peer">The number of the peer that records; 0 is the host.</param>
    /// <param name="scene">The session's scene.</param>
    /// <param name="start">The shared time at which the session started, within 48 days of the origin.</param>
    /// <param name="joined">The initial state of a peer that joined late; null for one that has the log from entry 1 on.</param>
    /// <exception cref="ArgumentException">
    /// The scene or the start cannot be encoded, or the joined state is of a world with another start.
    /// </exception>
    /// <exception cref="IOException">The file cannot be created or written, or another process is writing it.</exception>
    /// <exception cref="UnauthorizedAccessException">The file may not be written.</exception>
    public static RecordingWriter Create(string path, byte peer, Scene scene, SimTime start, JoinedState? joined = null)
    {
        FileStream file = RecordingFileStream.Open(path);
        try
        {
            return new RecordingWriter(file, peer, scene, start, joined);
        }
        catch
        {
            file.Dispose();
            throw;
        }
    }

    /// <summary>Writes the next entry of the host's log.</summary>
    /// <param name="index">
    /// Its place in the log: one more than that of the entry before; for the first entry 1, or the joined state's first index.
    /// </param>
    /// <param name="verdict">The host's verdict; not <see cref="Verdict.Pending"/>.</param>
    /// <param name="what">The event.</param>
    /// <exception cref="ArgumentOutOfRangeException">It is not the next entry, or not a verdict.</exception>
    /// <exception cref="ArgumentException">The event cannot be encoded: see <see cref="EventFormat.IsWellFormed"/>.</exception>
    /// <exception cref="InvalidOperationException">The recording has ended, or failed before.</exception>
    /// <exception cref="IOException">The stream cannot be written.</exception>
    public void WriteEntry(uint index, Verdict verdict, in ExternalEvent what)
    {
        ThrowIfClosed();
        if (index != nextIndex)
        {
            throw new ArgumentOutOfRangeException(nameof(index), index, $"The next entry of this recording's log is {nextIndex}.");
        }

        if (verdict is <= Verdict.Pending or > Verdicts.Last)
        {
            throw new ArgumentOutOfRangeException(nameof(verdict), verdict, "A log holds what the host said: accepted, or why not.");
        }

        WireWriter writer = new(content);
        writer.WriteUInt32(index);
        writer.WriteByte((byte)verdict);
        EventFormat.Write(ref writer, what);
        Write(RecordKind.Entry, content.AsSpan(0, writer.Position));
        nextIndex++;
    }

    /// <summary>Writes the hashes of a committed state and flushes. All entries that it depends on must have been written.</summary>
    /// <param name="time">The shared time: after that of the state before, and not before the start or the joined state.</param>
    /// <param name="stateHash"><see cref="Simulation.StateHash"/> at that time.</param>
    /// <param name="eventHash"><see cref="Simulation.EventHash"/> at that time.</param>
    /// <exception cref="ArgumentOutOfRangeException">The time is not after the one before.</exception>
    /// <exception cref="ArgumentException">The time is further than 48 days from the origin.</exception>
    /// <exception cref="InvalidOperationException">The recording has ended, or failed before.</exception>
    /// <exception cref="IOException">The stream cannot be written.</exception>
    public void WriteCommitted(SimTime time, ulong stateHash, ulong eventHash)
    {
        ThrowIfClosed();
        if (time < lastCommitted || (hasCommitted && time == lastCommitted))
        {
            throw new ArgumentOutOfRangeException(
                nameof(time), time.ToShortString(), $"A committed state must lie {(hasCommitted ? "after" : "at or after")} {lastCommitted.ToShortString()}.");
        }

        WireWriter writer = new(content);
        writer.WriteTime(time);
        writer.WriteUInt64(stateHash);
        writer.WriteUInt64(eventHash);
        Write(RecordKind.Committed, content.AsSpan(0, writer.Position));
        Flush();
        lastCommitted = time;
        hasCommitted = true;
    }

    /// <summary>Ends the recording and flushes. Without it readers report that the recording is not whole.</summary>
    /// <param name="reason">The reason, as a sentence for people; cut at <see cref="RecordingFormat.MaxReasonBytes"/>.</param>
    /// <exception cref="InvalidOperationException">The recording has ended, or failed before.</exception>
    /// <exception cref="IOException">The stream cannot be written.</exception>
    public void WriteEnd(string reason)
    {
        ThrowIfClosed();
        byte[] utf8 = Encoding.UTF8.GetBytes(reason ?? throw new ArgumentNullException(nameof(reason)));
        int length = Math.Min(utf8.Length, RecordingFormat.MaxReasonBytes);
        while (length < utf8.Length && (utf8[length] & 0xC0) == 0x80)
        {
            length--; // between characters, not within one
        }

        Write(RecordKind.End, utf8.AsSpan(0, length));
        Flush();
        isEnded = true;
    }

    /// <summary>Closes the stream. A recording without <see cref="WriteEnd"/> stays without an end.</summary>
    /// <exception cref="IOException">What was not flushed cannot be written.</exception>
    public void Dispose()
    {
        if (isDisposed)
        {
            return;
        }

        isDisposed = true;
        if (!leaveOpen)
        {
            stream.Dispose();
        }
        else if (!isFailed)
        {
            stream.Flush();
        }
    }

    private static byte[] Header(byte peer, Scene scene, SimTime start)
    {
        string version = RecordingFormat.LibraryVersion;
        byte[] bytes = new byte[RecordingFormat.HeaderBytes + WireText.EncodedLength(version, "The library's version")];
        WireWriter writer = new(bytes);
        writer.WriteByte(peer);
        writer.WriteTime(start);
        writer.WriteUInt64(scene.Hash);
        writer.WriteUInt16((ushort)Simulation.FoldVersion);
        WireText.Write(ref writer, version);
        return bytes;
    }

    private static byte[] Joined(JoinedState joined)
    {
        byte[] snapshot = joined.Snapshot is null ? Array.Empty<byte>() : SnapshotFormat.Encode(joined.Snapshot);
        byte[] bytes = new byte[RecordingFormat.JoinedHeadBytes + snapshot.Length];
        WireWriter writer = new(bytes);
        writer.WriteUInt32(joined.FirstIndex);
        writer.WriteBytes(snapshot);
        return bytes;
    }

    /// <summary>Writes one record: kind, length, content, checksum of all three.</summary>
    private void Write(RecordKind kind, ReadOnlySpan<byte> bytes)
    {
        isFailed = true; // until it is complete
        int at = 0;
        frame[at++] = (byte)kind;
        int rest = bytes.Length;
        while (rest >= 0x80)
        {
            frame[at++] = (byte)(rest | 0x80);
            rest >>= 7;
        }

        frame[at++] = (byte)rest;
        uint crc = Crc32.Append(Crc32.Append(0, frame.AsSpan(0, at)), bytes);
        stream.Write(frame.AsSpan(0, at));
        stream.Write(bytes);
        WireWriter end = new(frame);
        end.WriteUInt32(crc);
        stream.Write(frame.AsSpan(0, end.Position));
        isFailed = false;
    }

    private void Flush()
    {
        isFailed = true;
        stream.Flush();
        isFailed = false;
    }

    private void ThrowIfClosed()
    {
        if (isDisposed)
        {
            throw new ObjectDisposedException(nameof(RecordingWriter));
        }

        if (isFailed || isEnded)
        {
            throw new InvalidOperationException(
                isEnded ? "The recording has ended; nothing comes after its end." : "The recording's stream failed before; nothing more can be written.");
        }
    }
}
