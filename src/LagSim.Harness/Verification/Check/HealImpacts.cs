using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Timelines;

namespace LagSim.Harness.Verification.Check;

/// <summary>
/// Counts the heals of one world, and those that changed an impact: that of the impacts up to where the world had got before the late event
/// came cut one off for good, or put one in that was not there. Which impact it is its key tells, that is time to a tick, round and bodies;
/// one that happens again at the same key is the same one, whatever came of it.
/// </summary>
/// <remarks>
/// Exact, and as cheap as what a heal rewrites: nothing is looked at twice. What the world does ahead of any heal is not kept.
/// </remarks>
internal sealed class HealImpacts : IImpactObserver
{
    private readonly Simulation simulation;
    private readonly Dictionary<EventKey, (bool Was, bool Is)> touched = [];
    private long rollbacks; // of the simulation, when the last heal had ended

    /// <param name="simulation">The world.</param>
    /// <param name="isOfThePast">Whether what the heal at hand began with lies before the shared time, asked when it has ended.</param>
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

    /// <summary>How many heals there were that rewrote the past.</summary>
    internal long Heals { get; private set; }

    /// <summary>How many of them cut an impact off or put one in.</summary>
    internal long Changed { get; private set; }

    /// <summary>How many events they ran again.</summary>
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
            return; // nothing is being healed
        }

        touched[impact] = touched.TryGetValue(impact, out (bool Was, bool Is) known) ? (known.Was, isThere) : (!isThere, isThere);
    }
}
