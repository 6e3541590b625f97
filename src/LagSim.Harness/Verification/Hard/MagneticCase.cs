using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// A force across the velocity, of a magnetic field or of a spin. The path is a helix, which drifts with gravity as it would in an electric
/// field. The speed must not decay.
/// </summary>
/// <remarks>
/// The classical method turns the velocity, less its drift, by R(iz) a step, z = omega h: |R| = sqrt(1 - z^6/72 + z^8/576), its argument z
/// less z^5/120 and smaller terms. It conserves v - x cross omega, which is linear, so the error of the position is that of the velocity
/// over omega.
/// </remarks>
internal sealed class MagneticCase : IHardCase
{
    private const double Step = 1.0 / 64;

    private static readonly Vector3D Start = V(3, 0, 0.5);

    public string Name => "magnetic";

    public string Title => "a magnetic or Magnus force (v x omega), alone and with gravity, by every law";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach (bool isMagnus in new[] { false, true })
        {
            foreach ((HardFlight flight, double omega, double seconds) in Flights(context).Where(f => !isMagnus || f.Flight.Step == 0))
            {
                foreach (double gravity in new[] { 0, Gravity })
                {
                    foreach (HardRow row in RowsOf(context, flight, isMagnus, omega, seconds, gravity))
                    {
                        yield return row;
                    }
                }
            }
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        const double omega = 0.1 / Step;
        HardFlight steps = HardFlight.Steps(Step);
        foreach (double gravity in new[] { 0, Gravity })
        {
            (Vector3D x, Vector3D v) end = ClassicalRungeKutta.Run(
                ClassicalRungeKutta.Midpoint, ClassicalRungeKutta.Of(Across(false, omega, out _), V(0, -gravity)), default, Start, Step, 1000);
            foreach (HardRow row in RowsOf(steps, "field, ", omega, 1000 * Step, gravity, 1000, end.x, end.v))
            {
                yield return row with { Note = "the midpoint method" };
            }
        }

        // A classical method in place of the other laws must exceed their bounds.
        foreach (HardFlight flight in new[] { HardFlight.Closed(0), HardFlight.Controlled(1e-9) })
        {
            (Vector3D x, Vector3D v) end = ClassicalRungeKutta.Run(
                ClassicalRungeKutta.Step, ClassicalRungeKutta.Of(Across(false, omega, out _)), default, Start, Step, 640);
            foreach (HardRow row in RowsOf(flight, "field, ", omega, 10, 0, 640, end.x, end.v))
            {
                yield return row with { Note = "the classical method in its place" };
            }
        }
    }

    private static IEnumerable<(HardFlight Flight, double Omega, double Seconds)> Flights(HardContext context) =>
        context.Sizes([(0.1, 1000)], [(0.02, 100_000), (0.1, 10_000), (0.5, 1000)]).Select(s => (HardFlight.Steps(Step), s.Item1 / Step, s.Item2 * Step))
            .Concat(context.Sizes([(0.0, 10)], [(0, 100), (1e-9, 100.0)]).Select(s => (HardFlight.Closed(s.Item1), 2 * Math.PI, s.Item2)))
            .Concat(context.Sizes([(1e-9, 10.0)], [(1e-6, 100), (1e-9, 100), (1e-12, 100.0)]).Select(s => (HardFlight.Controlled(s.Item1), 2 * Math.PI, s.Item2)));

    /// <summary>Returns the force that gives 1 kg the acceleration v x omega about z: a field, or one that needs a spin.</summary>
    private static Force Across(bool isMagnus, double omega, out Vector3D spin)
    {
        spin = isMagnus ? V(0, 0, -2 * omega) : Vector3D.Zero;
        return isMagnus ? Force.Magnus("curve", 0.5) : Force.Magnetic("field", V(0, 0, omega), 1);
    }

    private IEnumerable<HardRow> RowsOf(HardContext context, HardFlight flight, bool isMagnus, double omega, double seconds, double gravity)
    {
        Force across = Across(isMagnus, omega, out Vector3D spin);
        Scene scene = new SceneBuilder("gyration").WithGravity(V(0, -gravity)).AddForce(across).AddBody("ball", flight.Ball(0.01), default, Start, spin: spin)
            .Build();
        Simulation simulation = context.Simulate(scene);
        simulation.AdvanceTo(Time.SimTime.FromSeconds(seconds));
        BodyState state = Read(simulation, 0, seconds);
        return RowsOf(flight, isMagnus ? "spin, " : "field, ", omega, seconds, gravity, (int)simulation.EventsProcessed, state.Position, state.Velocity);
    }

    private IEnumerable<HardRow> RowsOf(HardFlight flight, string by, double omega, double t, double gravity, int pieces, Vector3D x, Vector3D v)
    {
        double angle = omega * t;
        Vector3D drift = V(-gravity / omega); // a = g + v x omega vanishes on it
        Vector3D turning = Start - drift;
        double across = Math.Sqrt((turning.X * turning.X) + (turning.Y * turning.Y));
        double cos = Math.Cos(angle), sin = Math.Sin(angle); // v' = v x omega turns clockwise about z
        Vector3D place = (drift * t) + V(((turning.X * sin) + (turning.Y * (1 - cos))) / omega, ((turning.Y * sin) - (turning.X * (1 - cos))) / omega,
            turning.Z * t);
        double seen = Math.Sqrt(Math.Pow(v.X - drift.X, 2) + Math.Pow(v.Y - drift.Y, 2));
        double speed = Math.Abs((seen / across) - 1), off = (x - place).Length, radius = across / omega;
        string size = FormattableString.Invariant(
            $"{by}{(gravity > 0 ? "gravity, " : "")}{(flight.Step > 0 ? FormattableString.Invariant($"omega h = {omega * flight.Step}, {t / flight.Step:N0} steps") : FormattableString.Invariant($"{angle / (2 * Math.PI):0.#} turns, {flight.Text}"))}");
        const string works = "v x omega does no work: the speed beside the drift stays", curve = "circle and drift in closed form";
        if (flight.Step > 0)
        {
            double z = omega * flight.Step, steps = t / flight.Step;
            double loss = 1 - Math.Pow(1 - (Math.Pow(z, 6) / 72) + (Math.Pow(z, 8) / 576), steps / 2.0);
            double rounding = 40 * Rounding.Walk(steps) * (1 + (drift.Length / across)), phase = steps * Math.Pow(z, 5) / 120;
            yield return new HardRow(
                Name, size, speed, "speed_relative", loss + rounding,
                "the method's own loss, 1 - (1 - z^6/72 + z^8/576)^(n/2), and a walk of 40 roundings a step", works);
            yield return new HardRow(
                Name, size, off, "position_m", (radius * (phase + loss)) + (rounding * radius) + (40 * Rounding.Walk(steps) * (place.Length + radius)),
                "radius x (n z^5/120 of phase and the loss of speed), and a walk of 40 roundings a step of the place", curve);
            yield break;
        }

        // An error of a segment in velocity rotates with it, and moves the position by at most that over omega. The textbook's angle has
        // its own roundings.
        double fast = flight.ErrorOf(pieces, Start.Length + (2 * drift.Length)), far = flight.ErrorOf(pieces, place.Length + (2 * radius));
        yield return new HardRow(Name, size, speed, "speed_relative", fast / across, flight.Argument + ", none of it magnified", works);
        yield return new HardRow(
            Name, size, off, "position_m", far + (2 * fast / omega) + (4 * Rounding.Unit * angle * radius),
            flight.Argument + "; that of the speed over omega; 4 roundings of the angle, which is the reference's", curve);
    }
}
