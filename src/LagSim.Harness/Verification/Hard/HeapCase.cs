using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.SceneFiles.Runs;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// Heaps: balls that fall into a box with friction, a ball that only friction keeps on two others, a leaning tower that only rolling
/// resistance keeps from falling, and a pyramid of balls that never rests.
/// </summary>
internal sealed class HeapCase : IHardCase
{
    /// <summary>The contact tolerances, in metres: of balls that fall into a box, of a few standing balls, and of the pyramid.</summary>
    private const double Falling = 1e-5, Standing = 1e-6, OfPyramid = 1e-7;

    /// <summary>The edge of the pyramid's base, in balls; 30 balls then, with some 150 contacts.</summary>
    private const int Edge = 4;

    public string Name => "heap";

    public string Title => "a heap with friction falls into a box; a ball stays on two that only friction keeps together, a leaning tower by"
        + " rolling resistance; a pyramid of 30 balls stands in steps that never end: no gain of energy, no depth, no drift, and what carries it is its weight";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach ((int balls, double friction) in context.Sizes([(8, 0.5)], [(8, 0.0), (8, 0.5), (16, 0.3), (16, 1.0)]))
        {
            Simulation simulation = context.Simulate(Box(balls, friction, context.Seed));
            yield return Gain($"{balls} balls, mu {friction}", Largest(context, simulation, 3, out double depth));
            yield return Depth($"{balls} balls, mu {friction}", depth);
        }

        foreach (double friction in context.Sizes([0.28], [0.28, 0.5, 2]))
        {
            yield return Stays(context, friction);
        }

        foreach (int balls in context.Sizes([3], [2, 3, 5]))
        {
            yield return Leans(context, balls, 0.99);
        }

        foreach (double friction in context.Sizes([0.0], [0.0, 0.5]))
        {
            foreach (HardRow row in Stands(context, context.Size(0.25, 4.0), friction, Edge))
            {
                yield return row;
            }
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        // A ball on a stiff spring instead of a contact, by Euler's steps.
        double y = 1, v = 0, most = 0, depth = 0;
        const double step = 1.0 / 512;
        for (double t = 0; t < 3; t += step)
        {
            (y, v) = (y + (v * step), v + (((y < 0 ? -1e4 * y : 0) - Gravity) * step));
            depth = Math.Max(depth, -y);
            most = Math.Max(most, (0.5 * v * v) + (Gravity * y) + (y < 0 ? 0.5e4 * y * y : 0));
        }

        const string Springs = "a spring of 10 kN/m for a contact, by Euler's steps";
        yield return Gain("one ball", (most - Gravity) / Gravity) with { Note = Springs };
        yield return Depth("one ball", depth) with { Note = Springs };
        yield return Stays(context, 0.26) with { Note = "a friction below tan 15 degrees" };
        yield return Leans(context, 3, 1.01) with { Note = "a hundredth more aslant than resistance holds" };
        foreach (HardRow row in Stands(context, 0.25, 0, Edge + 0.1))
        {
            yield return row with { Note = "a bin that is a decimetre too wide" };
        }
    }

    /// <summary>A floor with four walls at a distance from its middle.</summary>
    private static SceneBuilder Bin(SceneBuilder builder, double half, double friction) => builder.AddPlane("floor", Vector3D.Up, 0.0, 0, friction)
        .AddPlane("west", V(1), -half, 0, friction).AddPlane("east", V(-1), -half, 0, friction)
        .AddPlane("north", V(0, 0, 1), -half, 0, friction).AddPlane("south", V(0, 0, -1), -half, 0, friction);

    /// <summary>Balls on a loose grid above a floor with four walls, all with the same friction.</summary>
    private static Scene Box(int balls, double friction, ulong seed)
    {
        SeededRandom random = new(seed);
        const double half = 0.8;
        SceneBuilder builder = Bin(new SceneBuilder("box").WithContactTolerance(Falling), half, friction);
        for (int n = 0; n < balls; n++)
        {
            double radius = random.NextDouble(0.2, 0.35);
            builder.AddBody(
                $"ball {n}", new BodySpec(radius, radius * radius * radius * 50, 0.3, friction: friction),
                V((((n % 2) - 0.5) * 0.8) + random.NextDouble(-0.02, 0.02), 0.4 + (0.75 * (n / 4)), ((n / 2 % 2) - 0.5) * 0.8));
        }

        return builder.Build();
    }

