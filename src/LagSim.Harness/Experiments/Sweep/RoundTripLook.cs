using System;
using System.Collections.Generic;

namespace LagSim.Harness.Experiments.Sweep;

/// <summary>One sample of a client's round trip during a cell of the sweep.</summary>
/// <param name="AtSeconds">The true time of the sample, in seconds.</param>
/// <param name="Milliseconds">The newest round trip, in milliseconds; 0 where there is none, because the client is joining again.</param>
/// <param name="IsInDip">Whether the link was in a dip.</param>
internal readonly record struct RoundTripLook(double AtSeconds, double Milliseconds, bool IsInDip)
{
    /// <summary>How long a round trip has to stay below the bound.</summary>
    private const double StaysForSeconds = 1;

    /// <summary>
    /// Returns the longest time from the end of a dip until the round trip is below a bound and stays there for a second; 0 without dips.
    /// </summary>
    /// <param name="course">All samples, in order.</param>
    /// <param name="belowMs">The bound, in milliseconds.</param>
    internal static double Recovery(IReadOnlyList<RoundTripLook> course, double belowMs)
    {
        double longest = 0;
        double? ended = null, since = null; // the end of the last dip without recovery so far, and the start of the recovery
        bool wasInDip = false;
        foreach (RoundTripLook look in course)
        {
            if (look.IsInDip != wasInDip)
            {
                // A dip that begins before recovery from the one before extends that one's time.
                ended = look.IsInDip ? ended : ended ?? look.AtSeconds;
                since = null;
                wasInDip = look.IsInDip;
            }

            if (ended is not double from || look.IsInDip)
            {
                continue;
            }

            since = look.Milliseconds > 0 && look.Milliseconds < belowMs ? since ?? look.AtSeconds : null;
            longest = Math.Max(longest, (since ?? look.AtSeconds) - from);
            ended = since is double well && look.AtSeconds - well >= StaysForSeconds ? null : ended;
        }

        return longest;
    }
}
