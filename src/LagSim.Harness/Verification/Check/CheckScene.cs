using System.Collections.Generic;
using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Check;

/// <summary>A random scene of a session, and what is done in it.</summary>
internal abstract class CheckScene
{
    /// <summary>The force that needs a body to turn; its number among <see cref="AddForces"/>.</summary>
    internal const int Magnus = 6;

    private readonly List<(BodySpec Spec, Vector3D Position, Vector3D Velocity)> bodies = [];

    /// <summary>The accelerations that a peer must supply.</summary>
    internal static IReadOnlyList<IAcceleration> Accelerations { get; } = [new CentralPull()];

    internal int BodyCount => bodies.Count;

    /// <summary>What the scene may cost, as events that it takes alone with all that is done in it; null: as much as any.</summary>
    internal virtual long? MaxEvents => null;

    /// <summary>How often players' hands take a body, at least.</summary>
    internal virtual int FewestHands => 0;

    /// <summary>How often players' hands take a body, at most.</summary>
    internal virtual int MaxHands => 3;

    /// <summary>Within how many seconds of its start something is done.</summary>
    internal virtual double BusySeconds => CheckCase.Length;

    internal BodySpec SpecOf(int body) => bodies[body].Spec;

    /// <summary>The scene with these of its bodies alone.</summary>
    internal Scene Build(IReadOnlyList<int> kept)
    {
        SceneBuilder builder = new SceneBuilder("check").WithSmallestRadius(0.15);
        AddSurroundings(builder);
        foreach (int i in kept)
        {
            (BodySpec spec, Vector3D position, Vector3D velocity) = bodies[i];
            builder.AddBody($"ball {i}", spec, position, velocity, spin: MayTurn(spec) ? new Vector3D(0, 3, i - 4) : Vector3D.Zero);
        }

        return builder.Build();
    }

    internal abstract BodySpec DrawSpec();

    /// <summary>Which of the scene's bodies something is done to.</summary>
    internal virtual int DrawBody(SeededRandom from) => from.NextInt(BodyCount);

    /// <summary>Within how many seconds of its start a hand takes a body, unless one is after what another has.</summary>
    internal virtual double GraspSeconds => BusySeconds;

    /// <summary>Which of the scene's bodies a hand takes.</summary>
    internal virtual int DrawHeld(SeededRandom from) => from.NextInt(BodyCount);

    /// <summary>Where something appears, or a hand goes.</summary>
    internal abstract Vector3D DrawPosition();

    internal abstract Vector3D DrawSpin(in BodySpec spec);

    /// <summary>Up to about that much along each axis.</summary>
    internal abstract Vector3D DrawVelocity(double most);

    /// <summary>Whether it makes a difference that a ball turns.</summary>
    protected static bool MayTurn(in BodySpec spec) => spec.Friction > 0 || spec.Forces.Contains(Magnus);

    protected void Add(in BodySpec spec, Vector3D position, Vector3D velocity) => bodies.Add((spec, position, velocity));

    /// <summary>All that there is but the balls.</summary>
    protected abstract void AddSurroundings(SceneBuilder builder);

    /// <summary>Four walls and a ceiling, that far from the middle, which is so much above the floor of the room.</summary>
    protected static void AddWalls(SceneBuilder builder, double half, double middle, double restitution) => builder
        .AddPlane("west", new Vector3D(1, 0, 0), new Vector3D(-half, 0, 0), restitution)
        .AddPlane("east", new Vector3D(-1, 0, 0), new Vector3D(half, 0, 0), restitution)
        .AddPlane("north", new Vector3D(0, 0, 1), new Vector3D(0, 0, -half), restitution)
        .AddPlane("south", new Vector3D(0, 0, -1), new Vector3D(0, 0, half), restitution)
        .AddPlane("ceiling", new Vector3D(0, -1, 0), new Vector3D(0, middle + half, 0), restitution);

    /// <summary>What drags moves itself, or not: up to 2 m/s along each axis.</summary>
    protected static Vector3D DrawWind(SeededRandom from) => from.IsLucky(50)
        ? new Vector3D(from.NextDouble(-1, 1), from.NextDouble(-1, 1), from.NextDouble(-1, 1)) * 2
        : Vector3D.Zero;

    /// <summary>The forces that may act on a ball, by number; the first that have a closed form are 1 to 3.</summary>
    /// <param name="builder">What gets them.</param>
    /// <param name="half">Half of how high the scene is, in metres.</param>
    /// <param name="wind">How what drags moves, in m/s.</param>
    protected static void AddForces(SceneBuilder builder, double half, Vector3D wind) => builder
        .AddForce(Force.Supplied(Accelerations[0]))
        .AddForce(Force.LinearDrag("oil", 0.3, wind))
        .AddForce(Force.Spring("spring", new Vector3D(0, half, 0), 1.5, 0.1))
        .AddForce(Force.Magnetic("coil", new Vector3D(0, 0.4, 1), 1.2))
        .AddForce(Force.QuadraticDrag("air", 0.1, wind))
        .AddForce(Force.Central("well", new Vector3D(0.2, half, 0), 1.5, 1))
        .AddForce(Force.Magnus("swerve", 0.1));
}
