using System;
using System.Collections.Generic;
using System.Diagnostics.CodeAnalysis;
using System.Globalization;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.SceneFiles;

/// <summary>The built-in scenes.</summary>
public static class BuiltInScenes
{
    /// <summary>The default number of balls of the crowd: 200.</summary>
    public const int DefaultCrowd = CrowdScene.DefaultBodies;

    /// <summary>The most balls a crowd can have: 100,000.</summary>
    public const int MaxCrowd = CrowdScene.MaxBodies;

    private static readonly string[] AllNames = ["drop", "pair", CradleScene.Name, BilliardsScene.Name, CrowdScene.Name, GoalsScene.Name];

    /// <summary>The names of all scenes, except <c>crowd-N</c>, a crowd of any number.</summary>
    public static IReadOnlyList<string> Names => AllNames;

    /// <summary>The valid names in words, for error messages.</summary>
    public static string KnownNames => $"{string.Join(", ", AllNames)}, crowd-N for N from 1 to {MaxCrowd}";

    /// <summary>Returns the built-in scene of a name, with default settings.</summary>
    public static bool TryGet(string name, [NotNullWhen(true)] out Scene? scene)
    {
        ArgumentNullException.ThrowIfNull(name);
        scene = name switch
        {
            "drop" => Drop(),
            "pair" => Pair(),
            CradleScene.Name => Cradle(),
            BilliardsScene.Name => Billiards(),
            GoalsScene.Name => Goals(),
            _ => CrowdScene.TryParse(name, out int bodies) ? CrowdScene.Build(name, bodies) : null,
        };
        return scene is not null;
    }

    /// <summary>Returns a description of a built-in scene, in a line.</summary>
    /// <exception cref="ArgumentException">There is no built-in scene of that name.</exception>
    public static string Describe(string name) => name switch
    {
        "drop" => "the thesis's drop test: a ball of 1 kg falls from 10 m onto a floor, bounces and comes to rest",
        "pair" => "two balls of unequal mass meet off-centre in flight, then bounce on a floor",
        CradleScene.Name => "Newton's cradle without strings: a ball runs into four that touch, for ever, between two walls",
        BilliardsScene.Name => "the break at pool: a cue ball runs into a rack of fifteen, on a table with four cushions and without friction",
        CrowdScene.Name => $"{DefaultCrowd} elastic balls of all sizes fly about in a box; crowd-N has N, 1 to {MaxCrowd}",
        GoalsScene.Name => "three balls, two goals, and rules: a count-down, a score, power-ups at random places, commands of players",
        _ => CrowdScene.TryParse(name, out int bodies)
            ? $"elastic balls of all sizes fly about in a box, {bodies} of them"
            : throw new ArgumentException($"There is no built-in scene '{name}'; there are {KnownNames}.", nameof(name)),
    };

    /// <summary>The drop test: a ball of radius 0.5 m and 1 kg, at rest at first, above the floor y = 0.</summary>
    /// <param name="heightMetres">The height of the ball's centre above the floor, at least its radius.</param>
    /// <param name="restitution">The restitution of the ball, 0 to 1; the floor's is 1, and the lesser counts.</param>
    /// <param name="law">The motion law of the ball.</param>
    /// <param name="rateHz">Steps per second of an integrating law, 1 to 1,000,000. A closed form has none.</param>
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

    /// <summary>The same two balls with a given motion law.</summary>
    public static Scene Pair(MotionLaw law) =>
        new SceneBuilder("pair")
            .AddPlane("floor", Vector3D.Up, Vector3D.Zero)
            .AddBody("light", new BodySpec(0.5, 1, 0.9, law), new Vector3D(-3, 4, 0), new Vector3D(3, 2, 0))
            .AddBody("heavy", new BodySpec(0.4, 3, 0.8, law), new Vector3D(3, 4.3, 0.2), new Vector3D(-3, 2, 0))
            .Build();

    /// <summary>
    /// Newton's cradle without strings: a ball of radius 0.5 m and 1 kg runs at 2 m/s into four that stand on a frictionless floor and
    /// touch; a wall beyond either end sends the one that leaves back, so that after 4 s all is as it was.
    /// </summary>
    /// <param name="restitution">The restitution of the balls, 0 to 1. With the default of 1 the motion never ends.</param>
    /// <exception cref="SceneException"><paramref name="restitution"/> is out of range.</exception>
    public static Scene Cradle(double restitution = 1) => CradleScene.Build(restitution);

