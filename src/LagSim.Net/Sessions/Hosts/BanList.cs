using LagSim.Net.Carriers;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Who is let in no more, for the whole session or for a while: players by what tells who they are, and machines.</summary>
/// <remarks>
/// An address is not a person: a household shares one, and so may a whole network. So a player whom a token or a key proves is out alone. One
/// who has no more than a pass can come again without it; that player's machine is out too once another is sent away from it.
/// </remarks>
/// <param name="limits">How many bans for a while are kept.</param>
internal sealed class BanList(JoinLimits limits)
{
    /// <summary>How long a machine is remembered from which somebody was sent away: an attack that comes again every few minutes ends it.</summary>
    private static readonly SimDuration Warned = SimDuration.FromSeconds(600);

    private readonly Bans<KnownPlayer> players = new(limits.PassingBans);
    private readonly Bans<PeerAddress> machines = new(limits.PassingBans);

    /// <summary>How many players and machines are remembered.</summary>
    internal int Count => players.Count + machines.Count;

    /// <summary>Shuts a player out for good, if something proves who it is; otherwise its machine. A pass is void once its player is sent away.</summary>
    internal void ShutOut(KnownPlayer who, PeerAddress machine)
    {
        if (who.IsProven)
        {
            players.AddForGood(who, machine);
        }
        else
        {
            machines.AddForGood(machine, machine);
        }
    }

    /// <summary>
    /// Shuts a player out for a while. Its machine as well if nothing proves who it is, and somebody was sent away from there within the
    /// last ten minutes or the machine was out not long before.
    /// </summary>
    internal void ShutOutForAWhile(KnownPlayer who, PeerAddress machine, SimTime now)
    {
        if (!who.IsNone)
        {
            players.Add(who, machine, now);
        }

        if (!who.IsProven && !machines.TryWarn(machine, machine, now, Warned))
        {
            machines.Add(machine, machine, now);
        }
    }

    /// <summary>Whether a player is not let in from a machine. One that is proven is not out for what others did there for a while.</summary>
    internal bool IsShutOut(KnownPlayer who, PeerAddress machine, SimTime now) =>
        players.IsOut(who, now) || (who.IsProven ? machines.IsOutForGood(machine) : machines.IsOut(machine, now));

    /// <summary>Lets a machine, and the players who were sent away from it, in again; false if none of them was shut out.</summary>
    internal bool LetInAgain(PeerAddress machine, SimTime now) =>
        machines.RemoveOf(machine, now) | players.RemoveOf(machine, now);
}
