using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Healing;

/// <summary>The box whose opposite sides meet, and many bodies in it with an index of their paths.</summary>
public sealed class PeriodicBoxTests
{
    private const double End = 1.5;

    public static TheoryData<string, Action<SceneBuilder>> Refusals => new()
    {
        { "gravity (0, -9.81, 0) m/s^2", builder => builder.WithGravity(SceneBuilder.DefaultGravity) },
        { "1 plane, 0 static spheres and 0 other forces;", builder => builder.AddPlane("floor", Vector3D.Up, V(0)) },
        { "0 planes, 1 static sphere and", builder => builder.AddStaticSphere("dome", V(1, 1, 1), 0.2) },
        { "flies by Ballistic", builder => builder.AddBody("b", Ball(0.1, flight: MotionLaw.RungeKutta4), V(1, 1, 1)) },
        { "each component is at least 0", builder => builder.AddBody("b", Ball(0.1), V(1, 1, 4)) },
        { "each component is at least 0", builder => builder.AddBody("b", Ball(0.1), V(-1, 1, 1)) },
        { "radius of body 'b' is 0.41 m; every side must be at least 5 times its diameter, 4.1", builder => builder.AddBody("b", Ball(0.41), V(1, 1, 1)) },
        { "5 times its diameter", builder => builder.WithPeriodicBox(V(4, 4, 0.9)).AddBody("b", Ball(0.1), V(1, 1, 0.5)) },
        { "every side must be above zero.", builder => builder.WithPeriodicBox(V(4, -4, 4)) },
        { "smallest radius of a body 0.5 m; every side must be at least 5 times the diameter, 5 m.", b => b.WithPeriodicBox(V(4, 4, 4)).WithSmallestRadius(0.5) },
        { "periodic box", builder => builder.WithPeriodicBox(V(4, double.NaN, 4)) },
        { "deep inside body", builder => builder.AddBody("a", Ball(0.1), V(0.05, 1, 1)).AddBody("b", Ball(0.1), V(3.9, 1, 1)) },
    };

    [Fact]
    public void Flight_OutOfOneSide_ComesInOnTheOppositeOne()
    {
        Simulation simulation = Run(Box().AddBody("ball", Ball(0.1), V(3.5, 0.25, 2), V(1, -1, 0.5)).Build(), 10);
        foreach (double t in new[] { 0.25, 0.5, 1, 3.75, 9.9 })
        {
            BodyState state = Read(simulation, First, t);
            Assert.Equal((3.5 + t) % 4, state.Position.X, 12);
            Assert.Equal((((0.25 - t) % 4) + 4) % 4, state.Position.Y, 12);
            Assert.Equal((2 + (0.5 * t)) % 4, state.Position.Z, 12);
            Assert.InRange(state.Position.X, 0, Math.BitDecrement(4.0));
        }
    }

    [Fact]
    public void Contact_AcrossASide_IsWhenTheImageIsTouched()
    {
        // 3.5 to 0.5 is 1 m around the side; at 1 m/s the surfaces, 0.2 m less, meet after 0.8 s.
        Simulation simulation = Run(Box().AddBody("a", Ball(0.1), V(3.5, 1, 1), V(1)).AddBody("b", Ball(0.1), V(0.5, 1, 1)).Build(), 2);
        Assert.Equal(0.8, Assert.Single(Impacts(simulation, First)).Key.Time.ToSeconds(), 12);
        Assert.Equal(1, Read(simulation, Second, 1).Velocity.X, 12);

        Simulation open = Run(Open().AddBody("a", Ball(0.1), V(3.5, 1, 1), V(1)).AddBody("b", Ball(0.1), V(0.5, 1, 1)).Build(), 2);
        Assert.Empty(Impacts(open, First)); // the control: without a box they never meet
    }

