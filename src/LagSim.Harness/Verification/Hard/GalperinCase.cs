using System;
using System.Collections.Generic;
using LagSim.Scenes;
using LagSim.Time;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>Galperin's billiard: two balls and a wall count the digits of pi.</summary>
internal sealed class GalperinCase : IHardCase
{
    private static readonly int[] Digits = [3, 31, 314, 3141, 31_415, 314_159, 3_141_592];

    public string Name => "galperin";

    public string Title => "Galperin's billiard: a mass ratio of 100^k gives the first k + 1 digits of pi as the number of impacts";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        for (int k = 0; k <= context.Size(3, 6); k++)
        {
            (long count, double energy) = Count(context, Math.Pow(100, k), 1, Digits[k]);
            yield return CountRow(k, count);
            yield return EnergyRow(k, energy);
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        (long count, double energy) = Count(context, 1e4, 0.99, Digits[2]);
        yield return CountRow(2, count) with { Note = "restitution 0.99" };
        yield return EnergyRow(2, energy) with { Note = "restitution 0.99" };
        yield return CountRow(3, Count(context, 1.001e6, 1, Digits[3]).Count) with { Note = "mass ratio 0.1 % too large" };
    }

    private HardRow CountRow(int k, long count) => new(
        Name, FormattableString.Invariant($"mass ratio 100^{k}"), Math.Abs(count - Digits[k]), "count", 0,
        "a count is right or wrong: 10^k pi is nowhere near a whole number for these k, so rounding has no part in it",
            "the digits of pi (Galperin, Playing pool with pi, 2003)")
    {
        Note = FormattableString.Invariant($"{count:N0} impacts"),
    };

    private HardRow EnergyRow(int k, double energy) => new(
        Name, FormattableString.Invariant($"mass ratio 100^{k}"), Math.Abs(energy - 1), "energy_relative",
            ((2.0 * Rounding.PerContact * Digits[k]) + 8) * Rounding.Unit,
        "twice 8 roundings of the speed an impact, added: one impact is like the next, so their roundings are not independent", "the energy at the start");

    private static (long Count, double Energy) Count(HardContext context, double ratio, double e, int expected)
    {
        Scene scene = Floating("galperin").AddPlane("wall", V(1), V(0)).AddBody("small", Ball(e: e), V(1.5)).AddBody("big", Ball(mass: ratio, e: e), V(3),
            V(-1)).Build();
        Simulation simulation = context.Simulate(scene);
        SimTime end = SimTime.FromSeconds(1000);
        long some;
        do
        {
            some = 20_000; // most impacts happen within a moment, so progress is by their number
            context.Report(Math.Min(1, simulation.ImpactsProcessed / (double)expected));
        }
        while (!simulation.TryAdvanceTo(end, ref some));

        double energy = 0.5 * (Read(simulation, 0, 1000).Velocity.LengthSquared + (ratio * Read(simulation, 1, 1000).Velocity.LengthSquared));
        return (simulation.ImpactsProcessed, energy / (0.5 * ratio));
    }
}
