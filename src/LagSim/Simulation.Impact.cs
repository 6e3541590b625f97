using LagSim.Contacts;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim;

/// <content>Impacts: who takes part, and what comes of it.</content>
public sealed partial class Simulation
{
    /// <summary>
    /// So many rounds of impacts in one instant are endless: elastic ones, for all others collapse. The longest that end, 3,141,592 impacts of two balls and a wall, have a few in each.
    /// </summary>
    private const uint MostRounds = 1 << 16;

    private readonly PlaneSet touched = new();

    /// <summary>Bounces as often as it closes: only a test's negative control sets it.</summary>
    internal bool NeverCollapses
    {
        get => faults.NeverCollapses;
        set => faults.NeverCollapses = value;
    }

    /// <summary>Takes the operands of a contact the wrong way round: only a test's negative control sets it.</summary>
    internal bool SwapsOperands
    {
        get => faults.SwapsOperands;
        set => faults.SwapsOperands = value;
    }

    private bool TryHandleImpact(int slot, in EventKey key)
    {
        if (IsAlone(slot, key) && TryHandleAlone(slot, key))
        {
            return true;
        }

        if (key.Round >= MostRounds)
        {
            throw Endless(slot, key.Time);
        }

        double residual = Gather(slot, key, out bool collapses);
        if (TryTakeBack(key))
        {
            return false;
        }

        resolver.SetTargets(collapses, key.Time);
        partners.NearMisses.Clear();
        bool givesWay = true;
        if (graph.HasHand() && !TrySpread(key, residual, presses: true, out givesWay))
        {
            return false;
        }

        if (!givesWay)
        {
            return true;
        }

        if (ReachesIsland())
        {
            return TrySpread(key, residual, presses: false, out _);
        }

        TellContacts(key);
        resolver.Resolve(collapses);
        EventKey canonical = CanonicalKey(key);
        for (int i = 0; i < graph.BodyCount; i++)
        {
            OpenAfterImpact(i, canonical, residual);
        }

        JoinNearMisses(canonical);
        return true;
    }

    /// <summary>Why an instant does not end.</summary>
    private EndlessInstantException Endless(int slot, SimTime time) => new(
        $"At {time.ToShortString()} the impacts of {Scene.Whose(bodies.Id(slot))} have no end: {MostRounds} in one instant. What is squeezed between others and loses no energy is struck for ever:"
        + " give it, or what squeezes it, a restitution below 1, a mass that is less unlike, or room.", time);

    /// <summary>What a collapse takes in besides has no part in its key: that would come before impacts of the round that are done already.</summary>
    private static bool IsOfThisRound(in ContactPoint c) => c.IsStruck && !c.IsFromBefore;

    /// <summary>The impact's key whichever of its contacts was popped: named by the least party that is struck and that one's least partner.</summary>
    private EventKey CanonicalKey(in EventKey popped)
    {
        int at = 0;
        while (!IsOfThisRound(graph.Contacts[at]))
        {
            at++;
        }

        int least = graph.Contacts[at].First;
        BodyId first = bodies.Id(graph.Slots[least]);
        BodyId second = first;
        for (int i = at; i < graph.ContactCount && graph.Contacts[i].First == least && second == first; i++)
        {
            second = graph.Contacts[i].Second == ContactPoint.Static || !IsOfThisRound(graph.Contacts[i]) ? first : bodies.Id(graph.Slots[graph.Contacts[i].Second]);
        }

        return new EventKey(popped.Time, popped.Round, EventKind.Impact, first, second, 0, 0);
    }

    private void OpenAfterImpact(int party, in EventKey key, double residual)
    {
        int slot = graph.Slots[party];
        if (paths.IsHeld(timelines.Last(slot)))
        {
            trajectories.Hands.GoOn(slot, key);
            return;
        }

        SupportSet supports = timelines.Segment(timelines.Last(slot)).Supports;
        touched.Clear();
        for (int i = 0; i < graph.ContactCount; i++)
        {
            ref readonly ContactPoint c = ref graph.Contacts[i];
            if (c.First == party && c.IsStruck && graph.IsSupportable(c))
            {
                touched.Add(c.Surface);
            }
        }

        for (int k = 0; k < supports.Count; k++)
        {
            touched.Add(supports[k]);
        }

        trajectories.Open(slot, key, graph.Positions[party], graph.Velocities[party], -residual, touched.Planes, graph.Spins[party]);
    }
}
