using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>A ball that falls along a line against drag and bounces, bounce by bounce, by every motion law that applies.</summary>
internal abstract class DragCase : IHardCase
{
    private const double E = 0.9;
    private const double FallSeconds = 4;
    private const double ControlStep = 1.0 / 32;

    public abstract string Name { get; }

    public abstract string Title { get; }

    /// <summary>The height from which it bounces, in metres.</summary>
    protected abstract double Height { get; }

    /// <summary>The duration of the bounces.</summary>
    protected abstract double BounceSeconds { get; }

    /// <summary>The fraction by which the drag of the controls is off, for a fall and for bounces.</summary>
    protected abstract (double Fall, double Bounces) Wrong { get; }

    protected abstract string FallReference { get; }

    protected abstract string BounceReference { get; }

    /// <summary>The source of the bound of fixed steps, for a fall and for bounces.</summary>
    protected abstract (string Fall, string Bounces) StepArguments { get; }

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach (HardFlight flight in Flights(context))
        {
            yield return FallRow(context, flight, 1);
            yield return BounceRow(context, flight, 1);
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        foreach (HardFlight flight in Flights(context))
        {
            yield return FallRow(context, flight, 1 + Wrong.Fall) with { Note = FormattableString.Invariant($"drag off by {Wrong.Fall}") };
            yield return BounceRow(context, flight, 1 + Wrong.Bounces) with { Note = FormattableString.Invariant($"drag off by {Wrong.Bounces}") };
        }

        HardFlight steps = HardFlight.Steps(ControlStep);
        ClassicalRungeKutta.Acceleration falling = ClassicalRungeKutta.Of(Drag(1), V(0, -Gravity));
        double[] snapped = ClassicalRungeKutta.SnappedTimes(falling, V(0, Height), E, ControlStep, (int)(BounceSeconds / ControlStep));
        yield return BounceRow(steps, [.. snapped.Select(time => (time, 0))]) with { Note = "contacts moved to the end of their step" };
        (Vector3D x, _) = ClassicalRungeKutta.Run(ClassicalRungeKutta.ThesisStep, falling, default, default, ControlStep, (long)(FallSeconds / ControlStep));
        yield return FallRow(steps, x.Y, 0) with { Note = "the thesis's update of the position" };
    }

    /// <summary>Whether the library has a closed form of the flight.</summary>
    protected abstract bool HasClosedForm { get; }

    /// <summary>Returns the drag on 1 kg, scaled by a factor.</summary>
    protected abstract Force Drag(double factor);

    /// <summary>Returns the distance fallen from rest.</summary>
    protected abstract double Depth(double seconds);

    /// <summary>Returns the acceleration at a velocity, upwards.</summary>
    protected abstract double Acceleration(double v);

    /// <summary>Returns the next flight from a height, upwards at a speed or at rest, to height zero, and its highest position.</summary>
    protected abstract Hop Next(double height, double up);

    /// <summary>Returns the error of fixed steps in a fall.</summary>
    protected abstract double StepError(double step, double seconds);

    /// <summary>
    /// Returns the errors of fixed steps in position and speed after a flight, with the contact at its end found on the quintic of its
    /// step.
    /// </summary>
    protected abstract (double Place, double Speed) StepErrors(double step, Hop hop);

    /// <summary>The laws, steps and tolerances.</summary>
    private IEnumerable<HardFlight> Flights(HardContext context) =>
        context.Sizes([1.0 / 32], [1.0 / 16, 1.0 / 64, 1.0 / 256]).Select(HardFlight.Steps)
            .Concat(HasClosedForm ? context.Sizes([0.0], [0, 1e-9, 1e-6]).Select(HardFlight.Closed) : [])
            .Concat(context.Sizes([1e-9], [1e-6, 1e-9, 1e-12]).Select(HardFlight.Controlled));

    private HardRow FallRow(HardContext context, HardFlight flight, double factor)
    {
        Scene scene = new SceneBuilder("fall").AddForce(Drag(factor)).AddBody("ball", flight.Ball(), default).Build();
        Simulation simulation = context.Run(scene, FallSeconds);
        return FallRow(flight, Read(simulation, 0, FallSeconds).Position.Y, simulation.Timeline(First).Count);
    }

    private HardRow FallRow(HardFlight flight, double y, int pieces)
    {
        double depth = Depth(FallSeconds);
        bool isStepped = flight.Law == MotionLaw.RungeKutta4;
        double bound = isStepped
            ? StepError(flight.Step, FallSeconds) + (HardFlight.RoundingsAPiece * depth * Rounding.Unit * FallSeconds / flight.Step)
            : flight.ErrorOf(pieces, depth) * (1 + FallSeconds);
        return new HardRow(
            Name, FormattableString.Invariant($"falls {FallSeconds} s, {flight.Text}"), Math.Abs(y + depth), "position_m", bound,
            isStepped ? StepArguments.Fall + "; 40 roundings a step" : flight.Argument + "; that of the speed for 4 s, undamped", FallReference);
    }

    private HardRow BounceRow(HardContext context, HardFlight flight, double factor)
    {
        Scene scene = new SceneBuilder("bounce").AddPlane("floor", Vector3D.Up, V(0, -0.5)).AddForce(Drag(factor))
            .AddBody("ball", flight.Ball(e: E), V(0, Height)).Build();
        return BounceRow(flight, Hops(context.Run(scene, BounceSeconds), First));
    }

    private HardRow BounceRow(HardFlight flight, List<(double Time, int Pieces)> seen)
    {
        double t = 0, worst = 0, bound = 0, height = Height, up = 0;
        bool isStepped = flight.Law == MotionLaw.RungeKutta4;
        ErrorSources off = new();
        foreach ((double impact, int pieces) in seen)
        {
            Hop hop = Next(height, up);
            t += hop.Seconds;
            worst = Math.Max(worst, Math.Abs(impact - t));
            off.Fly(up, Acceleration(up), -hop.Speed, Acceleration(-hop.Speed));
            double each = flight.ErrorOf(pieces, 2 * Height);
            (double place, double speed) = isStepped ? StepErrors(flight.Step, hop) : (each * (1 + hop.Seconds), each);
            off.Add(place + (isStepped ? HardFlight.RoundingsAPiece * 2 * Height * Rounding.Unit * hop.Seconds / flight.Step : 0), 0);
            off.Add(0, speed);
            bound = Math.Max(bound, off.Delay(hop.Speed) + Rounding.Tick);
            off.Bounce(E, -hop.Speed, Acceleration(-hop.Speed), Acceleration(E * hop.Speed));
            (height, up) = (0, E * hop.Speed);
        }

        return new HardRow(
            Name, FormattableString.Invariant($"{seen.Count} bounces, {flight.Text}"), seen.Count >= 4 ? worst : double.NaN, "time_s", bound,
            (isStepped ? StepArguments.Bounces : flight.Argument) + ", passed on through the contacts by their saltation, over the speed; and a "
                + "tick", BounceReference);
    }

    /// <summary>A flight from one bounce to the next.</summary>
    /// <param name="Seconds">The duration, in seconds.</param>
    /// <param name="Up">The upward speed at the start, in m/s.</param>
    /// <param name="Speed">The downward speed at the end, in m/s.</param>
    protected readonly record struct Hop(double Seconds, double Up, double Speed);
}
