using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;

namespace LagSim.Timelines;

/// <content>The hash of all events: what each segment adds to it.</content>
internal partial class TimelineStore
{
    /// <summary>The sum of the hashes of all segments ever opened and not cut off again, dropped ones included.</summary>
    internal ulong EventHash => hashes.Value;

    /// <summary>The hash that this store continues from, which already contains what its segments would add.</summary>
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
            hash.Add(holds[segment].Keyframe - origin);
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
            Carried.AddTo(ref hash, segment, origin);
        }

        return hash.Value;
    }

    /// <summary>
    /// Whether a segment only notes that an event tested a body that is gone: heals need it, since they cut the event with it. A peer that
    /// joined later has no such body, so the segment is in no hash and in no list of events.
    /// </summary>
    internal bool IsNote(int segment) =>
        !pieces[segment].Segment.IsPresent && pieces[segment].Key.Kind is (EventKind.Impact or EventKind.StepEnd);

    /// <summary>Whether an event opened a segment: none did for a body that is known by name but not there yet.</summary>
    private bool IsEvent(int segment) => pieces[segment].Key.Kind != EventKind.None && !IsNote(segment);

    /// <summary>Whether nothing counts in the segment's hash but what is known of every segment.</summary>
    private bool IsPlain(int segment) => spins.Length == 0 && pieces[segment].Segment.Law != MotionLaw.Held && IsEvent(segment);
}
