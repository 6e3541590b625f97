using System;
using System.Collections.Generic;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>A thousand elastic spheres in a walled cube. Measures their overlap, and the energy.</summary>
internal sealed class GasWork : WorkScene
{
    private const int Side = 10;
    private const double Radius = 0.5;
    private const double Fraction = 0.2;
    private const double Deep = 1e-3;

    public override string Name => "gas";

    public override string Title => "1,000 elastic spheres that fill a fifth of a walled cube, speeds normal with sd 1 m/s, no gravity, 10 s";

    public override string Reference => "hard spheres do not overlap, and the energy at the start";

    public override double Seconds => 10;

    public override IReadOnlyList<string> ErrorKinds { get; } = ["deepest_overlap_m", "most_pairs_deeper_than_1_mm", "max_energy_relative"];

    public override double Floor => 1e-15;

    public override double Ceiling => 0.5;

    public override bool HasPairs => true;

    public override IReadOnlyList<double> IntegratorRates => [2, 10, 50];

    public override IReadOnlyList<double> EngineRates => [60, 200, 1000];

    public override Scene Build(MotionLaw law, SimDuration step, double tolerance)
    {
        double side = Math.Cbrt(Side * Side * Side * 4.0 / 3 * Math.PI * Radius * Radius * Radius / Fraction), cell = side / Side;
        SceneBuilder builder = new SceneBuilder(Name).WithGravity(Vector3D.Zero);
        foreach (Vector3D normal in new Vector3D[] { new(1, 0, 0), new(0, 1, 0), new(0, 0, 1) })
        {
            builder.AddPlane(FormattableString.Invariant($"low {normal}"), normal, 0.0).AddPlane(FormattableString.Invariant($"high {normal}"), -normal, -side);
        }

        SeededRandom random = new(1);
        BodySpec ball = new(Radius, 1, 1, law, step);
        for (int n = 0; n < Side * Side * Side; n++)
        {
            Vector3D place = new Vector3D((n % Side) + 0.5, (n / Side % Side) + 0.5, (n / Side / Side) + 0.5) * cell;
            builder.AddBody(FormattableString.Invariant($"ball {n + 1}"), ball, place,
                new Vector3D(random.NextGaussian(), random.NextGaussian(), random.NextGaussian()));
        }

        return builder.Build();
    }

    protected override IWatch Watch() => new Overlaps(Scene);

    private sealed class Overlaps(Scene scene) : IWatch
    {
        private readonly EnergyWatch energy = new(scene);
        private readonly Vector3D[] places = new Vector3D[scene.Bodies.Count];
        private double deepest;
        private int most;
        private int looks;

        public void Look(IWorkRun run)
        {
            energy.Look(run);
            if (looks++ % 6 > 0)
            {
                return; // half a million pairs: a hundred times is enough
            }

            for (int n = 0; n < places.Length; n++)
            {
                places[n] = run.Position(n);
            }

            int deep = 0;
            for (int i = 0; i < places.Length; i++)
            {
                for (int j = 0; j < i; j++)
                {
                    double square = (places[i] - places[j]).LengthSquared;
                    if (square < 4 * Radius * Radius)
                    {
                        double depth = (2 * Radius) - Math.Sqrt(square);
                        deepest = Math.Max(deepest, depth);
                        deep += depth > Deep ? 1 : 0;
                    }
                }
            }

            most = Math.Max(most, deep);
        }

        public IReadOnlyList<double> Errors(IWorkRun run) => [deepest, most, energy.Worst];
    }
}
