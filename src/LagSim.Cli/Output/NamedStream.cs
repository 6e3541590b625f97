using System;
using System.IO;

namespace LagSim.Cli.Output;

/// <summary>A stream whose write failures name the file; the system's own message names only the cause.</summary>
internal sealed class NamedStream(string name, Stream inner) : Stream
{
    public override bool CanRead => false;

    public override bool CanSeek => false;

    public override bool CanWrite => true;

    public override long Length => throw new NotSupportedException();

    public override long Position { get => throw new NotSupportedException(); set => throw new NotSupportedException(); }

    public override void Write(byte[] buffer, int offset, int count) => Write(buffer.AsSpan(offset, count));

    public override void Write(ReadOnlySpan<byte> buffer)
    {
        try
        {
            inner.Write(buffer);
        }
        catch (Exception failure) when (failure is UnauthorizedAccessException || (failure is IOException wrong && !StandardOutput.IsClosedPipe(wrong)))
        {
            throw new IOException($"{name} cannot be written: {failure.Message.TrimEnd('.')}.", failure);
        }
    }

    public override void Flush() => inner.Flush();

    public override int Read(byte[] buffer, int offset, int count) => throw new NotSupportedException();

    public override long Seek(long offset, SeekOrigin origin) => throw new NotSupportedException();

    public override void SetLength(long value) => throw new NotSupportedException();
}
