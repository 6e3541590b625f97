using System;
using System.Globalization;
using System.Net;

namespace LagSim.Net.Carriers;

/// <summary>The source or destination of datagrams, as a value: an IP address and port, a connection from an IP address, or a number in a
/// virtual network.</summary>
/// <remarks>Immutable, safe on any thread, never allocates to compare. <c>default</c> is no address.</remarks>
public readonly struct PeerAddress : IEquatable<PeerAddress>
{
    /// <summary>The number of bytes that <see cref="Write"/> writes.</summary>
    internal const int Bytes = 20;

    private readonly ulong high;
    private readonly ulong low;
    private readonly uint portAndFamily; // port + 1 in the low 17 bits; bit 30: a connection, whose number it is; bit 31: IPv6

    private const uint Connected = 1u << 30;

    private PeerAddress(ulong high, ulong low, uint portAndFamily)
    {
        this.high = high;
        this.low = low;
        this.portAndFamily = portAndFamily;
    }

    /// <summary>True for <c>default</c>, which is no address.</summary>
    public bool IsNone => portAndFamily == 0 && high == 0 && low == 0;

    /// <summary>Address <paramref name="number"/> of a virtual network.</summary>
    public static PeerAddress Virtual(int number) => new(ulong.MaxValue, (ulong)number, 0);

    /// <summary>True for what <see cref="Virtual"/> made.</summary>
    internal bool IsVirtual => portAndFamily == 0 && !IsNone;

    /// <summary>
    /// A connection that a machine has opened to this one, over which datagrams go both ways. It is told from every endpoint, and from other
    /// connections of that machine.
    /// </summary>
    /// <param name="machine">The IPv4 or IPv6 address of the machine.</param>
    /// <param name="number">A number that no other connection has at the time.</param>
    /// <exception cref="ArgumentNullException">The machine is null.</exception>
    public static PeerAddress OfConnection(IPAddress machine, ushort number)
    {
        PeerAddress from = From(new IPEndPoint(machine ?? throw new ArgumentNullException(nameof(machine)), number));
        return new PeerAddress(from.high, from.low, from.portAndFamily | Connected);
    }

    /// <summary>True for what <see cref="OfConnection"/> made.</summary>
    public bool IsConnection => (portAndFamily & Connected) != 0;

    /// <summary>The address of an IPv4 or IPv6 endpoint; an IPv4 address mapped into IPv6 is the IPv4 address.</summary>
    /// <exception cref="ArgumentException">The endpoint is of another family.</exception>
    public static PeerAddress From(IPEndPoint endpoint)
    {
        if (endpoint is null)
        {
            throw new ArgumentNullException(nameof(endpoint));
        }

        IPAddress address = endpoint.Address.IsIPv4MappedToIPv6 ? endpoint.Address.MapToIPv4() : endpoint.Address;
        Span<byte> bytes = stackalloc byte[16];
        if (!address.TryWriteBytes(bytes, out int length))
        {
            throw new ArgumentException($"'{endpoint}' is neither an IPv4 nor an IPv6 endpoint.", nameof(endpoint));
        }

        bool v6 = length == 16;
        ulong high = v6 ? System.Buffers.Binary.BinaryPrimitives.ReadUInt64BigEndian(bytes) : 0;
        ulong low = v6
            ? System.Buffers.Binary.BinaryPrimitives.ReadUInt64BigEndian(bytes.Slice(8))
            : System.Buffers.Binary.BinaryPrimitives.ReadUInt32BigEndian(bytes);
        return new PeerAddress(high, low, (uint)(endpoint.Port + 1) | (v6 ? 1u << 31 : 0));
    }

    /// <summary>The endpoint given to <see cref="From"/>.</summary>
    /// <exception cref="InvalidOperationException">This is no address, a connection, or an address of a virtual network.</exception>
    public IPEndPoint ToEndPoint()
    {
        if (portAndFamily == 0 || IsConnection)
        {
            throw new InvalidOperationException($"'{this}' is not an IP address and port.");
        }

        return new IPEndPoint(ToIPAddress(), (int)((portAndFamily & 0x1FFFF) - 1));
    }

    /// <summary>The IP address of an endpoint, or of the machine of a connection.</summary>
    /// <exception cref="InvalidOperationException">This is no address, or one of a virtual network.</exception>
    public IPAddress ToIPAddress()
    {
        if (portAndFamily == 0)
        {
            throw new InvalidOperationException($"'{this}' has no IP address.");
        }

        Span<byte> bytes = stackalloc byte[16];
        bool v6 = (portAndFamily >> 31) != 0;
        if (v6)
        {
            System.Buffers.Binary.BinaryPrimitives.WriteUInt64BigEndian(bytes, high);
            System.Buffers.Binary.BinaryPrimitives.WriteUInt64BigEndian(bytes.Slice(8), low);
        }
        else
        {
            System.Buffers.Binary.BinaryPrimitives.WriteUInt32BigEndian(bytes, (uint)low);
        }

        return new IPAddress(bytes.Slice(0, v6 ? 16 : 4));
    }

    /// <summary>Whether the other address is of the same <see cref="Machine"/>.</summary>
    internal bool IsSameMachine(PeerAddress other) => Machine == other.Machine;

    /// <summary>
    /// The part of the address that is the same for everything one machine can send from: its IP address, whatever the port; for IPv6 its
    /// first 64 bits, since a host with one such address has all those of its network. What a machine may do is counted by it.
    /// </summary>
    public PeerAddress Machine => portAndFamily >> 31 != 0 ? new(high, 0, 1u << 31) : new(high, low, 0);

    /// <summary>Writes all of it as bytes, for a hash.</summary>
    internal void Write(Span<byte> destination)
    {
        System.Buffers.Binary.BinaryPrimitives.WriteUInt64LittleEndian(destination, high);
        System.Buffers.Binary.BinaryPrimitives.WriteUInt64LittleEndian(destination.Slice(8), low);
        System.Buffers.Binary.BinaryPrimitives.WriteUInt32LittleEndian(destination.Slice(16), portAndFamily);
    }

    /// <inheritdoc/>
    public bool Equals(PeerAddress other) => high == other.high && low == other.low && portAndFamily == other.portAndFamily;

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is PeerAddress other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => HashCode.Combine(high, low, portAndFamily);

    /// <summary>Same address.</summary>
    public static bool operator ==(PeerAddress a, PeerAddress b) => a.Equals(b);

    /// <summary>Different addresses.</summary>
    public static bool operator !=(PeerAddress a, PeerAddress b) => !a.Equals(b);

    /// <summary>
    /// <c>address:port</c>; <c>address#number</c> for a connection; <c>virtual:number</c>; or <c>none</c>.
    /// </summary>
    public override string ToString() =>
        IsNone ? "none"
        : portAndFamily == 0 ? string.Format(CultureInfo.InvariantCulture, "virtual:{0}", low)
        : IsConnection ? string.Format(CultureInfo.InvariantCulture, "{0}#{1}", ToIPAddress(), (portAndFamily & 0x1FFFF) - 1)
        : ToEndPoint().ToString();
}
