using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Wire;
using LagSim.Timelines;
using Xunit;

namespace LagSim.Tests.Wire;

/// <summary>Snapshots compared to the last bit, and what decoding them must give.</summary>
internal static class SnapshotBits
{
    internal static WorldSnapshot Decoded(ReadOnlySpan<byte> bytes)
    {
        Assert.True(SnapshotFormat.TryDecode(bytes, out WorldSnapshot? snapshot, out WireRefusal refusal), $"{refusal}");
        Assert.Equal(WireRefusal.None, refusal);
        return snapshot;
    }

    internal static void Refused(WireRefusal expected, ReadOnlySpan<byte> bytes)
    {
        Assert.False(SnapshotFormat.TryDecode(bytes, out WorldSnapshot? snapshot, out WireRefusal refusal));
        Assert.Null(snapshot);
        Assert.Equal(expected, refusal);
    }

    /// <summary>How many bytes a decoding takes on the heap, once everything it calls is compiled.</summary>
    internal static long Allocated(byte[] bytes)
    {
        SnapshotFormat.TryDecode(bytes, out _, out _);
        long before = GC.GetAllocatedBytesForCurrentThread();
        SnapshotFormat.TryDecode(bytes, out _, out _);
        return GC.GetAllocatedBytesForCurrentThread() - before;
    }

    /// <summary>Every field of both, and of numbers every bit.</summary>
    internal static bool Same(WorldSnapshot a, WorldSnapshot b) =>
        a.Start == b.Start && a.Time == b.Time && a.EventHash == b.EventHash && a.Bodies.Count == b.Bodies.Count
        && a.Bodies.Zip(b.Bodies).All(pair => Same(pair.First, pair.Second));

    internal static IEnumerable<double> Numbers(BodySnapshot b) =>
        new[] { b.Position, b.Velocity, b.Acceleration, b.Cubic, b.Quartic, b.Quintic, b.Hold.Offset, b.Spin, b.SpinRate }
            .Concat(b.Contacts.ToArray().SelectMany(c => new[] { c.Push, c.Turn })).SelectMany(v => new[] { v.X, v.Y, v.Z });

    private static bool Same(BodySnapshot a, BodySnapshot b) =>
        a.Id == b.Id && a.Spec.Equals(b.Spec) && a.Filter == b.Filter && a.Players == b.Players && a.Opened.Equals(b.Opened) && a.Law == b.Law && a.Epoch == b.Epoch && a.End == b.End
        && a.NextStep == b.NextStep && a.Hold == b.Hold && a.SupportCount == b.SupportCount
        && Enumerable.Range(0, a.SupportCount).All(n => a.Support(n) == b.Support(n))
        && a.Centre == b.Centre && a.StillSince == b.StillSince && a.Contacts.Length == b.Contacts.Length
        && a.Inside.SequenceEqual(b.Inside) && a.Crossings.SequenceEqual(b.Crossings)
        && a.Contacts.ToArray().Zip(b.Contacts.ToArray()).All(pair => Same(pair.First, pair.Second))
        && Numbers(a).Select(BitConverter.DoubleToInt64Bits).SequenceEqual(Numbers(b).Select(BitConverter.DoubleToInt64Bits));

    private static bool Same(PersistentContact a, PersistentContact b) => (a.Partner, a.Surface, a.Holds, a.Solved) == (b.Partner, b.Surface, b.Holds, b.Solved);
}
