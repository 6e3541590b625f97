using System;
using System.Collections.Generic;
using System.Diagnostics;

namespace LagSim.Net.Protection;

/// <summary>
/// The tokens with which players came in, for twice as long as one can be valid: by the time that has passed on this machine, whatever the
/// date says meanwhile.
/// </summary>
/// <remarks>
/// A clock that is moved ahead and back makes nothing forgotten. What is forgotten after its time cannot come again either, should the clock
/// be moved back then: no token is taken that ends before one that was forgotten. Safe on any thread: a host's sessions share it.
/// </remarks>
internal sealed class UsedTokens
{
    private static readonly TimeSpan Kept = 2 * TokenIssuer.MaxValidity;

    private readonly Dictionary<(ulong, ulong), (TimeSpan Used, long Until)> ids = new();
    private readonly List<(ulong, ulong)> old = new();
    private readonly Func<TimeSpan> elapsed;
    private long forgotten = long.MinValue; // when the last of the forgotten ones expires

    /// <param name="elapsed">The time since some instant, which nobody can set. Null for this machine's.</param>
    internal UsedTokens(Func<TimeSpan>? elapsed = null) =>
        this.elapsed = elapsed ?? (static () => TimeSpan.FromSeconds(Stopwatch.GetTimestamp() / (double)Stopwatch.Frequency));

    internal bool Contains((ulong, ulong) id)
    {
        lock (ids)
        {
            return ids.ContainsKey(id);
        }
    }

    /// <summary>
    /// How many seconds before the last of the forgotten tokens this one expires, so that it may be one of them; null for none.
    /// </summary>
    /// <param name="until">When it expires, in seconds since 1970.</param>
    internal long? SecondsForgotten(long until)
    {
        lock (ids)
        {
            return until <= forgotten ? forgotten - until : null;
        }
    }

    /// <summary>Adds a token; false if it was there, or may have been.</summary>
    /// <param name="id">What identifies it.</param>
    /// <param name="until">When it expires, in seconds since 1970.</param>
    internal bool Add((ulong, ulong) id, long until)
    {
        lock (ids)
        {
            TimeSpan now = elapsed();
            old.Clear();
            foreach (KeyValuePair<(ulong, ulong), (TimeSpan Used, long Until)> one in ids)
            {
                if (now - one.Value.Used >= Kept)
                {
                    old.Add(one.Key);
                    forgotten = Math.Max(forgotten, one.Value.Until);
                }
            }

            old.ForEach(one => ids.Remove(one));
            return until > forgotten && ids.TryAdd(id, (now, until));
        }
    }
}
