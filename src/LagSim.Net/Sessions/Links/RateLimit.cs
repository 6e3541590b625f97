using System;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>A rate limit: so many per second, with a burst after a pause.</summary>
internal sealed class RateLimit
{
    private readonly double perSecond;
    private readonly double most;
    private double left;
    private SimTime counted;

    internal RateLimit(double perSecond, double atOnce, SimTime now)
    {
        this.perSecond = perSecond;
        most = atOnce;
        left = atOnce;
        counted = now;
    }

    /// <summary>Whether it is full, like a new one.</summary>
    internal bool IsWhole(SimTime now)
    {
        Count(now);
        return left >= most;
    }

    /// <summary>How many are left.</summary>
    internal double Left(SimTime now)
    {
        Count(now);
        return left;
    }

    internal bool TrySpend(SimTime now)
    {
        Count(now);
        if (left < 1)
        {
            return false;
        }

        left--;
        return true;
    }

    private void Count(SimTime now)
    {
        left = Math.Min(most, left + ((now - counted).ToSeconds() * perSecond));
        counted = now;
    }
}
