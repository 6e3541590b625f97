using System.Collections.Generic;
using LagSim.Harness.Verification.References;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>An orbit of eccentricity 0.5 around a centre. Measures the position after three revolutions.</summary>
internal sealed class KeplerWork : WorkScene
{
    private const double E = 0.5;
    private const double Period = 2;

    private static readonly KeplerOrbit Orbit = new(E, Period);

    public override string Name => "kepler";

    public override string Title => "an orbit of eccentricity 0.5 and 1 m, three times round, 6 s";

    public override string Reference => "Kepler's equation";

    public override double Seconds => 3 * Period;

    public override IReadOnlyList<string> ErrorKinds { get; } = ["max_position_error_m"];

    public override double Floor => 1e-13;

    public override double Ceiling => 1;

    public override IReadOnlyList<double> IntegratorRates => [15, 30, 60, 120, 240, 480, 960, 1920, 3840];

    public override Force? Acting { get; } = Orbit.Pull;

    public override Scene Build(MotionLaw law, SimDuration step, double tolerance) => new SceneBuilder(Name).WithGravity(Vector3D.Zero).AddForce(Acting!)
        .AddBody("planet", new BodySpec(0.01, 1, 1, law, step, ForceSet.Of(0), tolerance), Orbit.Position(0), Orbit.StartVelocity).Build();

    public override (double X, double Y)? Flat(in Vector3D v, int body) => (v.X, v.Y);

    protected override IWatch Watch() => new PathWatch(Orbit.Position);
}
