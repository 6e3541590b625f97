using System;
using System.Collections.Generic;
using System.Globalization;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Scenes;

/// <summary>The scenes that come with the program.</summary>
public static class BuiltInScenes
{
    private static readonly string[] AllNames = ["drop", "pair"];

    /// <summary>The names of all of them.</summary>
    public static IReadOnlyList<string> Names => AllNames;

    /// <summary>The built-in scene of that name, as it is unless told otherwise.</summary>
    public static bool TryGet(string name, out Scene scene)
    {
        scene = name == "drop" ? Drop() : Pair();
        return Array.IndexOf(AllNames, name) >= 0;
    }

    /// <summary>What a built-in scene is, in a line.</summary>
    /// <exception cref="ArgumentException">There is no built-in scene of that name.</exception>
    public static string Describe(string name) => name switch
    {
        "drop" => "the thesis's drop test: a ball of 1 kg falls from 10 m onto a floor, bounces and comes to rest",
        "pair" => "two balls of unequal mass meet off-centre in flight, then bounce on a floor",
        _ => throw new ArgumentException($"There is no built-in scene '{name}'; there are {string.Join(", ", AllNames)}.", nameof(name)),
    };

    /// <summary>The drop test: a ball of radius 0.5 m and 1 kg, at rest at first, above the floor y = 0.</summary>
    /// <param name="heightMetres">The height of the ball's centre above the floor, at least its radius.</param>
    /// <param name="restitution">That of the ball, 0 to 1; the floor's is 1, and the lesser counts.</param>
    /// <param name="law">How the ball flies.</param>
    /// <param name="rateHz">Steps a second of an integrating law, 1 to 1,000,000. A closed form has none.</param>
    /// <exception cref="SceneException">A value is out of range.</exception>
    public static Scene Drop(
        double heightMetres = 10, double restitution = 0.8, MotionLaw law = MotionLaw.RungeKutta4, double rateHz = 200)
    {
        if (!(rateHz is >= 1 and <= 1e6))
        {
            throw new SceneException(
                string.Create(CultureInfo.InvariantCulture, $"The rate is {rateHz:R} steps a second; it must lie between 1 and 1E+06."));
        }

        SimDuration step = law == MotionLaw.Ballistic ? BodySpec.DefaultStep : SimDuration.FromSeconds(1 / rateHz);
        return new SceneBuilder("drop")
            .AddPlane("floor", Vector3D.Up, Vector3D.Zero)
            .AddBody("ball", new BodySpec(0.5, 1, restitution, law, step), new Vector3D(0, heightMetres, 0))
            .Build();
    }

    /// <summary>Two balls in closed-form flight that meet off-centre, 0.86 s after the start, then bounce on the floor y = 0.</summary>
    public static Scene Pair() => Pair(MotionLaw.Ballistic);

    /// <summary>The same two balls under a law of one's choice.</summary>
    public static Scene Pair(MotionLaw law) =>
        new SceneBuilder("pair")
            .AddPlane("floor", Vector3D.Up, Vector3D.Zero)
            .AddBody("light", new BodySpec(0.5, 1, 0.9, law), new Vector3D(-3, 4, 0), new Vector3D(3, 2, 0))
            .AddBody("heavy", new BodySpec(0.4, 3, 0.8, law), new Vector3D(3, 4.3, 0.2), new Vector3D(-3, 2, 0))
            .Build();

    /// <summary>The same scene with every body on another law of flight; of places, sizes and materials no bit changes.</summary>
    /// <param name="scene">The scene.</param>
    /// <param name="law">The law for all bodies.</param>
    /// <param name="step">The step of an integrating law; zero means <see cref="BodySpec.DefaultStep"/>. A closed form ignores it.</param>
    /// <exception cref="SceneException">That law cannot move some body: a supplied acceleration needs an integrating one.</exception>
    public static Scene WithMotion(Scene scene, MotionLaw law, SimDuration step)
    {
        ArgumentNullException.ThrowIfNull(scene);
        SceneBuilder builder = new SceneBuilder(scene.Name)
            .WithGravity(scene.Gravity)
            .WithResolution(scene.Resolution)
            .WithSmallestRadius(scene.SmallestRadius);
        foreach (StaticPlane plane in scene.Planes)
        {
            builder.AddPlane(plane.Name, plane.Normal, plane.Offset, plane.Restitution);
        }

        foreach (StaticSphere sphere in scene.StaticSpheres)
        {
            builder.AddStaticSphere(sphere.Name, sphere.Centre, sphere.Radius, sphere.Restitution);
        }

        foreach (IAcceleration acceleration in scene.Accelerations)
        {
            builder.AddAcceleration(acceleration);
        }

        foreach (SceneBody body in scene.Bodies)
        {
            BodySpec was = body.Spec;
            builder.AddBody(
                body.Name, new BodySpec(was.Radius, was.Mass, was.Restitution, law, step, was.Acceleration), body.Position, body.Velocity);
        }

        return builder.Build();
    }
}
