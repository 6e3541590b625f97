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
        bool isPlain = !rollback.IsActive && !MayBeStruckAgain(key)
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
        partyCount = 0;
        contactCount = 0;
        if (other == NoPartner)
        {
            AddParty(slot);
            AddContact(new ContactPoint(0, ContactPoint.Static, scheduler.Contact(slot).Surface, default));
        }
        else
        {
            bool ordered = bodies.Id(slot) < bodies.Id(other);
            AddParty(ordered ? slot : other);
            AddParty(ordered ? other : slot);
            AddContact(new ContactPoint(0, 1, -1, default));
        }

        for (int i = 0; i < partyCount; i++)
        {
            partyMasses[i] = bodies.Spec(parties[i]).Mass;
            partyAccelerations[i] = Scene.Gravity;
            partyRadii[i] = bodies.Spec(parties[i]).Radius;
            partySpins[i] = timelines.SpinOf(timelines.Last(parties[i])).AtEpoch; // in flight it stays
            flights.StateAt(parties[i], key.Time, residual, out partyPositions[i], out partyVelocities[i]);
        }

        SetTargets(collapses: false, key.Time);
        if (contacts[0].Lasts)
        {
            return false;
        }

        TellContacts(key);
        solver.Solve(contacts.AsSpan(0, 1), partyMasses.AsSpan(0, partyCount), partyVelocities.AsSpan(0, partyCount));
        Rub();
        LimitSpeeds();
        touched[0] = contacts[0].Surface;
        Span<int> planes = touched.AsSpan(0, IsSupportable(contacts[0]) ? 1 : 0);
        for (int i = 0; i < partyCount; i++)
        {
            trajectories.Open(parties[i], key, partyPositions[i], partyVelocities[i], -residual, planes, partySpins[i]);
        }

        timelines.Join(parties.AsSpan(0, partyCount));
        for (int i = 0; i < partyCount; i++)
        {
            Predict(parties[i]);
        }

        AloneProcessed++;
        PairsProcessed += partyCount - 1;
        return true;
    }
}
