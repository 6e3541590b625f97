using System.Collections.Generic;
using LagSim.Events;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Rollback;

/// <summary>
/// Holds back the changes of impacts, and of crossings, by a heal while some of them may still be undone, and reports them afterwards.
/// </summary>
internal sealed class HeldBackImpacts : IImpactObserver, ICrossingObserver
{
    private readonly List<(EventKey Impact, bool IsCut, ImpactContact Contact)> waiting = new();
    private readonly List<(Crossing Crossing, bool IsCut)> waitingCrossings = new();
    private bool holds;

    /// <summary>The observer that is notified; null for none.</summary>
    internal IImpactObserver? Listener { get; set; }

    /// <summary>The observer of crossings that is notified; null for none.</summary>
    internal ICrossingObserver? CrossingListener { get; set; }

    public void OnContact(in EventKey impact, in ImpactContact contact)
    {
        if (holds)
        {
            waiting.Add((impact, false, contact));
        }
        else
        {
            Listener?.OnContact(impact, contact);
        }
    }

    public void OnCut(in EventKey impact)
    {
        if (holds)
        {
            waiting.Add((impact, true, default));
        }
        else
        {
            Listener?.OnCut(impact);
        }
    }

    public void OnCrossing(in Crossing crossing)
    {
        if (holds)
        {
            waitingCrossings.Add((crossing, false));
        }
        else
        {
            CrossingListener?.OnCrossing(crossing);
        }
    }

    public void OnCut(in Crossing crossing)
    {
        if (holds)
        {
            waitingCrossings.Add((crossing, true));
        }
        else
        {
            CrossingListener?.OnCut(crossing);
        }
    }

    /// <summary>From now on nothing is reported.</summary>
    internal void Hold() => holds = true;

    /// <summary>
    /// Reports the held-back changes up to and including <paramref name="last"/>, in the order in which they came; the rest is
    /// dropped.
    /// </summary>
    internal void Release(SimTime last)
    {
        holds = false;
        foreach ((EventKey impact, bool isCut, ImpactContact contact) in waiting)
        {
            if (impact.Time > last)
            {
                continue;
            }

            if (isCut)
            {
                OnCut(impact);
            }
            else
            {
                OnContact(impact, contact);
            }
        }

        waiting.Clear();
        foreach ((Crossing crossing, bool isCut) in waitingCrossings)
        {
            if (crossing.Time <= last && isCut)
            {
                OnCut(crossing);
            }
            else if (crossing.Time <= last)
            {
                OnCrossing(crossing);
            }
        }

        waitingCrossings.Clear();
    }
}
