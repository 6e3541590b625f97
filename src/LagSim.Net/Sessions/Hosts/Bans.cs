using System.Collections.Generic;
using LagSim.Net.Carriers;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Who of a kind is out, until when, and who was: players, or machines.</summary>
/// <remarks>
/// <para>Memory is bounded. What is for good was said by the game or its operator, and stays: it is as much as they say. All else is forgotten
/// an hour after it is over, and a warning after its time. Of these no more are kept than the limit; beyond it the one is forgotten that has
/// been over for longest, and where all still go on, the one that ends first.</para>
/// <para>To end one ban early takes as many others as the limit says, each sent away from a machine of its own or with a token of its own.
/// Whoever has that many can come back with one of them.</para>
/// <para>Cost: a look at all that is kept for each that is added, which is once for a player that is sent away. For one thread.</para>
/// </remarks>
/// <typeparam name="T">What they are known by.</typeparam>
/// <param name="most">How many that are not for good are kept.</param>
internal sealed class Bans<T>(int most)
    where T : notnull
{
    /// <summary>The first duration; it doubles each further time, up to <see cref="Longest"/>.</summary>
    private static readonly SimDuration First = SimDuration.FromSeconds(60);

    /// <summary>The longest, and how long a ban is remembered after it is over.</summary>
    private static readonly SimDuration Longest = SimDuration.FromSeconds(3600);

    private readonly Dictionary<T, Ban> all = new();
    private readonly List<T> over = new();

    /// <summary>How many are remembered.</summary>
    internal int Count => all.Count;

    internal bool IsOut(T who, SimTime now) => all.TryGetValue(who, out Ban ban) && now < ban.Until;

    internal bool IsOutForGood(T who) => all.TryGetValue(who, out Ban ban) && ban.IsForGood;

    internal void AddForGood(T who, PeerAddress machine) => all[who] = new Ban(SimTime.MaxValue, Longest, machine, SimTime.MaxValue);

    /// <summary>Shuts it out: twice as long as the last time, if that is not forgotten.</summary>
    internal void Add(T who, PeerAddress machine, SimTime now)
    {
        Forget(now);
        bool isKnown = all.TryGetValue(who, out Ban last);
        if (last.IsForGood)
        {
            return;
        }

        SimDuration span = !isKnown || last.For == SimDuration.Zero ? First : last.For > Longest / 2 ? Longest : last.For * 2;
        Set(who, new Ban(now + span, span, machine, now + span + Longest));
    }

    /// <summary>Remembers for a time that somebody was sent away, without shutting it out; false if it is remembered for that or more already.</summary>
    internal bool TryWarn(T who, PeerAddress machine, SimTime now, SimDuration time)
    {
        Forget(now);
        if (all.ContainsKey(who))
        {
            return false;
        }

        Set(who, new Ban(now, SimDuration.Zero, machine, now + time));
        return true;
    }

    /// <summary>Forgets all that came about at a machine; false if nobody of them was out.</summary>
    internal bool RemoveOf(PeerAddress machine, SimTime now)
    {
        bool wasOut = false;
        over.Clear();
        foreach (KeyValuePair<T, Ban> one in all)
        {
            if (one.Value.Machine == machine)
            {
                wasOut |= now < one.Value.Until;
                over.Add(one.Key);
            }
        }

        RemoveOver();
        return wasOut;
    }

    private void Set(T who, in Ban ban)
    {
        all[who] = ban;
        T first = who;
        int passing = 0;
        foreach (KeyValuePair<T, Ban> one in all)
        {
            passing += one.Value.IsForGood ? 0 : 1;
            first = one.Value.Until < all[first].Until ? one.Key : first;
        }

        if (passing > most)
        {
            all.Remove(first);
        }
    }

    private void Forget(SimTime now)
    {
        over.Clear();
        foreach (KeyValuePair<T, Ban> one in all)
        {
            if (now > one.Value.RememberedTo)
            {
                over.Add(one.Key);
            }
        }

        RemoveOver();
    }

    private void RemoveOver() => over.ForEach(one => all.Remove(one));

    private readonly record struct Ban(SimTime Until, SimDuration For, PeerAddress Machine, SimTime RememberedTo)
    {
        internal bool IsForGood => Until == SimTime.MaxValue;
    }
}
