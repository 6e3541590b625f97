using System;
using System.Collections.Generic;
using LagSim.Collisions;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Rollback;

/// <summary>The bodies that a cut has still to reach, each with the key from which on it is cut.</summary>
internal sealed class PendingCuts(BodyTable bodies, TimelineStore timelines)
{
    private readonly Stack<(int Slot, EventKey Key)> pending = new();
    private Struck[] struck = Array.Empty<Struck>(); // by slot
    private long number; // of the cut

    /// <summary>A cut begins with a body.</summary>
    internal void Begin(int slot, in EventKey from)
    {
        number++;
        Push(slot, from);
    }

    internal void Push(int slot, in EventKey from) => pending.Push((slot, from));

    internal bool TryPop(out int slot, out EventKey from)
    {
        bool any = pending.Count > 0;
        (slot, from) = any ? pending.Pop() : default;
        return any;
    }

    /// <summary>
    /// Those that a body was struck with earlier in the instant of a key, and that were struck again in it after the key, in a round in
    /// which it may have been a collapse.
    /// </summary>
    /// <remarks>Each body is asked once, and again only from an earlier key on: an instant may have very many rounds.</remarks>
    internal void PushStruckWith(int body, in EventKey from)
    {
        int at = timelines.Last(body);
        if (at == TimelineStore.None || timelines.Key(at).Time != from.Time || !Of(body).IsAskedFirst(number, from))
        {
            return;
        }

        for (; at != TimelineStore.None && timelines.Key(at).Time == from.Time; at = timelines.Previous(at))
        {
            for (int other = timelines.Together(at); other != at; other = timelines.Together(other))
            {
                int partner = timelines.Owner(other);
                if (Of(partner).IsFoundFirst(number, from) && IsStruckAgain(partner, from))
                {
                    Push(partner, from);
                }
            }
        }
    }

    /// <summary>
    /// Where a cut leaves a body asleep: those that it lies on, from what is done to them next. It finds the body asleep now, and wakes it.
    /// </summary>
    internal void PushWhatWakes(int body, in EventKey from)
    {
        int asleep = timelines.Last(body);
        if (asleep == TimelineStore.None || timelines.Segment(asleep).Law != MotionLaw.Resting || !timelines.Segment(asleep).IsOfIsland)
        {
            return;
        }

        for (int contact = timelines.Carried.First(asleep); contact != TimelineStore.None; contact = timelines.Carried.Next(contact))
        {
            ref readonly PersistentContact with = ref timelines.Carried.At(contact);
            int partner = with.Surface == PersistentContact.NoSurface ? bodies.SlotOf(with.Partner) : -1;
            int act = partner < 0 ? TimelineStore.None : FirstActOn(partner, from);
            if (act != TimelineStore.None)
            {
                Push(partner, timelines.Key(act));
            }
        }
    }

    /// <summary>The first segment of a body after a key that was opened by what was done to it: by all but impacts and steps.</summary>
    private int FirstActOn(int body, in EventKey after)
    {
        BodyId id = bodies.Id(body);
        int first = TimelineStore.None;
        for (int at = timelines.Last(body); at != TimelineStore.None && EventKey.Compare(timelines.Key(at), after) > 0; at = timelines.Previous(at))
        {
            ref readonly EventKey key = ref timelines.Key(at);
            first = key.Body == id && key.Kind is not (EventKind.Impact or EventKind.StepEnd) ? at : first;
        }

        return first;
    }

    private bool IsStruckAgain(int body, in EventKey after)
    {
        int last = timelines.At(body, after.Time);
        return last != TimelineStore.None && EventKey.Compare(timelines.Key(last), after) > 0
            && timelines.Key(last).Round >= CollisionPredictor.CollapseRound;
    }

    private ref Struck Of(int slot)
    {
        if (slot >= struck.Length)
        {
            Array.Resize(ref struck, Math.Max(slot + 1, 2 * struck.Length));
        }

        return ref struck[slot];
    }

    /// <summary>From which key on a body was asked, and found, in a cut.</summary>
    private struct Struck
    {
        private long askedIn;
        private long foundIn;
        private EventKey askedFrom;
        private EventKey foundFrom;

        internal bool IsAskedFirst(long cut, in EventKey from) => IsFirst(ref askedIn, ref askedFrom, cut, from);

        internal bool IsFoundFirst(long cut, in EventKey from) => IsFirst(ref foundIn, ref foundFrom, cut, from);

        private static bool IsFirst(ref long lastIn, ref EventKey last, long cut, in EventKey from)
        {
            if (lastIn == cut && EventKey.Compare(last, from) <= 0)
            {
                return false;
            }

            (lastIn, last) = (cut, from);
            return true;
        }
    }
}
