using System;
using System.Collections.Generic;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>Forty-nine elastic balls that bounce on a plane from different heights. Measures the energy.</summary>
internal sealed class Elastic49Work : WorkScene
{
    private const int Side = 7;

    public override string Name => "elastic49";

    public override string Title => "7 x 7 elastic balls, 2 m apart, from 1.5 to 6.3 m, bounce on a plane, 20 s";

    public override string Reference => "the energy at the start";

    public override double Seconds => 20;

    public override IReadOnlyList<string> ErrorKinds { get; } = ["max_energy_relative"];

    public override double Floor => 1e-15;

    public override double Ceiling => 1;

    public override Scene Build(MotionLaw law, SimDuration step, double tolerance)
    {
        SceneBuilder builder = new SceneBuilder(Name).AddPlane("floor", Vector3D.Up, Vector3D.Zero);
        BodySpec ball = new(0.5, 1, 1, law, step);
        for (int n = 0; n < Side * Side; n++)
        {
            builder.AddBody(FormattableString.Invariant($"ball {n + 1}"), ball, new Vector3D(2 * (n % Side), 1.5 + (0.1 * n), 2 * (n / Side)));
        }

        return builder.Build();
    }

    /// <summary>In a row.</summary>
    public override (double X, double Y)? Flat(in Vector3D v, int body) => (2 * body, v.Y);

    protected override IWatch Watch() => new Energy(Scene);

    private sealed class Energy(Scene scene) : IWatch
    {
        private readonly EnergyWatch energy = new(scene);

        public void Look(IWorkRun run) => energy.Look(run);

        public IReadOnlyList<double> Errors(IWorkRun run) => [energy.Worst];
    }
}
