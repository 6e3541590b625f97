namespace LagSim.Net.Sessions;

/// <summary>What a player cost a host so far.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public readonly struct PlayerCost
{
    internal PlayerCost(byte player, double work, double mostAtOnce)
    {
        Player = player;
        Work = work;
        MostAtOnce = mostAtOnce;
    }

    /// <summary>The player's number.</summary>
    public byte Player { get; }

    /// <summary>All work that was charged to that number, in units of about a microsecond.</summary>
    public double Work { get; }

    /// <summary>The most that was spent at a time of <see cref="PlayerBudget.WorkAtOnce"/>; 0 without a budget.</summary>
    public double MostAtOnce { get; }
}
