using System;
using System.Linq;
using LagSim.Scenes;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>
/// What slides or rolls touches a plane, to a hundredth of the contact tolerance, and what rests where something pulls touches anything, to
/// the tolerance: nothing is carried by the air.
/// </summary>
internal sealed class CarryPromise : WorldPromise
{
    internal override string Name => "carry";

    internal override void Look(WorldMoment moment)
    {
        foreach (WorldBody body in moment.Bodies)
        {
            bool slips = body.State.Motion is MotionLaw.Sliding or MotionLaw.Rolling;
            bool rests = body.State.Motion == MotionLaw.Resting && moment.Scene.Gravity != Vector3D.Zero;
            double tolerance = moment.Scene.ContactTolerance;
            double off = slips ? FromPlanes(moment, body) : rests ? Math.Min(FromPlanes(moment, body), FromRound(moment, body)) : 0;
            if (off > (slips ? tolerance / 100 : tolerance) + Rounding(body))
            {
                Break(moment, string.Create(Invariant,
                    $"{body.Id} is {body.State.Motion} at {body.State.Position} m, {off:G4} m off what could carry it; the tolerance is {tolerance:G3} m."));
            }
        }
    }

    // Of its place, and a bounce that counts as none leaves a nanometre.
    private static double Rounding(WorldBody body) => 1e-9 + (1e-14 * body.State.Position.Length);

    private static double FromPlanes(WorldMoment moment, WorldBody body) => moment.Scene.Planes
        .Where(plane => body.State.Filter.CollidesWith(plane.Filter))
        .Select(plane => Math.Abs(plane.Gap(body.State.Position, body.Spec.Radius)))
        .DefaultIfEmpty(double.PositiveInfinity).Min();

    // Asleep on it, or deep in it, which other promises judge.
    private static double FromRound(WorldMoment moment, WorldBody body) => moment.Scene.StaticSpheres
        .Where(sphere => body.State.Filter.CollidesWith(sphere.Filter))
        .Select(sphere => (body.State.Position - sphere.Centre).Length - sphere.Radius - body.Spec.Radius)
        .Concat(moment.Bodies.Where(other => other.Id != body.Id && other.State.Filter.CollidesWith(body.State.Filter))
            .Select(other => moment.Way(other.State.Position, body.State.Position).Length - other.Spec.Radius - body.Spec.Radius))
        .DefaultIfEmpty(double.PositiveInfinity).Min();
}
