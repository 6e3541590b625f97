using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Harness.Links;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Hard;

/// <summary>Random scenes of all sizes, masses, speeds and gravities: no state is ever without a number.</summary>
internal sealed class ScalesCase : IHardCase
{
    private const int MostEvents = 3000;

    public string Name => "scales";

    public string Title => "random scenes at scales of 1e-9 to 1e9: every state is finite";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        int scenes = context.Size(60, 3000), built = 0, ended = 0, bad = 0;
        long events = 0;
        string first = "";
        for (int n = 0; n < scenes; n++)
        {
            context.Report((double)n / scenes);
            SeededRandom random = new((context.Seed << 20) + (ulong)n);
            Scene scene;
            try
            {
                scene = Draw(random, out double seconds);
                built++;
                events += Play(context, scene, seconds);
            }
            catch (SceneException)
            {
                continue; // not valid, and said so
            }
            catch (SimulationException end) when (!end.Message.Contains("NaN", StringComparison.Ordinal))
            {
                ended++; // faster than a body may be, or more than memory allows, and said so
            }
            catch (Exception failure) when (failure is not OperationCanceledException)
            {
                bad++;
                first = first.Length > 0 ? first : string.Create(CultureInfo.InvariantCulture, $"scene {n}: {failure.Message}");
            }
        }

        yield return Row(scenes, bad) with
        {
            Note = string.Create(CultureInfo.InvariantCulture,
                $"{built} of them valid, {events:N0} events, {ended} ended by a sentence{(first.Length > 0 ? "; " : "")}{first}"),
        };
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        // Bounces of all restitutions by plain roots, rounded to ticks, without the rule that only what closes is a contact.
        int bad = 0;
        for (int n = 0; n < 100; n++)
        {
            double e = n / 100.0, radius = 0.5, y = 1 + radius, v = 0;
            for (int hop = 0; hop < 1000; hop++)
            {
                double root = (v + Math.Sqrt((v * v) + (2 * HardWorlds.Gravity * (y - radius)))) / HardWorlds.Gravity,
                    t = Math.Round(root / Rounding.Tick) * Rounding.Tick;
                y += (v - (0.5 * HardWorlds.Gravity * t)) * t;
                v = e * ((HardWorlds.Gravity * t) - v);
            }

            bad += double.IsFinite(y + v) ? 0 : 1;
        }

        yield return Row(100, bad) with { Note = "plain roots, bounces of restitution 0 to 0.99" };
    }

    private HardRow Row(int scenes, int bad) => new(
        Name, FormattableString.Invariant($"{scenes:N0} scenes"), bad, "scenes_without_a_number", 0,
        "a number is finite or it is not; a scene that is refused, or ended because a body would become too fast, says so in a sentence",
            "every component of every state");

    /// <summary>A floor and some balls, all of one scale or another.</summary>
    private static Scene Draw(SeededRandom random, out double seconds)
    {
        double scale = Power(random, -9, 9), speed = scale * Power(random, -6, 6), gravity = random.NextDouble() < 0.2 ? 0 : Power(random, -9, 6);
        seconds = Math.Min(1e6, 20 * scale / speed);
        int bodies = 2 + (int)(5 * random.NextDouble());
        MotionLaw law = random.NextDouble() < 0.7 ? MotionLaw.Ballistic : MotionLaw.RungeKutta4;
        SimDuration step = SimDuration.FromSeconds(Math.Clamp(seconds * Power(random, -3, -1), 1e-6, 1));
        SceneBuilder builder = new SceneBuilder("scale").WithGravity(new Vector3D(0, -gravity, 0)).AddPlane("floor", Vector3D.Up, Vector3D.Zero,
            Restitution(random));
        if (random.NextDouble() < 0.5)
        {
            builder.AddPlane("left", new Vector3D(1, random.NextDouble() - 0.5, 0), new Vector3D(-4 * scale, 0, 0)).AddPlane("right", new Vector3D(-1, 0, 0.1),
                new Vector3D(20 * scale, 0, 0));
        }

        for (int n = 0; n < bodies; n++)
        {
            BodySpec ball = new(scale * random.NextDouble(0.05, 0.9), Power(random, -9, 9), Restitution(random), law, step);
            Vector3D place = new Vector3D(2 * n, 1 + (2 * random.NextDouble()), random.NextDouble() - 0.5) * scale;
            builder.AddBody(FormattableString.Invariant($"ball {n}"), ball, place,
                new Vector3D(random.NextGaussian(), random.NextGaussian(), random.NextGaussian()) * speed);
        }

        return builder.Build();
    }

    private static long Play(HardContext context, Scene scene, double seconds)
    {
        Simulation simulation = context.Simulate(scene, SimDuration.MaxValue);
        long events = MostEvents;
        simulation.TryAdvanceTo(SimTime.FromSeconds(seconds), ref events);
        for (int n = 0; n < simulation.BodyCount; n++)
        {
            BodyId body = simulation.BodyAt(n);
            foreach (BodyState state in simulation.Timeline(body).Select(entry => entry.State)
                .Append(HardWorlds.Read(simulation, body, simulation.SimulatedTo)))
            {
                if (!state.Position.IsFinite || !state.Velocity.IsFinite)
                {
                    throw new InvalidOperationException($"body {body} is at {state.Position} with {state.Velocity}.");
                }
            }
        }

        return simulation.EventsProcessed;
    }

    private static double Restitution(SeededRandom random) => random.NextDouble() switch
    {
        < 0.2 => 0,
        < 0.4 => 1,
        _ => random.NextDouble(),
    };

    private static double Power(SeededRandom random, double from, double to) => Math.Pow(10, random.NextDouble(from, to));
}
