namespace LagSim.Scenes;

/// <summary>Why a body has left the world by itself: its motion cannot be followed further, or there is no room for it. The numbers are part of hashes: never renumber.</summary>
/// <remarks>
/// What one body does never ends a world. A body that cannot be followed is taken out of it at that instant, by an event of the fold
/// (<see cref="Events.EventKind.Lost"/>), on every peer alike.
/// </remarks>
public enum LossReason : byte
{
    /// <summary>It is not lost.</summary>
    None = 0,

    /// <summary>
    /// It would be faster than a fifth of the scene's smallest radius in a tick: so fast it could pass through another body unseen.
    /// </summary>
    TooFast = 1,

    /// <summary>
    /// The forces on it change faster than the shortest step follows: close to the centre of a pull, or in a medium that is too thick for
    /// so light a body.
    /// </summary>
    TooStiff = 2,

    /// <summary>The forces on it have no finite value: at the very centre of a pull.</summary>
    NotFinite = 3,

    /// <summary>A hand let it go inside of static geometry that leaves it no room: between surfaces too close for it, as far as was looked.</summary>
    NoRoom = 4,
}
