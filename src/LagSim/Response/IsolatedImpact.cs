using System;
using LagSim.Collisions;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Response;

/// <summary>
/// The impact of two bodies in free flight with no other body near, or of one with a surface: nearly all impacts of a gas, and of a
/// bouncing ball, are of this kind. No contact graph has to be searched for it.
/// </summary>
internal class IsolatedImpact(
    Scene scene, BodyTable bodies, TimelineStore timelines, EventScheduler scheduler, RollbackState rollback, FreeFlights flights,
    ContactGraph graph, FreeImpactResponse resolver, ImpactNotifier notifier, ImpactSegments segments)
{
    private readonly StaticSurfaces surfaces = scene.Surfaces;

    /// <summary>How many impacts were of two alone, or of one and a surface alone.</summary>
    internal long Count { get; private set; }

    /// <summary>How many impacts were of two alone.</summary>
    internal long PairCount { get; private set; }

    /// <summary>
    /// Solves such an impact by the same rules as the general way, with the same bits. False, and nothing is done, if others take part too,
    /// or if the two part so slowly that persistent contact may follow: then other bodies in touch count.
    /// </summary>
    internal virtual bool TryHandle(int slot, in EventKey key)
    {
        if (!IsIsolated(slot, key))
        {
            return false;
        }

        double residual = scheduler.Contact(slot).Residual;
        Fill(slot, key.Time, residual);
        resolver.SetTargets(collapses: false, key);
        if (graph.Contacts[0].Lasts)
        {
            return false;
        }

        notifier.Tell(key);
        resolver.ResolveAlone();
        for (int i = 0; i < graph.BodyCount; i++)
        {
            segments.OpenIsolated(i, key, residual);
        }

        timelines.Join(graph.Slots);
        Count++;
        PairCount += graph.BodyCount - 1;
        return true;
    }

    /// <summary>
    /// Whether the impact is surely of two bodies, or of one and a surface, and nothing else. Another body that is struck at that tick has
    /// an event pending then, because no pending event is later than its body's next contact. Or that body, or another surface, was seen
    /// when one of the two was predicted, which then is tied. So if there is no such event and neither is tied, nothing else is struck,
    /// with one exception: of two bodies the one that did not find the other, and so has no event pending, may strike a surface.
    /// </summary>
    private bool IsIsolated(int slot, in EventKey key)
    {
        bool isPlain = !rollback.IsActive && !CollapseRule.MayBeStruckAgain(key)
            && !scheduler.Contact(slot).IsTied && flights.IsFree(slot);
        int other = scheduler.Contact(slot).Partner;
        return isPlain && (other == PendingContact.NoPartner
            ? scheduler.AreTheOnlyLeast(slot, key)
            : scheduler.Contact(other).Partner == slot && !scheduler.Contact(other).IsTied && flights.IsFree(other)
                && scheduler.AreTheOnlyLeast(other, key) && TouchesNoSurface(slot, key.Time) && TouchesNoSurface(other, key.Time));
    }

    private bool TouchesNoSurface(int slot, SimTime time)
    {
        bool misses = scene.SphereArray.Length == 0;
        for (int plane = 0; plane < scene.PlaneArray.Length && misses; plane++)
        {
            misses = flights.Misses(slot, surfaces.Plane(plane), time, time);
        }

        return misses;
    }

    private void Fill(int slot, SimTime time, double residual)
    {
        int other = scheduler.Contact(slot).Partner;
        graph.Clear();
        if (other == PendingContact.NoPartner)
        {
            graph.AddBody(slot);
            graph.AddContact(new ContactPoint(0, ContactPoint.Static, scheduler.Contact(slot).Surface, default));
        }
        else
        {
            bool ordered = bodies.Id(slot) < bodies.Id(other);
            graph.AddBody(ordered ? slot : other);
            graph.AddBody(ordered ? other : slot);
            graph.AddContact(new ContactPoint(0, 1, -1, default));
        }

        Span<int> slots = graph.Slots;
        for (int i = 0; i < slots.Length; i++)
        {
            ref readonly BodySpec spec = ref bodies.Spec(slots[i]);
            graph.Masses[i] = spec.Mass;
            graph.Radii[i] = spec.Radius;
            graph.Accelerations[i] = scene.Gravity;
            graph.Spins[i] = timelines.SpinOf(timelines.Last(slots[i])).AtEpoch; // in flight it stays
            flights.StateAt(slots[i], time, residual, out graph.Positions[i], out graph.Velocities[i]);
        }
    }
}
