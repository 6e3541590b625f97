using System;
using System.Collections.Generic;
using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Hands;

/// <summary>
/// Where a hand was, 120 times a second: what a headset's tracker gives, and the truth that a prediction is held against.
/// </summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public sealed class HandMotion
{
    /// <summary>Samples a second, of every motion: that of a present headset.</summary>
    public const int RateHertz = 120;

    private readonly Vector3D[] positions;

    /// <summary>A motion of these samples.</summary>
    /// <param name="name">What it is called: <c>slow</c>, <c>random</c> or a file.</param>
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

    /// <summary>What it is called.</summary>
    public string Name { get; }

    /// <summary>How many samples there are.</summary>
    public int Count => positions.Length;

    /// <summary>How long it lasts, in seconds, from the first sample to the last.</summary>
    public double Seconds => (Count - 1) / (double)RateHertz;

    /// <summary>Where the hand was at sample <paramref name="n"/>, in metres.</summary>
    public Vector3D PositionAt(int n) => positions[n];

    /// <summary>
    /// How fast it seemed to move at sample <paramref name="n"/> to who knows nothing later: the way since the sample before; m/s.
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
