using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <content>Members of islands between two ticks: what they look for no impacts with, how one goes on after something has happened to it, who wakes.</content>
public sealed partial class Simulation
{
    /// <summary>Opens the next piece of a member from a state: a chord to the end of the step under way, or of one that begins if it slept.</summary>
    private void GoOnAsMember(int slot, in EventKey key, in Vector3D position, in Vector3D velocity, in Vector3D spin, bool hasChanged)
    {
        int before = timelines.Last(slot);
        MotionSegment path = timelines.Segment(before);
        bool slept = path.Law == MotionLaw.Resting;
        SimTime centre = slept ? key.Time : timelines.CentreOf(before);
        SimTime still = slept || hasChanged ? key.Time : timelines.StillSince(before);
        if (slept && !hasChanged)
        {
            centre = timelines.CentreOf(before);
            still = timelines.StillSince(before);
            timelines.Append(slot, bodies.Id(slot), key, MotionSegment.AtRest(key.Time, path.Position), default, spin: timelines.SpinOf(before));
        }
        else
        {
            OpenChord(slot, key, slept ? NextTick(slot, key.Time, StepWanted(slot, position, velocity, spin)) : path.End, position, velocity, spin);
        }

        int piece = timelines.Last(slot);
        timelines.BeginMember(piece, centre, still);
        for (int at = timelines.FirstContact(before); at != TimelineStore.None; at = timelines.NextContact(at))
        {
            LastingContact contact = timelines.Contact(at);
            timelines.AddContact(piece, contact);
        }
    }

    /// <summary>When the first step of a body begins that becomes a member: at this instant if it is a tick, but for one that a step has let go at it.</summary>
    private SimTime NextTick(int slot, SimTime time, double wanted)
    {
        ref readonly EventKey opened = ref timelines.Key(timelines.Last(slot));
        bool hadIt = opened.Kind == EventKind.StepEnd && opened.Time == time;
        return step.Scale.TickFrom(hadIt ? time + SimDuration.OneTick : time, wanted);
    }

    /// <summary>The parties: those that sleep in contact with a body to which something is about to happen; false if one was ahead of it and has been taken back.</summary>
    private bool TryFindSleepers(int slot, in EventKey key)
    {
        graph.Clear();
        int last = timelines.Last(slot);
        if (last == TimelineStore.None || !paths.IsMember(last))
        {
            return true;
        }

        ahead.Clear();
        for (int at = timelines.FirstContact(last); at != TimelineStore.None; at = timelines.NextContact(at))
        {
            ref readonly LastingContact contact = ref timelines.Contact(at);
            int partner = contact.Surface == LastingContact.NoSurface ? bodies.SlotOf(contact.Partner) : NoPartner;
            int piece = partner < 0 ? TimelineStore.None : view.PieceBefore(partner, key);
            if (piece != TimelineStore.None && paths.IsMember(piece) && timelines.Segment(piece).Law == MotionLaw.Resting)
            {
                if (piece != timelines.Last(partner))
                {
                    ahead.Add(partner);
                }

                graph.AddBody(partner);
            }
        }

        if (ahead.Count > 0)
        {
            TakeBackAhead(key);
            return false;
        }

        graph.Sort();
        return true;
    }

    /// <summary>The parties wake: what they lay on has been touched.</summary>
    private void WakeParties(int slot, in EventKey key)
    {
        for (int i = 0; i < graph.BodyCount; i++)
        {
            int before = timelines.Last(graph.Slots[i]);
            GoOnAsMember(graph.Slots[i], key, timelines.Segment(before).Position, Vector3D.Zero, timelines.SpinOf(before).AtEpoch, hasChanged: true);
            timelines.EndMember(timelines.Last(graph.Slots[i]), bodies.Id(graph.Slots[i]));
        }

        graph.AddBody(slot);
        timelines.Join(graph.Slots);
        graph.KeepBodies(graph.BodyCount - 1);
        for (int i = 0; i < graph.BodyCount; i++)
        {
            Predict(graph.Slots[i]);
        }
    }
}
