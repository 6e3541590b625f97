using System.Globalization;

namespace LagSim.Harness.Verification.Stalls;

/// <summary>One disturbance of one peer.</summary>
/// <param name="Kind">The kind.</param>
/// <param name="Player">The peer: 0 for the host, clients count from 1.</param>
/// <param name="AtSeconds">The time at which it begins, in seconds after all peers are in.</param>
/// <param name="Seconds">How long it lasts, in seconds.</param>
public sealed record Stall(StallKind Kind, int Player, double AtSeconds, double Seconds)
{
    /// <summary>The interval between changes of an address.</summary>
    public const double ChangeSeconds = 10;

    /// <summary>The time at which it is over, in seconds.</summary>
    public double EndSeconds => AtSeconds + Seconds;

    /// <summary>Whether it affects a client: what happens to the host affects all.</summary>
    public bool Touches(int client) => Player == 0 || Player == client;

    /// <summary>Returns a short description.</summary>
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
