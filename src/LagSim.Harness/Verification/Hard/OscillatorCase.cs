using System;
using System.Collections.Generic;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// A harmonic oscillator. The classical method changes its amplitude by a factor known from theory, and is stable up to omega h = 2.828.
/// </summary>
internal sealed class OscillatorCase : IHardCase
{
    private const double Step = 1.0 / 32;

    public string Name => "oscillator";

    public string Title => "a harmonic oscillator on Runge-Kutta steps: the amplitude that theory gives, up to the edge of stability";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach ((double z, int steps) in context.Sizes([(0.25, 2000), (2.8, 100)],
            [(1.0 / 16, 100_000), (0.25, 100_000), (1, 10_000), (2, 500), (2.8, 1000), (2.828, 1000)]))
        {
            // The engine knows the rate of the library's own spring, and halves a step above 2.785. It follows a user-defined one to the
            // edge.
            bool isHalved = z > RungeKutta4.MaxRateTimesStep;
            yield return Row(z, steps, isHalved ? 2 : 1, Run(context, Spring(z), steps));
            if (isHalved)
            {
                yield return Row(z, steps, 1, Run(context, Force.Supplied(new SuppliedForce(Spring(z))), steps));
            }
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        foreach ((double z, int steps) in new[] { (0.25, 2000), (2.8, 100) })
        {
            yield return Row(z, steps, 1, ClassicalRungeKutta.Run(ClassicalRungeKutta.ThesisStep, ClassicalRungeKutta.Of(Spring(z)), V(1), default, Step, steps)) with
            {
                Note = "the thesis's update of the position",
            };
        }
    }

    /// <summary>A spring whose angular frequency times the step is z.</summary>
    private static Force Spring(double z) => Force.Spring("spring", default, z / Step * (z / Step));

    /// <summary>Returns position and velocity after a number of steps.</summary>
    private static (Vector3D X, Vector3D V) Run(HardContext context, Force spring, int steps)
    {
        Scene scene = Floating("oscillator").AddForce(spring).AddBody("ball", HardFlight.Steps(Step).Ball(0.01), V(1)).Build();
        Simulation simulation = context.Simulate(scene);
        simulation.AdvanceTo(SimTime.FromSeconds(steps * Step));
        BodyState state = Read(simulation, 0, steps * Step);
        return (state.Position, state.Velocity);
    }

    private HardRow Row(double whole, int steps, int parts, (Vector3D X, Vector3D V) end)
    {
        double omega = whole / Step, z = whole / parts;
        double amplitude = Math.Sqrt(end.X.LengthSquared + (end.V.LengthSquared / (omega * omega)));
        double factor = Math.Sqrt(1 - (Math.Pow(z, 6) / 72) + (Math.Pow(z, 8) / 576));
        double expected = Math.Pow(factor, steps * parts);
        double stages = 1 + (z * (1 + (z / 2 * (1 + (z / 3 * (1 + (z / 4)))))));
        return new HardRow(
            Name, FormattableString.Invariant($"omega h = {whole}, {steps:N0} steps{(parts > 1 ? ", which the engine halves" : "")}"),
            Math.Abs((amplitude / expected) - 1), "amplitude_relative",
            HardFlight.RoundingsAPiece * stages / factor * Rounding.Walk(steps * parts) * Math.Sqrt(3),
            "a walk of one rounding a step of the size of the stages, 1 + z + z^2/2 + z^3/6 + z^4/24, magnified by the 31 that the quintic's coefficients add to, and 9 for the rest",
            "factor sqrt(1 - z^6/72 + z^8/576) a step")
        {
            Note = FormattableString.Invariant($"the factor is {factor:R} a step"),
        };
    }
}
