using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// A line of elastic balls of unequal masses. Each passes on the speed of the closed form, and momentum and energy are conserved.
/// </summary>
internal sealed class MassChainCase : IHardCase
{
    public string Name => "mass-chain";

    public string Title => "a line of elastic balls whose masses differ by up to 1e12: what reaches the last, momentum and energy";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach ((string what, double[] masses) in Chains())
        {
            Chain chain = new(masses);
            foreach (HardRow row in RowsOf(what, chain, chain.Run(context, 1)))
            {
                yield return row;
            }
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        Chain chain = new([1, 1000, 1e6]);
        (double last, double momentum, double energy, int impacts) = chain.Run(context, 1);
        foreach (HardRow row in RowsOf("1 to 1e6 kg in 3 balls", chain,
            ((float)last, momentum - (chain.LargestMomentum * 1e-8), (float)energy + 1e-8, impacts)))
        {
            yield return row with { Note = "as single precision would have it" };
        }

        foreach (HardRow row in RowsOf("1 to 1e6 kg in 3 balls", chain, chain.Run(context, 1 - 1e-9))
            .Where(row => !row.ErrorKind.StartsWith("momentum", StringComparison.Ordinal)))
        {
            yield return row with { Note = "restitution 1 - 1e-9" };
        }
    }

    private static IEnumerable<(string What, double[] Masses)> Chains()
    {
        yield return ("equal, 10 balls", Enumerable.Repeat(1.0, 10).ToArray());
        yield return ("1 to 1e12 kg in 2 balls", [1, 1e12]);
        yield return ("1e12 to 1 kg in 2 balls", [1e12, 1]);
        yield return ("1 to 1e12 kg in 5 balls", [1, 1e3, 1e6, 1e9, 1e12]);
        yield return ("1e12 to 1 kg in 5 balls", [1e12, 1e9, 1e6, 1e3, 1]);
        yield return ("1e-6 to 1e6 kg in 13 balls", Enumerable.Range(0, 13).Select(n => Math.Pow(10, n - 6)).ToArray());
    }

    private IEnumerable<HardRow> RowsOf(string what, Chain chain, (double Last, double Momentum, double Energy, int Impacts) seen)
    {
        int hits = chain.Masses.Length - 1;
        yield return new HardRow(
            Name, what, Math.Abs((seen.Last / chain.Expected) - 1), "speed_relative", Rounding.PerContact * hits * Rounding.Unit,
            "8 roundings a hit, added", "product of 2 m1/(m1 + m2), in decimal arithmetic");
        double ends = Rounding.PerContact * Rounding.Unit * seen.Impacts;
        yield return new HardRow(
            Name, what, Math.Abs(seen.Momentum - chain.Masses[0]) / chain.LargestMomentum, "momentum_over_largest", ends
                + (chain.Masses.Length * Rounding.Unit),
            "8 roundings of the largest momentum an impact, added, and the sum's own", "the first ball's momentum");
        yield return new HardRow(
            Name, what, Math.Abs((seen.Energy / (0.5 * chain.Masses[0])) - 1), "energy_relative", (2 * ends) + (4 * chain.Masses.Length * Rounding.Unit),
            "twice 8 roundings an impact, added, and the sum's own", "the first ball's energy");
    }

    /// <summary>Balls in a row that are struck one after the other, the first at 1 m/s.</summary>
    private sealed class Chain
    {
        private readonly double[] speeds;

        internal Chain(double[] masses)
        {
            Masses = masses;
            speeds = new double[masses.Length];
            decimal speed = 1, largest = (decimal)masses[0];
            speeds[0] = 1;
            for (int n = 1; n < masses.Length; n++)
            {
                speed *= 2 * (decimal)masses[n - 1] / ((decimal)masses[n - 1] + (decimal)masses[n]);
                speeds[n] = (double)speed;
                largest = Math.Max(largest, speed * (decimal)masses[n]);
            }

            Expected = (double)speed;
            LargestMomentum = (double)largest;
        }

        internal double[] Masses { get; }

        internal double Expected { get; }

        internal double LargestMomentum { get; }

        internal (double Last, double Momentum, double Energy, int Impacts) Run(HardContext context, double e)
        {
            SceneBuilder builder = Floating("chain");
            double at = 0, end = 1;
            for (int n = 0; n < Masses.Length; n++)
            {
                builder.AddBody($"ball {n}", Ball(mass: Masses[n], e: e), V(at), V(n == 0 ? 1 : 0));
                double gap = Math.Max(speeds[n] / 2, 1e-6); // half a second each, or the time in which a slow one moves a micrometre
                end += gap / speeds[n];
                at += 1 + gap;
            }

            Simulation simulation = context.Run(builder.Build(), end);
            double energy = Enumerable.Range(0, Masses.Length).Sum(n => 0.5 * Masses[n] * Read(simulation, n, end).Velocity.LengthSquared);
            double last = Impacts(simulation, BodyId.OfScene(Masses.Length - 1)).Select(entry => entry.State.Velocity.X).DefaultIfEmpty(double.NaN).First();
            return (last, Momentum(simulation, end).X, energy, (int)simulation.ImpactsProcessed);
        }
    }
}
