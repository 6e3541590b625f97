using System;
using System.Linq;
using FsCheck;
using FsCheck.Fluent;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Determinism;

/// <summary>The one order that every peer must agree on, put to the test mostly where almost everything ties.</summary>
public sealed class EventOrderTests
{
    private static readonly long[] Ticks = [long.MinValue, -1, 0, 1, long.MaxValue];
    private static readonly uint[] Numbers = [0, 1, 2, 0x60000000, 0x80000000, 0xC0000000, uint.MaxValue];
    private static readonly byte[] Peers = [0, 1, 127, 128, 255];

    private static readonly EventKind[] Kinds =
        [EventKind.None, EventKind.Spawn, EventKind.Teleport, EventKind.Remove, EventKind.Impact, EventKind.StepEnd, (EventKind)255];

    private static readonly BodyId[] Bodies =
    [
        default, BodyId.OfScene(1), BodyId.OfScene(BodyId.MaxIndex), new(0, 1, 0), new(1, 0, 0), new(1, 1, 0), new(128, 0, 1),
        new(255, uint.MaxValue, BodyId.MaxIndex),
    ];

    /// <summary>Three keys: one, and two that each differ from it in about one part of five. So all three often tie in most parts or in all.</summary>
    private static readonly Arbitrary<(EventKey A, EventKey B, EventKey C)> Keys =
        (from a in Key() from b in Near(a) from c in Near(a) select (a, b, c)).ToArbitrary();

    /// <summary>Comparers that are wrong in ways that happen. Each is seen to fail the check that the right one passes.</summary>
    public static TheoryData<string> WrongComparers =>
        ["swaps operands", "ignores rounds", "ignores peers", "kind before round", "swaps bodies on a tie", "subtracts rounds", "never says equal", "signed bodies"];

    [Fact]
    public void Compare_AnyThreeKeys_IsATotalOrderAndTheCanonicalOne()
    {
        Check((a, b) => EventKey.Compare(a, b));
    }

    [Fact]
    public void CompareTo_AnyThreeKeys_IsATotalOrderAndTheCanonicalOne()
    {
        Check((a, b) => a.CompareTo(b));
    }

