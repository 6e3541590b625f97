namespace LagSim.Net.Sessions;

/// <summary>The work that a player has cost a host so far.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public readonly struct PlayerCost
{
    internal PlayerCost(byte player, double work, double seconds, double peakWork)
    {
        Player = player;
        Work = work;
        Seconds = seconds;
        PeakWork = peakWork;
    }

    /// <summary>The player's number.</summary>
    public byte Player { get; }

    /// <summary>The work charged to that number in all, in units of about a microsecond.</summary>
    public double Work { get; }

    /// <summary>How long that took by the host's clock, in seconds. It includes time in which other programs had the core.</summary>
    public double Seconds { get; }

    /// <summary>The most that was ever spent of <see cref="PlayerBudget.WorkAtOnce"/>; 0 without a budget.</summary>
    public double PeakWork { get; }
}
