using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Verification.References;
using LagSim.Scenes;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// A spring with a damper, from none to far beyond the critical one, and stiff ones, against exponentials, in closed form and under error
/// control.
/// </summary>
/// <remarks>
/// With the energy (v^2 + kappa x^2)/2 as a measure of distance no error grows, whatever the damping: an error of dx in position and dv in
/// velocity never moves the position by more than dx + dv/sqrt(kappa).
/// </remarks>
internal sealed class SpringCase : IHardCase
{
    private const double Stiff = 1e4; // rad/s

    public string Name => "spring";

    public string Title => "a spring with a damper below, at and above the critical one, and stiff ones, in closed form and under error control";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach ((double omega, double ratio, double seconds) in Springs(context))
        {
            foreach (HardFlight flight in Flights(context))
            {
                yield return Row(context, flight, omega, ratio, seconds, 1);
            }
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        foreach (HardFlight flight in Flights(context))
        {
            yield return Row(context, flight, 3, 0.1, 4, 1 + 1e-3) with { Note = "a spring that is a thousandth too strong" };
        }
    }

    private static IEnumerable<HardFlight> Flights(HardContext context) =>
        context.Sizes([0.0], [0, 1e-9]).Select(HardFlight.Closed).Concat(context.Sizes([1e-9], [1e-6, 1e-9, 1e-12]).Select(HardFlight.Controlled));

    /// <summary>The angular frequency without damping, the damping relative to critical, and the duration.</summary>
    private static (double Omega, double Ratio, double Seconds)[] Springs(HardContext context) => context.Sizes(
        [(3, 0, 4), (3, 1, 4), (Stiff, 0.1, 0.01)],
        [(3, 0, 32), (3, 0.1, 4), (3, 1, 4), (3, 3, 4), (3, 100, 4), (Stiff, 0, 0.1), (Stiff, 1, 0.1), (3, 1e4, 4.0)]);

    private HardRow Row(HardContext context, HardFlight flight, double omega, double ratio, double seconds, double factor)
    {
        const double start = 1;
        double kappa = omega * omega, gamma = 2 * ratio * omega, push = 0.5 * omega;
        Scene scene = Floating("spring").AddForce(Force.Spring("spring", V(2), kappa * factor, gamma))
            .AddBody("ball", flight.Ball(0.01), V(2 + start), V(push)).Build();
        Simulation simulation = context.Simulate(scene);
        DampedOscillator exact = new(gamma, kappa);
        double worst = 0;
        for (int n = 1; n <= 16; n++)
        {
            double t = seconds * n / 16;
            Time.SimTime at = Time.SimTime.FromSeconds(t);
            simulation.AdvanceTo(at);
            worst = Math.Max(worst, Math.Abs(Read(simulation, First, at).Position.X - 2 - exact.Place(start, push, at.ToSeconds())));
        }

        // The position is rounded by its coordinate, 2 plus its amplitude. The velocity is rounded by omega times the amplitude, which
        // counts the same once divided by omega.
        double amplitude = Math.Sqrt((start * start) + (push * push / kappa)), each = flight.ErrorOf((int)simulation.EventsProcessed, 0);
        double roundings = flight.ErrorOf((int)simulation.EventsProcessed, 2 + (2 * amplitude)) - each;
        double response = flight.Law == MotionLaw.ClosedForm ? 16 * Rounding.Unit * (gamma + omega) * seconds * amplitude : 0;
        return new HardRow(
            Name, FormattableString.Invariant($"{omega:N0} rad/s, damping {ratio:#,0.#} times the critical, {seconds} s, {flight.Text}"), worst, "position_m",
            (each * (1 + (1 / omega))) + roundings + response + (4 * Rounding.Unit * omega * seconds * amplitude),
            flight.Argument + (flight.Law == MotionLaw.ClosedForm ? "; the response's 8 units in the last place for each radian (LinearResponse)" : "")
                + "; 4 roundings of the reference's angle; no error grows in the norm of the energy",
            "exponentials, sine and cosine")
        {
            Note = FormattableString.Invariant($"{simulation.EventsProcessed} pieces"),
        };
    }
}
