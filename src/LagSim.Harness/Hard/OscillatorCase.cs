using System;
using System.Collections.Generic;
using LagSim.Harness.Forces;
using LagSim.Scenes;
using LagSim.Time;
using static LagSim.Harness.Hard.HardWorlds;

namespace LagSim.Harness.Hard;

/// <summary>A harmonic oscillator: the classical method changes its amplitude by a factor that theory knows, and is stable up to omega h = 2.828.</summary>
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
            Scene scene = Floating("oscillator").AddForce(Force.Supplied(new LinearSpring(z / Step))).AddBody("ball", Stepped(Step, 0.01), V(1)).Build();
            Simulation simulation = context.Simulate(scene);
            simulation.AdvanceTo(SimTime.FromSeconds(steps * Step));
            BodyState state = Read(simulation, 0, steps * Step);
            yield return Row(z, steps, state.Position, state.Velocity);
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        foreach ((double z, int steps) in new[] { (0.25, 2000), (2.8, 100) })
        {
            (Vector3D x, Vector3D v) = ClassicalRungeKutta.Run(
                ClassicalRungeKutta.ThesisStep, ClassicalRungeKutta.Of(new LinearSpring(z / Step)), V(1), default, Step, steps);
            yield return Row(z, steps, x, v) with { Note = "the thesis's update of the position" };
        }
    }

    private HardRow Row(double z, int steps, Vector3D x, Vector3D v)
    {
        double omega = z / Step;
        double amplitude = Math.Sqrt(x.LengthSquared + (v.LengthSquared / (omega * omega)));
        double factor = Math.Sqrt(1 - (Math.Pow(z, 6) / 72) + (Math.Pow(z, 8) / 576));
        double expected = Math.Pow(factor, steps);
        double stages = 1 + (z * (1 + (z / 2 * (1 + (z / 3 * (1 + (z / 4)))))));
        return new HardRow(
            Name, FormattableString.Invariant($"omega h = {z}, {steps:N0} steps"), Math.Abs((amplitude / expected) - 1), "amplitude_relative",
            40 * stages / factor * Rounding.Walk(steps) * Math.Sqrt(3),
            "a walk of one rounding a step of the size of the stages, 1 + z + z^2/2 + z^3/6 + z^4/24, magnified by the 31 that the quintic's coefficients add to, and 9 for the rest",
            "factor sqrt(1 - z^6/72 + z^8/576) a step")
        {
            Note = FormattableString.Invariant($"the factor is {factor:R} a step"),
        };
    }
}
