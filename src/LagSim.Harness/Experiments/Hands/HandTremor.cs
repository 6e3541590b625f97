using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Experiments.Hands;

/// <summary>The tremor of a hand and the noise of its tracker: noise around 10 Hz, 0.3 mm rms along each axis.</summary>
/// <remarks>A resonance of second order, x(n) = 2 r cos(2 pi 10 / 120) x(n-1) - r^2 x(n-2) + noise, with r = 0.95.</remarks>
internal sealed class HandTremor
{
    private const double Rms = 0.0003;
    private const double Radius = 0.95;
    private const double CosineOfStep = 0.86602540378443865; // 10 Hz of 120 are 30 degrees
    private const double A1 = 2 * Radius * CosineOfStep;
    private const double A2 = -Radius * Radius;
    private const int SettlingSamples = 200;

    // The variance of the recursion for noise of variance 1: (1 - a2) / ((1 + a2) ((1 - a2)^2 - a1^2)).
    private const double Variance = (1 - A2) / ((1 + A2) * (((1 - A2) * (1 - A2)) - (A1 * A1)));

    private readonly SeededRandom luck;
    private readonly double scale = Rms / System.Math.Sqrt(Variance);
    private Vector3D last;
    private Vector3D beforeLast;

    internal HandTremor(SeededRandom luck)
    {
        this.luck = luck;
        for (int n = 0; n < SettlingSamples; n++)
        {
            Next();
        }
    }

    internal Vector3D Next()
    {
        Vector3D noise = new(luck.NextGaussian(), luck.NextGaussian(), luck.NextGaussian());
        Vector3D next = (A1 * last) + (A2 * beforeLast) + (noise * scale);
        beforeLast = last;
        last = next;
        return next;
    }
}
