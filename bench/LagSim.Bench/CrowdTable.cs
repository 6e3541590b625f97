using System;
using System.Globalization;
using LagSim.Events;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>What bodies cost that players spawn at one point, or at random places within one of their own size, also elastic ones and ones of
/// unlike masses: the longest instant, and the first second.</summary>
internal static class CrowdTable
{
    private static readonly SimTime Spawned = SimTime.FromSeconds(0.1);
    private static readonly SimTime End = SimTime.FromSeconds(1.1);

    internal static void Print(bool brief)
    {
        Console.WriteLine($"n balls of 0.2 m spawned 1 m above a floor at one tick; {ThreadClock.Name} of the thread");
        Console.WriteLine("| spawned | of | n | longest instant, ms | per ball, us | first second, ms | per ball, us | events |");
        Console.WriteLine("|---|---|---|---|---|---|---|---|");
        foreach ((double within, double restitution, double light) in new (double, double, double)[] { (0, 0.5, 1), (0.2, 0.5, 1), (0, 1, 1), (0, 1, 0.01), (0, 0.5, 1e-6) })
        {
            string of = string.Create(CultureInfo.InvariantCulture, $"e = {restitution}, 1 kg{(light < 1 ? $" and {light:0.######} kg in turn" : "")}");
            Run(32, within, restitution, light); // so that nothing is measured that the compiler has not finished with
            foreach (int bodies in brief ? new[] { 16, 32 } : restitution < 1 && light == 1 ? new[] { 16, 32, 64, 128, 192, 256, 512 } : new[] { 16, 32, 64, 128 })
            {
                (double longest, double first, long events) = Run(bodies, within, restitution, light);
                Console.WriteLine(string.Create(
                    CultureInfo.InvariantCulture,
                    $"| {(within > 0 ? "within a radius" : "at one point")} | {of} | {bodies} | {longest:0.0} | {longest * 1000 / bodies:0} | {first:0} | {first * 1000 / bodies:0} | {events:N0} |"));
            }
        }
    }

    private static (double Longest, double First, long Events) Run(int bodies, double within, double restitution, double light)
    {
        Simulation world = new(new SceneBuilder("a floor").AddPlane("floor", Vector3D.Up, 0).WithSmallestRadius(0.1).Build());
        Random random = new(bodies);
        for (uint n = 1; n <= bodies; n++)
        {
            BodySpec spec = new(0.2, n % 2 == 0 ? light : 1, restitution);
            world.Submit(PlayerAction.Spawn(spec, new Vector3D(0, 1, 0) + (InUnitBall(random) * within)).Stamp(Spawned, 1, n));
        }

        world.AdvanceTo(Spawned - SimDuration.OneTick);
        double longest = 0;
        double all = 0;
        for (bool isThere = false; !isThere;)
        {
            long one = 1;
            double before = ThreadClock.Microseconds;
            isThere = world.TryAdvanceTo(End, ref one);
            double took = (ThreadClock.Microseconds - before) / 1000;
            longest = Math.Max(longest, took);
            all += took;
        }

        return (longest, all, world.EventsProcessed);
    }

    private static Vector3D InUnitBall(Random random)
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
