using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// Random scenes of all sizes, masses, speeds, gravities and forces, by every law, with friction and spin, static spheres and periodic
/// boxes. No state may ever be NaN or infinite.
/// </summary>
internal sealed class ScalesCase : IHardCase
{
    private const int MaxEvents = 3000;

    private static readonly MotionLaw[] Laws = [MotionLaw.Automatic, MotionLaw.RungeKutta4, MotionLaw.DormandPrince54, MotionLaw.ClosedForm];

    public string Name => "scales";

    public string Title => "random scenes at scales of 1e-9 to 1e9, by every law and with every force: every state is finite";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach ((string what, Func<SeededRandom, (Scene Scene, double Seconds)> draw, int few, int many) in new (string, Func<SeededRandom, (Scene, double)>, int, int)[]
            { ("free flight", Free, 60, 3000), ("forces, friction, spin", Forced, 60, 3000), ("periodic boxes", Boxed, 20, 600) })
        {
            yield return Run(context, what, context.Size(few, many), draw);
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        // Bounces of all restitutions by plain roots, rounded to ticks, without the rule that only closing pairs are contacts.
        int bad = 0;
        for (int n = 0; n < 100; n++)
        {
            double e = n / 100.0, radius = 0.5, y = 1 + radius, v = 0;
            for (int hop = 0; hop < 1000; hop++)
            {
                double root = (v + Math.Sqrt((v * v) + (2 * Gravity * (y - radius)))) / Gravity, t = Math.Round(root / Rounding.Tick) * Rounding.Tick;
                y += (v - (0.5 * Gravity * t)) * t;
                v = e * ((Gravity * t) - v);
            }

            bad += double.IsFinite(y + v) ? 0 : 1;
        }

        yield return Row("bounces", 100, bad) with { Note = "plain roots, bounces of restitution 0 to 0.99" };
        yield return Run(context, "a program's force", 10, NaNForced) with { Note = "a force that is not a number" };
    }

    private HardRow Run(HardContext context, string what, int scenes, Func<SeededRandom, (Scene Scene, double Seconds)> draw)
    {
        int built = 0, ended = 0, bad = 0;
        long events = 0;
        string first = "";
        for (int n = 0; n < scenes; n++)
        {
            context.Report((double)n / scenes);
            try
            {
                (Scene scene, double seconds) = draw(new SeededRandom((context.Seed << 20) + (ulong)n));
                built++;
                events += Play(context, scene, seconds);
            }
            catch (SceneException refusal) when (IsOfNumbers(refusal))
            {
                continue; // refused with an error
            }
            catch (SimulationException end) when (IsOfNumbers(end))
            {
                ended++; // ended with an error: faster than a body may be, too stiff for any step, or more than memory allows
            }
            catch (Exception failure) when (failure is not OperationCanceledException)
            {
                bad++;
                first = first.Length > 0 ? first : string.Create(CultureInfo.InvariantCulture, $"scene {n}: {failure.Message}");
            }
        }

        return Row(what, scenes, bad) with
        {
            Note = string.Create(CultureInfo.InvariantCulture,
                $"{built} of them valid, {events:N0} events, {ended} ended by a sentence{(first.Length > 0 ? "; " : "")}{first}"),
        };
    }

    private HardRow Row(string what, int scenes, int bad) => new(
        Name, FormattableString.Invariant($"{what}, {scenes:N0} scenes"), bad, "scenes_without_a_number", 0,
        "a number is finite or it is not; a scene that is refused, or ended because a body would become too fast, says so in a sentence",
            "every component of every state");

    /// <summary>A floor and some balls, all of one scale; as fast for their size as allowed.</summary>
    private static (Scene Scene, double Seconds) Free(SeededRandom random)
    {
        double scale = Power(random, -9, 9), speed = scale * Power(random, -6, 6), gravity = random.NextDouble() < 0.2 ? 0 : Power(random, -9, 6);
        double seconds = Math.Min(1e6, 20 * scale / speed);
        int bodies = 2 + (int)(5 * random.NextDouble());
        MotionLaw law = random.NextDouble() < 0.7 ? MotionLaw.Ballistic : MotionLaw.RungeKutta4;
        SimDuration step = SimDuration.FromSeconds(Math.Clamp(seconds * Power(random, -3, -1), 1e-6, 1));
        SceneBuilder builder = new SceneBuilder("free").WithGravity(V(0, -gravity)).AddPlane("floor", Vector3D.Up, Vector3D.Zero, Part(random));
        if (IsLucky(random))
        {
            builder.AddPlane("left", V(1, random.NextDouble() - 0.5), V(-4 * scale)).AddPlane("right", V(-1, 0, 0.1), V(20 * scale));
        }

        for (int n = 0; n < bodies; n++)
        {
            BodySpec ball = new(scale * random.NextDouble(0.05, 0.9), Power(random, -9, 9), Part(random), law, step);
            builder.AddBody(FormattableString.Invariant($"ball {n}"), ball, V(2 * n, 1 + (2 * random.NextDouble()), random.NextDouble() - 0.5) * scale,
                Any(random) * speed);
        }

        return (builder.Build(), seconds);
    }

