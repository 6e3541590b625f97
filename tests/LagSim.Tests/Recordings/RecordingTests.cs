using System;
using System.IO;
using System.Linq;
using System.Text;
using FsCheck;
using FsCheck.Fluent;
using LagSim.Net.Recordings;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Tests.Determinism;
using LagSim.Tests.Wire;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.Recordings.Recorded;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Recordings;

public sealed class RecordingTests
{
    [Fact]
    public void Read_WhatWasWritten_IsTheSame()
    {
        Simulation world = World(Log);
        Recording recording = Read(Small(peer: 7));

        Assert.Null(recording.Damage);
        Assert.Equal((byte)7, recording.Header!.Peer);
        Assert.Equal(Start, recording.Header.Start);
        Assert.Equal(Recorded.Scene.Hash, recording.Header.SceneHash);
        Assert.Equal(typeof(Recording).Assembly.GetName().Version!.ToString(3), recording.Header.LibraryVersion.Split('-')[0]);
        Assert.Equal(Recorded.Scene.Hash, recording.Scene!.Hash);
        Assert.Null(recording.SceneError);
        Assert.Null(recording.Joined);
        Assert.Equal(Log, recording.Entries);
        Assert.Equal(Enumerable.Range(0, 5).Select(i => Start + Seconds(i / 2.0)), recording.Committed.Select(c => c.Time));
        Assert.All(recording.Committed, c => Assert.Equal((world.StateHash(c.Time), world.EventHash(c.Time)), (c.StateHash, c.EventHash)));
        Assert.Equal("This peer left.", recording.EndReason);
        Assert.Equal((Simulation.FoldVersion, true, Start + Seconds(2)), (recording.Header.FoldVersion, recording.IsWhole, recording.HoldsUpTo));
        Assert.Equal("holds 6 log entries, and 5 committed states up to T 2 s.", recording.Extent);
    }

    [Fact]
    public void Read_AnyWorldWithAForce_IsTheSame()
    {
        for (int seed = 1; seed <= 15; seed++)
        {
            Recording recording = Read(Recorded.Random(seed, out RandomWorld world), world.Scene.Accelerations);
            Assert.Null(recording.Damage);
            Assert.Equal(world.Scene.Hash, recording.Scene!.Hash);
            Assert.Equal(world.Events.OrderBy(e => e.Key), recording.Entries.Select(e => e.Event).OrderBy(e => e.Key));
            Assert.Null(recording.EndReason);
        }
    }

    [Fact]
    public void Read_AnyEventOfAnyVerdict_IsTheSame()
    {
        Verdict[] verdicts = [Verdict.Accepted, Verdict.TooLate, Verdict.TooEarly, Verdict.NoRight, Verdict.Invalid];
        LogEntry[] log = Gen.Sample(WireGen.Event, 500, new Rnd(20261121, 1), 30).Select((e, i) => new LogEntry((uint)i + 1, verdicts[i % 5], e)).ToArray();
        Recording recording = Read(Bytes(writer =>
        {
            foreach (LogEntry entry in log)
            {
                writer.WriteEntry(entry.Index, entry.Verdict, entry.Event);
            }
        }));

        Assert.Null(recording.Damage);
        Assert.Equal(log, recording.Entries);
        Assert.Equal(500, log.Select(entry => entry.ToString()).Distinct().Count());
    }

    [Fact]
    public void Read_LateClient_HasItsStateAndTheLogFromThere()
    {
        JoinedState joined = Joined(4, 1);
        Recording recording = Read(Small(Log[3..], 3, joined: joined));

        Assert.Null(recording.Damage);
        Assert.Equal((4u, Start + Seconds(1)), (recording.Joined!.FirstIndex, recording.Joined.Time!.Value));
        Assert.Equal(SnapshotFormat.Encode(joined.Snapshot!), SnapshotFormat.Encode(recording.Joined.Snapshot!));
        Assert.Equal(Log[3..], recording.Entries);
        Assert.Equal(3, recording.Committed.Count);
    }

    [Fact]
    public void Read_SceneThatNeedsAForceThatIsNotHere_HasAllTheRest()
    {
        byte[] bytes = Recorded.Random(1, out RandomWorld world);
        Recording recording = Read(bytes);

        Assert.Null(recording.Damage);
        Assert.Null(recording.Scene);
        Assert.Contains("needs the acceleration 'test force' of version 1", recording.SceneError, StringComparison.Ordinal);
        Assert.Equal(Read(bytes, world.Scene.Accelerations).Entries, recording.Entries);
        Assert.Equal(11, recording.Committed.Count);
    }

