using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Carriers;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Who is let in no more, for the whole session or for a while: players by what proves who they are, and machines.</summary>
/// <remarks>
/// An address is not a person: a household shares one, and so may a whole network. So a player whom a token or a key proves is out alone. One
/// who has no more than a pass can come again without it; that player's machine is out too once another is sent away from it.
/// </remarks>
internal sealed class BanList
{
    /// <summary>The first duration; it doubles each further time, up to <see cref="Longest"/>.</summary>
    private static readonly SimDuration First = SimDuration.FromSeconds(60);

    private static readonly SimDuration Longest = SimDuration.FromSeconds(3600);

    /// <summary>How long a machine is remembered from which somebody was sent away: an attack that comes again every few minutes ends it.</summary>
    private static readonly SimDuration Warned = SimDuration.FromSeconds(600);

    private readonly Dictionary<string, Ban> players = new();
    private readonly Dictionary<PeerAddress, Ban> machines = new();
    private readonly Dictionary<PeerAddress, SimTime> warned = new(); // when somebody there was sent away, and the machine was not

    /// <summary>Shuts a player out for good: alone if something proves who it is, otherwise with its machine.</summary>
    internal void ShutOut(PlayerNames who, PeerAddress machine)
    {
        foreach (string name in who.All)
        {
            players[name] = Ban.ForGood(machine);
        }

        if (!who.AreProven)
        {
            machines[machine] = Ban.ForGood(machine);
        }
    }

    /// <summary>
    /// Shuts a player out for a while. Its machine as well if nothing proves who it is, and somebody was sent away from there within the
    /// last ten minutes or the machine was out before.
    /// </summary>
    internal void ShutOutForAWhile(PlayerNames who, PeerAddress machine, SimTime now)
    {
        foreach (string name in who.All)
        {
            players[name] = Longer(players, name, machine, now);
        }

        if (who.AreProven)
        {
            return;
        }

        if (machines.ContainsKey(machine) || (warned.TryGetValue(machine, out SimTime last) && now - last <= Warned))
        {
            machines[machine] = Longer(machines, machine, machine, now);
        }

        warned[machine] = now;
    }

    /// <summary>Whether a player is not let in from a machine. One that is proven is not out for what others did there for a while.</summary>
    internal bool IsShutOut(PlayerNames who, PeerAddress machine, SimTime now) =>
        (IsOut(machines, machine, now) && (!who.AreProven || machines[machine].IsForGood)) || who.All.Any(name => IsOut(players, name, now));

    /// <summary>Lets a machine, and the players who were sent away from it, in again; false if none of them was shut out.</summary>
    internal bool LetInAgain(PeerAddress machine, SimTime now)
    {
        string[] from = [.. players.Where(player => player.Value.Machine == machine).Select(player => player.Key)];
        bool wasOut = IsOut(machines, machine, now) || from.Any(name => IsOut(players, name, now));
        machines.Remove(machine);
        warned.Remove(machine);
        foreach (string name in from)
        {
            players.Remove(name);
        }

        return wasOut;
    }

    private static bool IsOut<T>(Dictionary<T, Ban> bans, T who, SimTime now)
        where T : notnull => bans.TryGetValue(who, out Ban ban) && now < ban.Until;

    private static Ban Longer<T>(Dictionary<T, Ban> bans, T who, PeerAddress machine, SimTime now)
        where T : notnull
    {
        SimDuration span = !bans.TryGetValue(who, out Ban last) ? First : last.For > Longest / 2 ? Longest : last.For * 2;
        return last.IsForGood ? last : new Ban(now + span, span, machine);
    }

    private readonly record struct Ban(SimTime Until, SimDuration For, PeerAddress Machine)
    {
        internal bool IsForGood => Until == SimTime.MaxValue;

        internal static Ban ForGood(PeerAddress machine) => new(SimTime.MaxValue, Longest, machine);
    }
}
