using System;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>How many events a joiner may have judged: so many a second, and after a pause as many at once.</summary>
/// <remarks>What is over it is not refused but left for later: the joiner sends it again, as it does with anything that is not acknowledged.</remarks>
internal sealed class EventBudget
{
    private readonly int most;
    private double left;
    private SimTime counted;

    internal EventBudget(int perSecond, SimTime now)
    {
        most = perSecond;
        left = perSecond;
        counted = now;
    }

    internal bool TrySpend(SimTime now)
    {
        left = Math.Min(most, left + ((now - counted).ToSeconds() * most));
        counted = now;
        if (left < 1)
        {
            return false;
        }

        left--;
        return true;
    }
}