    [Fact]
    public void Create_ProcessThatIsKilled_LeavesAFileThatIsGoodUpToItsLastCommittedState()
    {
        string path = Path.Combine(Path.GetTempPath(), Path.GetRandomFileName() + RecordingFormat.Extension);
        try
        {
            using RecordingWriter writer = RecordingWriter.Create(path, 1, Recorded.Scene, Start);
            Assert.Equal(Recorded.Scene.Hash, Recording.Read(path).Scene!.Hash);
            writer.WriteEntry(1, Verdict.Accepted, Log[0].Event);
            writer.WriteCommitted(Start + Seconds(1), 1, 2);
            writer.WriteEntry(2, Verdict.Accepted, Log[1].Event);

            // The writer is neither ended nor closed: this is what the file has if it never will be.
            Recording left = Recording.Read(path);
            Assert.Equal(Log[0], left.Entries[0]);
            Assert.Equal(new CommittedState(Start + Seconds(1), 1, 2), Assert.Single(left.Committed));
            Assert.Null(left.EndReason);
            Assert.Equal((false, Start + Seconds(1)), (left.IsWhole, left.HoldsUpTo));

            writer.WriteEnd("Done.");
            Assert.True(Recording.Read(path).IsWhole);
            Assert.Equal("Done.", Recording.Read(path).EndReason);
            Assert.Equal(2, Recording.Read(path).Entries.Count);
        }
        finally
        {
            File.Delete(path);
        }
    }

    [Fact]
    public void Write_EntriesAndStates_AllocatesNothingAndFlushesEachState()
    {
        CountingStream stream = new();
        using RecordingWriter writer = new(stream, 0, Recorded.Scene, Start);
        uint index = 1;
        Write(10);
        int flushes = stream.Flushes;
        long least = long.MaxValue; // once in a while the runtime itself allocates on a thread of a busy machine
        for (int round = 0; round < 5; round++)
        {
            long before = GC.GetAllocatedBytesForCurrentThread();
            Write(1000);
            least = Math.Min(least, GC.GetAllocatedBytesForCurrentThread() - before);
        }

        Assert.Equal(0, least);
        Assert.Equal(5000, stream.Flushes - flushes);

        void Write(int count)
        {
            for (int i = 0; i < count; i++)
            {
                writer.WriteEntry(index++, Verdict.Accepted, Log[1].Event);
                writer.WriteCommitted(Start + Seconds(index), 3, 4);
            }
        }
    }

    [Fact]
    public void Write_StreamThatFails_ReachesTheCallerAndEndsTheRecording()
    {
        CountingStream stream = new();
        RecordingWriter writer = new(stream, 0, Recorded.Scene, Start);
        writer.WriteEntry(1, Verdict.Accepted, Log[0].Event);
        stream.IsFull = true;

        Assert.Throws<IOException>(() => writer.WriteEntry(2, Verdict.Accepted, Log[1].Event));
        stream.IsFull = false;
        Assert.Throws<InvalidOperationException>(() => writer.WriteEntry(2, Verdict.Accepted, Log[1].Event));
        Assert.Throws<InvalidOperationException>(() => writer.WriteEnd("x"));
        writer.Dispose();
        Assert.True(stream.IsDisposed);

        Assert.Throws<IOException>(() => new RecordingWriter(new CountingStream { IsFull = true }, 0, Recorded.Scene, Start));
    }

    [Fact]
    public void Read_StreamThatFails_ReachesTheCaller() =>
        Assert.Throws<IOException>(() => Recording.Read(new CountingStream { IsFull = true }));

    [Fact]
    public void Write_OutOfOrder_IsRefusedAndLeavesTheRecordingAsItIs()
    {
        byte[] bytes = Bytes(writer =>
        {
            Assert.Throws<ArgumentOutOfRangeException>(() => writer.WriteEntry(0, Verdict.Accepted, Log[0].Event));
            Assert.Throws<ArgumentOutOfRangeException>(() => writer.WriteEntry(2, Verdict.Accepted, Log[0].Event));
            Assert.Throws<ArgumentOutOfRangeException>(() => writer.WriteEntry(1, Verdict.Pending, Log[0].Event));
            Assert.Throws<ArgumentOutOfRangeException>(() => writer.WriteEntry(1, (Verdict)99, Log[0].Event));
            Assert.Throws<ArgumentException>(() => writer.WriteEntry(1, Verdict.Accepted, default));
            Assert.Throws<ArgumentOutOfRangeException>(() => writer.WriteCommitted(Start - SimDuration.OneTick, 0, 0));
            Assert.Throws<ArgumentException>(() => writer.WriteCommitted(SimTime.MaxValue, 0, 0));
            writer.WriteCommitted(Start, 0, 0);
            Assert.Throws<ArgumentOutOfRangeException>(() => writer.WriteCommitted(Start, 0, 0));
            writer.WriteEntry(1, Verdict.Accepted, Log[0].Event);
            Assert.Throws<ArgumentNullException>(() => writer.WriteEnd(null!));
            writer.WriteEnd("End.");
            Assert.Throws<InvalidOperationException>(() => writer.WriteEnd("End."));
            Assert.Throws<InvalidOperationException>(() => writer.WriteCommitted(Start + Seconds(1), 0, 0));
            writer.Dispose();
            Assert.Throws<ObjectDisposedException>(() => writer.WriteEntry(2, Verdict.Accepted, Log[1].Event));
        });

        Recording recording = Read(bytes);
        Assert.Null(recording.Damage);
        Assert.Single(recording.Entries);
        Assert.Single(recording.Committed);
        Assert.Equal("End.", recording.EndReason);
    }

