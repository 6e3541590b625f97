using System;

namespace LagSim.Net.Protection;

/// <summary>What a player with a connect token may do, besides watching.</summary>
[Flags]
public enum PlayerRights
{
    /// <summary>Watch only.</summary>
    None = 0,

    /// <summary>Act on bodies, within what the scene grants.</summary>
    Act = 1,

    /// <summary>Spawn bodies, within what the scene grants.</summary>
    Spawn = 2,

    /// <summary>Everything that a player without a token may.</summary>
    All = Act | Spawn,
}
