using System;
using System.Numerics;
using FsCheck;
using FsCheck.Fluent;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.Api.TickGenerators;

namespace LagSim.Tests.Api;

public sealed class SimDurationTests
{
    private const double Tick = 1.0 / (1L << 40);

    /// <summary>Texts that are no time; <see cref="SimTimeTests"/> uses them too.</summary>
    public static TheoryData<string> NotATime =>
    [
        "", "s", "-", "-s", ".", ".s", ".5s", "1.s", "-.5s", "1", "1.5", "1S", "1 s", " 1s", "1s ", "+1s", "--1s", "1-s", "1ss", "1.2.3s",
        "1,5s", "1e3s", "1_000s", "0x1s", "NaNs", "Infinitys", "1ms", "1s\0", "\u0661s", "1.\uFF15s", "s1", "0.00000000000000000000000000000000000000000s",
    ];

    /// <summary>Times, but not a whole number of ticks or beyond the range.</summary>
    public static TheoryData<string> NotRepresentable =>
        ["0.1s", "0.0000000000001s", "1.3s", "8388608s", "-8388608.5s", "99999999999999999999s", "-99999999999999999999s"];

    [Fact]
    public void Parse_TextOfAnyDuration_IsThatDuration()
    {
        ForAny(ticks =>
        {
            string text = SimDuration.FromTicks(ticks).ToString();
            return SimDuration.Parse(text).Ticks == ticks && text.Length <= 64 && text.EndsWith('s') && text.Trim() == text;
        });
    }

    [Theory]
    [InlineData(0, "0s")]
    [InlineData(1L << 39, "0.5s")]
    [InlineData(-(1L << 38), "-0.25s")]
    [InlineData(49L << 38, "12.25s")]
    [InlineData(1, "0.0000000000009094947017729282379150390625s")]
    [InlineData(long.MinValue, "-8388608s")]
    [InlineData(long.MaxValue, "8388607.9999999999990905052982270717620849609375s")]
    public void ToString_KnownDuration_IsExactDecimalSeconds(long ticks, string text)
    {
        Assert.Equal(text, SimDuration.FromTicks(ticks).ToString());
        Assert.Equal(ticks, SimDuration.Parse(text).Ticks);
    }

    [Theory]
    [MemberData(nameof(NotATime))]
    [MemberData(nameof(NotRepresentable))]
    public void Parse_AnythingElse_IsRefused(string text)
    {
        Assert.Throws<FormatException>(() => SimDuration.Parse(text));
    }

    [Fact]
    public void Parse_MillionCharacters_IsRefusedWithoutRepeatingThem()
    {
        foreach (string text in new[] { new string('1', 1_000_000) + "s", "0." + new string('0', 1_000_000) + "s", new string('s', 1_000_000) })
        {
            FormatException error = Assert.Throws<FormatException>(() => SimDuration.Parse(text));
            Assert.InRange(error.Message.Length, 1, 200);
        }
    }

    [Fact]
    public void Parse_Null_IsRefused()
    {
        Assert.Throws<ArgumentNullException>(() => SimDuration.Parse(null!));
    }

    [Fact]
    public void Parse_AnyText_IsATimeOrAFormatException()
    {
        Gen<string> nearlyTimes = Gen.Elements("0123456789.-s se+".ToCharArray()).ArrayOf().Select(chars => new string(chars));
        Gen<string> anything = ArbMap.Default.GeneratorFor<string>().Where(text => text is not null);
        Check(Prop.ForAll(Gen.OneOf(nearlyTimes, anything).ToArbitrary(), text =>
        {
            try
            {
                SimDuration parsed = SimDuration.Parse(text);
                return SimDuration.Parse(parsed.ToString()) == parsed;
            }
            catch (FormatException)
            {
                return true;
            }
        }));
    }

    [Theory]
    [InlineData(double.NaN)]
    [InlineData(double.PositiveInfinity)]
    [InlineData(double.NegativeInfinity)]
    [InlineData(8388608.0)]
    [InlineData(-8388609.0)]
    [InlineData(double.MaxValue)]
    [InlineData(double.MinValue)]
    public void FromSeconds_NotFiniteOrOutOfRange_IsRefusedWithTheValue(double seconds)
    {
        ArgumentOutOfRangeException error = Assert.Throws<ArgumentOutOfRangeException>(() => SimDuration.FromSeconds(seconds));
        Assert.Equal(seconds, error.ActualValue);
        Assert.Throws<ArgumentOutOfRangeException>(() => SimDuration.FromMilliseconds(seconds * 1000));
    }

