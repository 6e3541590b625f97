using System;
using System.Collections.Generic;
using System.Globalization;
using LagSim.Events;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.SceneFiles;
using LagSim.Hosting;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>Work as it is counted for a player's budget, beside the CPU time that it takes: units in a microsecond, in worlds of every kind.</summary>
internal static class CountedTable
{
    internal static void Print(bool brief)
    {
        foreach ((_, Func<Simulation> make, double until) in Worlds(brief))
        {
            Run(make(), until); // so that nothing is measured that the compiler has not finished with
        }

        Console.WriteLine($"units counted in a microsecond of {ThreadClock.Name} of the thread; 1 is exact, below 1 is counted too little");
        Console.WriteLine("| world | ms | events | units a us |");
        Console.WriteLine("|---|---|---|---|");
        foreach ((string name, Func<Simulation> make, double until) in Worlds(brief))
        {
            (double took, double counted, long events) = Run(make(), until);
            Console.WriteLine(string.Create(CultureInfo.InvariantCulture, $"| {name} | {took / 1000:0.0} | {events:N0} | {counted / took:0.00} |"));
        }
    }

    private static IEnumerable<(string Name, Func<Simulation> Make, double Until)> Worlds(bool brief)
    {
        foreach (int balls in brief ? new[] { 32 } : new[] { 16, 32, 64, 128 })
        {
            yield return ($"{balls} balls at one point, e = 0.5", () => Crowd(balls, 0, 0.5, 1), 1.1);
            yield return ($"{balls} within a radius, e = 0.5", () => Crowd(balls, 0.2, 0.5, 1), 1.1);
            yield return ($"{balls} at one point, elastic", () => Crowd(balls, 0, 1, 1), 1.1);
            yield return ($"{balls} at one point, every other of a hundredth of the mass, elastic", () => Crowd(balls, 0, 1, 0.01), 0.4);
            yield return ($"{balls} at one point, every other of a millionth of the mass, e = 0.5", () => Crowd(balls, 0, 0.5, 1e-6), 1.1);
        }

        yield return ("a ball at 500 m/s in a gap of 1 mm", () => Gap(1e-3), brief ? 0.05 : 0.3);
        foreach (int balls in brief ? new[] { 64 } : new[] { 8, 64, 500 })
        {
            yield return ($"gas of {balls} in a periodic box", () => Gas(balls), 2);
        }

        foreach (string name in new[] { "billiards", "crowd", "crowd-1000", "drop" })
        {
            yield return ($"scene {name}", () => new Simulation(BuiltInScenes.TryGet(name, out Scene? scene) ? scene : throw new InvalidOperationException(name)), 6);
        }

        foreach (int balls in new[] { 32, 64 })
        {
            yield return ($"heap of {balls} in a pit", () => Heap(balls), brief ? 1 : 3);
        }
    }

    private static (double Microseconds, double Counted, long Events) Run(Simulation world, double until)
    {
        WorkLedger work = new() { MaxWorkPerStep = double.PositiveInfinity };
        world.Engine.Meter.Observer = work;
        double began = ThreadClock.Microseconds;
        world.AdvanceTo(SimTime.FromSeconds(until));
        return (ThreadClock.Microseconds - began, work.Total, world.EventsProcessed);
    }

    private static Simulation Crowd(int balls, double within, double restitution, double light)
    {
        Simulation world = new(new SceneBuilder("a floor").AddPlane("floor", Vector3D.Up, 0).WithSmallestRadius(0.1).Build());
        Random random = new(balls);
        for (uint n = 1; n <= balls; n++)
        {
            BodySpec spec = new(0.2, n % 2 == 0 ? light : 1, restitution);
            world.Submit(PlayerAction.Spawn(spec, new Vector3D(0, 1, 0) + (Anywhere(random) * within)).Stamp(SimTime.FromSeconds(0.1), 1, n));
        }

        return world;
    }

    private static Simulation Gap(double gap)
    {
        Simulation world = new(new SceneBuilder("gap").AddPlane("floor", Vector3D.Up, 0).AddPlane("roof", -Vector3D.Up, -(1 + gap))
            .AddBody("ball", new BodySpec(0.5, 1, 1), new Vector3D(0, 0.5 + (gap / 2), 0)).Build());
        world.Submit(ExternalEvent.SetVelocity(SimTime.FromSeconds(0.01), 1, 1, BodyId.OfScene(0), new Vector3D(0, 500, 0)));
        return world;
    }

    private static Simulation Gas(int balls)
    {
        SceneBuilder scene = new SceneBuilder("gas").WithGravity(Vector3D.Zero).WithPeriodicBox(new Vector3D(10, 10, 10));
        Random random = new(1);
        int side = (int)Math.Ceiling(Math.Cbrt(balls));
        for (int n = 0; n < balls; n++)
        {
            Vector3D cell = new(n % side, n / side % side, n / side / side);
            scene.AddBody($"ball {n}", new BodySpec(0.3, 1, 1), (cell + new Vector3D(0.5, 0.5, 0.5)) * (10.0 / side), Anywhere(random) * 30);
        }

        return new Simulation(scene.Build());
    }

    private static Simulation Heap(int balls)
    {
        SceneBuilder scene = new SceneBuilder("heap").AddPlane("floor", Vector3D.Up, 0.0)
            .AddPlane("west", new Vector3D(1, 0, 0), -0.4).AddPlane("east", new Vector3D(-1, 0, 0), -0.4)
            .AddPlane("north", new Vector3D(0, 0, 1), -0.4).AddPlane("south", new Vector3D(0, 0, -1), -0.4);
        Random random = new(7);
        for (int n = 0; n < balls; n++)
        {
            Vector3D place = new(Place(n % 3), 0.15 + (0.25 * (n / 9)), Place(n / 3 % 3));
            scene.AddBody($"ball {n}", new BodySpec(0.1, 1, 0.2, friction: 0.3), place);
        }

        return new Simulation(scene.Build());

        double Place(int column) => ((column - 1) * 0.24) + (0.02 * random.NextDouble());
    }

    private static Vector3D Anywhere(Random random)
    {
        Vector3D place;
        do
        {
            place = new Vector3D((2 * random.NextDouble()) - 1, (2 * random.NextDouble()) - 1, (2 * random.NextDouble()) - 1);
        }
        while (place.LengthSquared > 1);
        return place;
    }
}