    [Theory]
    [MemberData(nameof(WrongComparers))]
    public void Check_WrongComparer_IsSeenToFail(string name)
    {
        Exception error = Assert.ThrowsAny<Exception>(() => Check(Wrong(name)));
        Assert.Contains("of failing propert", error.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Operators_AnyTwoKeys_AgreeWithCompare()
    {
        Prop.ForAll(Keys, keys =>
        {
            (EventKey a, EventKey b, _) = keys;
            int order = Canonical(a, b);
            return a < b == order < 0 && a > b == order > 0 && a <= b == order <= 0 && a >= b == order >= 0 && a == b == (order == 0)
                && a != b == (order != 0) && a.Equals(b) == (order == 0) && a.Equals((object)b) == (order == 0)
                && (order != 0 || a.GetHashCode() == b.GetHashCode());
        }).Check(Many);
    }

    [Fact]
    public void Keys_AsGenerated_TieOftenAndInEveryNumberOfParts()
    {
        // The check is worth what its keys are: without ties it would pass comparers that get ties wrong.
        EventKey[] pairs = Gen.Sample(Keys.Generator, 2000, 50).SelectMany(keys => new[] { keys.A, keys.B }).ToArray();
        int[] tied = new int[8];
        for (int i = 0; i < pairs.Length; i += 2)
        {
            tied[PartsInCommon(pairs[i], pairs[i + 1])]++;
        }

        Assert.All(tied[5..], count => Assert.True(count > 100, string.Join(' ', tied)));
        Assert.True(pairs.Chunk(2).Count(pair => pair[0].Time == pair[1].Time) > 1000);
    }

    [Fact]
    public void Compare_AllKeysShiftedByOneSpan_IsUnchanged()
    {
        Prop.ForAll(Keys, keys =>
        {
            // Inwards by half, so that no pool's edge overflows.
            EventKey a = At(keys.A, keys.A.Time.Ticks / 2), b = At(keys.B, keys.B.Time.Ticks / 2);
            return new[] { -(1L << 61), -1, 1, 1L << 61 }.All(by =>
                EventKey.Compare(At(a, a.Time.Ticks + by), At(b, b.Time.Ticks + by)) == EventKey.Compare(a, b));
        }).Check(Many);
    }

    [Fact]
    public void Before_AnyEventAtThatTimeOrLater_SortsFirst()
    {
        Prop.ForAll(Keys, keys =>
            EventKey.Before(keys.A.Time) <= keys.A
            && (keys.A.Time == SimTime.MinValue || EventKey.Before(keys.A.Time) > At(keys.A, keys.A.Time.Ticks - 1))).Check(Many);
    }

    [Fact]
    public void Round_EffectAtTheTickOfItsCause_SortsAfterItWhateverElse()
    {
        Prop.ForAll(Keys, keys =>
        {
            (EventKey cause, EventKey other, _) = keys;
            uint round = Math.Min(cause.Round, uint.MaxValue - 1);
            EventKey first = new(cause.Time, round, cause.Kind, cause.Body, cause.Other, cause.Peer, cause.Sequence);
            EventKey effect = new(cause.Time, round + 1, other.Kind, other.Body, other.Other, other.Peer, other.Sequence);
            return first < effect;
        }).Check(Many);
    }

    private static Config Many => Config.QuickThrowOnFailure.WithMaxTest(5000);

    /// <summary>Fails unless the comparer is a total order that is consistent with equality, and the canonical one.</summary>
    private static void Check(Comparison<EventKey> compare)
    {
        Prop.ForAll(Keys, keys =>
        {
            (EventKey a, EventKey b, EventKey c) = keys;
            return (compare(a, a) == 0).Label("reflexive")
                .And((Math.Sign(compare(a, b)) == -Math.Sign(compare(b, a))).Label("antisymmetric"))
                .And((compare(a, b) > 0 || compare(b, c) > 0 || compare(a, c) <= 0).Label("transitive"))
                .And((compare(a, b) != 0 || Math.Sign(compare(a, c)) == Math.Sign(compare(b, c))).Label("equals sort alike"))
                .And((compare(a, b) == 0 == (PartsInCommon(a, b) == 7)).Label("consistent with equality"))
                .And((Math.Sign(compare(a, b)) == Math.Sign(Canonical(a, b))).Label("canonical"));
        }).Check(Many);
    }

    /// <summary>The order as the design says it, part by part, written so that it shares nothing with the engine's.</summary>
    private static int Canonical(in EventKey a, in EventKey b) => Parts(a).CompareTo(Parts(b));

    private static (long, uint, byte, (byte, uint, int), (byte, uint, int), byte, uint) Parts(in EventKey key) =>
        (key.Time.Ticks, key.Round, (byte)key.Kind, Parts(key.Body), Parts(key.Other), key.Peer, key.Sequence);

    private static (byte, uint, int) Parts(BodyId id) => (id.Peer, id.Sequence, id.Index);

    private static int PartsInCommon(in EventKey a, in EventKey b) =>
        (a.Time == b.Time ? 1 : 0) + (a.Round == b.Round ? 1 : 0) + (a.Kind == b.Kind ? 1 : 0) + (a.Body == b.Body ? 1 : 0)
        + (a.Other == b.Other ? 1 : 0) + (a.Peer == b.Peer ? 1 : 0) + (a.Sequence == b.Sequence ? 1 : 0);

    private static Gen<EventKey> Key() =>
        from ticks in Gen.Elements(Ticks)
        from round in Gen.Elements(Numbers)
        from kind in Gen.Elements(Kinds)
        from body in Gen.Elements(Bodies)
        from other in Gen.Elements(Bodies)
        from peer in Gen.Elements(Peers)
        from sequence in Gen.Elements(Numbers)
        select new EventKey(SimTime.FromTicks(ticks), round, kind, body, other, peer, sequence);

    private static Gen<EventKey> Near(EventKey key) =>
        from changes in Gen.Choose(0, 4).ArrayOf(7)
        from drawn in Key()
        select new EventKey(
            changes[0] == 0 ? drawn.Time : key.Time,
            changes[1] == 0 ? drawn.Round : key.Round,
            changes[2] == 0 ? drawn.Kind : key.Kind,
            changes[3] == 0 ? drawn.Body : key.Body,
            changes[4] == 0 ? drawn.Other : key.Other,
            changes[5] == 0 ? drawn.Peer : key.Peer,
            changes[6] == 0 ? drawn.Sequence : key.Sequence);

    private static EventKey At(in EventKey key, long ticks) =>
        new(SimTime.FromTicks(ticks), key.Round, key.Kind, key.Body, key.Other, key.Peer, key.Sequence);

    private static EventKey With(in EventKey key, uint round, byte peer) =>
        new(key.Time, round, key.Kind, key.Body, key.Other, peer, key.Sequence);

    private static Comparison<EventKey> Wrong(string name) => name switch
    {
        "swaps operands" => (a, b) => EventKey.Compare(b, a),
        "ignores rounds" => (a, b) => EventKey.Compare(With(a, 0, a.Peer), With(b, 0, b.Peer)),
        "ignores peers" => (a, b) => EventKey.Compare(With(a, a.Round, 0), With(b, b.Round, 0)),
        "kind before round" => (a, b) => a.Time == b.Time && a.Kind != b.Kind ? a.Kind.CompareTo(b.Kind) : EventKey.Compare(a, b),
        "swaps bodies on a tie" => (a, b) =>
            a.Time == b.Time && a.Round == b.Round && a.Kind == b.Kind && a.Body != b.Body ? b.Body.CompareTo(a.Body) : EventKey.Compare(a, b),
        "subtracts rounds" => (a, b) =>
            a.Time == b.Time && a.Round != b.Round ? unchecked((int)(a.Round - b.Round)) : EventKey.Compare(a, b),
        "never says equal" => (a, b) => EventKey.Compare(a, b) is int order && order != 0 ? order : -1,
        "signed bodies" => (a, b) =>
            a.Time == b.Time && a.Round == b.Round && a.Kind == b.Kind && a.Body != b.Body
                ? ((long)a.Body.Packed).CompareTo((long)b.Body.Packed)
                : EventKey.Compare(a, b),
        _ => throw new ArgumentOutOfRangeException(nameof(name), name, null),
    };
}
