using LagSim.Contacts;
using LagSim.Events;
using LagSim.Rollback;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Islands;

/// <summary>Wakes the bodies that sleep on a body to which something is about to happen.</summary>
internal class SleepWaker(
    BodyTable bodies, TimelineStore timelines, SegmentLookup view, ContactGraph graph, RewindRequests rewinds, MemberFactory members)
{
    private readonly Paths paths = new(timelines);

    /// <summary>
    /// Has the graph hold those that sleep in contact with a body to which something is about to happen; false if one of them is ahead and
    /// has to be rewound first.
    /// </summary>
    internal bool TryFind(int slot, in EventKey key)
    {
        graph.Clear();
        int last = timelines.Last(slot);
        if (last != TimelineStore.None && timelines.Segment(last).Loss != LossReason.None)
        {
            last = timelines.Previous(last); // what slept on it did so while it could be followed
        }

        if (last == TimelineStore.None || !paths.IsMember(last))
        {
            return true;
        }

        for (int at = timelines.Carried.First(last); at != TimelineStore.None; at = timelines.Carried.Next(at))
        {
            ref readonly PersistentContact contact = ref timelines.Carried.At(at);
            int partner = contact.Surface == PersistentContact.NoSurface ? bodies.SlotOf(contact.Partner) : -1;
            int piece = partner < 0 ? TimelineStore.None : view.SegmentBefore(partner, key);
            if (piece != TimelineStore.None && paths.IsMember(piece) && timelines.Segment(piece).Law == MotionLaw.Resting)
            {
                if (piece != timelines.Last(partner))
                {
                    rewinds.Add(partner, key);
                }

                graph.AddBody(partner);
            }
        }

        if (!rewinds.AreNone)
        {
            return false;
        }

        graph.Sort();
        return true;
    }

    /// <summary>The bodies of the graph wake: what they lay on has been touched, and is added last.</summary>
    internal virtual void Wake(int slot, in EventKey key)
    {
        int sleepers = graph.BodyCount;
        for (int i = 0; i < sleepers; i++)
        {
            int before = timelines.Last(graph.Slots[i]);
            if (members.TryGoOn(graph.Slots[i], key, timelines.Segment(before).Position, Vector3D.Zero, timelines.SpinOf(before).AtEpoch, hasChanged: true))
            {
                timelines.EndMember(timelines.Last(graph.Slots[i]), bodies.Id(graph.Slots[i]));
            }
        }

        graph.AddBody(slot);
        if (sleepers > 0)
        {
            timelines.Join(graph.Slots);
        }
    }
}
