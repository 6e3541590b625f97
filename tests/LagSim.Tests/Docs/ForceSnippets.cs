using System;
using System.Net;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Tests.Docs;

/// <summary>The code of docs/FORCES.md, each as it stands there: <see cref="SnippetTests"/> holds the page to it and runs it.</summary>
internal static class ForceSnippets
{
    internal static Scene Forces()
    {
        Scene scene = new SceneBuilder("forces")
            .WithGravity(new Vector3D(0, -9.81, 0)) // the default; in m/s², for every body
            .AddForce(Force.QuadraticDrag("air", coefficient: 0.0107, medium: new Vector3D(3, 0, 0)), out ForceSet air) // with a wind of 3 m/s
            .AddForce(Force.Magnus("lift", coefficient: 0.005), out ForceSet lift)
            .AddForce(Force.Spring("rubber", anchor: new Vector3D(0, 5, 0), stiffness: 40, damping: 0.1), out ForceSet rubber)
            .AddPlane("floor", Vector3D.Up, Vector3D.Zero)
            .AddBody("football", new BodySpec(0.11, 0.43, 0.8, forces: air | lift), new Vector3D(0, 1, 0), velocity: new Vector3D(25, 8, 0), spin: new Vector3D(0, 50, 0))
            .AddBody("yo-yo", new BodySpec(0.03, 0.1, 0.5, forces: rubber), new Vector3D(0, 4, 5))
            .AddBody("stone", new BodySpec(0.05, 1, 0.3), new Vector3D(-2, 3, 0)) // no force but gravity
            .Build();
        return scene;
    }

    internal static void Explain(Scene scene)
    {
        Console.WriteLine(scene.Explain());
    }

    internal static Scene Whirl()
    {
        Scene scene = new SceneBuilder("whirl")
            .AddForce(Force.Supplied(new Whirl()), out ForceSet whirl)
            .AddBody("leaf", new BodySpec(0.1, 0.01, 0, forces: whirl), new Vector3D(2, 10, 0))
            .Build();
        return scene;
    }

    internal static void Join(IPEndPoint address)
    {
        ClientOptions options = new() { Accelerations = new[] { new Whirl() } };
        using PeerThread peer = PeerThread.Join(address, options);
    }

    internal static BodyState Roll()
    {
        Scene scene = new SceneBuilder("lane")
            .AddPlane("lane", Vector3D.Up, Vector3D.Zero, friction: 0.2)
            .AddBody(
                "ball", new BodySpec(radius: 0.108, mass: 6, restitution: 0.1, friction: 0.5, rollingResistance: 0.01),
                new Vector3D(0, 0.108, 0), velocity: new Vector3D(8, 0, 0))
            .Build();
        Simulation world = new(scene);
        world.AdvanceTo(SimTime.FromSeconds(2));
        world.TryRead(scene.BodyNamed("ball"), SimTime.FromSeconds(2), out BodyState ball);
        Console.WriteLine($"{ball.Motion} at {ball.Velocity.X:F3} m/s, turning by {ball.Spin.Z:F2} rad/s");
        return ball;
    }

    internal static BodySpec[] Laws(ForceSet air)
    {
        BodySpec automatic = new(0.11, 0.43, 0.8, forces: air, tolerance: 1e-6); // the cheapest that is exact; here error control within 1 µm instead of 1 nm
        BodySpec order5 = new(0.11, 0.43, 0.8, MotionLaw.DormandPrince54, SimDuration.FromSeconds(0.01), air, tolerance: 0); // fixed steps of 10 ms
        BodySpec order4 = new(0.11, 0.43, 0.8, MotionLaw.RungeKutta4, SimDuration.FromSeconds(0.005), air); // fixed steps of 5 ms, the thesis's law
        return [automatic, order5, order4];
    }
}

/// <summary>Turns about the vertical through the origin what is moved by it, and slows it down.</summary>
internal sealed class Whirl : IAcceleration
{
    public string Name => "whirl";

    public int Version => 1; // raise it with every change of a result

    public Vector3D At(double seconds, in Vector3D position, in Vector3D velocity) =>
        new Vector3D(-position.Z, 0, position.X) - (velocity * 0.5);
}
