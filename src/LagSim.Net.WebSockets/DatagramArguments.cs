using System;

namespace LagSim.Net.Carriers;

/// <summary>The checks that <see cref="IDatagramPort"/> asks of every port.</summary>
internal static class DatagramArguments
{
    /// <exception cref="ArgumentException">It is empty or too long.</exception>
    internal static void ThrowIfNoDatagram(ReadOnlySpan<byte> datagram)
    {
        if (datagram.Length is 0 or > IDatagramPort.MaxDatagramBytes)
        {
            throw new ArgumentException(
                $"A datagram has 1 to {IDatagramPort.MaxDatagramBytes} bytes; this one has {datagram.Length}.", nameof(datagram));
        }
    }

    /// <exception cref="ArgumentException">It may be too short for a datagram.</exception>
    internal static void ThrowIfTooShort(Span<byte> buffer)
    {
        if (buffer.Length < IDatagramPort.MaxDatagramBytes)
        {
            throw new ArgumentException($"{buffer.Length} bytes may be too few: {IDatagramPort.MaxDatagramBytes} are needed.", nameof(buffer));
        }
    }
}
