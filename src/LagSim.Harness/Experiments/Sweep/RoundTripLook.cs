using System;
using System.Collections.Generic;

namespace LagSim.Harness.Experiments.Sweep;

/// <summary>One look at a client's round trip while a cell of the sweep is played.</summary>
/// <param name="AtSeconds">When, by true time.</param>
/// <param name="Milliseconds">Its newest round trip; 0 where it has none, being on its way in again.</param>
/// <param name="IsInDip">Whether its link carried less just then.</param>
internal readonly record struct RoundTripLook(double AtSeconds, double Milliseconds, bool IsInDip)
{
    /// <summary>So long a round trip has to stay below the bound.</summary>
    private const double StaysForSeconds = 1;

    /// <summary>
    /// The longest from the end of a dip until the round trip is below a bound and stays there for a second; 0 if there was no dip.
    /// </summary>
    /// <param name="course">All looks, in order.</param>
    /// <param name="belowMs">The bound.</param>
    internal static double Recovery(IReadOnlyList<RoundTripLook> course, double belowMs)
    {
        double longest = 0;
        double? ended = null, since = null; // the end of the last dip that is not made good for, and since when all is well
        bool wasInDip = false;
        foreach (RoundTripLook look in course)
        {
            if (look.IsInDip != wasInDip)
            {
                // One that begins before its forerunner was made good for goes on with that one's time.
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