    /// <summary>
    /// The break at pool: a cue ball at 8 m/s, a rack of fifteen that touch, a table of 2.54 m by 1.27 m with four cushions.
    /// </summary>
    /// <remarks>Balls slide without friction and do not spin, so they never stop; restitution alone slows them down.</remarks>
    /// <param name="ballRestitution">The restitution of ball on ball, 0 to 1.</param>
    /// <param name="cushionRestitution">The restitution of the cushions, 0 to 1; the lesser of the two counts.</param>
    /// <param name="breakSpeed">How fast the cue ball comes, in m/s; 0 if somebody has still to break.</param>
    /// <exception cref="SceneException">A value is out of range.</exception>
    public static Scene Billiards(
        double ballRestitution = 0.95, double cushionRestitution = 0.8, double breakSpeed = BilliardsScene.BreakSpeed) =>
        BilliardsScene.Build(ballRestitution, cushionRestitution, breakSpeed);

    /// <summary>Three balls on a floor with two goals, and <see cref="GoalsRules"/>, which kick them off after a second.</summary>
    public static Scene Goals() => GoalsScene.Build();

    /// <summary>Elastic balls of 0.15 m to 0.3 m in a cubic box without gravity, at most one to a cubic metre, at some 1.7 m/s.</summary>
    /// <remarks>The same for the same number, always. Cost: O(n log n).</remarks>
    /// <param name="bodies">The number of balls, 1 to <see cref="MaxCrowd"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException"><paramref name="bodies"/> is out of range.</exception>
    public static Scene Crowd(int bodies = DefaultCrowd) =>
        bodies is >= 1 and <= MaxCrowd
            ? CrowdScene.Build(CrowdScene.NameOf(bodies), bodies)
            : throw new ArgumentOutOfRangeException(nameof(bodies), bodies, $"A crowd has 1 to {MaxCrowd} balls.");

    /// <summary>
    /// Equal elastic balls of 0.05 m in a periodic box, at a mean speed of 0.17 m/s. Measurements in it do not depend on walls.
    /// </summary>
    /// <remarks>The same for the same numbers, always. Cost: O(n log n).</remarks>
    /// <param name="bodies">The number of balls, 65 to <see cref="MaxCrowd"/>; fewer do not fill a box that is wide enough for
    /// them.</param>
    /// <param name="fraction">The volume fraction of the balls, above 0 and at most 0.5, where only a cube of an integer, from 125 on, fits
    /// the lattice they start on.</param>
    /// <exception cref="ArgumentOutOfRangeException">A value is out of range.</exception>
    /// <exception cref="SceneException">The box would be too small for its bodies, or the lattice too narrow.</exception>
    public static Scene Gas(int bodies, double fraction = 0.2)
    {
        if (bodies is < 65 or > MaxCrowd)
        {
            throw new ArgumentOutOfRangeException(nameof(bodies), bodies, $"A gas has 65 to {MaxCrowd} balls.");
        }

        return fraction is > 0 and <= GasScene.HighestFraction
            ? GasScene.Build(bodies, fraction)
            : throw new ArgumentOutOfRangeException(nameof(fraction), fraction, "The balls of a gas fill above 0 and at most 0.5 of their box.");
    }

    /// <summary>
    /// Returns the same scene with every body on another motion law. Positions, sizes and materials stay the same to the bit.
    /// </summary>
    /// <param name="scene">The scene.</param>
    /// <param name="law">The law for all bodies.</param>
    /// <param name="step">The step of an integrating law; zero means <see cref="BodySpec.DefaultStep"/>. A closed form ignores it.</param>
    /// <exception cref="SceneException">The law cannot move some body: its forces have no such closed form.</exception>
    public static Scene WithMotion(Scene scene, MotionLaw law, SimDuration step)
    {
        ArgumentNullException.ThrowIfNull(scene);
        SceneBuilder builder = new SceneBuilder(scene.Name)
            .WithGravity(scene.Gravity)
            .WithRestitutionThreshold(scene.RestitutionThreshold)
            .WithContactTolerance(scene.ContactTolerance)
            .WithSmallestRadius(scene.SmallestRadius)
            .WithSpawners(scene.Spawners)
            .WithPeriodicBox(scene.Box.Size)
            .WithSeed(scene.Seed);
        if (scene.Rules is SceneRules rules)
        {
            builder.WithRules(rules);
        }

        foreach (StaticPlane plane in scene.Planes)
        {
            builder.AddPlane(plane.Name, plane.Normal, plane.Offset, plane.Restitution, plane.Friction, plane.Filter);
        }

        foreach (StaticSphere sphere in scene.StaticSpheres)
        {
            builder.AddStaticSphere(sphere.Name, sphere.Centre, sphere.Radius, sphere.Restitution, sphere.Friction, sphere.Filter);
        }

        foreach (Sensor sensor in scene.Sensors)
        {
            builder.AddSensor(sensor, scene);
        }

        foreach (Force force in scene.Forces)
        {
            builder.AddForce(force);
        }

        foreach (SceneBody body in scene.Bodies)
        {
            builder.AddBody(body.Name, body.Spec.With(law, step), body.Position, body.Velocity, body.Players, body.Spin);
        }

        return builder.Build();
    }
}
