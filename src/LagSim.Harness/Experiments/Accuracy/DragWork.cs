using System.Collections.Generic;
using LagSim.Harness.Verification.References;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>A ball that falls and bounces under linear drag, against the closed form, bounce by bounce.</summary>
/// <remarks>
/// Linear, because quadratic drag on a line, k v |v|, has a second derivative that jumps where the velocity changes sign: no method of
/// order four has order four there, and an order measured across it says nothing of contacts. <c>lagsim hard drag-quadratic</c> has that
/// case.
/// </remarks>
internal sealed class DragWork : WorkScene
{
    private const double K = 0.5; // per second
    private const double Drop = 10;
    private const double Radius = 0.5;
    private const double Restitution = 0.8;

    private static readonly LinearDragFall Fall = new(9.81, K);

    public override string Name => "drag";

    public override string Title => "a ball falls 10 m under linear drag and bounces with restitution 0.8, 5 s";

    public override string Reference => "closed form, hop by hop";

    public override double Seconds => 5;

    public override IReadOnlyList<string> ErrorKinds { get; } = ["max_position_error_m"];

    public override double Floor => 1e-14;

    public override double Ceiling => 10;

    public override IReadOnlyList<double> IntegratorRates => [5, 10, 20, 40, 80, 160, 320, 640];

    public override Force? Acting { get; } = Force.LinearDrag("drag", K);

    public override Scene Build(MotionLaw law, SimDuration step, double tolerance) =>
        new SceneBuilder(Name).AddPlane("floor", Vector3D.Up, Vector3D.Zero).AddForce(Acting!)
        .AddBody("ball", new BodySpec(Radius, 1, Restitution, law, step, ForceSet.Of(0), tolerance), new Vector3D(0, Drop + Radius, 0)).Build();

    public override (double X, double Y)? Flat(in Vector3D v, int body) => (v.X, v.Y);

    protected override IWatch Watch() => new PathWatch(t => new Vector3D(0, Radius + HeightAt(t), 0));

    private static double HeightAt(double t)
    {
        double y = Drop, v = 0;
        for (double landing = Fall.Landing(y, v); t > landing; landing = Fall.Landing(y, v))
        {
            t -= landing;
            (y, v) = (0, -Restitution * Fall.Speed(v, landing));
        }

        return Fall.Height(y, v, t);
    }
}
