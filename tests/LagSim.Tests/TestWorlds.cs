using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;

namespace LagSim.Tests;

/// <summary>Small worlds and what tests ask of them.</summary>
internal static class TestWorlds
{
    internal const double Gravity = 9.81;

    internal static readonly Vector3D Floating = Vector3D.Zero;

    internal static readonly BodyId First = BodyId.OfScene(0);

    internal static readonly BodyId Second = BodyId.OfScene(1);

    internal static readonly BodyId Third = BodyId.OfScene(2);

    /// <summary>A history without end.</summary>
    internal static SimulationOptions KeepAll => new(default, SimDuration.MaxValue);

    internal static SimTime At(double seconds) => SimTime.FromSeconds(seconds);

    internal static Vector3D V(double x, double y = 0, double z = 0) => new(x, y, z);

    internal static BodySpec Ball(
        double radius = 0.5, double mass = 1, double e = 1, MotionLaw flight = MotionLaw.Ballistic, double step = 0, int force = 0) =>
        new(radius, mass, e, flight, step == 0 ? null : SimDuration.FromSeconds(step), force == 0 ? ForceSet.None : ForceSet.Of(force - 1));

    /// <summary>One ball of radius 0.5 m, its lowest point this high above a floor.</summary>
    internal static Scene Drop(double height, double e, MotionLaw flight = MotionLaw.Ballistic) =>
        new SceneBuilder("drop").AddPlane("floor", Vector3D.Up, V(0), 1).AddBody("ball", Ball(e: e, flight: flight), V(0, height + 0.5)).Build();

    internal static Simulation Run(Scene scene, double seconds)
    {
        Simulation simulation = new(scene, KeepAll);
        simulation.AdvanceTo(At(seconds));
        return simulation;
    }

    internal static Simulation Run(Scene scene, double seconds, IEnumerable<ExternalEvent> events)
    {
        Simulation simulation = new(scene, KeepAll);
        foreach (ExternalEvent external in events)
        {
            simulation.Submit(external);
        }

        simulation.AdvanceTo(At(seconds));
        return simulation;
    }

    internal static BodyState Read(Simulation simulation, BodyId body, double seconds) => Read(simulation, body, At(seconds));

    internal static BodyState Read(Simulation simulation, BodyId body, SimTime time)
    {
        simulation.TryRead(body, time, out BodyState state);
        return state;
    }

    internal static List<TimelineEntry> Impacts(Simulation simulation, BodyId body) =>
        simulation.Timeline(body).Where(entry => entry.Key.Kind == EventKind.Impact).ToList();

    internal static Vector3D Momentum(Simulation simulation, SimTime time) => Bodies(simulation).Aggregate(
        Vector3D.Zero, (sum, body) => sum + (Read(simulation, body, time).Velocity * simulation.SpecOf(body).Mass));

    /// <summary>Kinetic and, under the scene's gravity, potential energy.</summary>
    internal static double Energy(Simulation simulation, SimTime time) => Bodies(simulation).Sum(body =>
    {
        BodyState state = Read(simulation, body, time);
        return simulation.SpecOf(body).Mass * ((0.5 * state.Velocity.LengthSquared) - Vector3D.Dot(simulation.Scene.Gravity, state.Position));
    });

    internal static IEnumerable<BodyId> Bodies(Simulation simulation) => Enumerable.Range(0, simulation.BodyCount).Select(simulation.BodyAt);

    /// <summary>The least distance between any two surfaces at an instant; negative where they overlap.</summary>
    internal static double MinGap(Simulation simulation, SimTime time)
    {
        List<(Vector3D Position, double Radius)> balls = Bodies(simulation)
            .Select(body => (State: Read(simulation, body, time), simulation.SpecOf(body).Radius))
            .Where(ball => ball.State.Motion != MotionLaw.Absent)
            .Select(ball => (ball.State.Position, ball.Radius)).ToList();
        double least = double.MaxValue;
        for (int i = 0; i < balls.Count; i++)
        {
            foreach (StaticPlane plane in simulation.Scene.Planes)
            {
                least = Math.Min(least, plane.Gap(balls[i].Position, balls[i].Radius));
            }

            foreach (StaticSphere sphere in simulation.Scene.StaticSpheres)
            {
                least = Math.Min(least, (balls[i].Position - sphere.Centre).Length - sphere.Radius - balls[i].Radius);
            }

            for (int j = 0; j < i; j++)
            {
                least = Math.Min(least, (balls[i].Position - balls[j].Position).Length - balls[i].Radius - balls[j].Radius);
            }
        }

        return least;
    }

    internal static void Near(double expected, double actual, double tolerance) =>
        Assert.True(Math.Abs(actual - expected) <= tolerance, $"Expected {expected:R} +- {tolerance:R}, was {actual:R}.");

    internal static void Near(in Vector3D expected, in Vector3D actual, double tolerance) =>
        Assert.True((actual - expected).Length <= tolerance, $"Expected {expected} +- {tolerance:R}, was {actual}.");

    internal static void SameBits(in BodyState expected, in BodyState actual) => Assert.True(
        expected.IsSameBits(actual),
        $"Expected {expected.Motion} {expected.Position} {expected.Velocity}, was {actual.Motion} {actual.Position} {actual.Velocity}.");

    internal static void SameTimelines(Simulation expected, Simulation actual)
    {
        Assert.Equal(Bodies(expected), Bodies(actual));
        foreach (BodyId body in Bodies(expected))
        {
            IReadOnlyList<TimelineEntry> a = expected.Timeline(body), b = actual.Timeline(body);
            Assert.Equal(a.Count, b.Count);
            for (int i = 0; i < a.Count; i++)
            {
                Assert.Equal(a[i].Key, b[i].Key);
                SameBits(a[i].State, b[i].State);
            }
        }
    }
}

/// <summary>An acceleration given by a function.</summary>
internal sealed class FunctionForce(Func<double, Vector3D, Vector3D, Vector3D> function) : IAcceleration
{
    public string Name => "test force";

    public int Version => 1;

    public Vector3D At(double seconds, in Vector3D position, in Vector3D velocity) => function(seconds, position, velocity);
}
