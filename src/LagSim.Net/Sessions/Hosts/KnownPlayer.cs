using System.Collections.Generic;
using LagSim.Net.Protection;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>By what a host knows a player again: the identity in its connect token, its key, its pass.</summary>
internal readonly struct PlayerNames
{
    private readonly string? proven;
    private readonly string? byPass;

    /// <param name="admission">What a connect token says of the player; null without one.</param>
    /// <param name="keyed">The number that its key or token gives; 0 for none.</param>
    /// <param name="place">The place whose pass it has; null for none.</param>
    internal PlayerNames(PlayerAdmission? admission, byte keyed, PlayerPlaces.Place? place)
    {
        proven = admission is not null ? $"player {admission.PlayerId}" : keyed > 0 ? $"key {keyed}" : null;
        byPass = place is null ? null : $"visit {place.Visit}";
    }

    /// <summary>Whether a token or a key proves who it is, so that nobody else is the same, and it cannot come as another.</summary>
    internal bool AreProven => proven is not null;

    internal IEnumerable<string> All
    {
        get
        {
            if (proven is not null)
            {
                yield return proven;
            }

            if (byPass is not null)
            {
                yield return byPass;
            }
        }
    }
}
