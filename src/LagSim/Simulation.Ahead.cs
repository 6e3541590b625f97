using System;
using System.Threading;
using LagSim.Contacts;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <content>The next steps of islands, taken by other threads before they are due, where there are several islands.</content>
public sealed partial class Simulation
{
    /// <summary>An island of fewer contacts takes its step in less time than another thread takes to begin.</summary>
    private const int LeastContactsAhead = 8;

    private readonly int threads;
    private readonly Action<WaitCallback, object>? otherThread;
    private StepsAhead? stepsAhead; // made when there are two islands
    private int[] opened = Array.Empty<int>(); // a slot of each island that the event at hand has opened
    private int openedCount;
    private int lastOpened = -1; // and of one that an event before has

    /// <summary>How many threads at most may be at work for it.</summary>
    internal int Threads => threads;

    /// <summary>How many steps of islands another thread has taken in time: it depends on the machine, and nothing on it.</summary>
    internal long StepsUsedAhead => stepsAhead?.Used ?? 0;

    /// <summary>Uses steps taken ahead though their islands have been touched since: a negative control, which only a test sets.</summary>
    internal bool UsesStepsOfTouched { get; set; }

    private void NoteOpened(int slot)
    {
        if (openedCount == opened.Length)
        {
            Array.Resize(ref opened, Math.Max(4, openedCount * 2));
        }

        opened[openedCount++] = slot;
    }

    /// <summary>
    /// After an event: has the next steps of the islands that it opened taken, by their paths as they are now, if this thread has others to be busy with.
    /// </summary>
    private void TakeStepsAhead()
    {
        int count = openedCount;
        openedCount = 0;
        if (threads > 1 && (count > 1 || IsOtherMoving(opened[0])))
        {
            stepsAhead ??= new StepsAhead(threads - 1, () => new IslandStep(Scene, forces) { MayBeDeep = MayBeDeep }, otherThread) { TakesAnyState = UsesStepsOfTouched };
            for (int i = 0; i < count; i++)
            {
                TakeStepAhead(opened[i]);
            }
        }

        lastOpened = opened[count - 1];
    }

    /// <summary>Whether the island that was opened before this one is another, and moves.</summary>
    private bool IsOtherMoving(int slot)
    {
        if (lastOpened < 0 || lastOpened == slot)
        {
            return false;
        }

        int piece = timelines.Last(lastOpened);
        return piece != TimelineStore.None && timelines.Segment(piece).Law == MotionLaw.Constrained
            && timelines.Key(piece) != timelines.Key(timelines.Last(slot));
    }

    private void TakeStepAhead(int slot)
    {
        ref readonly MotionSegment path = ref timelines.Segment(timelines.Last(slot));
        if (path.Law != MotionLaw.Constrained)
        {
            return;
        }

        SimTime due = path.End;
        FindMates(slot, withSelf: true);
        EvaluateParties(due, 0);
        GrowGroups();
        FindTouching(0);
        GroupAllThatTouches();
        for (int least = 0; least < partyCount; least++)
        {
            if (group[least] == least && needsSteps[least] && stepsAhead!.TryRent(clock.Time, out StepsAhead.Job job))
            {
                FillStep(job.Step, least, 0);
                if (job.Step.ContactCount >= LeastContactsAhead && !IsOwnForceAmong(least))
                {
                    stepsAhead.Begin(job, due, LastingSpeed);
                }
            }
        }
    }

    /// <summary>Whether a program's own force, which may not be asked on another thread, acts on any of a group.</summary>
    private bool IsOwnForceAmong(int least)
    {
        bool acts = false;
        for (int i = 0; i < partyCount && !acts; i++)
        {
            acts = group[i] == least && forces.HasSupplied(bodies[parties[i]].Spec);
        }

        return acts;
    }
}
