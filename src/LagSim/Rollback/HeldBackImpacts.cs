using System.Collections.Generic;
using LagSim.Events;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Rollback;

/// <summary>Keeps back what a heal does to impacts while some of it may turn out not to have happened, and tells it afterwards.</summary>
internal sealed class HeldBackImpacts : IImpactObserver
{
    private readonly List<(EventKey Impact, bool IsCut, ImpactContact Contact)> waiting = new();
    private bool holds;

    /// <summary>Who is told; null for nobody.</summary>
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

    /// <summary>From now on nothing is told.</summary>
    internal void Hold() => holds = true;

    /// <summary>
    /// Tells what was kept back of impacts up to and including <paramref name="last"/>, in the order in which it came; the rest was as
    /// nothing.
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
