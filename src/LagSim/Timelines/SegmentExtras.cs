using System;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Timelines;

/// <summary>
/// What only some segments have: an integrated path, a hold, a spin, a filter, contacts that persist. Each is an array by segment, made once a
/// segment needs it.
/// </summary>
/// <remarks>Apart from the segments, so that a world without them pays nothing. Not thread-safe.</remarks>
internal sealed class SegmentExtras
{
    private DenseOutput[] dense = Array.Empty<DenseOutput>();
    private Hold[] holds = Array.Empty<Hold>();
    private Spin[] spins = Array.Empty<Spin>();
    private CollisionFilter[] filters = Array.Empty<CollisionFilter>();
    private CollisionFilter? opening; // the filter of the segment that is opened next, if not that of the one before it

    /// <summary>What members' segments carry besides their paths.</summary>
    internal CarriedContacts Carried { get; } = new();

    internal DenseOutput Dense(int segment) => segment < dense.Length ? dense[segment] : default;

    /// <summary>The hold of a segment that is held.</summary>
    internal ref readonly Hold Hold(int segment) => ref holds[segment];

    /// <summary>How the body turns on the segment.</summary>
    internal Spin Spin(int segment) => segment < spins.Length ? spins[segment] : default;

    /// <summary>Whether any segment has had another filter than the default.</summary>
    internal bool HaveFilters => filters.Length > 0;

    /// <summary>What the body collides with on the segment.</summary>
    internal CollisionFilter Filter(int segment) => segment < filters.Length ? filters[segment] : default;

    /// <summary>The segment that is opened next has this filter; any other has that of the segment before it.</summary>
    internal void OpenWith(CollisionFilter filter) => opening = filter;

    /// <summary>Whether <see cref="AddTo"/> may add anything: it does so for none of the segments of a plain flight.</summary>
    internal bool MayAddToHash(in MotionSegment motion) => spins.Length > 0 || filters.Length > 0 || motion.Law == MotionLaw.Held || motion.IsOfIsland;

    /// <summary>Notes what a segment that is opened has.</summary>
    /// <param name="segment">The segment.</param>
    /// <param name="before">The body's segment before it, or <see cref="TimelineStore.None"/>.</param>
    /// <param name="motion">Its motion, whose law says what it has.</param>
    /// <param name="output">Its integrated path.</param>
    /// <param name="hold">Its hold.</param>
    /// <param name="spin">Its spin.</param>
    /// <param name="room">For how many segments there is room.</param>
    internal void Set(int segment, int before, in MotionSegment motion, in DenseOutput output, in Hold hold, in Spin spin, int room)
    {
        if (motion.IsDense)
        {
            Put(ref dense, segment, output, room);
        }

        if (motion.Law == MotionLaw.Held)
        {
            Put(ref holds, segment, hold, room);
        }

        if (spins.Length > 0 || !spin.IsNone)
        {
            Put(ref spins, segment, spin, room);
        }

        if (filters.Length > 0 || opening is not null)
        {
            SetFilter(segment, before, motion, room);
        }
    }

    /// <summary>Makes room for as many segments as the store has, where any has something.</summary>
    internal void Grow(int room)
    {
        Grow(ref dense, room);
        Grow(ref holds, room);
        Grow(ref spins, room);
        Grow(ref filters, room);
        Carried.Grow(room);
    }

    /// <summary>Adds to a hash what a segment has.</summary>
    internal void AddTo(ref StableHash hash, int segment, in MotionSegment motion, SimTime origin)
    {
        if (motion.Law == MotionLaw.Held)
        {
            hash.Add((ulong)holds[segment].Peer);
            hash.Add(holds[segment].Offset);
            hash.Add(holds[segment].KeyframeTime - origin);
            hash.Add(motion.Acceleration);
            hash.Add(dense[segment].Cubic);
            AddStrengthTo(ref hash, holds[segment], origin);
        }

        Spin spin = Spin(segment);
        if (!spin.IsNone)
        {
            hash.Add(spin.AtEpoch);
            hash.Add(spin.Rate);
        }

        CollisionFilter filter = Filter(segment);
        if (!filter.IsDefault)
        {
            hash.Add(0xF117E4UL);
            hash.Add(filter.Packed);
        }

        if (motion.IsOfIsland)
        {
            Carried.AddTo(ref hash, segment, origin);
        }
    }

    /// <summary>Adds what a hand says of its strength, and what it has given of it: nothing for one that has struck nothing and says nothing.</summary>
    private static void AddStrengthTo(ref StableHash hash, in Hold hold, SimTime origin)
    {
        if (hold.MaxForce != 0 || hold.MaxPower != 0)
        {
            hash.Add(0xF02CEUL);
            hash.Add(hold.MaxForce);
            hash.Add(hold.MaxPower);
        }

        if (hold.BusyUntil != default)
        {
            hash.Add(0xB054UL);
            hash.Add(hold.BusyUntil - origin);
        }
    }

    private void SetFilter(int segment, int before, in MotionSegment motion, int room)
    {
        CollisionFilter filter = !motion.IsPresent ? default : opening ?? (before == TimelineStore.None ? default : Filter(before));
        opening = null;
        if (filters.Length > 0 || !filter.IsDefault)
        {
            Put(ref filters, segment, filter, room);
        }
    }

    private static void Put<T>(ref T[] values, int segment, in T value, int room)
    {
        if (segment >= values.Length)
        {
            Array.Resize(ref values, room);
        }

        values[segment] = value;
    }

    private static void Grow<T>(ref T[] values, int room)
    {
        if (values.Length > 0)
        {
            Array.Resize(ref values, room);
        }
    }
}
