namespace LagSim.Events;

/// <summary>What becomes of a spawn or a teleport to a place where another body or static geometry is that it collides with, by the filter that
/// it has at that instant.</summary>
/// <remarks>
/// Decided inside the world when the event's time comes, and so again when a late event changes who is there. The numbers are part of the
/// wire.
/// </remarks>
public enum WhenOccupied : byte
{
    /// <summary>It is put there all the same. Two bodies are then pushed apart as fast as one would fall through that depth, which takes 1 s for
    /// half a metre without gravity, and 0.32 s on Earth. In a periodic box nothing pushes them: they stay in one another until their own
    /// motion parts them, so <see cref="Skip"/> or <see cref="Beside"/> is better there. Out of static geometry it is put to the surface; if
    /// there is no room outside, nothing happens.</summary>
    Overlap = 0,

    /// <summary>Nothing happens, and <see cref="Simulation.TookEffect"/> is false.</summary>
    Skip = 1,

    /// <summary>
    /// It is put at the first free place that is found on spheres around the place, each half a radius wider than the one before: beside it
    /// first, then above, then below. Inside of static geometry that place is first put out of it. If none is free within 32 radii, nothing
    /// happens.
    /// </summary>
    Beside = 2,
}
