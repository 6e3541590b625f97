using System;
using System.Collections.Generic;
using System.Globalization;
using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>Unequal balls run through a funnel onto a floor.</summary>
/// <remarks>
/// Planes alone make no funnel with a hole: each is the edge of a half space, and what all of them leave free is convex. So the funnel is
/// made of four static spheres on the vertical edges of a shaft. Each is as wide as half the shaft, so neighbours touch, and between the
/// four there is a hole of 0.41 of that.
/// </remarks>
/// <param name="balls">The number of balls.</param>
/// <param name="seconds">The simulated time, in seconds.</param>
internal sealed class HopperWork(int balls = 200, double seconds = 3) : ContactWork
{
    private const double Smallest = 0.05;
    private const double Largest = 0.1;
    private const double Half = 0.8;
    private const double Height = 1.4;
    private const double Friction = 0.3;
    private const double Restitution = 0.2;
    private const ulong Seed = 200;

    public override string Name => "hopper";

    public override string Title => string.Create(
        CultureInfo.InvariantCulture,
        $"{balls} balls of r {Smallest} to {Largest} m with friction {Friction} and restitution {Restitution} run"
            + $" between four static spheres of r {Half} m in a shaft of {2 * Half} m, {seconds} s");

    public override double Seconds => seconds;

    public override IReadOnlyList<string> ErrorKinds { get; } = [Overlap, EnergyGain];

    public override WorkScene Small => new HopperWork(20, 0.8);

    private protected override SceneBuilder Begin()
    {
        SceneBuilder builder = Pit.Dig(new SceneBuilder(Name), Half);
        for (int n = 0; n < 4; n++)
        {
            Vector3D centre = new(n % 2 == 0 ? -Half : Half, Height, n / 2 == 0 ? -Half : Half);
            builder.AddStaticSphere(FormattableString.Invariant($"rim {n + 1}"), centre, Half);
        }

        SeededRandom random = new(Seed);
        List<BodySpec> specs = [];
        for (int n = 0; n < balls; n++)
        {
            double radius = random.NextDouble(Smallest, Largest), part = radius / Largest;
            specs.Add(new BodySpec(radius, part * part * part, Restitution, friction: Friction));
        }

        return Pit.Pour(builder, specs, Largest, Half, Height + Half + (1.5 * Largest), random);
    }
}
