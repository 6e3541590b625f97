namespace LagSim.Net.Sessions;

/// <summary>The work that a player has cost a host so far.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public readonly struct PlayerCost
{
    internal PlayerCost(byte player, double work, double peakWork)
    {
        Player = player;
        Work = work;
        PeakWork = peakWork;
    }

    /// <summary>The player's number.</summary>
    public byte Player { get; }

    /// <summary>The work charged to that number in all, in units of about a microsecond.</summary>
    public double Work { get; }

    /// <summary>The most that was ever spent of <see cref="PlayerBudget.WorkAtOnce"/>; 0 without a budget.</summary>
    public double PeakWork { get; }
}