    [Fact]
    public void Contacts_OfRandomPairs_AreTheFirstWithAnyImage()
    {
        Random random = new(5);
        int met = 0;
        for (int i = 0; i < 400; i++)
        {
            Vector3D Place() => V(random.NextDouble() * 4, random.NextDouble() * 4, random.NextDouble() * 4);
            Vector3D Speed() => V(random.NextDouble() - 0.5, random.NextDouble() - 0.5, random.NextDouble() - 0.5) * 4;
            (Vector3D x, Vector3D u, Vector3D y, Vector3D v) = (Place(), Speed(), Place(), Speed());
            double first = double.MaxValue;
            foreach (Vector3D image in from a in Range(-4, 4) from b in Range(-4, 4) from c in Range(-4, 4) select V(a, b, c) * 4)
            {
                first = Math.Min(first, FirstTouch(x - y - image, u - v, 0.8));
            }

            if (first == 0)
            {
                continue; // they would start in each other
            }

            Simulation simulation = Run(Box().AddBody("a", Ball(0.4), x, u).AddBody("b", Ball(0.4), y, v).Build(), 3);
            double found = Impacts(simulation, First).Select(entry => entry.Key.Time.ToSeconds()).FirstOrDefault(double.MaxValue);
            Assert.True(first > 3 ? found > 3 : Math.Abs(found - first) < 1e-9, $"pair {i}: {found} instead of {first}");
            met += first <= 3 ? 1 : 0;
        }

        Assert.InRange(met, 60, 390);
    }

    [Fact]
    public void Gas_ForSomeSeconds_KeepsEnergyAndMomentumAndNobodyOverlaps()
    {
        Simulation simulation = Run(BuiltInScenes.Gas(216, 0.3), 2);
        Assert.True(simulation.ImpactsProcessed > 800, $"{simulation.ImpactsProcessed}");
        Assert.Equal(Energy(simulation, At(0)), Energy(simulation, At(2)), 12);
        Assert.True((Momentum(simulation, At(0)) - Momentum(simulation, At(2))).Length < 1e-12);
        BodyState[] states = Bodies(simulation).Select(body => Read(simulation, body, At(2))).ToArray();
        double least = double.MaxValue;
        for (int i = 0; i < states.Length; i++)
        {
            for (int j = 0; j < i; j++)
            {
                least = Math.Min(least, simulation.Scene.Box.Nearest(states[i].Position - states[j].Position).Length);
            }
        }

        Assert.True(least > 0.1 - 1e-9, $"{least}");
    }

    [Theory]
    [InlineData(HealingMode.CausalCone, 64)]
    [InlineData(HealingMode.CausalCone, 100_000)]
    [InlineData(HealingMode.FullRollback, 64)]
    public void Gas_WithEventsInAnyOrder_IsThatOfAWorldThatHadThemBefore(HealingMode mode, int bruteForceLimit)
    {
        for (int seed = 0; seed < (bruteForceLimit == 64 ? 6 : 2); seed++)
        {
            Random random = new(seed);
            Scene scene = BuiltInScenes.Gas(125, seed % 2 == 0 ? 0.2 : 0.35);
            List<ExternalEvent> events = Events(random, scene);
            Simulation onTime = new(scene, KeepAll);
            events.ForEach(external => onTime.Submit(external));
            onTime.AdvanceTo(At(End));

            Simulation late = new(scene, new SimulationOptions(default, SimDuration.FromSeconds(0.6), healing: mode).WithBruteForceLimit(bruteForceLimit));
            foreach ((double when, ExternalEvent external) in events.Select(e => (e.Time.ToSeconds() + (random.NextDouble() * 0.59), e)).OrderBy(e => e.Item1))
            {
                late.AdvanceTo(SimTime.Max(At(Math.Min(when, End)), late.SimulatedTo));
                Assert.NotEqual(SubmitResult.TooOld, late.Submit(external));
            }

            late.AdvanceTo(At(End));
            Assert.True(late.Rollbacks > 10);
            Assert.Null(TimelineComparison.FirstDifference(onTime.Engine, late.Engine));
            Assert.Equal((onTime.StateHash(At(End)), onTime.EventHash(At(End))), (late.StateHash(At(End)), late.EventHash(At(End))));
        }
    }

    [Fact]
    public void Heal_OfOneEventAmongMany_TouchesAsFewAmongTenTimesAsMany()
    {
        double few = MeanBodies(512), many = MeanBodies(4096);
        Assert.InRange(many / few, 0.5, 1.6);

        static double MeanBodies(int bodies)
        {
            Simulation simulation = new(BuiltInScenes.Gas(bodies), new SimulationOptions(default, SimDuration.FromSeconds(0.5)));
            List<HealReport> reports = [];
            simulation.Healed += reports.Add;
            Random random = new(1);
            simulation.AdvanceTo(At(0.5));
            for (uint i = 1; i <= 100; i++)
            {
                simulation.AdvanceTo(simulation.SimulatedTo + SimDuration.FromMilliseconds(1));
                SimTime now = simulation.SimulatedTo;
                simulation.Submit(ExternalEvent.Impulse(
                    now - SimDuration.FromMilliseconds(100), 1, i, BodyId.OfScene(random.Next(bodies)), V(0.1, 0.05)));
                simulation.AdvanceTo(now);
            }

            return reports.Average(report => report.Bodies);
        }
    }

