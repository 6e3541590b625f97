using System;
using LagSim.Scenes;

namespace LagSim.Harness.Verification.References;

/// <summary>
/// An ellipse with a semi-major axis of 1 m about a centre of attraction at the origin, starting at its far end, by Kepler's equation.
/// </summary>
/// <param name="e">The eccentricity, from 0 to below 1.</param>
/// <param name="period">The period, in seconds.</param>
internal sealed class KeplerOrbit(double e, double period)
{
    /// <summary>The eccentricity.</summary>
    internal double E => e;

    /// <summary>The mean motion in radians a second.</summary>
    internal double Motion { get; } = 2 * Math.PI / period;

    /// <summary>The gravitational parameter of the centre, m^3/s^2.</summary>
    internal double Mu => Motion * Motion;

    /// <summary>The attraction.</summary>
    internal Force Pull => Force.Central("sun", Vector3D.Zero, Mu);

    /// <summary>The velocity at the far end, where it starts.</summary>
    internal Vector3D StartVelocity => new(0, -Motion * Math.Sqrt((1 - e) / (1 + e)), 0);

    /// <summary>Returns the position of the body.</summary>
    internal Vector3D Position(double seconds)
    {
        double mean = Math.PI + (Motion * seconds), anomaly = mean;
        double low = mean - e, high = mean + e;
        for (int n = 0; n < 100; n++)
        {
            anomaly = 0.5 * (low + high); // bisection, since Newton's method has its own troubles at 0.999
            (low, high) = anomaly - (e * Math.Sin(anomaly)) < mean ? (anomaly, high) : (low, anomaly);
        }

        return new Vector3D(Math.Cos(anomaly) - e, Math.Sqrt(1 - (e * e)) * Math.Sin(anomaly), 0);
    }

    /// <summary>Returns the speed at a distance from the centre, in m/s.</summary>
    internal double SpeedAt(double distance) => Math.Sqrt(Mu * ((2 / distance) - 1));
}
