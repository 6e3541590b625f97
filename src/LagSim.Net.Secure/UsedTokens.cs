using System.Collections.Generic;

namespace LagSim.Net.Protection;

/// <summary>
/// The tokens with which players came in, until a day after they expire: a join that began before that is over long before.
/// </summary>
/// <remarks>Safe on any thread: a host's sessions share it.</remarks>
internal sealed class UsedTokens
{
    private const long SecondsKept = 86_400;

    private readonly Dictionary<(ulong, ulong), long> untils = new();
    private readonly List<(ulong, ulong)> expired = new();

    internal bool Contains((ulong, ulong) id)
    {
        lock (untils)
        {
            return untils.ContainsKey(id);
        }
    }

    /// <summary>Adds a token; false if it was there.</summary>
    /// <param name="id">What identifies it.</param>
    /// <param name="until">When it expires, in seconds since 1970.</param>
    /// <param name="now">The time, likewise.</param>
    internal bool Add((ulong, ulong) id, long until, long now)
    {
        lock (untils)
        {
            expired.Clear();
            foreach (KeyValuePair<(ulong, ulong), long> one in untils)
            {
                if (one.Value + SecondsKept <= now)
                {
                    expired.Add(one.Key);
                }
            }

            expired.ForEach(one => untils.Remove(one));
            return untils.TryAdd(id, until);
        }
    }
}
