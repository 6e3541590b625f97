using LagSim.Contacts;
using LagSim.Events;
using LagSim.Timelines;

namespace LagSim.Islands;

/// <summary>Joins the segments that one event opens, so that a rollback that cuts one of them cuts all.</summary>
internal class SegmentLinker(
    BodyTable bodies, TimelineStore timelines, ContactGraph graph, Partners partners, MemberFactory members)
{
    private readonly Paths paths = new(timelines);

    /// <summary>
    /// Joins the segments of the graph's bodies, and opens segments for the near misses. These continue as before, and belong to the graph
    /// from then on: cutting one later cuts the bodies that it was tested against.
    /// </summary>
    internal virtual void Join(in EventKey key)
    {
        AddNearMisses(key);
        timelines.Join(graph.Slots);
    }

    private protected void AddNearMisses(in EventKey key)
    {
        foreach (int slot in partners.NearMisses)
        {
            if (graph.IndexOf(slot) < 0)
            {
                GoOn(slot, key);
                graph.AddBody(slot);
            }
        }
    }

    private void GoOn(int slot, in EventKey key)
    {
        int last = timelines.Last(slot);
        if (paths.IsMember(last))
        {
            if (members.TryGoOn(slot, key, paths.PositionAt(last, key.Time), timelines.Segment(last).Velocity, timelines.SpinOf(last).AtEpoch, hasChanged: false))
            {
                timelines.EndMember(timelines.Last(slot), bodies.Id(slot));
            }
        }
        else
        {
            Hold hold = timelines.HoldOf(last);
            timelines.Append(
                slot, bodies.Id(slot), key, timelines.Segment(last), timelines.Dense(last), hold.Busy(hold.BusyAt(key.Time)), timelines.SpinOf(last));
        }
    }
}
