using System.Collections.Generic;
using LagSim.Net.Carriers;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>The machines from which a host lets no client in, for the whole session or for a while.</summary>
internal sealed class BanList
{
    /// <summary>The first duration; it doubles each further time, up to <see cref="Longest"/>.</summary>
    private static readonly SimDuration First = SimDuration.FromSeconds(60);

    private static readonly SimDuration Longest = SimDuration.FromSeconds(3600);

    private readonly HashSet<PeerAddress> banned = new();
    private readonly Dictionary<PeerAddress, (SimTime Until, SimDuration For)> forAWhile = new();

    /// <summary>Shuts a machine out for good.</summary>
    internal void Ban(PeerAddress machine) => banned.Add(machine);

    /// <summary>Shuts a machine out for a while.</summary>
    internal void ShutOutForAWhile(PeerAddress machine, SimTime now)
    {
        SimDuration span = forAWhile.TryGetValue(machine, out (SimTime Until, SimDuration For) last) ? Twice(last.For) : First;
        forAWhile[machine] = (now + span, span);
    }

    internal bool IsShutOut(PeerAddress machine, SimTime now) => banned.Contains(machine) || IsOutForAWhile(machine, now);

    /// <summary>Lets a machine in again; false if it was not shut out.</summary>
    internal bool LetInAgain(PeerAddress machine, SimTime now)
    {
        bool wasOut = IsShutOut(machine, now);
        banned.Remove(machine);
        forAWhile.Remove(machine);
        return wasOut;
    }

    private static SimDuration Twice(SimDuration span) => span > Longest / 2 ? Longest : span * 2;

    private bool IsOutForAWhile(PeerAddress machine, SimTime now) =>
        forAWhile.TryGetValue(machine, out (SimTime Until, SimDuration For) until) && now < until.Until;
}
