using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.SceneFiles.Runs;

/// <summary>
/// The partner of a body in an impact. The key of an impact of many bodies names two of them; the partners of the others follow from their
/// places.
/// </summary>
internal static class ImpactPartner
{
    /// <summary>The body that a body met; null if it met none.</summary>
    /// <param name="impact">What happened to it.</param>
    /// <param name="all">All events of the same span of time.</param>
    /// <param name="scene">The scene.</param>
    internal static BodyId? Body(in BodyEvent impact, IEnumerable<BodyEvent> all, Scene scene)
    {
        EventKey key = impact.Key;
        BodyId self = impact.Body;
        if (key.Body == key.Other)
        {
            return null;
        }

        if (self == key.Body || self == key.Other)
        {
            return self == key.Body ? key.Other : key.Body;
        }

        // The bodies of one impact are linked by contacts, so the nearest one touches this one.
        BodyState state = impact.State;
        return all.Where(e => e.Key == key && e.Body != self).MinBy(e => Gap(scene, self, state, e)).Body;
    }

    /// <summary>
    /// The surface that a body ran into: of those it touches, the one towards which it moved fastest; one that carries it is touched too.
    /// </summary>
    /// <param name="scene">The scene.</param>
    /// <param name="radius">The body's radius in metres.</param>
    /// <param name="before">The body right before.</param>
    /// <param name="after">The body right after.</param>
    /// <returns>The surface's name; empty if it touches none.</returns>
    internal static string Surface(Scene scene, double radius, BodyState before, BodyState after)
    {
        // Touching is within the scene's resolution, what the body moves in a tick, and the rounding of where it is.
        double slack = scene.Resolution + (SimDuration.OneTick.ToSeconds() * (before.Velocity.Length + after.Velocity.Length));
        Vector3D position = after.Position;
        return scene.Planes
            .Select(plane => (plane.Name, plane.Normal, Gap: plane.Gap(position, radius), Scale: position.Length))
            .Concat(scene.StaticSpheres.Select(sphere =>
            {
                Vector3D apart = position - sphere.Centre;
                return (sphere.Name, Normal: apart / apart.Length, Gap: apart.Length - sphere.Radius - radius, Scale: position.Length + apart.Length);
            }))
            .Where(surface => Math.Abs(surface.Gap) <= slack + (1e-15 * surface.Scale))
            .OrderBy(surface => Vector3D.Dot(surface.Normal, before.Velocity))
            .Select(surface => surface.Name)
            .FirstOrDefault("");
    }

    private static double Gap(Scene scene, BodyId self, in BodyState state, in BodyEvent other) =>
        (state.Position - other.State.Position).Length - scene.Bodies[self.Index].Spec.Radius - scene.Bodies[other.Body.Index].Spec.Radius;
}
