using System;

namespace LagSim.Net.Sessions;

/// <summary>
///  What one player may cost a host and everybody else: so much work a second in the long run, and so much at once. Work is what simulating
/// takes, in units of about a microsecond on one core: what <see cref="Hosting.WorkLedger"/> counts, or measures by the session's clock
/// where that is more.
/// </summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public sealed class PlayerBudget
{
    /// <summary>The budget where nothing else is said: 100,000 a second, and 120,000 at once.</summary>
    /// <remarks>
    ///  A tenth of a core in the long run, so that eight players who all go to the limit leave a fifth of it; and 0.12 s at once, so that a
    /// world is still within a quarter of a second of real time when a player is out, on a machine that is half as fast as was thought.
    /// docs/BUDGETS.md has what players of the built-in scenes need of it.
    /// </remarks>
    public static readonly PlayerBudget Default = new();

    /// <summary>A budget.</summary>
    /// <param name="workPerSecond">How much work a second of real time, in units of about a microsecond; 1 to 1e9, default 100,000.</param>
    /// <param name="workAtOnce">How much at once, after a time of quiet; 1 to 1e9, default 120,000.</param>
    /// <exception cref="ArgumentOutOfRangeException">A value is out of its range.</exception>
    public PlayerBudget(double workPerSecond = 100_000, double workAtOnce = 120_000)
    {
        WorkPerSecond = Checked(workPerSecond, nameof(workPerSecond));
        WorkAtOnce = Checked(workAtOnce, nameof(workAtOnce));
    }

    /// <summary>How much work a second of real time, in units of about a microsecond.</summary>
    public double WorkPerSecond { get; }

    /// <summary>How much at once, after a time of quiet.</summary>
    public double WorkAtOnce { get; }

    private static double Checked(double value, string name) => value is >= 1 and <= 1e9 ? value
        : throw new ArgumentOutOfRangeException(name, value, FormattableString.Invariant($"A player's budget is 1 to 1e9 units of work; {value:R} is none."));
}
