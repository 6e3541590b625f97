using System;
using Xunit;

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

    /// <summary>Whether bytes are accepted; it asserts itself that what is accepted is as it must be.</summary>
    internal delegate bool Decoder(ReadOnlySpan<byte> bytes);

    /// <summary>Decodes mutations of valid bytes, every fourth cut short, and asserts that enough of them are accepted, and enough are not, to say something.</summary>
    internal static void DecodeMany(byte[][] valid, int trials, int seed, Decoder decoder)
    {
        Random random = new(seed);
        int accepted = 0;
        for (int i = 0; i < trials; i++)
        {
            byte[] bytes = Of(valid[random.Next(valid.Length)], random);
            accepted += decoder(random.Next(4) > 0 ? bytes : bytes.AsSpan(0, random.Next(bytes.Length))) ? 1 : 0;
        }

        Assert.True(accepted > trials / 10 && accepted < trials - (trials / 10), $"{accepted} of {trials} accepted: the mutations say little.");
    }
}
