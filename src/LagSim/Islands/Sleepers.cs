using LagSim.Contacts;
using LagSim.Events;
using LagSim.Rollback;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Islands;

/// <summary>Who sleeps on a body to which something is about to happen, and wakes.</summary>
internal sealed class Sleepers(
    BodyTable bodies, TimelineStore timelines, PathView view, ContactGraph graph, Partners partners, MemberFactory members)
{
    private readonly Paths paths = new(timelines);

    /// <summary>
    /// The parties: those that sleep in contact with a body to which something is about to happen; false if one was ahead of it and has
    /// been taken back.
    /// </summary>
    internal bool TryFind(int slot, in EventKey key)
    {
        graph.Clear();
        int last = timelines.Last(slot);
        if (last == TimelineStore.None || !paths.IsMember(last))
        {
            return true;
        }

        partners.Ahead.Clear();
        for (int at = timelines.FirstContact(last); at != TimelineStore.None; at = timelines.NextContact(at))
        {
            ref readonly LastingContact contact = ref timelines.Contact(at);
            int partner = contact.Surface == LastingContact.NoSurface ? bodies.SlotOf(contact.Partner) : -1;
            int piece = partner < 0 ? TimelineStore.None : view.PieceBefore(partner, key);
            if (piece != TimelineStore.None && paths.IsMember(piece) && timelines.Segment(piece).Law == MotionLaw.Resting)
            {
                if (piece != timelines.Last(partner))
                {
                    partners.Ahead.Add(partner);
                }

                graph.AddBody(partner);
            }
        }

        if (partners.Ahead.Count > 0)
        {
            return false;
        }

        graph.Sort();
        return true;
    }

    /// <summary>The parties wake: what they lay on has been touched.</summary>
    internal void Wake(int slot, in EventKey key)
    {
        for (int i = 0; i < graph.BodyCount; i++)
        {
            int before = timelines.Last(graph.Slots[i]);
            members.GoOn(graph.Slots[i], key, timelines.Segment(before).Position, Vector3D.Zero, timelines.SpinOf(before).AtEpoch, hasChanged: true);
            timelines.EndMember(timelines.Last(graph.Slots[i]), bodies.Id(graph.Slots[i]));
        }

        graph.AddBody(slot);
        timelines.Join(graph.Slots);
        graph.KeepBodies(graph.BodyCount - 1);
    }
}