    /// <summary>
    /// Lengths, times and masses with a scale of their own each, with forces and gravity about strong enough to matter.
    /// </summary>
    private static (Scene Scene, double Seconds) Forced(SeededRandom random)
    {
        double length = Power(random, -9, 9), time = Power(random, -9, 9), mass = Power(random, -9, 9), speed = length / time;
        SceneBuilder builder = new SceneBuilder("forced").WithGravity(IsLucky(random) ? V(0, -Math.Min(1e6, speed / time)) : Vector3D.Zero)
            .WithRestitutionThreshold(Math.Clamp(1e-9 * length, 1e-15, 1e-3))
            .AddPlane("floor", Vector3D.Up, -3 * length, Part(random)).AddPlane("west", V(1), -3 * length).AddPlane("east", V(-1), -3 * length, Part(random));
        if (IsLucky(random))
        {
            builder.AddStaticSphere("stone", V(0, -2 * length), 0.5 * length, Part(random));
        }

        Force[] forces =
        [
            Force.LinearDrag("oil", Strong(random, mass / time), Any(random) * speed), Force.QuadraticDrag("air", Strong(random, mass / length)),
            Force.Spring("spring", default, Strong(random, mass / time / time), Strong(random, mass / time)),
            Force.Magnetic("coil", V(0, 1, 1), Strong(random, mass / time)),
            Force.Magnus("curve", Strong(random, mass * 0.01)), Force.Central("well", V(0, 0, 4 * length), Strong(random, length * length * speed / time)),
            Force.Central("slide", V(0, 0, -4 * length), Strong(random, speed / time), (int)(9 * random.NextDouble()) - 4),
        ];
        Array.ForEach(forces, force => builder.AddForce(force));
        for (int n = 0; n < 6; n++)
        {
            ForceSet acting = IsLucky(random) ? ForceSet.Of((int)(7 * random.NextDouble())) | ForceSet.Of((int)(7 * random.NextDouble())) : ForceSet.None;
            BodySpec ball = new(
                Math.Max(1e-9, 0.3 * length), Math.Clamp(mass * (IsLucky(random) ? 1 : Power(random, -9, 9)), 1e-30, 1e30), Part(random),
                Laws[(int)(random.NextDouble() * (IsLucky(random) ? 3 : 4))], SimDuration.FromSeconds(Math.Clamp(0.02 * time, 1e-6, 1)), acting,
                IsLucky(random) ? 0 : Math.Min(1, 1e-6 * length), IsLucky(random) ? Part(random) : 0, Part(random));
            builder.AddBody(
                FormattableString.Invariant($"ball {n}"), ball, V(n % 3, n / 3) * (0.7 * length), Any(random) * speed,
                spin: IsLucky(random) ? Any(random) * (1 / time) : default);
        }

        return (builder.Build(), Math.Min(1e5, 5 * time));
    }

    /// <summary>Some balls in a periodic box.</summary>
    private static (Scene Scene, double Seconds) Boxed(SeededRandom random)
    {
        double length = Power(random, -7, 9), speed = length * Power(random, -6, 6), size = 10 * length;
        SceneBuilder builder = Floating("boxed").WithPeriodicBox(V(size, size, size));
        for (int n = 0; n < 6; n++)
        {
            builder.AddBody(
                FormattableString.Invariant($"ball {n}"),
                new BodySpec(random.NextDouble(0.1, 0.9) * length, Power(random, -9, 9), Part(random), friction: IsLucky(random) ? Part(random) : 0),
                V(1 + (2 * (n % 3)), 1 + (2 * (n / 3)), 5) * length, Any(random) * speed, spin: IsLucky(random) ? Any(random) * (speed / length) : default);
        }

        return (builder.Build(), Math.Min(1e6, 20 * length / speed));
    }

    private static (Scene Scene, double Seconds) NaNForced(SeededRandom random)
    {
        Force broken = Force.Supplied(new SuppliedForce(Force.LinearDrag("broken", double.NaN)));
        return (new SceneBuilder("broken").AddForce(broken).AddBody("ball", HardFlight.Steps(0.01).Ball(random.NextDouble(0.1, 1)), default).Build(), 1);
    }

    private static long Play(HardContext context, Scene scene, double seconds)
    {
        Simulation simulation = context.Simulate(scene, SimDuration.MaxValue);
        long events = MaxEvents;
        simulation.TryAdvanceTo(SimTime.FromSeconds(seconds), ref events);
        for (int n = 0; n < simulation.BodyCount; n++)
        {
            BodyId body = simulation.BodyAt(n);
            foreach (BodyState state in simulation.Timeline(body).Select(entry => entry.State).Append(Read(simulation, body, simulation.SimulatedTo)))
            {
                if (!state.Position.IsFinite || !state.Velocity.IsFinite || !state.Spin.IsFinite)
                {
                    throw new InvalidOperationException($"body {n} is at {state.Position} with {state.Velocity}, turning {state.Spin}.");
                }
            }
        }

        return simulation.EventsProcessed;
    }

    /// <summary>Whether a message mentions no NaN or infinite state, as "(NaN, NaN, NaN) m" and "became NaN or infinite" do.</summary>
    private static bool IsOfNumbers(Exception sentence) =>
        !sentence.Message.Contains("NaN", StringComparison.Ordinal) && !sentence.Message.Contains("Infinity,", StringComparison.Ordinal);

    private static bool IsLucky(SeededRandom random) => random.NextDouble() < 0.5;

    private static double Part(SeededRandom random) => random.NextDouble() switch
    {
        < 0.2 => 0,
        < 0.4 => 1,
        _ => random.NextDouble(),
    };

    /// <summary>Draws about a given size, and now and then a very different one.</summary>
    private static double Strong(SeededRandom random, double size) => size * (IsLucky(random) ? random.NextDouble() : Power(random, -6, 6));

    private static Vector3D Any(SeededRandom random) => V(random.NextGaussian(), random.NextGaussian(), random.NextGaussian());

    private static double Power(SeededRandom random, double from, double to) => Math.Pow(10, random.NextDouble(from, to));
}
