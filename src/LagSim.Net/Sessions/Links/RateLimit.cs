using System;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>A rate limit: so many per second, with a burst after a pause.</summary>
internal sealed class RateLimit
{
    private readonly double perSecond;
    private double left;
    private SimTime counted;

    internal RateLimit(double perSecond, double atOnce, SimTime now)
    {
        this.perSecond = perSecond;
        Most = atOnce;
        left = atOnce;
        counted = now;
    }

    /// <summary>The most at once.</summary>
    internal double Most { get; }

    /// <summary>Whether it is full, like a new one.</summary>
    internal bool IsWhole(SimTime now)
    {
        Count(now);
        return left >= Most;
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
        left = Math.Min(Most, left + ((now - counted).ToSeconds() * perSecond));
        counted = now;
    }
}
