using System;
using System.Collections.Generic;
using LagSim.Scenes;
using static LagSim.Harness.Hard.HardWorlds;

namespace LagSim.Harness.Hard;

/// <summary>
/// A damped body whose step is as long as its decay: theory's factor where the method is stable, and beyond that a refusal or smaller steps, never a silent
/// explosion.
/// </summary>
internal sealed class StiffCase : IHardCase
{
    private const double Step = 1.0 / 64;
    private const int Steps = 50;

    public string Name => "stiff";

    public string Title => "strong damping on Runge-Kutta steps: theory's decay up to k h = 2.785, beyond it a refusal or smaller steps";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach (double z in context.Sizes([0.5, 2.7], [0.1, 0.5, 1, 2, 2.7]))
        {
            yield return DecayRow(z, Speed(context, z));
        }

        foreach (double z in context.Sizes([3.0], [3, 10, 100]))
        {
            yield return StableRow(context, z);
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        (_, Vector3D v) = Euler(0.5);
        yield return DecayRow(0.5, v.X) with { Note = "explicit Euler" };
        (_, v) = Euler(3);
        yield return GrowthRow(3, v.X) with { Note = "explicit Euler" };
    }

    private static (Vector3D X, Vector3D V) Euler(double z) => ClassicalRungeKutta.Run(
        (f, t, x, v, h) => (x + (v * h), v + (f(t, x, v) * h)), ClassicalRungeKutta.Of(Damping(z)), default, V(1), Step, Steps);

    private static Force Damping(double z) => Force.LinearDrag("damping", z / Step);

    private static double Speed(HardContext context, double z)
    {
        Scene scene = Floating("damped").AddForce(Damping(z)).AddBody("ball", HardFlight.Steps(Step).Ball(), default, V(1)).Build();
        return Read(context.Run(scene, Steps * Step), 0, Steps * Step).Velocity.X;
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

    private HardRow StableRow(HardContext context, double z)
    {
        try
        {
            return GrowthRow(z, Speed(context, z));
        }
        catch (SceneException refusal)
        {
            return GrowthRow(z, 0) with { Note = "refused: " + refusal.Message };
        }
        catch (SimulationException end)
        {
            // To be stopped by the limit of all speeds is no refusal: the sentence has to name the step.
            bool isRefusal = end.Message.Contains("step of", StringComparison.Ordinal);
            return GrowthRow(z, isRefusal ? 0 : double.PositiveInfinity) with { Note = (isRefusal ? "refused: " : "blew up: ") + end.Message };
        }
    }

    private HardRow GrowthRow(double z, double speed) => new(
        Name, FormattableString.Invariant($"k h = {z}, {Steps} steps"), Math.Abs(speed), "speed_over_start", 1,
        "damping alone never makes a body faster than it was; a refusal that says so counts as 0", "exp(-k t), which is below 1");
}
