using System;
using LagSim.Scenes;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>Where a hand is, as a function of time drawn by a seed: slowly to and fro, or in reaches from one random place to the next, each with a tremor.</summary>
internal sealed class HandMotion
{
    private const double Tremor = 0.0005; // m, at 9 Hz

    private readonly (double Amplitude, double Hertz, double Phase)[] slow = new (double, double, double)[9];
    private readonly Vector3D[] places = new Vector3D[400];
    private readonly double[] arrivals = new double[400]; // when it gets there; from then on it goes to the next
    private readonly bool isSlow;

    internal HandMotion(int seed, bool isSlow)
    {
        Random random = new(seed);
        this.isSlow = isSlow;
        for (int i = 0; i < slow.Length; i++)
        {
            slow[i] = (0.05 + (0.15 * random.NextDouble()), 0.05 + (0.35 * random.NextDouble()), random.NextDouble() * 2 * Math.PI);
        }

        for (int i = 1; i < places.Length; i++)
        {
            places[i] = V((random.NextDouble() - 0.5) * 0.6, (random.NextDouble() - 0.5) * 0.6, (random.NextDouble() - 0.5) * 0.6);
            arrivals[i] = arrivals[i - 1] + 0.4 + (0.8 * random.NextDouble());
        }
    }

    internal Vector3D At(double t)
    {
        double shake = Tremor * Math.Sin(2 * Math.PI * 9 * t);
        Vector3D about = V(shake, -shake, shake);
        if (isSlow)
        {
            return about + V(Sum(0, t), Sum(3, t), Sum(6, t));
        }

        int next = Array.FindIndex(arrivals, arrival => arrival > t);
        double s = (t - arrivals[next - 1]) / (arrivals[next] - arrivals[next - 1]);
        return about + places[next - 1] + ((places[next] - places[next - 1]) * (s * s * s * (10 + (s * (-15 + (6 * s)))))); // least jerk, as people reach
    }

    private double Sum(int first, double t)
    {
        double sum = 0;
        for (int i = first; i < first + 3; i++)
        {
            sum += slow[i].Amplitude * Math.Sin((2 * Math.PI * slow[i].Hertz * t) + slow[i].Phase);
        }

        return sum;
    }
}
