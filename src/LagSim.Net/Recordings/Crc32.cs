using System;
using System.Runtime.InteropServices;

namespace LagSim.Net.Recordings;

/// <summary>
/// The CRC-32 of IEEE 802.3, as in zip and PNG: reflected polynomial 0xEDB88320. It detects accidental damage, not tampering.
/// </summary>
internal static class Crc32
{
    private static readonly uint[] Table = MakeTable();

    /// <summary>Continues a checksum with these bytes. The checksum of no bytes is 0.</summary>
    internal static uint Append(uint before, ReadOnlySpan<byte> bytes)
    {
        uint crc = ~before;
        // A writable span, because the indexer of a read-only one cannot be linked by some Mono runtimes (docs/ARCHITECTURE.md).
        foreach (byte next in MemoryMarshal.CreateSpan(ref MemoryMarshal.GetReference(bytes), bytes.Length))
        {
            crc = Table[(byte)(crc ^ next)] ^ (crc >> 8);
        }

        return ~crc;
    }

    private static uint[] MakeTable()
    {
        uint[] table = new uint[256];
        for (uint n = 0; n < table.Length; n++)
        {
            uint crc = n;
            for (int bit = 0; bit < 8; bit++)
            {
                crc = (crc & 1) == 0 ? crc >> 1 : (crc >> 1) ^ 0xEDB88320;
            }

            table[n] = crc;
        }

        return table;
    }
}
