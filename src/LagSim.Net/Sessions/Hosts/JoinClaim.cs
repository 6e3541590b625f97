using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>The identity of a welcomed client: its join, the number that its key gives, and the player that it proved to be.</summary>
internal sealed class JoinClaim
{
    /// <param name="join">The join.</param>
    /// <param name="keyed">The number that its key gives; 0 for none.</param>
    /// <param name="claimed">The place of the player that it proved to be; null for none.</param>
    /// <param name="until">When it is given up if it has no number by then.</param>
    internal JoinClaim(in JoinDatagram join, byte keyed, PlayerPlaces.Place? claimed, SimTime until)
    {
        Nonce = join.Nonce;
        Cookie = join.Cookie;
        Wanted = join.Player;
        Keyed = keyed;
        Claimed = claimed;
        ClaimedPass = claimed?.Pass;
        Until = until;
    }

    internal ulong Nonce { get; }

    internal Token128 Cookie { get; }

    /// <summary>The number that it says it had; 0 for none.</summary>
    internal byte Wanted { get; }

    /// <summary>The number that its key gives it; 0 for none.</summary>
    internal byte Keyed { get; }

    /// <summary>The place of the player that it was before, unless another has taken it since; null for none.</summary>
    internal PlayerPlaces.Place? Former => Claimed is not null && Claimed.Pass == ClaimedPass ? Claimed : null;

    /// <summary>When it is given up if it has no number by then.</summary>
    internal SimTime Until { get; }

    private PlayerPlaces.Place? Claimed { get; }

    private Token128? ClaimedPass { get; }
}
