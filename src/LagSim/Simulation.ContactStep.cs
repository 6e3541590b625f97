using LagSim.Contacts;
using LagSim.Events;
using LagSim.Islands;
using LagSim.Timelines;

namespace LagSim;

/// <content>Contact steps as events: what a step opens is cut together, and predicted.</content>
public sealed partial class Simulation
{
    private readonly ContactStep step;
    private readonly Partners partners;
    private readonly MemberFactory members;
    private readonly IslandStepper stepper;
    private readonly Sleepers sleepers;
    private readonly SolverWork work = new();

    /// <summary>How many contact steps were taken.</summary>
    internal long StepsTaken => stepper.StepsTaken;

    /// <summary>Takes no contact for one that lasts: only a test's negative control sets it.</summary>
    internal bool IgnoresIslands
    {
        get => faults.IgnoresIslands;
        set => faults.IgnoresIslands = value;
    }

    /// <summary>A tick of an island has come; false if somebody who takes part was ahead of it and has been taken back.</summary>
    private bool TryHandleContactStep(int slot, in EventKey key)
    {
        if (!stepper.TryStep(slot, key, out EventKey canonical))
        {
            TakeBackAhead(key);
            return false;
        }

        JoinNearMisses(canonical);
        stepMarks.Clear();
        return true;
    }

    /// <summary>
    /// The parties, and those that the event at hand has looked at and that are no part of it, are opened by one event, and predicted again: who is cut later cuts
    /// whoever looked at it. What is looked at goes on as it did.
    /// </summary>
    private void JoinNearMisses(in EventKey key)
    {
        foreach (int slot in partners.NearMisses)
        {
            if (graph.IndexOf(slot) >= 0 || faults.Has(HealingFault.ForgetsWhoWasLookedAt))
            {
                continue;
            }

            int last = timelines.Last(slot);
            if (paths.IsMember(last))
            {
                members.GoOn(slot, key, paths.PositionAt(last, key.Time), timelines.Segment(last).Velocity, timelines.SpinOf(last).AtEpoch, hasChanged: false);
                timelines.EndMember(timelines.Last(slot), bodies.Id(slot));
            }
            else
            {
                timelines.Append(slot, bodies.Id(slot), key, timelines.Segment(last), timelines.Dense(last), timelines.HoldOf(last), timelines.SpinOf(last));
            }

            graph.AddBody(slot);
        }

        if (!faults.Has(HealingFault.CutsMembersAlone))
        {
            timelines.Join(graph.Slots);
        }

        for (int i = 0; i < graph.BodyCount; i++)
        {
            Predict(graph.Slots[i]);
        }
    }

    private void TakeBackAhead(in EventKey key)
    {
        while (partners.Ahead.Count > 0)
        {
            int slot = partners.Ahead[partners.Ahead.Count - 1];
            partners.Ahead.RemoveAt(partners.Ahead.Count - 1);
            TakeBack(slot, key);
        }
    }
}
