using System;

namespace LagSim.Tests.Wire;

/// <summary>Bytes that were right, with one to three of them changed: to anything, by one bit, or to a value at the edge of a range.</summary>
internal static class Mutation
{
    private static readonly byte[] Edges = [0, 1, 0x7F, 0x80, 0xF0, 0xFF];

    internal static byte[] Of(byte[] valid, Random random)
    {
        byte[] bytes = (byte[])valid.Clone();
        for (int change = random.Next(1, 4); change > 0; change--)
        {
            int at = random.Next(bytes.Length);
            bytes[at] = random.Next(3) switch
            {
                0 => (byte)random.Next(256),
                1 => (byte)(bytes[at] ^ (1 << random.Next(8))),
                _ => Edges[random.Next(Edges.Length)],
            };
        }

        return bytes;
    }
}
