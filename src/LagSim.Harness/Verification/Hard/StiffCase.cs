using System;
using System.Collections.Generic;
using LagSim.Scenes;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// A damped body whose step is as long as its decay, in flight and on a floor. It follows theory's factor where the method is stable, and
/// beyond that gets a refusal or smaller steps, never a silent explosion.
/// </summary>
internal sealed class StiffCase : IHardCase
{
    private const double Step = 1.0 / 64;
    private const int Steps = 50;

    /// <summary>The shortest step of bodies in persistent contact, and the number of steps from the middle of the second one on.</summary>
    private const double ShortestOnFloor = 1.0 / (1 << 20);
    private const int StepsOnFloor = 20;

    private const string OnFloor = ", on a floor";

    public string Name => "stiff";

    public string Title => "strong damping on Runge-Kutta steps: theory's decay up to k h = 2.785, beyond it a refusal or smaller steps; on a floor alike";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach (double z in context.Sizes([0.5, 2.7], [0.1, 0.5, 1, 2, 2.7]))
        {
            yield return DecayRow(z, Speed(context, z));
        }

        foreach (double z in context.Sizes([3.0], [3, 10, 100]))
        {
            yield return StableRow(z, Steps, () => Speed(context, z));
        }

        foreach (double z in context.Sizes([0.25, 0.9], [0.1, 0.25, 0.5, 0.9]))
        {
            yield return DecayRowOnFloor(z, DecayOnFloor(context, Force.LinearDrag("damping", z / ShortestOnFloor)));
        }

        foreach (double z in context.Sizes([3.0], [3, 10, 1000]))
        {
            yield return StableRow(z, StepsOnFloor, () => SpeedOnFloor(context, Force.QuadraticDrag("air", z / (2 * ShortestOnFloor)))) with { Size = FormattableString.Invariant($"k h = {z}, {StepsOnFloor} steps{OnFloor}") };
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        (_, Vector3D v) = Euler(0.5);
        yield return DecayRow(0.5, v.X) with { Note = "explicit Euler" };
        (_, v) = Euler(3);
        yield return GrowthRow(3, Steps, v.X) with { Note = "explicit Euler" };
        yield return DecayRowOnFloor(1, Heun(1)) with { Note = "half kicks, the second at the velocity that the first foretells" };
        yield return GrowthRow(3, StepsOnFloor, Heun(3)) with { Note = "half kicks, the second at the velocity that the first foretells" };
    }

    private static double Heun(double z) => Math.Pow(1 - z + (z * z / 2), StepsOnFloor);

    private static (Vector3D X, Vector3D V) Euler(double z) => ClassicalRungeKutta.Run(
        (f, t, x, v, h) => (x + (v * h), v + (f(t, x, v) * h)), ClassicalRungeKutta.Of(Damping(z)), default, V(1), Step, Steps);

    private static Force Damping(double z) => Force.LinearDrag("damping", z / Step);

    private static double Speed(HardContext context, double z)
    {
        Scene scene = Floating("damped").AddForce(Damping(z)).AddBody("ball", HardFlight.Steps(Step).Ball(), default, V(1)).Build();
        return Read(context.Run(scene, Steps * Step), 0, Steps * Step).Velocity.X;
    }

    private static double SpeedOnFloor(HardContext context, Force force) => ReadOnFloor(RunOnFloor(context, force), StepsOnFloor);

    /// <summary>
    /// Returns the slowdown from the middle of the second step to the middle of a number of steps later: a member's velocity is that of the
    /// middle.
    /// </summary>
    private static double DecayOnFloor(HardContext context, Force force)
    {
        Simulation simulation = RunOnFloor(context, force);
        return ReadOnFloor(simulation, StepsOnFloor + 1.5) / ReadOnFloor(simulation, 1.5);
    }

    private static double ReadOnFloor(Simulation simulation, double steps) => Read(simulation, 0, steps * ShortestOnFloor).Velocity.X;

    private static Simulation RunOnFloor(HardContext context, Force force)
    {
        Scene scene = new SceneBuilder("on a floor").AddPlane("floor", Vector3D.Up, Vector3D.Zero, 0).AddForce(force)
            .AddBody("ball", new BodySpec(0.5, 1, 0, forces: ForceSet.Of(0)), V(0, 0.5), V(1)).Build();
        return context.Run(scene, (StepsOnFloor + 2) * ShortestOnFloor);
    }

    /// <summary>The factor of the implicit midpoint rule.</summary>
    private HardRow DecayRowOnFloor(double z, double decay)
    {
        double factor = (1 - (z / 2)) / (1 + (z / 2));
        return new HardRow(
            Name, FormattableString.Invariant($"k h = {z}, {StepsOnFloor} steps{OnFloor}"),
                Math.Abs((decay / Math.Pow(factor, StepsOnFloor)) - 1), "speed_relative",
            10 * (1 + z) / (1 - (z / 2)) / factor * StepsOnFloor * Rounding.Unit,
            "five roundings a step of the size 1 + z, and as much where the iteration ends, over 1 - z/2 for what it multiplies, over the"
                + " factor",
            "factor (1 - z/2) / (1 + z/2) a step of 2^-20 s");
    }

    private HardRow DecayRow(double z, double speed)
    {
        double factor = 1 - (z * (1 - (z / 2 * (1 - (z / 3 * (1 - (z / 4)))))));
        double stages = 1 + (z * (1 + (z / 2 * (1 + (z / 3 * (1 + (z / 4)))))));
        double expected = Math.Pow(factor, Steps);
        return new HardRow(
            Name, FormattableString.Invariant($"k h = {z}, {Steps} steps"), Math.Abs((speed / expected) - 1), "speed_relative",
                40 * stages / Math.Abs(factor) * Steps * Rounding.Unit,
            "a rounding a step of the size of the stages, 1 + z + z^2/2 + z^3/6 + z^4/24, magnified by the 31 that the quintic's coefficients add to, and 9 for the rest, over the factor",
            "factor 1 - z + z^2/2 - z^3/6 + z^4/24 a step");
    }

    private HardRow StableRow(double z, int steps, Func<double> speed)
    {
        try
        {
            return GrowthRow(z, steps, speed());
        }
        catch (SceneException refusal)
        {
            return GrowthRow(z, steps, 0) with { Note = "refused: " + refusal.Message };
        }
        catch (SimulationException end)
        {
            // A stop by the limit of all speeds is no refusal: the message has to name the step.
            bool isRefusal = end.Message.Contains("step of", StringComparison.Ordinal) || end.Message.Contains("steps that follow", StringComparison.Ordinal);
            return GrowthRow(z, steps, isRefusal ? 0 : double.PositiveInfinity) with { Note = (isRefusal ? "refused: " : "blew up: ") + end.Message };
        }
    }

    private HardRow GrowthRow(double z, int steps, double speed) => new(
        Name, FormattableString.Invariant($"k h = {z}, {steps} steps"), Math.Abs(speed), "speed_over_start", 1,
        "damping alone never makes a body faster than it was; a refusal that says so counts as 0", "exp(-k t), which is below 1");
}
