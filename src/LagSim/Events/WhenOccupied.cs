namespace LagSim.Events;

/// <summary>What becomes of a spawn or a teleport to a place where another body or static geometry is that it collides with, by the filter that
/// it has at that instant.</summary>
/// <remarks>
/// Decided inside the world when the event's time comes, and so again when a late event changes who is there. The numbers are part of the
/// wire.
/// </remarks>
public enum WhenOccupied : byte
{
    /// <summary>It is put there all the same; two bodies are then pushed apart slowly, where anything pushes. Out of static geometry it is put
    /// to the surface; if there is no room outside, nothing happens.</summary>
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
