using System;

namespace LagSim.Net.Sessions;

/// <summary>
/// The work that one player may cause for all peers: so much per second in the long run, and so much at once. Work is measured in units of
/// about a microsecond on one core, as <see cref="Hosting.WorkLedger"/> counts it: a busy machine charges nobody more.
/// </summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public sealed class PlayerBudget
{
    /// <summary>The default budget: 100,000 per second, and 120,000 at once.</summary>
    /// <remarks>
    /// That is a tenth of a core in the long run, so that eight players at the limit leave a fifth of it; and 0.12 s at once, so that a
    /// world is still within a quarter of a second of real time when a player is expelled, even on a machine half as fast as assumed.
    /// docs/BUDGETS.md lists what players of the built-in scenes need.
    /// </remarks>
    public static readonly PlayerBudget Default = new();

    /// <summary>Creates a budget.</summary>
    /// <param name="workPerSecond">The work per second of real time, in units of about a microsecond; 1 to 1e9, default 100,000.</param>
    /// <param name="workAtOnce">The work at once, after a quiet period; 1 to 1e9, default 120,000.</param>
    /// <exception cref="ArgumentOutOfRangeException">A value is out of range.</exception>
    public PlayerBudget(double workPerSecond = 100_000, double workAtOnce = 120_000)
    {
        WorkPerSecond = Checked(workPerSecond, "per second", nameof(workPerSecond));
        WorkAtOnce = Checked(workAtOnce, "at once", nameof(workAtOnce));
    }

    /// <summary>The work per second of real time, in units of about a microsecond.</summary>
    public double WorkPerSecond { get; }

    /// <summary>The work at once, after a quiet period.</summary>
    public double WorkAtOnce { get; }

    private static double Checked(double value, string when, string name) => value is >= 1 and <= 1e9 ? value
        : throw new ArgumentOutOfRangeException(name, value, $"What a player may cost {when} is 1 to 1e9 units of work, of about a microsecond each.");
}
