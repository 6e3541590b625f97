using System;
using System.Globalization;
using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.SceneFiles;

/// <summary>Equal elastic balls in a periodic box, with the same density everywhere and no edge, whatever their number.</summary>
/// <remarks>
/// They start on a lattice and forget it after a few impacts each. At a volume fraction of 0.2 each has about five impacts a second: in a
/// gas of hard spheres of diameter d and mean speed v, the rate is sqrt(2) pi d^2 v n times the contact value of the pair correlation, (1 -
/// f/2) / (1 - f)^3 (Carnahan and Starling).
/// </remarks>
internal static class GasScene
{
    internal const double Radius = 0.05;
    internal const double HighestFraction = 0.5;

    private const double SpeedDeviation = 0.105; // m/s along each axis: a mean speed of 0.167 m/s
    private const ulong Seed = 1;

    internal static Scene Build(int bodies, double fraction)
    {
        double side = Math.Round(2 * Radius * Math.Cbrt(bodies * Math.PI / 6 / fraction), 9);
        int cells = 1;
        while ((long)cells * cells * cells < bodies)
        {
            cells++;
        }

        SceneBuilder builder = new SceneBuilder(string.Create(CultureInfo.InvariantCulture, $"gas-{bodies}"))
            .WithGravity(Vector3D.Zero)
            .WithPeriodicBox(new Vector3D(side, side, side));
        SeededRandom speeds = new(Seed);
        BodySpec ball = new(Radius, 1, 1);
        long all = (long)cells * cells * cells;
        double cell = side / cells;
        for (int n = 0; n < bodies; n++)
        {
            long at = n * all / bodies;
            Vector3D place = new Vector3D((at % cells) + 0.5, (at / cells % cells) + 0.5, (at / cells / cells) + 0.5) * cell;
            Vector3D velocity = new Vector3D(speeds.NextGaussian(), speeds.NextGaussian(), speeds.NextGaussian()) * SpeedDeviation;
            builder.AddBody($"ball {n + 1}", ball, place, velocity);
        }

        return builder.Build();
    }
}
