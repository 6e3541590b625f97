using System;

namespace LagSim.Scenes;

/// <summary>Whether a place is clear of static geometry that stops a body, and where the nearest such place is.</summary>
/// <remarks>
/// What stops a body is decided by its filter at that instant, which is asked for each time. Pure and immutable; cost: the surfaces of the
/// scene.
/// </remarks>
internal sealed class Clearance(Scene scene)
{
    private readonly StaticSurfaces surfaces = scene.Surfaces;
    private readonly NearestPlace nearest = new(scene.Surfaces);

    /// <summary>Whether a ball at a place is inside of nothing that stops it, but for what rounding and the scene's threshold leave of
    /// touching.</summary>
    internal bool IsClear(in Vector3D position, double radius, CollisionFilter filter)
    {
        bool isClear = true;
        double slack = Slack(position.Taxicab + radius);
        for (int surface = 0; surface < surfaces.Count && isClear; surface++)
        {
            isClear = surfaces.Gap(surface, position, radius) >= -slack || !filter.CollidesWith(surfaces.Filter(surface));
        }

        return isClear;
    }

    /// <summary>Whether a ball can be at a place at all: clear of what stops it, within the world, and not at the centre of a pull that has
    /// no direction there.</summary>
    internal bool Admits(in Vector3D position, in BodySpec spec, CollisionFilter filter) =>
        Math.Abs(position.X) <= Limits.MaxCoordinate && Math.Abs(position.Y) <= Limits.MaxCoordinate
        && Math.Abs(position.Z) <= Limits.MaxCoordinate && !Limits.IsAtCentre(position, spec, scene.ForceArray)
        && IsClear(position, spec.Radius, filter);

    /// <summary>Whether two balls are not inside of each other, but for as little.</summary>
    /// <param name="position">The centre of one.</param>
    /// <param name="centre">That of the other.</param>
    /// <param name="reach">The sum of their radii.</param>
    internal bool AreApart(in Vector3D position, in Vector3D centre, double reach) =>
        scene.Box.Nearest(position - centre).Length - reach >= -Slack(position.Taxicab + centre.Taxicab + reach);

    /// <summary>
    /// The nearest place outside of static geometry that stops a ball (<see cref="NearestPlace"/>), or, where none is between the surfaces
    /// that are near, the first of those around it; false if there is none there either.
    /// </summary>
    internal bool TryPutOut(in Vector3D position, double radius, CollisionFilter filter, out Vector3D place)
    {
        bool isOut = nearest.TryFind(position, radius, filter, out place) && IsClear(place, radius, filter);
        Vector3D middle = place;
        for (int n = 0; n < PlacesAround.Count && !isOut; n++)
        {
            place = PlacesAround.At(n, middle, radius);
            isOut = IsClear(place, radius, filter);
        }

        return isOut;
    }

    /// <summary>What rounding and the scene's threshold leave of touching, in metres, among numbers of that size.</summary>
    internal double Slack(double size) => scene.RestitutionThreshold + (1e-15 * size);
}
