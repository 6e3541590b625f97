using System;
using System.Buffers.Binary;
using System.Runtime.InteropServices;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Wire;

/// <summary>Reads consecutive little-endian fields from untrusted bytes.</summary>
/// <remarks>
/// Never throws, never reads past the end, allocates nothing. The first error is kept in <see cref="Refusal"/>; from then on every read
/// returns zero, so a decoder reads all its fields and checks once, in <see cref="Finish"/>.
/// </remarks>
internal ref struct WireReader
{
    private readonly ReadOnlySpan<byte> bytes;
    private int position;

    /// <summary>Creates a reader at the start of <paramref name="source"/>.</summary>
    public WireReader(ReadOnlySpan<byte> source)
        : this(source, WireFormat.MaxBytes)
    {
    }

    /// <summary>Creates a reader of data that may be longer than a datagram, up to <paramref name="limit"/> bytes.</summary>
    internal WireReader(ReadOnlySpan<byte> source, int limit)
    {
        bytes = source;
        position = 0;
        Refusal = source.Length > limit ? WireRefusal.TooLong : WireRefusal.None;
    }

    /// <summary>The first error, or <see cref="WireRefusal.None"/>.</summary>
    public WireRefusal Refusal { get; private set; }

    /// <summary>The number of bytes not read yet.</summary>
    internal readonly int Remaining => bytes.Length - position;

    /// <summary>
    /// Creates a reader after the header of a datagram; it has refused already if the datagram is not of this type and version.
    /// </summary>
    public static WireReader Open(ReadOnlySpan<byte> datagram, DatagramType type)
    {
        WireReader reader = new(datagram, type == DatagramType.Sealed ? WireFormat.MaxBytes : WireFormat.MaxPlainBytes);
        DatagramType found = reader.ReadHeader();
        reader.Require(found == type, WireRefusal.OtherType);
        return reader;
    }

    /// <summary>Reads magic, version and a known type.</summary>
    public DatagramType ReadHeader()
    {
        Require(bytes.Length >= WireFormat.HeaderBytes, WireRefusal.TooShort);
        Require(ReadUInt16() == WireFormat.Magic, WireRefusal.NotLagSim);
        Require(ReadByte() == WireFormat.Version, WireRefusal.VersionDiffers);
        DatagramType type = (DatagramType)ReadByte();
        Require(type is >= DatagramType.ConnectRequest and <= DatagramType.KeyExchangeReply, WireRefusal.UnknownType);
        return type;
    }

    /// <summary>Reads one byte.</summary>
    public byte ReadByte() => TryTake(1, out ReadOnlySpan<byte> taken) ? ByteAt(taken, 0) : (byte)0;

    /// <summary>
    /// Returns one byte of a span, which must be there. It avoids the span's own indexer: some Mono runtimes cannot link it
    /// (docs/ARCHITECTURE.md).
    /// </summary>
    internal static byte ByteAt(ReadOnlySpan<byte> bytes, int index) => MemoryMarshal.Read<byte>(bytes.Slice(index));

    /// <summary>Reads two bytes.</summary>
    public ushort ReadUInt16() =>
        TryTake(sizeof(ushort), out ReadOnlySpan<byte> taken) ? BinaryPrimitives.ReadUInt16LittleEndian(taken) : (ushort)0;

    /// <summary>Reads four bytes.</summary>
    public uint ReadUInt32() => TryTake(sizeof(uint), out ReadOnlySpan<byte> taken) ? BinaryPrimitives.ReadUInt32LittleEndian(taken) : 0;

    /// <summary>Reads eight bytes.</summary>
    public ulong ReadUInt64() => TryTake(sizeof(ulong), out ReadOnlySpan<byte> taken) ? BinaryPrimitives.ReadUInt64LittleEndian(taken) : 0;

    /// <summary>Reads eight bytes, two's complement.</summary>
    public long ReadInt64() => TryTake(sizeof(long), out ReadOnlySpan<byte> taken) ? BinaryPrimitives.ReadInt64LittleEndian(taken) : 0;

    /// <summary>Reads a double, eight bytes of IEEE 754. Refuses infinities and NaN, and turns -0.0 into 0.0.</summary>
    public double ReadDouble()
    {
        double value = BitConverter.Int64BitsToDouble(ReadInt64());
        Require(double.IsFinite(value));
        return value + 0.0;
    }

    /// <summary>Reads three doubles: x, y, z.</summary>
    public Vector3D ReadVector() => new(ReadDouble(), ReadDouble(), ReadDouble());

    /// <summary>Reads a time within <see cref="WireFormat.MaxTimeTicks"/> of the origin.</summary>
    public SimTime ReadTime()
    {
        SimTime time = SimTime.FromTicks(ReadInt64());
        Require(WireFormat.IsInRange(time));
        return time;
    }

    /// <summary>Reads a time, or <see cref="SimTime.MinValue"/> for none.</summary>
    public SimTime ReadOptionalTime()
    {
        SimTime time = SimTime.FromTicks(ReadInt64());
        Require(time == SimTime.MinValue || WireFormat.IsInRange(time));
        return time;
    }

    /// <summary>Returns that many bytes without copying; none if fewer are left.</summary>
    internal ReadOnlySpan<byte> ReadBytes(int count) => TryTake(count, out ReadOnlySpan<byte> taken) ? taken : default;

    /// <summary>Refuses the datagram unless the condition holds; the first refusal stays the reason.</summary>
    public void Require(bool condition, WireRefusal otherwise = WireRefusal.BadValue)
    {
        if (!condition && Refusal == WireRefusal.None)
        {
            Refusal = otherwise;
        }
    }

    /// <summary>Ends the datagram here: refuses it if bytes are left.</summary>
    /// <returns>True if nothing was wrong.</returns>
    public bool Finish(out WireRefusal refusal)
    {
        Require(position == bytes.Length, WireRefusal.TrailingBytes);
        refusal = Refusal;
        return refusal == WireRefusal.None;
    }

    private bool TryTake(int count, out ReadOnlySpan<byte> taken)
    {
        Require(count <= bytes.Length - position, WireRefusal.TooShort);
        bool sound = Refusal == WireRefusal.None;
        taken = sound ? bytes.Slice(position, count) : default;
        position += sound ? count : 0;
        return sound;
    }
}
