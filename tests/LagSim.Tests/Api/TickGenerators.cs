using System;
using System.Numerics;
using FsCheck;
using FsCheck.Fluent;
using Xunit;

namespace LagSim.Tests.Api;

/// <summary>64-bit values of every magnitude: FsCheck's own are small, and what overflows or rounds is not.</summary>
internal static class TickGenerators
{
    internal static readonly Gen<long> Any = Gen.OneOf(
        Gen.Elements(long.MinValue, long.MinValue + 1, -1L << 53, -1L << 40, -1, 0, 1, 1L << 40, (1L << 53) + 1, long.MaxValue - 1, long.MaxValue),
        Gen.Choose(-1000, 1000).Select(x => (long)x),
        from bits in Full from shift in Gen.Choose(0, 63) select bits >> shift,
        Full);

    private static Gen<long> Full =>
        from a in Gen.Choose(0, 0xFFFF)
        from b in Gen.Choose(0, 0xFFFF)
        from c in Gen.Choose(0, 0xFFFF)
        from d in Gen.Choose(0, 0xFFFF)
        select ((long)a << 48) | ((long)b << 32) | ((long)c << 16) | (uint)d;

    internal static void ForAny(Func<long, bool> holds) => Check(Prop.ForAll(Any.ToArbitrary(), holds));

    internal static void ForAny(Func<long, long, bool> holds) => Check(Prop.ForAll(Any.ToArbitrary(), Any.ToArbitrary(), holds));

    internal static void ForAny(Func<long, long, long, bool> holds) =>
        Check(Prop.ForAll(Any.ToArbitrary(), Any.ToArbitrary(), Any.ToArbitrary(), holds));

    internal static void Check(Property property) => property.Check(Config.QuickThrowOnFailure.WithMaxTest(2000));

    /// <summary>True if the sum comes out as exact arithmetic has it, or throws <see cref="OverflowException"/> if that does not fit.</summary>
    internal static bool IsExactOrOverflows(BigInteger expected, Func<long> compute)
    {
        if (expected >= long.MinValue && expected <= long.MaxValue)
        {
            return compute() == (long)expected;
        }

        Assert.Throws<OverflowException>(() => compute());
        return true;
    }
}
