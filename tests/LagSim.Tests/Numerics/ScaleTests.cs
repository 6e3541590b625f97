using System;
using System.Collections.Generic;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Numerics;

/// <summary>Scenes of every scale: lengths, speeds, masses, forces from 1e-9 to 1e9. Nothing in them ever becomes NaN or infinite, and what cannot be simulated ends with a sentence.</summary>
public sealed class ScaleTests
{
    private const int Scenes = 300;

    [Fact]
    public void State_OfScenesOfEveryScale_StaysFinite()
    {
        int ran = 0, ended = 0;
        List<string> sentences = [];
        for (int seed = 0; seed < Scenes; seed++)
        {
            Simulation? world = Begin(seed, sentences);
            if (world is null)
            {
                continue;
            }

            try
            {
                double span = Span(seed);
                for (int i = 1; i <= 20; i++)
                {
                    long events = 150; // a gas of dust takes millions; some of each has to do
                    bool isThere = world.TryAdvanceTo(At(span * i / 20), ref events);
                    Assert.All(Bodies(world), body => AssertFinite(Read(world, body, world.SimulatedTo), seed));
                    if (!isThere)
                    {
                        break;
                    }
                }

                ran++;
            }
            catch (SimulationException failure)
            {
                sentences.Add(failure.Message);
                ended++;
            }
        }

        Assert.True(ran > Scenes / 2, $"{ran} ran, {ended} ended, {Scenes - ran - ended} were not begun");
        Assert.All(sentences, sentence => Assert.DoesNotContain("(NaN", sentence, StringComparison.Ordinal));
    }

    /// <summary>The control: with a force that gives NaN the check sees it at once.</summary>
    [Fact]
    public void State_UnderAForceThatIsNotANumber_IsRefused()
    {
        Scene scene = new SceneBuilder("nan").AddForce(Force.Supplied(new FunctionForce((_, _, _) => V(double.NaN))), out ForceSet nan)
            .AddBody("ball", new BodySpec(0.5, 1, 1, forces: nan), V(0)).Build();
        Assert.Throws<SimulationException>(() => new Simulation(scene));
        Assert.ThrowsAny<Exception>(() => AssertFinite(new BodyState(V(double.NaN), V(0), MotionLaw.Ballistic), 0));
    }

    /// <summary>A few crossings of the scene, at its own speed.</summary>
    private static double Span(int seed)
    {
        Draw draw = new(seed);
        double length = draw.Scale(), time = draw.Scale();
        return Math.Min(1e5, Math.Max(1e-9, 5 * time * (length > 0 ? 1 : 0)));
    }

    private static Simulation? Begin(int seed, List<string> sentences)
    {
        Draw draw = new(seed);
        double length = draw.Scale(), time = draw.Scale(), mass = draw.Scale();
        double speed = length / time;
        SceneBuilder builder = new SceneBuilder("scale").WithGravity(draw.IsLucky() ? V(0, -Math.Min(1e6, speed / time)) : Floating)
            .WithResolution(Math.Min(1e-3, Math.Max(1e-15, 1e-9 * length)))
            .AddPlane("floor", Vector3D.Up, -3 * length, draw.Part()).AddPlane("west", V(1), -3 * length).AddPlane("east", V(-1), -3 * length, draw.Part());
        if (draw.IsLucky())
        {
            builder.AddStaticSphere("stone", V(0, -2 * length), 0.5 * length, draw.Part());
        }

        builder.AddForce(Force.LinearDrag("oil", mass / time * draw.Part())).AddForce(Force.QuadraticDrag("air", mass / length * draw.Part()))
            .AddForce(Force.Spring("spring", V(0), mass / time / time * draw.Part())).AddForce(Force.Magnetic("coil", V(0, 1, 1), mass / time * draw.Part()))
            .AddForce(Force.Magnus("curve", mass * 0.01)).AddForce(Force.Central("well", V(0, 0, 4 * length), Math.Min(1e30, length * length * speed / time)));
        for (int i = 0; i < 6; i++)
        {
            ForceSet forces = draw.IsLucky() ? ForceSet.Of(draw.Next(6)) | ForceSet.Of(draw.Next(6)) : ForceSet.None;
            double heavier = draw.IsLucky() ? 1 : draw.Scale();
            BodySpec spec = new(
                Math.Max(1e-9, 0.3 * length), Math.Min(1e30, Math.Max(1e-30, mass * heavier)), draw.Part(), draw.IsLucky() ? MotionLaw.Automatic : MotionLaw.RungeKutta4,
                SimDuration.FromSeconds(Math.Min(1, Math.Max(1e-6, 0.02 * time))), forces, draw.IsLucky() ? 0 : 1e-6 * length, draw.IsLucky() ? draw.Part() : 0, 0.01);
            builder.AddBody(
                $"ball {i}", spec, V(i % 3, i / 3, 0) * (0.7 * length), V(draw.Part() - 0.5, draw.Part() - 0.5, draw.Part() - 0.5) * speed, spin: V(draw.Part(), 0, 1) * (1 / time));
        }

        try
        {
            return new Simulation(builder.Build(), new SimulationOptions(default, SimDuration.FromSeconds(1)));
        }
        catch (Exception failure) when (failure is SceneException or SimulationException)
        {
            sentences.Add(failure.Message); // too fast for its smallest body, too stiff, too steep a tolerance: told by a sentence that names it
            return null;
        }
    }

    private static void AssertFinite(in BodyState state, int seed) =>
        Assert.True(state.Position.IsFinite && state.Velocity.IsFinite && state.Spin.IsFinite, $"seed {seed}: {state.Position} {state.Velocity} {state.Spin}");

    private sealed class Draw(int seed)
    {
        private readonly Random random = new(seed);

        internal double Scale() => Math.Pow(10, random.Next(-9, 10));

        internal double Part() => random.NextDouble();

        internal bool IsLucky() => random.Next(2) == 0;

        internal int Next(int count) => random.Next(count);
    }
}
