using System;
using System.Buffers.Binary;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Wire;

/// <summary>Writes consecutive little-endian fields into a span.</summary>
/// <remarks>Allocates nothing. Writing past the end throws <see cref="ArgumentException"/>: the caller knows the size beforehand.</remarks>
internal ref struct WireWriter
{
    private readonly Span<byte> bytes;

    /// <summary>Creates a writer at the start of <paramref name="destination"/>.</summary>
    public WireWriter(Span<byte> destination)
    {
        bytes = destination;
        Position = 0;
    }

    /// <summary>The number of bytes written.</summary>
    public int Position { get; private set; }

    /// <summary>Writes one byte.</summary>
    public void WriteByte(byte value) => Next(1)[0] = value;

    /// <summary>Writes two bytes.</summary>
    public void WriteUInt16(ushort value) => BinaryPrimitives.WriteUInt16LittleEndian(Next(sizeof(ushort)), value);

    /// <summary>Writes four bytes.</summary>
    public void WriteUInt32(uint value) => BinaryPrimitives.WriteUInt32LittleEndian(Next(sizeof(uint)), value);

    /// <summary>Writes eight bytes.</summary>
    public void WriteUInt64(ulong value) => BinaryPrimitives.WriteUInt64LittleEndian(Next(sizeof(ulong)), value);

    /// <summary>Writes eight bytes, two's complement.</summary>
    public void WriteInt64(long value) => BinaryPrimitives.WriteInt64LittleEndian(Next(sizeof(long)), value);

    /// <summary>Writes eight bytes, IEEE 754; -0.0 is written as 0.0.</summary>
    /// <exception cref="ArgumentException">The value is not finite.</exception>
    public void WriteDouble(double value)
    {
        if (!double.IsFinite(value))
        {
            throw new ArgumentException($"{value} cannot travel: only finite numbers can.", nameof(value));
        }

        WriteInt64(BitConverter.DoubleToInt64Bits(value + 0.0)); // -0.0 + 0.0 is 0.0
    }

    /// <summary>Writes three doubles: x, y, z.</summary>
    /// <exception cref="ArgumentException">A component is not finite.</exception>
    public void WriteVector(in Vector3D value)
    {
        WriteDouble(value.X);
        WriteDouble(value.Y);
        WriteDouble(value.Z);
    }

    /// <summary>Writes a time, as eight bytes of ticks.</summary>
    /// <exception cref="ArgumentException">The time is further than <see cref="WireFormat.MaxTimeTicks"/> from the origin.</exception>
    public void WriteTime(SimTime value)
    {
        if (!WireFormat.IsInRange(value))
        {
            throw new ArgumentException($"The time {value} cannot travel: it is more than 48 days from the origin.", nameof(value));
        }

        WriteInt64(value.Ticks);
    }

    /// <summary>Writes a time, or <see cref="SimTime.MinValue"/> for none.</summary>
    /// <exception cref="ArgumentException">It is neither none nor within <see cref="WireFormat.MaxTimeTicks"/> of the origin.</exception>
    public void WriteOptionalTime(SimTime value)
    {
        if (value == SimTime.MinValue)
        {
            WriteInt64(value.Ticks);
        }
        else
        {
            WriteTime(value);
        }
    }

    /// <summary>Writes these bytes as they are.</summary>
    internal void WriteBytes(scoped ReadOnlySpan<byte> value) => value.CopyTo(Next(value.Length));

    /// <summary>Writes magic, version and type, with which every datagram begins.</summary>
    public void WriteHeader(DatagramType type)
    {
        WriteUInt16(WireFormat.Magic);
        WriteByte(WireFormat.Version);
        WriteByte((byte)type);
    }

    private Span<byte> Next(int count)
    {
        if (count > bytes.Length - Position)
        {
            throw new ArgumentException($"{count} more bytes do not fit: {Position} of {bytes.Length} are written.");
        }

        Span<byte> next = bytes.Slice(Position, count);
        Position += count;
        return next;
    }
}