    [Fact]
    public void New_WhatCannotBeRecorded_IsRefused()
    {
        Assert.Throws<ArgumentNullException>(() => new RecordingWriter(null!, 0, Recorded.Scene, Start));
        Assert.Throws<ArgumentNullException>(() => new RecordingWriter(Stream.Null, 0, null!, Start));
        Assert.Throws<ArgumentException>(() => new RecordingWriter(Stream.Null, 0, Recorded.Scene, SimTime.MinValue));
        SceneBuilder tooMany = Enumerable.Range(0, SceneFormat.MaxBodies + 1).Aggregate(new SceneBuilder("row"), (row, n) => row.AddBody($"{n}", Ball(), V(2 * n)));
        Assert.Throws<ArgumentException>(() => new RecordingWriter(Stream.Null, 0, tooMany.Build(), Start));
        Assert.Throws<ArgumentException>(() => new RecordingWriter(Stream.Null, 0, Recorded.Scene, Start + SimDuration.OneTick, Joined(1, 1)));
        Assert.Throws<ArgumentOutOfRangeException>(() => new JoinedState(0, null));
        Assert.Throws<ArgumentException>(() => new JoinedState(1, new WorldSnapshot(Start, Start, 0, [])));
        Assert.Throws<ArgumentException>(() => new JoinedState(1, new WorldSnapshot(Start, SimTime.MaxValue, 0, [])));
        BodySnapshot body = World(Log).Snapshot(Start + Seconds(1)).Bodies[0];
        WorldSnapshot large = new(Start, Start + Seconds(1), 0, Enumerable.Repeat(body, (RecordingFormat.MaxSnapshotBytes / 167) + 1).ToArray());
        Assert.Contains("at most 67108864 are allowed", Assert.Throws<ArgumentException>(() => new JoinedState(1, large)).Message, StringComparison.Ordinal);
        Assert.Throws<ArgumentNullException>(() => Recording.Read((Stream)null!));
        Assert.Throws<FileNotFoundException>(() => Recording.Read(Path.Combine(Path.GetTempPath(), Path.GetRandomFileName())));
    }

    [Fact]
    public void WriteEnd_LongReason_IsCutBetweenCharacters()
    {
        string reason = "x" + string.Concat(Enumerable.Repeat("\U0001D11E", 1200));
        Recording recording = Read(Bytes(writer => writer.WriteEnd(reason)));

        Assert.Null(recording.Damage);
        Assert.StartsWith(recording.EndReason!, reason, StringComparison.Ordinal);
        Assert.Equal(3997, Encoding.UTF8.GetByteCount(recording.EndReason!));
        Assert.Equal("half \uFFFD", Read(Bytes(writer => writer.WriteEnd("half \uD834"))).EndReason);
    }

    [Fact]
    public void Dispose_LeaveOpen_LeavesTheStreamOpen()
    {
        CountingStream stream = new();
        new RecordingWriter(stream, 0, Recorded.Scene, Start, leaveOpen: true).Dispose();
        Assert.False(stream.IsDisposed);
        new RecordingWriter(stream, 0, Recorded.Scene, Start).Dispose();
        Assert.True(stream.IsDisposed);
    }

    [Fact]
    public void Crc32_KnownBytes_HaveTheKnownChecksum()
    {
        byte[] digits = Encoding.ASCII.GetBytes("123456789");
        Assert.Equal(0xCBF43926, Crc32.Append(0, digits));
        Assert.Equal(0xCBF43926, Crc32.Append(Crc32.Append(0, digits.AsSpan(0, 4)), digits.AsSpan(4)));
        Assert.Equal(0xCBF43926, Crc(digits));
        Assert.Equal(0u, Crc32.Append(0, []));
    }

    /// <summary>Takes everything, counts flushes, and fails when it is full.</summary>
    private sealed class CountingStream : MemoryStream
    {
        internal CountingStream()
            : base(1 << 20)
        {
        }

        internal bool IsFull { get; set; }

        internal int Flushes { get; private set; }

        internal bool IsDisposed { get; private set; }

        public override void Flush() => Flushes++;

        public override void Write(ReadOnlySpan<byte> buffer)
        {
            ThrowIfFull();
            base.Write(buffer);
        }

        public override void Write(byte[] buffer, int offset, int count)
        {
            ThrowIfFull();
            base.Write(buffer, offset, count);
        }

        public override int Read(byte[] buffer, int offset, int count)
        {
            ThrowIfFull();
            return base.Read(buffer, offset, count);
        }

        public override int Read(Span<byte> buffer)
        {
            ThrowIfFull();
            return base.Read(buffer);
        }

        protected override void Dispose(bool disposing)
        {
            IsDisposed = true;
            base.Dispose(disposing);
        }

        private void ThrowIfFull()
        {
            if (IsFull)
            {
                throw new IOException("No space left.");
            }
        }
    }
}
