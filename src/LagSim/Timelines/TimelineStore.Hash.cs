using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;

namespace LagSim.Timelines;

/// <content>The hash of all events: what each segment adds to it.</content>
internal sealed partial class TimelineStore
{
    /// <summary>The sum of the hashes of all segments ever opened and not cut off again, dropped ones included.</summary>
    internal ulong EventHash => hashes.Value;

    /// <summary>The hash from which this store goes on, which has what its segments would add in it already.</summary>
    internal void ContinueFrom(ulong eventHash) => hashes.Value = eventHash;

    internal ulong HashOf(int segment, BodyId body)
    {
        ref readonly EventKey key = ref pieces[segment].Key;
        if (key.Kind == EventKind.None)
        {
            return 0; // a body not yet there: that one has heard of it is not an event
        }

        ref readonly MotionSegment motion = ref pieces[segment].Segment;
        StableHash hash = EventHashSum.Of(key, motion, body, origin);
        if (motion.Law == MotionLaw.Held)
        {
            hash.Add((ulong)holds[segment].Peer);
            hash.Add(holds[segment].Offset);
            hash.Add(holds[segment].Knot - origin);
            hash.Add(motion.Acceleration);
            hash.Add(dense[segment].Cubic);
        }

        Spin spin = SpinOf(segment);
        if (!spin.IsNone)
        {
            hash.Add(spin.AtEpoch);
            hash.Add(spin.Rate);
        }

        if (motion.IsOfIsland)
        {
            AddMember(ref hash, segment);
        }

        return hash.Value;
    }

    /// <summary>Whether nothing counts in the segment's hash but what is known of every segment.</summary>
    private bool IsPlain(int segment) => spins.Length == 0 && pieces[segment].Segment.Law != MotionLaw.Held && pieces[segment].Key.Kind != EventKind.None;
}