    [Fact]
    public void Scene_WithABox_TravelsAndIsWrittenAndReadBack()
    {
        Scene scene = BuiltInScenes.Gas(100);
        Assert.True(SceneFormat.TryDecode(SceneFormat.Encode(scene), default, out Scene? travelled, out string? error), error);
        Assert.Equal((scene.Hash, scene.Box), (travelled.Hash, travelled.Box));
        Assert.NotEqual(scene.Hash, Open().Build().Hash);
        Scene read = SceneFile.Parse(System.Text.Encoding.UTF8.GetBytes(SceneFile.ToJson(scene)), "gas");
        Assert.Equal((scene.Hash, scene.Box), (read.Hash, read.Box));
    }

    [Theory]
    [MemberData(nameof(Refusals))]
    public void Build_WhatDoesNotGoWithABox_IsRefused(string named, Action<SceneBuilder> add)
    {
        SceneBuilder builder = Box();
        add(builder);
        Assert.Contains(named, Assert.Throws<SceneException>(builder.Build).Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Submit_APlaceOutsideOfTheBoxOrABodyTooWideForIt_IsRefused()
    {
        Simulation simulation = new(Box().AddBody("ball", Ball(0.1), V(1, 1, 1)).Build());
        Assert.Contains("each component is at least 0", Refusal(ExternalEvent.Teleport(At(1), 1, 1, First, V(4, 1, 1))), StringComparison.Ordinal);
        Assert.Contains("5 times its diameter", Refusal(ExternalEvent.Spawn(At(1), 1, 1, Ball(0.41), V(1, 1, 2))), StringComparison.Ordinal);
        Assert.Contains("in a periodic box nothing is held", Refusal(ExternalEvent.Grab(At(1), 1, 1, First, V(0))), StringComparison.Ordinal);
        Assert.Contains("flies by Ballistic", Refusal(ExternalEvent.Spawn(At(1), 1, 1, Ball(0.1, flight: MotionLaw.RungeKutta4), V(1, 1, 2))), StringComparison.Ordinal);

        string Refusal(ExternalEvent external) => Assert.Throws<SceneException>(() => simulation.Submit(external)).Message;
    }

    private static SceneBuilder Open() => new SceneBuilder("open").WithGravity(Floating);

    private static SceneBuilder Box() => new SceneBuilder("box").WithGravity(Floating).WithPeriodicBox(V(4, 4, 4));

    private static IEnumerable<int> Range(int from, int to) => Enumerable.Range(from, to - from + 1);

    /// <summary>The root of |d + v t| = reach at which the two close; 0 where they overlap, the largest number where they never meet.</summary>
    private static double FirstTouch(Vector3D d, Vector3D v, double reach)
    {
        double c = d.LengthSquared - (reach * reach), b = Vector3D.Dot(d, v), a = v.LengthSquared;
        double discriminant = (b * b) - (a * c);
        return c <= 0 ? 0 : b < 0 && discriminant > 0 ? c / (Math.Sqrt(discriminant) - b) : double.MaxValue;
    }

    private static List<ExternalEvent> Events(Random random, Scene scene)
    {
        List<ExternalEvent> events = [];
        for (uint i = 1; i <= 40; i++)
        {
            SimTime time = At(random.NextDouble() * 1.2);
            BodyId body = BodyId.OfScene(random.Next(scene.Bodies.Count));
            events.Add(random.Next(6) switch
            {
                0 => ExternalEvent.Remove(time, 1, i, body),
                1 => ExternalEvent.SetVelocity(time, 1, i, body, V(random.NextDouble(), 0.1)),
                _ => ExternalEvent.Impulse(time, 1, i, body, V(random.NextDouble() - 0.5, random.NextDouble() - 0.5, random.NextDouble() - 0.5) * 0.3),
            });
        }

        return events;
    }
}
