using LagSim.Scenes;

namespace LagSim.Harness.SceneFiles;

/// <summary>Newton's cradle without strings.</summary>
/// <remarks>
/// The balls stand on a frictionless floor and touch, so the rule for several contacts at one instant passes the push from ball to ball,
/// and the laws of rest and sliding apply. Two walls stand in for the strings. Every position and time is a multiple of a power of two, so
/// nothing is rounded, and after each period of 4 s the world is the same to the bit.
/// </remarks>
internal static class CradleScene
{
    internal const string Name = "cradle";
    internal const double Radius = 0.5;
    internal const double Speed = 2;
    internal const double WallDistance = 4.5;
    internal const int Resting = 4;

    internal static Scene Build(double restitution)
    {
        BodySpec ball = new(Radius, 1, restitution);
        SceneBuilder builder = new SceneBuilder(Name)
            .AddPlane("floor", Vector3D.Up, Vector3D.Zero)
            .AddPlane("left", new Vector3D(1, 0, 0), -WallDistance)
            .AddPlane("right", new Vector3D(-1, 0, 0), -WallDistance)
            .AddBody("ball 1", ball, new Vector3D(Radius - WallDistance, Radius, 0), new Vector3D(Speed, 0, 0));
        for (int n = 0; n < Resting; n++)
        {
            builder.AddBody($"ball {n + 2}", ball, new Vector3D(n - 1, Radius, 0));
        }

        return builder.Build();
    }
}
