using System;
using System.Collections.Generic;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>The thesis's drop: a ball falls from 10 m with restitution 0.8; its height against the closed form.</summary>
internal sealed class DropWork : WorkScene
{
    private const double Height = 10;
    private const double Restitution = 0.8;
    private const double Radius = 0.5;
    private const double Gravity = 9.81;

    public override string Name => "drop";

    public override string Title => "a ball falls from 10 m and bounces with restitution 0.8, 3 s";

    public override string Reference => "closed form";

    public override double Seconds => 3;

    public override IReadOnlyList<string> ErrorKinds { get; } = ["max_position_error_m"];

    public override double Floor => 1e-14;

    public override double Ceiling => 10;

    public override Scene Build(MotionLaw law, SimDuration step, double tolerance) =>
        BuiltInScenes.Drop(Height, Restitution, law, law == MotionLaw.RungeKutta4 ? 1 / step.ToSeconds() : 200);

    public override (double X, double Y)? Flat(in Vector3D v, int body) => (v.X, v.Y);

    protected override IWatch Watch() => new PathWatch(t => new Vector3D(0, HeightAt(t), 0));

    private static double HeightAt(double t)
    {
        double fall = Height - Radius, first = Math.Sqrt(2 * fall / Gravity);
        if (t <= first)
        {
            return Height - (0.5 * Gravity * t * t);
        }

        double speed = Gravity * first * Restitution, hop = 2 * speed / Gravity;
        t -= first;
        while (t > hop)
        {
            t -= hop;
            speed *= Restitution;
            hop *= Restitution;
        }

        return Radius + ((speed - (0.5 * Gravity * t)) * t);
    }
}
