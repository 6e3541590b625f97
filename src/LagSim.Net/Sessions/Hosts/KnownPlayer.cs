using LagSim.Net.Protection;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>By what a host knows a player again: the identity in its connect token, else its key, else its pass. The default is nothing.</summary>
/// <remarks>
/// Who is proven by token or key needs no pass to be known by: a pass opens no number that has a key, and brings back what the token said.
/// </remarks>
internal readonly record struct KnownPlayer
{
    private readonly string? name;

    /// <param name="admission">What a connect token says of the player; null without one.</param>
    /// <param name="keyed">The number that its key or token gives; 0 for none.</param>
    /// <param name="place">The place whose pass it has; null for none.</param>
    internal KnownPlayer(PlayerAdmission? admission, byte keyed, PlayerPlaces.Place? place)
    {
        IsProven = admission is not null || keyed > 0;
        name = admission is not null ? $"player {admission.PlayerId}" : keyed > 0 ? $"key {keyed}" : place is null ? null : $"visit {place.Visit}";
    }

    /// <summary>Whether a token or a key proves who it is, so that nobody else is the same, and it cannot come as another.</summary>
    internal bool IsProven { get; }

    /// <summary>Whether nothing tells it from any newcomer.</summary>
    internal bool IsNone => name is null;
}
