using System;
using System.Collections.Generic;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>A body on a spring. Measures the position after ten periods and a quarter.</summary>
internal sealed class SpringWork : WorkScene
{
    private const double Omega = 2 * Math.PI;

    public override string Name => "spring";

    public override string Title => "a body on a spring with a period of 1 s and an amplitude of 1 m, 10.25 s";

    public override string Reference => "cosine";

    public override double Seconds => 10.25;

    public override IReadOnlyList<string> ErrorKinds { get; } = ["max_position_error_m"];

    public override double Floor => 1e-14;

    public override double Ceiling => 1;

    public override IReadOnlyList<double> IntegratorRates => [10, 20, 40, 80, 160, 320, 640, 1280];

    public override Force? Acting { get; } = Force.Spring("spring", Vector3D.Zero, Omega * Omega);

    public override Scene Build(MotionLaw law, SimDuration step, double tolerance) => new SceneBuilder(Name).WithGravity(Vector3D.Zero).AddForce(Acting!)
        .AddBody("body", new BodySpec(0.01, 1, 1, law, step, ForceSet.Of(0), tolerance), new Vector3D(1, 0, 0)).Build();

    public override (double X, double Y)? Flat(in Vector3D v, int body) => (v.X, v.Y);

    protected override IWatch Watch() => new PathWatch(t => new Vector3D(Math.Cos(Omega * t), 0, 0));
}
