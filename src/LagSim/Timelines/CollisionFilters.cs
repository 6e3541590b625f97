using LagSim.Scenes;

namespace LagSim.Timelines;

/// <summary>Whether what a segment belongs to collides with a surface or with another body, by their collision filters.</summary>
/// <remarks>Where no filter is set nothing is read, and everything collides.</remarks>
internal readonly struct CollisionFilters(SegmentExtras extras, StaticSurfaces surfaces)
{
    private readonly SegmentExtras extras = extras;
    private readonly StaticSurfaces surfaces = surfaces;

    /// <summary>Whether the body of a segment collides with a surface.</summary>
    internal bool MeetSurface(int segment, int surface) => MeetSurface(extras.Filter(segment), surface);

    /// <summary>The same of a body with that filter.</summary>
    internal bool MeetSurface(CollisionFilter filter, int surface) =>
        (filter.IsDefault && !surfaces.HaveFilters) || filter.CollidesWith(surfaces.Filter(surface));

    /// <summary>Whether the bodies of two segments collide.</summary>
    internal bool Meet(int segment, int other) =>
        !extras.HaveFilters || extras.Filter(segment).CollidesWith(extras.Filter(other));
}
