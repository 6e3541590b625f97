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
        if (!IsEvent(segment))
        {
            return 0;
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

    /// <summary>
    /// Whether a segment is one that an event opened. That a body is heard of before it is there is no event, and neither is that somebody was looked at who is gone:
    /// who joins later knows nothing of either.
    /// </summary>
    internal bool IsEvent(int segment)
    {
        EventKind kind = pieces[segment].Key.Kind;
        return kind != EventKind.None && (pieces[segment].Segment.IsPresent || kind is not (EventKind.Impact or EventKind.StepEnd));
    }

    /// <summary>Whether nothing counts in the segment's hash but what is known of every segment.</summary>
    private bool IsPlain(int segment) => spins.Length == 0 && pieces[segment].Segment.Law != MotionLaw.Held && IsEvent(segment);
}
