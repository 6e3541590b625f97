using System;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.Api.TickGenerators;

namespace LagSim.Tests.Api;

public sealed class BodyIdTests
{
    [Fact]
    public void FromPacked_AnyNumber_HasThePartsThatMakeItAgain()
    {
        ForAny(bits =>
        {
            BodyId id = BodyId.FromPacked((ulong)bits);
            return id.Packed == (ulong)bits && new BodyId(id.Peer, id.Sequence, id.Index) == id && id.Index is >= 0 and <= BodyId.MaxIndex;
        });
    }

    [Theory]
    [InlineData(0, 0u, 0)]
    [InlineData(0, 0u, BodyId.MaxIndex)]
    [InlineData(255, uint.MaxValue, BodyId.MaxIndex)]
    [InlineData(1, 2u, 3)]
    public void Constructor_AnyParts_KeepsThem(byte peer, uint sequence, int index)
    {
        BodyId id = new(peer, sequence, index);
        Assert.Equal((peer, sequence, index), (id.Peer, id.Sequence, id.Index));
        Assert.Equal($"{peer}.{sequence}.{index}", id.ToString());
    }

    [Theory]
    [InlineData(-1)]
    [InlineData(BodyId.MaxIndex + 1)]
    [InlineData(int.MinValue)]
    [InlineData(int.MaxValue)]
    public void Constructor_IndexOutOfRange_IsRefused(int index)
    {
        Assert.Throws<ArgumentOutOfRangeException>(() => new BodyId(1, 1, index));
        Assert.Throws<ArgumentOutOfRangeException>(() => BodyId.OfScene(index));
    }

    [Fact]
    public void Order_AnyTwo_IsByPeerThenSequenceThenIndex()
    {
        // The second differs from the first in some parts only, or ties would be too rare to tell.
        ForAny((first, second, keep) =>
        {
            BodyId a = BodyId.FromPacked((ulong)first);
            BodyId s = BodyId.FromPacked((ulong)second);
            BodyId b = new((keep & 1) == 0 ? a.Peer : s.Peer, (keep & 2) == 0 ? a.Sequence : s.Sequence, (keep & 4) == 0 ? a.Index : s.Index);
            int expected = (a.Peer, a.Sequence, a.Index).CompareTo((b.Peer, b.Sequence, b.Index));
            return Math.Sign(a.CompareTo(b)) == Math.Sign(expected)
                && a < b == expected < 0 && a > b == expected > 0 && a <= b == expected <= 0 && a >= b == expected >= 0
                && a == b == (expected == 0) && a != b == (expected != 0) && a.Equals(b) == (expected == 0)
                && a.Equals((object)b) == (expected == 0) && (expected != 0 || a.GetHashCode() == b.GetHashCode());
        });
    }

    [Fact]
    public void Default_Always_IsTheScenesFirstBody()
    {
        Assert.Equal(default, BodyId.OfScene(0));
        Assert.True(BodyId.OfScene(BodyId.MaxIndex) < new BodyId(0, 1, 0));
    }
}
