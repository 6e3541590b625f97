using System;
using System.IO;
using System.IO.Pipelines;
using System.Net.WebSockets;
using System.Threading;
using System.Threading.Tasks;

namespace LagSim.Tests.Carriers;

/// <summary>Two WebSockets that are each other's other end, in memory, with as little room between them as a slow network has.</summary>
internal sealed class SocketPair
{
    private const int Room = 4096; // bytes that wait between the two, before a send has to wait

    private readonly Gate gate = new();

    internal SocketPair()
    {
        Pipe there = NewPipe(), back = NewPipe();
        Server = WebSocket.CreateFromStream(new Duplex(back.Reader, there.Writer, null), new WebSocketCreationOptions { IsServer = true });
        Client = WebSocket.CreateFromStream(new Duplex(there.Reader, back.Writer, gate), new WebSocketCreationOptions { IsServer = false });
    }

    internal WebSocket Server { get; }

    internal WebSocket Client { get; }

    /// <summary>From now on the client takes nothing.</summary>
    internal void StopReading() => gate.Close();

    /// <summary>From now on it takes what comes.</summary>
    internal void GoOnReading() => gate.Open();

    private static Pipe NewPipe() => new(new PipeOptions(pauseWriterThreshold: Room, resumeWriterThreshold: Room / 2, useSynchronizationContext: false));

    private sealed class Gate
    {
        private volatile TaskCompletionSource? closed;

        internal Task Passed => closed?.Task ?? Task.CompletedTask;

        internal void Close() => closed = new TaskCompletionSource(TaskCreationOptions.RunContinuationsAsynchronously);

        internal void Open()
        {
            TaskCompletionSource? was = closed;
            closed = null;
            was?.SetResult();
        }
    }

    private sealed class Duplex(PipeReader reader, PipeWriter writer, Gate? gate) : Stream
    {
        private readonly Stream input = reader.AsStream(), output = writer.AsStream();

        public override bool CanRead => true;

        public override bool CanSeek => false;

        public override bool CanWrite => true;

        public override long Length => throw new NotSupportedException();

        public override long Position
        {
            get => throw new NotSupportedException();
            set => throw new NotSupportedException();
        }

        public override async ValueTask<int> ReadAsync(Memory<byte> buffer, CancellationToken cancellationToken = default)
        {
            await (gate?.Passed ?? Task.CompletedTask).WaitAsync(cancellationToken);
            return await input.ReadAsync(buffer, cancellationToken);
        }

        public override async ValueTask WriteAsync(ReadOnlyMemory<byte> buffer, CancellationToken cancellationToken = default)
        {
            await output.WriteAsync(buffer, cancellationToken);
            await output.FlushAsync(cancellationToken);
        }

        public override void Flush()
        {
        }

        public override Task FlushAsync(CancellationToken cancellationToken) => Task.CompletedTask;

        public override int Read(byte[] buffer, int offset, int count) => throw new NotSupportedException();

        public override long Seek(long offset, SeekOrigin origin) => throw new NotSupportedException();

        public override void SetLength(long value) => throw new NotSupportedException();

        public override void Write(byte[] buffer, int offset, int count) => throw new NotSupportedException();

        protected override void Dispose(bool disposing)
        {
            writer.CancelPendingFlush(); // as a socket that is closed ends what waits for it
            reader.CancelPendingRead();
            output.Dispose();
            input.Dispose();
            base.Dispose(disposing);
        }
    }
}
