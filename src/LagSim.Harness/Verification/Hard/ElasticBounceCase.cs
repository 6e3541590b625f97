using System;
using System.Collections.Generic;
using LagSim.Scenes;
using LagSim.Time;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>A ball that bounces without loss. Bounds the effect of rounding to ticks on its time and energy.</summary>
internal sealed class ElasticBounceCase : IHardCase
{
    private static readonly double FirstImpact = Math.Sqrt(2 / Gravity);

    public string Name => "elastic-bounce";

    public string Title => "a ball that bounces 1 m high without loss: time and energy after many contacts";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach (int contacts in context.Sizes([10_000], [10_000, 100_000, 1_000_000]))
        {
            (double time, double energy) = Bounce(context, contacts);
            yield return TimeRow(contacts, time);
            yield return EnergyRow(contacts, energy);
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        const int contacts = 10_000;
        yield return TimeRow(contacts, ReflectAtTick(contacts, 40)) with { Note = "reflected at the nearest tick, gap snapped to zero" };
        yield return EnergyRow(contacts, StepWise(contacts)) with { Note = "steps of a millisecond, reflected at their ends" };
    }

    private static (double Time, double Energy) Bounce(HardContext context, int contacts)
    {
        Scene scene = new SceneBuilder("bounce").AddPlane("floor", Vector3D.Up, Vector3D.Zero).AddBody("ball", Ball(), V(0, 1.5)).Build();
        Simulation simulation = context.Simulate(scene);
        SimTime last = SimTime.FromSeconds(((2.0 * contacts) - 0.5) * FirstImpact); // half way down again
        for (int part = 1; part <= 50; part++)
        {
            simulation.AdvanceTo(SimTime.FromTicks(last.Ticks / 50 * part));
            context.Report(part / 50.0);
        }

        simulation.AdvanceTo(last);
        BodyState state = Read(simulation, First, last);
        double energy = (0.5 * state.Velocity.LengthSquared) + (Gravity * (state.Position.Y - 0.5));
        return (simulation.ImpactsProcessed == contacts ? ImpactTimes(simulation, First)[^1] : double.NaN, energy);
    }

    private HardRow TimeRow(int contacts, double time)
    {
        double hop = 2 * FirstImpact, n = contacts;
        return new HardRow(
            Name, FormattableString.Invariant($"{contacts:N0} contacts"), Math.Abs(time - (((2 * n) - 1) * FirstImpact)), "time_s",
            (0.5 * Rounding.Tick) + (hop * Rounding.Walk(Rounding.PerContact) * n * Math.Sqrt(n / 3)),
            "half a tick, and the sum over all hops of a speed that walks by 8 roundings a contact, four times its rms: hop x 4 u sqrt(8/3) n sqrt(n/3)",
            "t_n = (2n - 1) t1");
    }

    private HardRow EnergyRow(int contacts, double energy) => new(
        Name, FormattableString.Invariant($"{contacts:N0} contacts"), Math.Abs((energy / Gravity) - 1), "energy_relative",
        (2 * Rounding.Walk(Rounding.PerContact * (double)contacts)) + (8 * Rounding.Unit),
        "twice the speed's walk by 8 roundings a contact, four times its rms, and 8 roundings to read it: 8 u sqrt(8n/3)", "g h, as at the start");

    /// <summary>
    /// The same bounces by a tick-based engine that reflects at the tick nearest to the root and puts the ball on the floor there.
    /// </summary>
    private static double ReflectAtTick(int contacts, int bits)
    {
        double tick = Math.ScaleB(1, -bits), v = 0, gap = 1;
        decimal ticks = 0;
        for (int n = 0; n < contacts; n++)
        {
            double root = (v + Math.Sqrt((v * v) + (2 * Gravity * gap))) / Gravity;
            double whole = Math.Ceiling(root / tick);
            v = (Gravity * whole * tick) - v;
            gap = 0;
            ticks += (decimal)whole;
        }

        return (double)ticks * tick;
    }

    /// <summary>
    /// Steps of a millisecond, exact in between, reflected at the end of the step that crosses the floor. Returns the energy half way up
    /// after the last contact.
    /// </summary>
    private static double StepWise(int contacts)
    {
        double gap = 1, v = 0;
        const double h = 1e-3;
        for (int n = 0; n < contacts;)
        {
            gap += (v - (0.5 * Gravity * h)) * h;
            v -= Gravity * h;
            if (gap < 0 && v < 0)
            {
                (gap, v) = (0, -v);
                n++;
            }
        }

        return (0.5 * v * v) + (Gravity * gap);
    }
}