    [Fact]
    public void FromSeconds_LargestThatFits_IsExact()
    {
        double seconds = Math.BitDecrement(8388608.0);
        Assert.Equal(long.MaxValue - 1023, SimDuration.FromSeconds(seconds).Ticks);
        Assert.Equal(-(long.MaxValue - 1023), SimDuration.FromSeconds(-seconds).Ticks);
    }

    [Theory]
    [InlineData(0.5, 0)]
    [InlineData(1.5, 2)]
    [InlineData(2.5, 2)]
    [InlineData(-0.5, 0)]
    [InlineData(-1.5, -2)]
    [InlineData(-2.5, -2)]
    [InlineData(0.49999999999999994, 0)]
    [InlineData(0.50000000000000011, 1)]
    [InlineData(4503599627370495.5, 4503599627370496)]
    [InlineData(4503599627370494.5, 4503599627370494)]
    public void FromSeconds_BetweenTwoTicks_GoesToTheNearestAndTiesToEven(double inTicks, long ticks)
    {
        Assert.Equal(ticks, SimDuration.FromSeconds(inTicks * Tick).Ticks);
    }

    [Fact]
    public void FromSeconds_NegativeZeroOrDenormal_IsZero()
    {
        Assert.Equal(0, SimDuration.FromSeconds(-0.0).Ticks);
        Assert.Equal(0, SimDuration.FromSeconds(double.Epsilon).Ticks);
        Assert.Equal(0L, BitConverter.DoubleToInt64Bits(SimDuration.FromSeconds(-0.0).ToSeconds()));
    }

    [Fact]
    public void FromSeconds_OfToSeconds_IsTheSameUpToTwoToTheThirteenSeconds()
    {
        ForAny(ticks => Math.Abs(ticks / 2) >= 1L << 52 || SimDuration.FromSeconds(SimDuration.FromTicks(ticks).ToSeconds()).Ticks == ticks);
    }

    [Fact]
    public void FromMilliseconds_WholeMilliseconds_IsTheNearestTick()
    {
        // Integers as the oracle. Up to 32 s the one rounding of a division by 1000 cannot reach the nearest half tick.
        Check(Prop.ForAll(Gen.Choose(-32_000, 32_000).ToArbitrary(), ms =>
        {
            long exact = (long)ms << 40, ticks = SimDuration.FromMilliseconds(ms).Ticks;
            return Math.Abs((ticks * 1000) - exact) <= 500;
        }));
    }

    [Fact]
    public void Arithmetic_AnyOperands_IsExactOrOverflows()
    {
        ForAny((a, b) =>
        {
            SimDuration x = SimDuration.FromTicks(a), y = SimDuration.FromTicks(b);
            return IsExactOrOverflows((BigInteger)a + b, () => (x + y).Ticks)
                && IsExactOrOverflows((BigInteger)a - b, () => (x - y).Ticks)
                && IsExactOrOverflows(-(BigInteger)a, () => (-x).Ticks)
                && IsExactOrOverflows((BigInteger)a * b, () => (x * b).Ticks)
                && (b == 0 || IsExactOrOverflows(BigInteger.Divide(a, b), () => (x / b).Ticks));
        });
    }

    [Fact]
    public void Arithmetic_AtTheEdges_OverflowsOrDividesByZero()
    {
        SimDuration least = SimDuration.FromTicks(long.MinValue);
        Assert.Throws<OverflowException>(() => SimDuration.MaxValue + SimDuration.OneTick);
        Assert.Throws<OverflowException>(() => least - SimDuration.OneTick);
        Assert.Throws<OverflowException>(() => -least);
        Assert.Throws<OverflowException>(() => least * -1);
        Assert.Throws<OverflowException>(() => least / -1);
        Assert.Throws<DivideByZeroException>(() => SimDuration.OneTick / 0);
    }

    [Fact]
    public void Comparison_AnyTwo_IsThatOfTheirTicks()
    {
        ForAny((a, b) =>
        {
            SimDuration x = SimDuration.FromTicks(a), y = SimDuration.FromTicks(b);
            return Math.Sign(x.CompareTo(y)) == a.CompareTo(b)
                && x < y == a < b && x > y == a > b && x <= y == a <= b && x >= y == a >= b && x == y == (a == b) && x != y == (a != b)
                && x.Equals(y) == (a == b) && x.Equals((object)y) == (a == b) && (a != b || x.GetHashCode() == y.GetHashCode());
        });
    }
}
