using System;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>
/// Reports that a host expelled a player, or removed what a departed one left behind, because it cost more than
/// <see cref="HostOptions.PlayerBudget"/>.
/// </summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public sealed class PlayerExpulsion
{
    internal PlayerExpulsion(byte player, bool wasThere, string cost, double work, double seconds, int removed, int stopped, SimTime from)
    {
        Player = player;
        WasThere = wasThere;
        Work = work;
        Seconds = seconds;
        BodiesRemoved = removed;
        BodiesStopped = stopped;
        From = from;
        string what = wasThere ? $"Player {player} is disconnected: what it did"
            : player == 0 ? "What players who are gone had left is removed: it" : $"What player {player}, who is gone, had left is removed: it";
        Sentence = $"{what} {cost}" + FormattableString.Invariant(
            $" As of {from.ToShortString()} of the simulation, {removed} of its bodies {(removed == 1 ? "is" : "are")} removed")
            + $" and {stopped} {(stopped == 1 ? "other that it moved is" : "others that it moved are")} stopped.";
    }

    /// <summary>What something cost, by count and clock, to end a sentence with.</summary>
    /// <param name="work">In units of about a microsecond.</param>
    /// <param name="took">How long that took by the clock, in seconds.</param>
    /// <param name="within">Within how many seconds it was done.</param>
    internal static string CostOf(double work, double took, double within) => FormattableString.Invariant(
        $"took {work / 1000:0} ms of work as it is counted, {took * 1000:0} ms by the clock, within {within:0.0##} s, more than one player may cost.");

    /// <summary>The player's number; 0 for departed players whose number has another holder by now.</summary>
    public byte Player { get; }

    /// <summary>Whether a client had that number, and was disconnected.</summary>
    public bool WasThere { get; }

    /// <summary>
    /// The work charged to the player since it last stayed within its budget for a while, in units of about a microsecond.
    /// </summary>
    public double Work { get; }

    /// <summary>
    /// How long that work took by the host's clock, in seconds; it includes time in which other programs had the core, and decides nothing.
    /// </summary>
    public double Seconds { get; }

    /// <summary>The number of its spawned bodies that are removed.</summary>
    public int BodiesRemoved { get; }

    /// <summary>The number of other bodies that are stopped, because it had moved them and much of the work was for them.</summary>
    public int BodiesStopped { get; }

    /// <summary>The simulated time of the removals: before the work began, or as far back as can still be changed.</summary>
    public SimTime From { get; }

    /// <summary>All of it as a sentence, for a log.</summary>
    public string Sentence { get; }

    /// <inheritdoc cref="Sentence"/>
    public override string ToString() => Sentence;
}