    /// <summary>
    /// A square pyramid in a bin that is as wide as its base. Its weight is a user-defined force, of which the engine does not know the
    /// potential, so it never rests.
    /// </summary>
    private static Scene Pyramid(double friction, double width)
    {
        SceneBuilder builder = new SceneBuilder("pyramid").WithGravity(Vector3D.Zero).WithContactTolerance(OfPyramid)
            .AddForce(Force.Supplied(new SuppliedWeight()));
        Bin(builder, width / 2, friction);
        for (int layer = 0; layer < Edge; layer++)
        {
            int side = Edge - layer;
            for (int n = 0; n < side * side; n++)
            {
                Vector3D at = V((n % side) - ((side - 1) / 2.0), 0.5 + (layer * Math.Sqrt(0.5)), (n / side) - ((side - 1) / 2.0));
                builder.AddBody($"ball {layer}.{n}", new BodySpec(0.5, 1, 0, MotionLaw.Automatic, forces: ForceSet.Of(0), tolerance: 1e-9, friction: friction), at);
            }
        }

        return builder.Build();
    }

    /// <summary>
    /// Returns the largest gain of energy at ticks, rotation included, over the least before, relative to the energy at the start; and the
    /// deepest overlap.
    /// </summary>
    private static double Largest(HardContext context, Simulation simulation, double seconds, out double depth)
    {
        double least = SceneEnergy.Of(simulation, SimTime.Zero), start = least, gain = 0;
        depth = 0;
        const int Samples = 600;
        double step = ContactSteps.Step(Falling);
        for (int n = 1; n <= Samples; n++)
        {
            double at = seconds * n / Samples;
            simulation.AdvanceTo(SimTime.FromSeconds(at));
            double tick = ContactSteps.TickBefore(at, step);
            double energy = Enumerable.Range(0, simulation.BodyCount).Sum(
                body => EnergyOf(simulation.SpecOf(BodyId.OfScene(body)), ContactSteps.AtTick(simulation, body, tick, step)));
            gain = double.IsNaN(energy) ? double.NaN : Math.Max(gain, energy - least);
            least = Math.Min(least, energy);
            depth = Math.Max(depth, Deepest(simulation, at));
            context.Report(n / (double)Samples);
        }

        return gain / start;
    }

    private static double EnergyOf(in BodySpec spec, in BodyState state) => spec.Mass
        * ((0.5 * state.Velocity.LengthSquared)
            + (Gravity * state.Position.Y) + (0.2 * spec.Radius * spec.Radius * state.Spin.LengthSquared));

    private static double Deepest(Simulation simulation, double at)
    {
        double depth = 0;
        (Vector3D Position, double Radius)[] balls = [.. Enumerable.Range(0, simulation.BodyCount).Select(n => (Read(simulation, n, at).Position, simulation.SpecOf(BodyId.OfScene(n)).Radius))];
        for (int i = 0; i < balls.Length; i++)
        {
            depth = Math.Max(depth, simulation.Scene.Planes.Max(p => p.Offset + balls[i].Radius - Vector3D.Dot(p.Normal, balls[i].Position)));
            for (int j = 0; j < i; j++)
            {
                depth = Math.Max(depth, balls[i].Radius + balls[j].Radius - (balls[i].Position - balls[j].Position).Length);
            }
        }

        return depth;
    }

    /// <summary>
    /// In free flight, which is exact, the error is of the second order at ticks: positions by d or two, speeds by the square of a kick g
    /// h, which is 2 g d.
    /// </summary>
    private HardRow Gain(string size, double gain) => new(
        Name, size, gain, "energy_gain_relative", 3 * Falling / 0.4,
        "all of it lifted by 2 d, d being 1e-5 m, and half the square of a kick, g d, as part of the energy of what lies 0.4 m high as the"
            + " lowest layer does; at ticks",
        "all the energy there was before");

    private HardRow Depth(string size, double depth) => new(
        Name, size, depth, "depth_m", 2 * Falling, "two of d, 1e-5 m: a fall in a step, and the turning of a line of centres in one", "no"
            + " ball is in another or in a plane");

    /// <summary>
    /// A ball on two touching ones, on a floor. Friction holds them from the tangent of 15 degrees on, half the angle between the line of
    /// centres and the vertical.
    /// </summary>
    private HardRow Stays(HardContext context, double friction)
    {
        BodySpec ball = new(0.5, 1, 0, friction: friction);
        Scene scene = new SceneBuilder("three").WithContactTolerance(Standing).AddPlane("floor", Vector3D.Up, 0.0, 0, friction)
            .AddBody("left", ball, V(-0.5, 0.5)).AddBody("right", ball, V(0.5, 0.5)).AddBody("top", ball, V(0, 0.5 + Math.Sqrt(0.75))).Build();
        Simulation simulation = context.Run(scene, 3);
        double drift = Enumerable.Range(0, 3).Max(n => (Read(simulation, n, 3).Position - scene.Bodies[n].Position).Length);
        return new HardRow(
            Name, FormattableString.Invariant($"a ball on two, mu {friction}, 3 s"), drift, "drift_m", 4 * ContactSteps.Closing * Standing,
            "a tenth of d, 1e-6 m, for each of four contacts: a step leaves one to close by half of that at most, and a step later it is put"
                + " right", "they stay where mu is at least tan 15 degrees, 0.268");
    }

