using LagSim.Scenes;

namespace LagSim.Harness.SceneFiles;

/// <summary>Three balls on a frictionless floor between four walls; whatever comes within a metre of the left or right wall is in a goal.</summary>
internal static class GoalsScene
{
    internal const string Name = "goals";

    private const double Radius = 0.3;
    private const double GoalLine = 4;
    private const double Wall = 5;
    private const double Side = 3;

    internal static Scene Build()
    {
        BodySpec ball = new(Radius, 0.5, 0.95);
        SceneBuilder builder = new SceneBuilder(Name)
            .AddPlane("floor", Vector3D.Up, Vector3D.Zero)
            .AddPlane("left wall", new Vector3D(1, 0, 0), -Wall)
            .AddPlane("right wall", new Vector3D(-1, 0, 0), -Wall)
            .AddPlane("near wall", new Vector3D(0, 0, 1), -Side)
            .AddPlane("far wall", new Vector3D(0, 0, -1), -Side)
            .AddSensorPlane("left goal", new Vector3D(1, 0, 0), -GoalLine)
            .AddSensorPlane("right goal", new Vector3D(-1, 0, 0), -GoalLine)
            .WithRules(BuiltInRules.Named(Name)!)
            .WithSeed(1)
            .WithSmallestRadius(GoalsRules.PowerUpRadius);
        for (int n = 0; n < 3; n++)
        {
            builder.AddBody($"ball {n}", ball, new Vector3D(0, Radius, 1.5 * (n - 1)));
        }

        return builder.Build();
    }
}
