using System;
using System.Collections.Generic;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>The break at pool. Measures the positions of the balls soon after, against LagSim's closed-form flight.</summary>
/// <remarks>
/// The time is short, since every impact of balls magnifies an error. Closed-form flight is its own reference. Its own error is estimated
/// by the same scene with the cue ball moved by one unit in the last place. Engines differ in their rules for the simultaneous contacts in
/// the rack, which is in the figures too.
/// </remarks>
internal sealed class BilliardsWork : WorkScene
{
    public override string Name => "billiards";

    public override string Title => "the break at pool, 0.5 s";

    public override string Reference =>
        "LagSim's closed-form flight; that of a cue ball which starts a unit in the last place further on where closed-form flight itself is asked";

    public override double Seconds => 0.5;

    public override IReadOnlyList<string> ErrorKinds { get; } = ["rms_position_m"];

    public override double Floor => 1e-13;

    public override double Ceiling => 0.3;

    public override bool HasPairs => true;

    public override IReadOnlyList<double> IntegratorRates => [10, 60, 240];

    public override IReadOnlyList<double> EngineRates => [60, 200, 1000, 5000, 10_000, 50_000];

    public override Scene Build(MotionLaw law, SimDuration step, double tolerance) =>
        law == MotionLaw.Ballistic ? BuiltInScenes.Billiards() : BuiltInScenes.WithMotion(BuiltInScenes.Billiards(), law, step);

    /// <summary>Top view: balls never leave the table.</summary>
    public override (double X, double Y)? Flat(in Vector3D v, int body) => (v.X, v.Z);

    public override (double X, double Y) FlatNormal(in Vector3D normal) => (normal.X, normal.Z);

    public override Vector3D Unflat(double x, double y, int body) => new(x, BilliardsScene.Radius, y);

    protected override IWatch Watch() => new Positions(Scene);

    private static Scene Nudged(Scene scene)
    {
        SceneBuilder builder = new SceneBuilder(scene.Name);
        foreach (StaticPlane plane in scene.Planes)
        {
            builder.AddPlane(plane.Name, plane.Normal, plane.Offset, plane.Restitution);
        }

        for (int n = 0; n < scene.Bodies.Count; n++)
        {
            SceneBody body = scene.Bodies[n];
            Vector3D at = body.Position;
            builder.AddBody(body.Name, body.Spec, n > 0 ? at : new Vector3D(Math.BitIncrement(at.X), at.Y, Math.BitIncrement(at.Z)), body.Velocity);
        }

        return builder.Build();
    }

    private sealed class Positions(Scene scene) : IWatch
    {
        public void Look(IWorkRun run)
        {
        }

        public IReadOnlyList<double> Errors(IWorkRun run)
        {
            double off = Distance(run, scene);
            return [off == 0 ? Distance(run, Nudged(scene)) : double.IsFinite(off) ? off : double.NaN];
        }

        private static double Distance(IWorkRun run, Scene other)
        {
            using LagSimMethod.Run reference = new(other, new SimulationOptions());
            reference.AdvanceTo(run.Seconds);
            double squares = 0;
            for (int n = 0; n < other.Bodies.Count; n++)
            {
                squares += (run.Position(n) - reference.Position(n)).LengthSquared;
            }

            return Math.Sqrt(squares / other.Bodies.Count);
        }
    }
}
