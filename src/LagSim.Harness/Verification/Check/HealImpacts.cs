using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Timelines;

namespace LagSim.Harness.Verification.Check;

/// <summary>
/// Counts the heals of a world, and those that changed an impact: that removed or added one among the impacts before the world's time when
/// the late event arrived. An impact is identified by its key, which is its time to a tick, its round and its bodies. One that recurs at
/// the same key is the same, whatever its result.
/// </summary>
/// <remarks>
/// Exact, and as cheap as the heal's rewriting, since nothing is visited twice. Predictions ahead of a heal are not kept.
/// </remarks>
internal sealed class HealImpacts : IImpactObserver
{
    private readonly Simulation simulation;
    private readonly Dictionary<EventKey, (bool Was, bool Is)> touched = [];
    private long rollbacks; // of the simulation, at the end of the last heal

    /// <param name="simulation">The world.</param>
    /// <param name="isOfThePast">Whether the current heal began before the shared time. Called at the end of the heal.</param>
    internal HealImpacts(Simulation simulation, Func<HealReport, bool> isOfThePast)
    {
        this.simulation = simulation;
        rollbacks = simulation.Rollbacks;
        simulation.Engine.Reconvergence.Observer = this;
        simulation.Healed += report =>
        {
            if (isOfThePast(report))
            {
                Heals++;
                Events += report.Events;
                HasChanged(report);
            }

            touched.Clear();
            rollbacks = simulation.Rollbacks;
        };
    }

    /// <summary>The number of heals that rewrote the past.</summary>
    internal long Heals { get; private set; }

    /// <summary>The number of heals that removed or added an impact.</summary>
    internal long Changed { get; private set; }

    /// <summary>The number of events that heals re-simulated.</summary>
    internal long Events { get; private set; }

    public void OnContact(in EventKey impact, in ImpactContact contact) => Note(impact, isThere: true);

    public void OnCut(in EventKey impact) => Note(impact, isThere: false);

    private void HasChanged(in HealReport report)
    {
        foreach ((EventKey key, (bool was, bool now)) in touched)
        {
            if (was != now && key.Time <= report.To)
            {
                Changed++;
                return;
            }
        }
    }

    private void Note(in EventKey impact, bool isThere)
    {
        if (simulation.Rollbacks == rollbacks)
        {
            return; // no heal is in progress
        }

        touched[impact] = touched.TryGetValue(impact, out (bool Was, bool Is) known) ? (known.Was, isThere) : (!isThere, isThere);
    }
}
