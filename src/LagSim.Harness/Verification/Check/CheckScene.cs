using System.Collections.Generic;
using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Check;

/// <summary>A random scene of a session, and the actions in it.</summary>
internal abstract class CheckScene
{
    /// <summary>The force that acts only on a turning body; its number in <see cref="AddForces"/>.</summary>
    internal const int Magnus = 6;

    private readonly List<(BodySpec Spec, Vector3D Position, Vector3D Velocity)> bodies = [];

    /// <summary>The accelerations that a peer must supply.</summary>
    internal static IReadOnlyList<IAcceleration> Accelerations { get; } = [new CentralPull()];

    internal int BodyCount => bodies.Count;

    /// <summary>The budget of the scene, in events that it takes alone with all actions; null for the usual one.</summary>
    internal virtual long? MaxEvents => null;

    /// <summary>The least number of grabs.</summary>
    internal virtual int FewestHands => 0;

    /// <summary>The largest number of grabs.</summary>
    internal virtual int MaxHands => 3;

    /// <summary>The time after its start within which players act, in seconds.</summary>
    internal virtual double BusySeconds => CheckCase.Length;

    /// <summary>The sensors of the scene; none, the default, for none.</summary>
    internal CheckSensors? Sensors { get; set; }

    internal BodySpec SpecOf(int body) => bodies[body].Spec;

    /// <summary>Returns the scene with some of its bodies only.</summary>
    internal Scene Build(IReadOnlyList<int> kept)
    {
        SceneBuilder builder = new SceneBuilder("check").WithSmallestRadius(0.15);
        AddSurroundings(builder);
        Sensors?.AddTo(builder, kept, NameOf);
        foreach (int i in kept)
        {
            (BodySpec spec, Vector3D position, Vector3D velocity) = bodies[i];
            builder.AddBody(NameOf(i), spec, position, velocity, spin: MayTurn(spec) ? new Vector3D(0, 3, i - 4) : Vector3D.Zero);
        }

        return builder.Build();
    }

    internal abstract BodySpec DrawSpec();

    /// <summary>Draws the body of the scene for an action.</summary>
    internal virtual int DrawBody(SeededRandom from) => from.NextInt(BodyCount);

    /// <summary>The time after its start within which a hand takes a body, in seconds, unless two are after the same.</summary>
    internal virtual double GraspSeconds => BusySeconds;

    /// <summary>Draws the body of the scene for a hand.</summary>
    internal virtual int DrawHeld(SeededRandom from) => from.NextInt(BodyCount);

    /// <summary>Draws a position for a spawn or a hand.</summary>
    internal abstract Vector3D DrawPosition();

    internal abstract Vector3D DrawSpin(in BodySpec spec);

    /// <summary>Draws a velocity up to about a given size along each axis.</summary>
    internal abstract Vector3D DrawVelocity(double most);

    private static string NameOf(int body) => $"ball {body}";

    /// <summary>Whether it makes a difference that a ball turns.</summary>
    protected static bool MayTurn(in BodySpec spec) => spec.Friction > 0 || spec.Forces.Contains(Magnus);

    protected void Add(in BodySpec spec, Vector3D position, Vector3D velocity) => bodies.Add((spec, position, velocity));

    /// <summary>Adds everything except the balls.</summary>
    protected abstract void AddSurroundings(SceneBuilder builder);

    /// <summary>Adds four walls at a distance from the middle, and a ceiling at a height above the floor.</summary>
    protected static void AddWalls(SceneBuilder builder, double half, double middle, double restitution) => builder
        .AddPlane("west", new Vector3D(1, 0, 0), new Vector3D(-half, 0, 0), restitution)
        .AddPlane("east", new Vector3D(-1, 0, 0), new Vector3D(half, 0, 0), restitution)
        .AddPlane("north", new Vector3D(0, 0, 1), new Vector3D(0, 0, -half), restitution)
        .AddPlane("south", new Vector3D(0, 0, -1), new Vector3D(0, 0, half), restitution)
        .AddPlane("ceiling", new Vector3D(0, -1, 0), new Vector3D(0, middle + half, 0), restitution);

    /// <summary>Draws the velocity of the medium of a drag: zero, or up to 2 m/s along each axis.</summary>
    protected static Vector3D DrawWind(SeededRandom from) => from.IsLucky(50)
        ? new Vector3D(from.NextDouble(-1, 1), from.NextDouble(-1, 1), from.NextDouble(-1, 1)) * 2
        : Vector3D.Zero;

    /// <summary>Adds the forces that may act on a ball, by number. The first that have a closed form are 1 to 3.</summary>
    /// <param name="builder">The builder to add them to.</param>
    /// <param name="half">Half of the height of the scene, in metres.</param>
    /// <param name="wind">The velocity of the medium of drags, in m/s.</param>
    protected static void AddForces(SceneBuilder builder, double half, Vector3D wind) => builder
        .AddForce(Force.Supplied(Accelerations[0]))
        .AddForce(Force.LinearDrag("oil", 0.3, wind))
        .AddForce(Force.Spring("spring", new Vector3D(0, half, 0), 1.5, 0.1))
        .AddForce(Force.Magnetic("coil", new Vector3D(0, 0.4, 1), 1.2))
        .AddForce(Force.QuadraticDrag("air", 0.1, wind))
        .AddForce(Force.Central("well", new Vector3D(0.2, half, 0), 1.5, 1))
        .AddForce(Force.Magnus("swerve", 0.1));
}
