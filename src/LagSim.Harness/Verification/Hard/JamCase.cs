using System;
using System.Collections.Generic;
using LagSim.Scenes;
using LagSim.Testing.Links;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// A jammed hopper: a smooth ball, slightly too large for the hole between four static spheres, is stuck in it under a heap. Its depth is
/// that of the geometry, whatever the load.
/// </summary>
/// <remarks>
/// The line from a rim's centre to the plug rises by a small angle t, so a load W presses each of the four contacts with W / (4 sin t). The
/// plug is deeper than a contact by 1 / sin t. The plug has no friction, else it could stick above its position.
/// </remarks>
internal sealed class JamCase : IHardCase
{
    private const double Rim = 0.8, Tolerance = 1e-5, Seconds = 3, Ball = 0.2;

    public string Name => "jam";

    public string Title => "a jammed hopper: a ball in the hole between four static spheres, under a heap, at the depth that geometry gives";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach ((double degrees, int load) in context.Sizes(
            [(10.0, 0), (10.0, 8)], [(30.0, 0), (30.0, 24), (10.0, 0), (10.0, 24), (4.0, 0), (4.0, 24)]))
        {
            yield return Sits(context, degrees, load, 1);
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        yield return Sits(context, 10, 8, 0.98) with { Note = "a plug that is too small by a fiftieth" };
    }

    private HardRow Sits(HardContext context, double degrees, int load, double part)
    {
        double slope = degrees * Math.PI / 180, reach = Math.Sqrt(2) * Rim / Math.Cos(slope), rest = reach * Math.Sin(slope);
        double radius = reach - Rim;
        SceneBuilder builder = new SceneBuilder("jam").WithContactTolerance(Tolerance).AddPlane("floor", Vector3D.Up, -3.0)
            .AddPlane("west", V(1), -Rim).AddPlane("east", V(-1), -Rim).AddPlane("north", V(0, 0, 1), -Rim).AddPlane("south", V(0, 0, -1), -Rim);
        for (int n = 0; n < 4; n++)
        {
            builder.AddStaticSphere(FormattableString.Invariant($"rim {n + 1}"), V(n % 2 == 0 ? -Rim : Rim, 0, n / 2 == 0 ? -Rim : Rim), Rim);
        }

        builder.AddBody("plug", new BodySpec(part * radius, 1, 0.2), V(0, rest + 0.01));
        SeededRandom random = new(context.Seed);
        for (int n = 0; n < load; n++)
        {
            double x = (((n % 2) - 0.5) * 0.6) + random.NextDouble(-0.05, 0.05);
            double z = (((n / 2 % 2) - 0.5) * 0.6) + random.NextDouble(-0.05, 0.05);
            double y = Math.Max(Rim, rest + radius) + (1.5 * Ball) + (n / 4 * 0.5);
            builder.AddBody(FormattableString.Invariant($"ball {n + 1}"), new BodySpec(Ball, 1, 0.2, friction: 0.3), V(x, y, z));
        }

        Simulation simulation = context.Run(builder.Build(), Seconds);
        double off = (Read(simulation, 0, Seconds).Position - V(0, rest)).Length;
        return new HardRow(
            Name, FormattableString.Invariant($"{load} balls on a plug whose contacts rise by {degrees} degrees, {Seconds} s"), off, "off_m",
            Tolerance / Math.Sin(slope), "d, 1e-5 m, over the sine of the slope: a contact is d deep at most while it settles",
            "where a sphere touches four whose centres are the corners of a square");
    }
}
