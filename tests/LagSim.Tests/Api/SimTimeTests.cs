using System;
using System.Numerics;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.Api.TickGenerators;

namespace LagSim.Tests.Api;

public sealed class SimTimeTests
{
    [Fact]
    public void Parse_TextOfAnyTime_IsThatTime()
    {
        ForAny(ticks => SimTime.Parse(SimTime.FromTicks(ticks).ToString()).Ticks == ticks);
    }

    [Fact]
    public void ToString_AnyTime_IsThatOfTheDurationFromTheOrigin()
    {
        ForAny(ticks => SimTime.FromTicks(ticks).ToString() == SimDuration.FromTicks(ticks).ToString());
    }

    [Theory]
    [InlineData(0L, "0s")]
    [InlineData(1L, "0.000000000001s")]
    [InlineData(3L, "0.000000000003s")]
    [InlineData(10995116278L, "0.01s")] // FromSeconds(0.01) is off by a part of a tick
    [InlineData(10995116279L, "0.010000000001s")]
    [InlineData(-1649267441664L, "-1.5s")]
    [InlineData((1L << 40) - 1, "0.999999999999s")]
    [InlineData(long.MaxValue, "8388607.999999999999s")]
    [InlineData(long.MinValue, "-8388608s")]
    public void ToShortString_OfATime_HasTheFewestDecimals(long ticks, string text)
    {
        Assert.Equal(text, SimTime.FromTicks(ticks).ToShortString());
        Assert.Equal(text, SimDuration.FromTicks(ticks).ToShortString());
    }

    [Fact]
    public void ToShortString_OfAnyTime_IsNearerToItThanToAnyOther() => ForAny(ticks =>
    {
        string text = SimTime.FromTicks(ticks).ToShortString();
        string[] parts = text.TrimStart('-')[..^1].Split('.');
        BigInteger scale = BigInteger.Pow(10, parts.Length == 2 ? parts[1].Length : 0);
        BigInteger off = (BigInteger.Parse(string.Concat(parts), System.Globalization.CultureInfo.InvariantCulture) << 40) - (BigInteger.Abs(ticks) * scale);
        return scale <= BigInteger.Pow(10, 13) && BigInteger.Abs(off) * 2 <= scale && text.StartsWith('-') == ticks < 0;
    });

    [Fact]
    public void Event_InAMessage_HasAReadableTime() => Assert.Equal(
        "Impulse of body 0.0.3 at 0.01s by 1.2", ExternalEvent.Impulse(SimTime.FromSeconds(0.01), 1, 2, BodyId.OfScene(3), Vector3D.Up).ToString());

    [Theory]
    [MemberData(nameof(SimDurationTests.NotATime), MemberType = typeof(SimDurationTests))]
    [MemberData(nameof(SimDurationTests.NotRepresentable), MemberType = typeof(SimDurationTests))]
    public void Parse_AnythingElse_IsRefused(string text)
    {
        Assert.Throws<FormatException>(() => SimTime.Parse(text));
    }

    [Fact]
    public void Parse_MillionCharactersOrNull_IsRefused()
    {
        Assert.Throws<FormatException>(() => SimTime.Parse(new string('9', 1_000_000) + "s"));
        Assert.Throws<ArgumentNullException>(() => SimTime.Parse(null!));
    }

    [Theory]
    [InlineData(double.NaN)]
    [InlineData(double.PositiveInfinity)]
    [InlineData(double.NegativeInfinity)]
    [InlineData(8388608.0)]
    [InlineData(-8388609.0)]
    public void FromSeconds_NotFiniteOrOutOfRange_IsRefusedWithTheValue(double seconds)
    {
        Assert.Equal(seconds, Assert.Throws<ArgumentOutOfRangeException>(() => SimTime.FromSeconds(seconds)).ActualValue);
    }

    [Fact]
    public void FromSeconds_AnyTimeInRange_IsThatOfTheDuration()
    {
        ForAny(bits =>
        {
            double seconds = bits / 1.2e12; // every magnitude up to 2^63 / 1.2e12, a little less than the range
            return SimTime.FromSeconds(seconds).Ticks == SimDuration.FromSeconds(seconds).Ticks;
        });
    }

    [Fact]
    public void Default_Always_IsTheOriginBetweenLeastAndMost()
    {
        Assert.Equal(default, SimTime.Zero);
        Assert.Equal(0, SimTime.Zero.Ticks);
        Assert.True(SimTime.MinValue < SimTime.Zero && SimTime.Zero < SimTime.MaxValue);
    }

    [Fact]
    public void Arithmetic_AnyOperands_IsExactOrOverflows()
    {
        ForAny((a, b) =>
        {
            SimTime time = SimTime.FromTicks(a), other = SimTime.FromTicks(b);
            SimDuration span = SimDuration.FromTicks(b);
            return IsExactOrOverflows((BigInteger)a + b, () => (time + span).Ticks)
                && IsExactOrOverflows((BigInteger)a - b, () => (time - span).Ticks)
                && IsExactOrOverflows((BigInteger)a - b, () => (time - other).Ticks);
        });
    }

    [Fact]
    public void Translation_AnyTwoTimesByAnySpan_KeepsOrderAndDistance()
    {
        // What makes a scene that starts at another instant give the same bits. Shifted by two, nothing here overflows.
        ForAny((a, b, shift) =>
        {
            SimTime x = SimTime.FromTicks(a >> 2), y = SimTime.FromTicks(b >> 2);
            SimDuration by = SimDuration.FromTicks(shift >> 2);
            return (x + by) - (y + by) == x - y
                && (x + by).CompareTo(y + by) == x.CompareTo(y)
                && (x + by) - by == x
                && (x + by) - x == by
                && y + (x - y) == x;
        });
    }

    [Fact]
    public void MinAndMax_AnyTwo_AreTheEarlierAndTheLater()
    {
        ForAny((a, b) =>
            SimTime.Min(SimTime.FromTicks(a), SimTime.FromTicks(b)).Ticks == Math.Min(a, b)
            && SimTime.Max(SimTime.FromTicks(a), SimTime.FromTicks(b)).Ticks == Math.Max(a, b));
    }

    [Fact]
    public void Comparison_AnyTwo_IsThatOfTheirTicks()
    {
        ForAny((a, b) =>
        {
            SimTime x = SimTime.FromTicks(a), y = SimTime.FromTicks(b);
            return Math.Sign(x.CompareTo(y)) == a.CompareTo(b)
                && x < y == a < b && x > y == a > b && x <= y == a <= b && x >= y == a >= b && x == y == (a == b) && x != y == (a != b)
                && x.Equals(y) == (a == b) && x.Equals((object)y) == (a == b) && (a != b || x.GetHashCode() == y.GetHashCode());
        });
    }
}
