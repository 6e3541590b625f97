using LagSim.Scenes;

namespace LagSim.Net.Sessions;

/// <summary>The scene that <see cref="SessionWarmup"/> plays in, with something of every kind of motion and contact.</summary>
internal static class WarmupScene
{
    /// <summary>The body that the host acts on; the next is the client's.</summary>
    internal const int HostsBody = 0;

    /// <summary>The body that the client acts on.</summary>
    internal const int ClientsBody = 1;

    private const double Radius = 0.5;

    /// <summary>
    /// Creates a scene with a few bodies under every kind of law, each checked against every other; or with so many in plain flight that
    /// they are found by the neighbour lists.
    /// </summary>
    internal static Scene Of(bool few)
    {
        SceneBuilder builder = new SceneBuilder("warm-up").WithRules(new WarmupRules())
            .AddPlane("floor", Vector3D.Up, Vector3D.Zero)
            .AddPlane("wall", new Vector3D(1, 0, 0), new Vector3D(-20, 0, 0))
            .AddForce(Force.LinearDrag("syrup", 0.1), out ForceSet syrup)
            .AddForce(Force.QuadraticDrag("air", 0.01), out ForceSet air)
            .AddBody("host's", new BodySpec(Radius, 1, 0.5, friction: 0.3, rollingResistance: 0.01), new Vector3D(-3, Radius, 0))
            .AddBody("client's", new BodySpec(Radius, 1, 0.5, few ? MotionLaw.RungeKutta4 : MotionLaw.Ballistic), new Vector3D(3, 2, 0))
            .AddBody("beside the host's", new BodySpec(Radius, 2, 0.5, friction: 0.3), new Vector3D(-1.5, Radius, 0))
            .AddBody("beside the client's", new BodySpec(Radius, 2, 0.5), new Vector3D(4.5, Radius, 0));
        if (few)
        {
            return builder
                .AddStaticSphere("stone", new Vector3D(0, 0, 8), 1)
                .AddBody("on the stone", new BodySpec(Radius, 1, 0.2, friction: 0.3), new Vector3D(0.1, 3, 8))
                .AddBody("in syrup", new BodySpec(Radius, 1, 0.8, forces: syrup), new Vector3D(8, 3, 0), new Vector3D(-2, 0, 0))
                .AddBody("in air", new BodySpec(Radius, 1, 0.8, forces: air, friction: 0.2), new Vector3D(8, 3, 4), new Vector3D(-2, 0, 0), spin: new Vector3D(0, 0, 3))
                .Build();
        }

        const int across = 9;
        for (int n = 0; n < across * across; n++)
        {
            int row = n / across, column = n % across;
            builder.AddBody($"ball {n}", new BodySpec(Radius, 1, 0.9), new Vector3D(-8 + (2 * column), n % 3 == 0 ? 1.5 : Radius, 4 + (2 * row)));
        }

        return builder.Build();
    }
}
