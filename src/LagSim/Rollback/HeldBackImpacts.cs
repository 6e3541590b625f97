using System.Collections.Generic;
using LagSim.Events;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Rollback;

/// <summary>Holds back the changes of impacts by a heal while some of them may still be undone, and reports them afterwards.</summary>
internal sealed class HeldBackImpacts : IImpactObserver
{
    private readonly List<(EventKey Impact, bool IsCut, ImpactContact Contact)> waiting = new();
    private bool holds;

    /// <summary>The observer that is notified; null for none.</summary>
    internal IImpactObserver? Listener { get; set; }

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

    /// <summary>From now on nothing is reported.</summary>
    internal void Hold() => holds = true;

    /// <summary>
    /// Reports the held-back changes of impacts up to and including <paramref name="last"/>, in the order in which they came; the rest is
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
    }
}
