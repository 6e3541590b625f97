using System;
using LagSim.Hosting;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Tests.Docs;

/// <summary>The code of docs/SENSORS.md, each as it stands there: <see cref="SnippetTests"/> holds the page to it and runs it.</summary>
internal static class SensorSnippets
{
    internal static Scene Penalty()
    {
        Scene scene = new SceneBuilder("penalty")
            .AddPlane("lawn", Vector3D.Up, Vector3D.Zero, friction: 0.5)
            .AddBody("ball", new BodySpec(0.11, 0.43, 0.7, friction: 0.6), new Vector3D(0, 0.11, 0), velocity: new Vector3D(20, 4, 0))
            .AddSensorPlane("goal", normal: new Vector3D(-1, 0, 0), point: new Vector3D(11, 0, 0), SensorCoverage.Whole) // behind x = 11 m
            .AddBody("keeper", new BodySpec(0.4, 80, 0.1), new Vector3D(10.5, 0.4, 0))
            .AddSensorSphere("keeper's reach", new Vector3D(0, 0.6, 0), radius: 2, SensorCoverage.Part, carrier: "keeper") // about its centre
            .Build();
        return scene;
    }

    internal static bool Read(Scene scene)
    {
        Simulation world = new(scene);
        world.AdvanceTo(SimTime.FromSeconds(1));
        int goal = scene.SensorNamed("goal");
        foreach (Crossing crossing in world.Crossings(world.HistoryEdge, world.SimulatedTo))
        {
            Console.WriteLine($"{scene.Describe(crossing.Body)} {(crossing.Entered ? "enters" : "leaves")} '{scene.Sensors[crossing.Sensor].Name}' at {crossing.Time.ToShortString()}");
        }

        bool isGoal = world.IsInside(scene.BodyNamed("ball"), goal, SimTime.FromSeconds(1));
        return isGoal;
    }

    internal static void Hear(Scene scene, int goal)
    {
        CrossingNotices crossings = new();
        using SimulationHost host = new(scene, new StopwatchClock(), crossings: crossings);
        host.Start();

        // each frame
        while (crossings.TryRead(out CrossingNotice crossing))
        {
            if (crossing.Kind == NoticeKind.Confirmed && crossing.Sensor == goal && crossing.Entered)
            {
                Console.WriteLine($"goal at {crossing.Time.ToShortString()}");
            }
        }
    }
}
