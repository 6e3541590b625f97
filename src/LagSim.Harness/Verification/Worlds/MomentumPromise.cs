using System;
using LagSim.Scenes;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>Where nothing acts from outside, no gravity, no force and no surface, the momentum of all bodies stays from one act to the
/// next.</summary>
internal sealed class MomentumPromise : WorldPromise
{
    private const double Relative = 1e-9;

    private readonly bool isJudged;
    private Vector3D? before;
    private int bodies;

    internal MomentumPromise(WorldScene world)
    {
        Scene scene = world.Scene;
        isJudged = scene.Gravity == Vector3D.Zero && scene.Forces.Count == 0 && scene.Planes.Count == 0 && scene.StaticSpheres.Count == 0
            && scene.Rules is null && !world.HasHands;
    }

    internal override string Name => "momentum";

    internal override void Look(WorldMoment moment)
    {
        if (!isJudged)
        {
            return;
        }

        Vector3D now = Vector3D.Zero;
        double size = 0;
        foreach (WorldBody body in moment.Bodies)
        {
            now += body.State.Velocity * body.Spec.Mass;
            size += body.Speed * body.Spec.Mass;
        }

        if (before is not Vector3D old || moment.Acts.Count > 0 || moment.Bodies.Count != bodies)
        {
            (before, bodies) = (now, moment.Bodies.Count);
        }
        else if (!((now - old).Length <= Relative * Math.Max(1, size)))
        {
            Break(moment, string.Create(Invariant, $"{now} N s, and after the last act it was {old} N s."));
        }
    }
}
