using System.Globalization;

namespace LagSim.Harness.Verification.Stalls;

/// <summary>One thing that happens to one peer.</summary>
/// <param name="Kind">What.</param>
/// <param name="Player">Whose: 0 for the host, clients count from 1.</param>
/// <param name="AtSeconds">When it begins, after all are in.</param>
/// <param name="Seconds">How long it lasts.</param>
public sealed record Stall(StallKind Kind, int Player, double AtSeconds, double Seconds)
{
    /// <summary>How often an address changes, while it does.</summary>
    public const double ChangeSeconds = 10;

    /// <summary>When it is over.</summary>
    public double EndSeconds => AtSeconds + Seconds;

    /// <summary>Whether a client notices it itself: what befalls the host befalls all.</summary>
    public bool Touches(int client) => Player == 0 || Player == client;

    /// <summary>All of it in a few words.</summary>
    public override string ToString()
    {
        string what = Kind switch
        {
            StallKind.HostFrozen => "host frozen",
            StallKind.HostKilled => "host killed and back",
            StallKind.ClientFrozen => $"client {Player} frozen",
            StallKind.ClientKilled => $"client {Player} killed and back",
            _ => $"client {Player} on another port every {ChangeSeconds} s",
        };
        return string.Create(CultureInfo.InvariantCulture, $"{what} from {AtSeconds:0.0} s for {Seconds:0.0} s");
    }
}
