using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Verification.Hard;

/// <summary>A granular gas cools by Haff's law as long as it stays homogeneous.</summary>
/// <remarks>
/// An impact takes (1 - e^2) T from two spheres on average, since the square of the closing speed is 4T/m at contact. So T = T0 (1 +
/// t/tau)^-2 with 1/tau = (1 - e^2) f0/6, where f0 is Enskog's rate of impacts of a sphere at T0. The distribution of speeds departs from
/// Maxwell's a little, which speeds it up by 1 + 3/16 a2 (van Noije and Ernst 1998).
/// </remarks>
internal sealed class HaffCase : IHardCase
{
    public string Name => "haff";

    public string Title => "a granular gas before it clusters: Haff's law of cooling";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach (double e in context.Sizes([0.95], [0.98, 0.95, 0.9]))
        {
            foreach (HardRow row in RowsOf(context, e, e))
            {
                yield return row;
            }
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context) => RowsOf(context, 0.95, 0.96)
        .Select(row => row with { Note = "held against a restitution of 0.96" });

    private IEnumerable<HardRow> RowsOf(HardContext context, double e, double expected)
    {
        const double fraction = 0.1;
        int bodies = context.Size(729, 4096);
        Scene granular = EquilibriumGas.WithRestitution(EquilibriumGas.Settle(context, BuiltInScenes.Gas(bodies, fraction)), e);
        Simulation simulation = new(granular, new SimulationOptions(default, SimDuration.FromSeconds(1e-3), cancellation: context.Cancellation));
        double start = EquilibriumGas.Temperature(simulation, SimTime.Zero);
        double square = expected * expected;
        double excess = 16 * (1 - expected) * (1 - (2 * square)) / (81 - (17 * expected) + (30 * square * (1 - expected)));
        double rate = (1 - square) * EquilibriumGas.Frequency(fraction, start) / 6 * (1 + (3.0 / 16 * excess));
        foreach (double x in new[] { 0.5, 1 })
        {
            SimTime at = SimTime.FromSeconds(x / rate);
            while (simulation.SimulatedTo < at)
            {
                simulation.AdvanceTo(SimTime.Min(at, simulation.SimulatedTo + SimDuration.FromSeconds(0.1)));
                context.Report(0.2 + (0.8 * (simulation.SimulatedTo - SimTime.Zero).ToSeconds() * rate));
            }

            double law = 1 / ((1 + x) * (1 + x));
            double scatter = 2 * Math.Log(1 + x) / Math.Sqrt(simulation.ImpactsProcessed);
            yield return new HardRow(
                Name, FormattableString.Invariant($"{bodies:N0} spheres, e {e}, t = {x} tau, {simulation.ImpactsProcessed:N0} impacts"),
                Math.Abs((EquilibriumGas.Temperature(simulation, at) / start / law) - 1), "temperature_relative", (0.005 * 2 * x / (1 + x)) + (4 * scatter),
                "0.5 % of Enskog's rate, which is 2x/(1 + x) of that in the temperature, x = t/tau; and four times the scatter of what so many impacts take, ln(T0/T)/sqrt(n)",
                "T = T0 (1 + t/tau)^-2 (Haff 1983), with the second Sonine coefficient");
        }
    }
}
