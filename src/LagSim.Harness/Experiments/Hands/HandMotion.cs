using System;
using System.Collections.Generic;
using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Hands;

/// <summary>
/// The positions of a hand, 120 times a second, as a headset's tracker gives them. The ground truth of predictions.
/// </summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public sealed class HandMotion
{
    /// <summary>The sample rate of every motion, in Hz: that of present headsets.</summary>
    public const int RateHertz = 120;

    private readonly Vector3D[] positions;

    /// <summary>Creates a motion from samples.</summary>
    /// <param name="name">The name: <c>slow</c>, <c>random</c> or a file.</param>
    /// <param name="positions">Metres, one each 1/120 s, the first at time 0; at least one, all finite.</param>
    /// <exception cref="ArgumentException">There is no sample, or one is not finite.</exception>
    public HandMotion(string name, IReadOnlyList<Vector3D> positions)
    {
        ArgumentException.ThrowIfNullOrEmpty(name);
        ArgumentNullException.ThrowIfNull(positions);
        if (positions.Count == 0)
        {
            throw new ArgumentException($"The hand motion '{name}' has no sample.", nameof(positions));
        }

        this.positions = new Vector3D[positions.Count];
        for (int n = 0; n < positions.Count; n++)
        {
            this.positions[n] = positions[n].IsFinite
                ? positions[n]
                : throw new ArgumentException($"Sample {n} of the hand motion '{name}' is {positions[n]}; every component must be finite.", nameof(positions));
        }

        Name = name;
    }

    /// <summary>The name.</summary>
    public string Name { get; }

    /// <summary>The number of samples.</summary>
    public int Count => positions.Length;

    /// <summary>The duration from the first sample to the last, in seconds.</summary>
    public double Seconds => (Count - 1) / (double)RateHertz;

    /// <summary>Returns the position at sample <paramref name="n"/>, in metres.</summary>
    public Vector3D PositionAt(int n) => positions[n];

    /// <summary>
    /// Returns the velocity at sample <paramref name="n"/>, as measured from the sample before, in m/s.
    /// </summary>
    public Vector3D VelocityAt(int n) => n == 0 ? Vector3D.Zero : (positions[n] - positions[n - 1]) * RateHertz;

    /// <summary>The largest acceleration, m/s^2, from second differences; 0 with fewer than three samples.</summary>
    public double LargestAcceleration()
    {
        double largest = 0;
        for (int n = 2; n < Count; n++)
        {
            largest = Math.Max(largest, (VelocityAt(n) - VelocityAt(n - 1)).Length * RateHertz);
        }

        return largest;
    }
}
