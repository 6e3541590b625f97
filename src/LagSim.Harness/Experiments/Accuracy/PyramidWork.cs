using System;
using System.Collections.Generic;
using System.Globalization;
using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>A pile of balls in one plane, each on two of the row below, between two walls: it stands, and should go on standing.</summary>
/// <remarks>
/// The places are exact but for a rounding of the heights, which are rounded up. Rolling resistance is LagSim's alone; the engines compared
/// have none set.
/// </remarks>
/// <param name="rows">The number of rows, each with one ball less than the row below.</param>
/// <param name="widest">The number of balls in the lowest row, which fills the floor between the walls.</param>
/// <param name="seconds">The simulated time, in seconds.</param>
internal sealed class PyramidWork(int rows = 5, int widest = 8, double seconds = 3) : ContactWork
{
    private const double Radius = 0.125; // a power of two, so that places in a row are exact
    private const double Friction = 0.5;
    private const double Resistance = 0.01;
    private const double Restitution = 0.2;

    public override string Name => "pyramid";

    public override string Title => string.Create(
        CultureInfo.InvariantCulture,
        $"a pile of {Balls} balls of r {Radius} m in one plane between two walls, friction {Friction}, restitution {Restitution},"
            + $" stands for {seconds} s");

    public override string Reference => "what stands goes on standing: nothing moves, overlaps, or gains energy";

    public override double Seconds => seconds;

    public override IReadOnlyList<string> ErrorKinds { get; } = [Moved, Drift, Overlap, EnergyGain];

    public override WorkScene Small => new PyramidWork(3, 4, 1.2);

    private int Balls => rows * ((2 * widest) - rows + 1) / 2;

    public override (double X, double Y)? Flat(in Vector3D v, int body) => (v.X, v.Y);

    private protected override SceneBuilder Begin()
    {
        BodySpec ball = new(Radius, 1, Restitution, friction: Friction, rollingResistance: Resistance);
        SceneBuilder builder = new SceneBuilder(Name).AddPlane("floor", Vector3D.Up, 0.0)
            .AddPlane("west", new Vector3D(1, 0, 0), -widest * Radius).AddPlane("east", new Vector3D(-1, 0, 0), -widest * Radius);
        double rise = Math.BitIncrement(Math.Sqrt(3) * Radius);
        for (int row = 0; row < rows; row++)
        {
            for (int n = 0; n < widest - row; n++)
            {
                double x = ((2 * n) - (widest - row - 1)) * Radius;
                builder.AddBody(FormattableString.Invariant($"ball {row + 1}.{n + 1}"), ball, new Vector3D(x, Radius + (row * rise), 0));
            }
        }

        return builder;
    }
}