    /// <summary>
    /// A tower of equal balls on a floor, with an oblique line of centres. The part above the k-th contact from the top weighs k balls,
    /// with its centre k radii up that line. So rolling resistance c, which takes a moment of c r times the normal force, holds it to k tan
    /// = c, and the lowest contact of two gives way first.
    /// </summary>
    /// <remarks>At the start each ball spins as much as a heap leaves when it comes to rest.</remarks>
    private HardRow Leans(HardContext context, int balls, double part)
    {
        const double Resistance = 0.05, Seconds = 3;
        double tangent = part * Resistance / (balls - 1), up = 1 / Math.Sqrt(1 + (tangent * tangent));
        BodySpec ball = new(0.5, 1, 0, friction: 0.4, rollingResistance: Resistance);
        SceneBuilder builder = new SceneBuilder("tower").WithContactTolerance(Standing).AddPlane("floor", Vector3D.Up, 0.0, 0, 0.4);
        for (int n = 0; n < balls; n++)
        {
            builder.AddBody($"ball {n}", ball, V(n * up * tangent, 0.5 + (n * up)), spin: V(0, 0, -2e-7));
        }

        Simulation simulation = context.Run(builder.Build(), Seconds);
        BodyState[] ends = [.. Enumerable.Range(0, balls).Select(n => Read(simulation, n, Seconds))];
        double drift = ends.Max(end => end.Motion == MotionLaw.Resting ? 0 : double.NaN);
        drift += Enumerable.Range(0, balls).Max(n => (ends[n].Position - simulation.Scene.Bodies[n].Position).Length);
        return new HardRow(
            Name, FormattableString.Invariant($"a tower of {balls}, c {Resistance}, aslant by {part} of what that holds, {Seconds} s"), drift, "drift_m",
            balls * Standing, "d, 1e-6 m, for each contact below it, in which that settles so near to the most that it holds",
            "it rests where the number of balls but one, times the tangent of its slant, is at most c; NaN where it does not rest");
    }

    private IEnumerable<HardRow> Stands(HardContext context, double seconds, double friction, double width)
    {
        Scene pyramid = Pyramid(friction, width);
        Simulation simulation = context.Simulate(pyramid);
        double drift = 0, momentum = 0, gain = 0, weight = Gravity * pyramid.Bodies.Count, start = Energy(0);
        int samples = (int)(seconds * 100);
        for (int n = 1; n <= samples; n++)
        {
            double at = seconds * n / samples;
            simulation.AdvanceTo(SimTime.FromSeconds(at));
            momentum = Math.Max(momentum, Momentum(simulation, at).Length / weight);
            gain = Math.Max(gain, (Energy(at) - start) / start);
            drift = Math.Max(drift, Enumerable.Range(0, pyramid.Bodies.Count).Max(body => (Read(simulation, body, at).Position - pyramid.Bodies[body].Position).Length));
            context.Report(n / (double)samples);
        }

        double step = ContactSteps.Step(OfPyramid), most = Edge * ContactSteps.Closing * OfPyramid;
        bool isStepped = simulation.EventsProcessed > 0.9 * seconds / step; // else nothing was tested
        string size = FormattableString.Invariant($"a pyramid of {pyramid.Bodies.Count}, mu {friction}, {seconds} s");
        drift = isStepped ? drift : double.NaN;
        yield return new HardRow(Name, size, drift, "drift_m", most,
            "a tenth of d, 1e-7 m, a layer: a step leaves a contact to close by half of that at most, and a step later it is put right",
            "nothing moves; NaN where no steps were taken");
        yield return new HardRow(
            Name, size, momentum, "momentum_s", ContactSteps.Closing / 2 * OfPyramid / step / Gravity,
            "each ball at the 0.05 d that a step may leave", "forces that sum to the weight leave no momentum");
        yield return new HardRow(
            Name, size, gain, "energy_gain_relative_standing", weight * most / start,
            "all of it lifted by as much as it may drift", "the energy at the start");

        // The weight is a user-defined force, of which the engine does not know the potential.
        double Energy(double at) => SceneEnergy.Of(simulation, SimTime.FromSeconds(at))
            + Enumerable.Range(0, pyramid.Bodies.Count).Sum(n => Gravity * pyramid.Bodies[n].Spec.Mass * Read(simulation, n, at).Position.Y);
    }
}
