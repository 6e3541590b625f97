using System;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim;

/// <content>
/// The impact of two bodies in free flight with nobody near, or of one with a surface: what nearly all impacts of a gas are, and of a ball that bounces;
/// nothing has to be gathered for it.
/// </content>
public sealed partial class Simulation
{
    /// <summary>Takes bodies that meet three at a time for two: only a test's negative control sets it.</summary>
    internal bool IgnoresTies
    {
        get => faults.IgnoresTies;
        set => faults.IgnoresTies = value;
    }

    /// <summary>Gathers every impact, however plain, and looks at every pair: only a test sets it, to compare.</summary>
    internal bool TakesNoShortcut
    {
        get => faults.TakesNoShortcut;
        set => faults.TakesNoShortcut = value;
    }

    /// <summary>How many impacts were of two alone, or of one and a surface alone.</summary>
    internal long AloneProcessed { get; private set; }

    /// <summary>How many impacts were of two alone.</summary>
    internal long PairsProcessed { get; private set; }

    /// <summary>
    /// Whether the impact is surely of two bodies, or of one and a surface, and nothing else. Whoever else is struck at that tick has an event pending then,
    /// for nobody's pending event is later than his next contact; or he, or another surface, was seen when one of the two was predicted, which then is tied.
    /// So if there is none and neither is tied, nobody is, but by a surface the one of two that did not find the other, which has none pending.
    /// </summary>
    private bool IsAlone(int slot, in EventKey key)
    {
        bool isPlain = !rollback.IsActive && !CollapseRule.MayBeStruckAgain(key)
            && (!scheduler.Contact(slot).IsTied || IgnoresTies) && flights.IsFree(slot) && !TakesNoShortcut && !SwapsOperands;
        int other = scheduler.Contact(slot).Partner;
        return isPlain && (other == NoPartner
            ? scheduler.IsLeastAloneWith(slot, key)
            : scheduler.Contact(other).Partner == slot && (!scheduler.Contact(other).IsTied || IgnoresTies) && flights.IsFree(other) && scheduler.IsLeastAloneWith(other, key)
                && TouchesNoSurface(slot, key.Time) && TouchesNoSurface(other, key.Time));
    }

    private bool TouchesNoSurface(int slot, SimTime time)
    {
        bool misses = Scene.SphereArray.Length == 0;
        for (int plane = 0; plane < Scene.PlaneArray.Length && misses; plane++)
        {
            misses = flights.Misses(slot, surfaces.Plane(plane), time, time);
        }

        return misses;
    }

    /// <summary>
    /// What the general way makes of such an impact, to the bit, by the same rules. False, and nothing is done, if the two part so slowly that lasting contact
    /// may come of it: then who else is in touch counts.
    /// </summary>
    private bool TryHandleAlone(int slot, in EventKey key)
    {
        int other = scheduler.Contact(slot).Partner;
        double residual = scheduler.Contact(slot).Residual;
        graph.Clear();
        if (other == NoPartner)
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
        Span<Vector3D> positions = graph.Positions;
        Span<Vector3D> velocities = graph.Velocities;
        Span<Vector3D> spins = graph.Spins;
        for (int i = 0; i < slots.Length; i++)
        {
            ref readonly BodySpec spec = ref bodies.Spec(slots[i]);
            graph.Masses[i] = spec.Mass;
            graph.Radii[i] = spec.Radius;
            graph.Accelerations[i] = Scene.Gravity;
            spins[i] = timelines.SpinOf(timelines.Last(slots[i])).AtEpoch; // in flight it stays
            flights.StateAt(slots[i], key.Time, residual, out positions[i], out velocities[i]);
        }

        resolver.SetTargets(collapses: false, key.Time);
        if (graph.Contacts[0].Lasts)
        {
            return false;
        }

        TellContacts(key);
        resolver.ResolveAlone();
        touched.Clear();
        if (graph.IsSupportable(graph.Contacts[0]))
        {
            touched.Add(graph.Contacts[0].Surface);
        }

        for (int i = 0; i < slots.Length; i++)
        {
            trajectories.Open(slots[i], key, positions[i], velocities[i], -residual, touched.Planes, spins[i]);
        }

        timelines.Join(slots);
        for (int i = 0; i < slots.Length; i++)
        {
            Predict(slots[i]);
        }

        AloneProcessed++;
        PairsProcessed += slots.Length - 1;
        return true;
    }
}
