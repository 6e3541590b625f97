using System;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Peers;

/// <summary>The instants of shared time at which peers are compared, at a fixed interval after the start.</summary>
/// <param name="Start">The start of the scene, which itself is not sampled.</param>
/// <param name="Interval">The interval between samples.</param>
/// <param name="Count">The number of samples.</param>
public readonly record struct SampleGrid(SimTime Start, SimDuration Interval, int Count)
{
    /// <summary>The n-th instant, counted from 0.</summary>
    public SimTime At(int n) => Start + (Interval * (n + 1));

    /// <summary>The number of the first instant after <paramref name="time"/>; <see cref="Count"/> if there is none.</summary>
    public int FirstAfter(SimTime time) =>
        time < Start ? 0 : (int)Math.Min(Count, (time - Start).Ticks / Interval.Ticks);
}
