using System.Collections.Generic;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Timelines;
using LagSim.Trajectories;

namespace LagSim;

/// <summary>Reads which bodies have left the world by themselves, as far as that is kept.</summary>
internal sealed class LossReader(BodyTable bodies, TimelineStore timelines, ForceFailures texts)
{
    /// <summary>Those that are lost now, in canonical order of bodies.</summary>
    internal IReadOnlyList<LostBody> Read()
    {
        List<LostBody> lost = new();
        foreach (int slot in bodies)
        {
            int last = timelines.Last(slot);
            while (last != TimelineStore.None && timelines.IsNote(last))
            {
                last = timelines.Previous(last); // others have looked for it since
            }

            if (last != TimelineStore.None && timelines.Key(last).Kind == EventKind.Lost && timelines.Key(last).Body == bodies.Id(slot))
            {
                lost.Add(Of(slot, last));
            }
        }

        return lost;
    }

    /// <summary>The loss of a body whose last segment tells of it. The segment before has the state, if it is still kept.</summary>
    private LostBody Of(int slot, int last)
    {
        EventKey key = timelines.Key(last);
        LossReason reason = (LossReason)key.Sequence;
        int before = timelines.Previous(last);
        Vector3D position = before == TimelineStore.None ? Vector3D.Zero : timelines.Segment(before).Position;
        Vector3D velocity = before == TimelineStore.None ? Vector3D.Zero : timelines.Segment(before).Velocity;
        Vector3D spin = before == TimelineStore.None ? Vector3D.Zero : timelines.SpinOf(before).AtEpoch;
        return new LostBody(bodies.Id(slot), key.Time, reason, position, velocity, texts.OfLoss(slot, key.Time, reason, position, velocity, spin));
    }
}
