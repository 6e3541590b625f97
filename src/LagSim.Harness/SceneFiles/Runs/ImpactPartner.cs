using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.SceneFiles.Runs;

/// <summary>
/// Finds the partner of a body in an impact. The key of an impact of many bodies names two of them; the partners of the others follow from
/// their positions.
/// </summary>
internal static class ImpactPartner
{
    /// <summary>Returns the body that a body met; null if it met none.</summary>
    /// <param name="impact">The body's event.</param>
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
    /// Returns the surface that a body hit: of those it touches, the one towards which it moved fastest. It may also touch one that carries
    /// it.
    /// </summary>
    /// <param name="scene">The scene.</param>
    /// <param name="radius">The body's radius in metres.</param>
    /// <param name="before">The state of the body right before the impact.</param>
    /// <param name="after">The state of the body right after the impact.</param>
    /// <returns>The surface's name; empty if it touches none.</returns>
    internal static string Surface(Scene scene, double radius, BodyState before, BodyState after)
    {
        // Touching is within the scene's restitution threshold, the body's motion in a tick, and the rounding of its position.
        double slack = scene.RestitutionThreshold + (SimDuration.OneTick.ToSeconds() * (before.Velocity.Length + after.Velocity.Length));
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
