using System;
using System.Collections.Generic;
using LagSim.Net.Sessions.Links;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>Which numbers have come, against a set of all that have.</summary>
public sealed class SeenNumbersTests
{
    [Fact]
    public void AnyOrder_CountsEachOnce_AndTellsWhichOfThe32BeforeHaveCome()
    {
        for (int seed = 0; seed < 60; seed++)
        {
            Random random = new(seed);
            SeenNumbers seen = new();
            HashSet<uint> all = [];
            uint newest = 0, top = seed % 2 == 0 ? 0 : uint.MaxValue - 40_000; // up to the greatest there is
            for (int n = 0; n < 500; n++)
            {
                uint number = random.Next(20) switch
                {
                    0 => top += (uint)random.Next(1, 40),
                    1 => top += (uint)random.Next(1, 1600), // a gap as long as all that is remembered
                    < 10 => top = Math.Max(1, top + 1),
                    _ => (uint)Math.Max(0, (long)top - random.Next(0, 1100)),
                };
                bool isKnown = number == 0 || all.Contains(number) || (newest > number && newest - number >= SeenNumbers.Span);
                Assert.Equal(!isKnown, seen.Add(number));
                if (!isKnown)
                {
                    all.Add(number);
                }

                newest = Math.Max(newest, isKnown ? 0 : number);
                Assert.Equal(newest, seen.Newest);
                uint bits = 0;
                for (uint k = 1; k <= 32 && k < newest; k++)
                {
                    bits |= all.Contains(newest - k) ? 1u << (int)(k - 1) : 0;
                }

                Assert.Equal(bits, seen.BitsBefore(newest));
            }
        }
    }
}
