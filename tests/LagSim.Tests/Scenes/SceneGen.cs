using System;
using System.Linq;
using FsCheck;
using FsCheck.Fluent;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Tests.Scenes;

/// <summary>Scenes of every kind that a builder accepts: normals and offsets of all bits, bodies that start apart.</summary>
internal static class SceneGen
{
    private static readonly Gen<double> Unit = from a in Gen.Choose(0, int.MaxValue - 1)
                                               from b in Gen.Choose(0, int.MaxValue - 1)
                                               select (a + (b / (double)int.MaxValue)) / int.MaxValue;

    private static readonly Gen<double> Signed = Gen.OneOf(Unit.Select(u => (2 * u) - 1), Gen.Elements(0, -0.0, 1, -1, 0.1, 1e-300, 5e-324));

    private static readonly Gen<Vector3D> Direction = from x in Signed
                                                      from y in Signed
                                                      from z in Signed
                                                      from scale in Log(-100, 100)
                                                      select Usable(new Vector3D(x * scale, y * scale, z * scale));

    private static readonly Gen<string> Prefix = Gen.Elements("a", "Ball ", "\"\\/", "é∞", "𝄞<&>'", "\u2028", "\uFEFF", new string('n', 50));

    private static readonly Gen<SimDuration> Step = Gen.OneOf(
        Gen.Constant(BodySpec.DefaultStep),
        Gen.Choose(1, 1_000_000).Select(us => SimDuration.FromSeconds(us / 1e6)),
        Unit.Select(u => SimDuration.FromTicks(1_100_000 + (long)(u * (SimDuration.TicksPerSecond - 1_100_000)))));

    internal static readonly Gen<(Vector3D Normal, Vector3D Point)> Plane =
        from normal in Direction from point in Within(1e11) select (normal, point);

    private static readonly Gen<PeerSet> Peers = Gen.OneOf(
        Gen.Elements(PeerSet.Everyone, PeerSet.Nobody), Gen.Choose(0, (int)PeerSet.Everyone.Mask).Select(mask => PeerSet.FromMask((uint)mask)));

    /// <summary>Any scene without supplied accelerations. Its planes lie far below, so that nothing overlaps at the start.</summary>
    internal static readonly Gen<Scene> Any =
        from name in Prefix
        from gravity in Within(1e5)
        from restitutionThreshold in Log(-14, -4)
        from tolerance in Gen.OneOf(Gen.Constant(0.0), Log(-9, -1))
        from smallest in Gen.OneOf(Gen.Constant(0.0), Log(-8, 8))
        from planes in Gen.Choose(0, 3)
        from planeSeeds in Gen.ArrayOf(Plane, planes)
        from spheres in Gen.ArrayOf(Log(-8, 8))
        from forces in Gen.ArrayOf(AnyForce)
        from spawners in Peers
        from bodies in Gen.ArrayOf(Body)
        from sensors in Gen.ArrayOf(Sensor)
        select Build(
            name, gravity, restitutionThreshold, tolerance, smallest, planeSeeds, spheres, forces.Take(ForceSet.MaxForces).ToArray(), spawners, bodies, sensors);

    private static Gen<(BodySpec Spec, Vector3D Velocity, PeerSet Players)> Body =>
        from radius in Log(-8, 8)
        from mass in Log(-29, 29)
        from restitution in Gen.OneOf(Unit, Gen.Elements(0.0, -0.0, 1.0))
        from law in Gen.Elements(MotionLaw.RungeKutta4, MotionLaw.DormandPrince54, MotionLaw.Automatic)
        from forces in Gen.Choose(0, int.MaxValue)
        from tolerance in Gen.OneOf(Gen.Elements(0, 1e-300, BodySpec.DefaultTolerance, 1), Unit)
        from step in Step
        from velocity in Within(100)
        from players in Peers
        from friction in Gen.OneOf(Gen.Elements(0.0, 100), Unit)
        from rolling in Gen.OneOf(Gen.Elements(0.0, 1), Unit)
        from filter in Wire.WireGen.Filter
        from tag in Gen.OneOf(Gen.Constant(0ul), Wire.WireGen.Bits64)
        select (
            new BodySpec(radius, mass, restitution, law, step, ForceSet.FromMask((uint)forces), tolerance, friction, rolling, filter, tag), velocity,
            players);

    /// <summary>Weak ones, so that they are not too stiff for the lightest body.</summary>
    private static Gen<Func<string, Force>> AnyForce =>
        from kind in Gen.Choose(0, 5)
        from strength in Unit.Select(u => 1e-25 * u)
        from vector in Within(1e3)
        from power in Gen.Choose(-4, 4)
        select (Func<string, Force>)(name => kind switch
        {
            0 => Force.LinearDrag(name, strength, vector),
            1 => Force.QuadraticDrag(name, strength, vector),
            2 => Force.Spring(name, vector, strength * 1e-20, strength),
            5 => Force.Magnus(name, strength * 1e-10), // spins are up to 1e8 rad/s
            3 => Force.Magnetic(name, vector * 1e-3, strength),
            _ => Force.Central(name, vector, strength, power),
        });

    private static Gen<Action<SceneBuilder, string, string?>> Sensor =>
        from coverage in Gen.Elements(SensorCoverage.Centre, SensorCoverage.Part, SensorCoverage.Whole)
        from isPlane in Gen.Elements(true, false)
        from normal in Direction
        from place in Within(1e11)
        from radius in Log(-8, 8)
        from filter in Wire.WireGen.Filter
        from isCarried in Gen.Elements(true, false)
        select (Action<SceneBuilder, string, string?>)((builder, name, body) => _ = isPlane
            ? builder.AddSensorPlane(name, normal, place, coverage, filter)
            : builder.AddSensorSphere(name, place, radius, coverage, filter, isCarried ? body : null));

    private static Gen<double> Log(int least, int most) =>
        from u in Unit from e in Gen.Choose(least, most - 1) select (1 + (9 * u)) * Math.Pow(10, e);

    private static Gen<Vector3D> Within(double limit) =>
        from x in Signed from y in Signed from z in Signed select new Vector3D(x * limit, y * limit, z * limit);

    private static Vector3D Usable(Vector3D v) => v.Length is > 1e-140 and < 1e140 ? v : Vector3D.Up;

    private static Scene Build(
        string name,
        Vector3D gravity,
        double restitutionThreshold,
        double tolerance,
        double smallest,
        (Vector3D Normal, Vector3D Point)[] planes,
        double[] spheres,
        Func<string, Force>[] forces,
        PeerSet spawners,
        (BodySpec Spec, Vector3D Velocity, PeerSet Players)[] bodies,
        Action<SceneBuilder, string, string?>[] sensors)
    {
        SceneBuilder builder = new SceneBuilder(name).WithGravity(gravity).WithRestitutionThreshold(restitutionThreshold).WithSpawners(spawners);
        double least = bodies.Select(b => b.Spec.Radius).Append(smallest > 0 ? smallest : 1e9).Min();
        if (tolerance > 0)
        {
            builder.WithContactTolerance(tolerance);
        }

        if (smallest > 0)
        {
            builder.WithSmallestRadius(least);
        }

        for (int i = 0; i < forces.Length; i++)
        {
            builder.AddForce(forces[i]($"{name}f{i}"));
        }

        // All parts stand in a row; a plane that would cut it is moved to the far side of it.
        double x = 0.1;
        for (int i = 0; i < spheres.Length; i++)
        {
            builder.AddStaticSphere($"{name}s{i}", new Vector3D(x + spheres[i], 1 / 3.0, -0.0), spheres[i], 0.7, spheres[i] > 1 ? 0.3 : 100, i < bodies.Length ? bodies[i].Spec.Filter : default);
            x += (2.01 * spheres[i]) + 0.3;
        }

        for (int i = 0; i < bodies.Length; i++)
        {
            (BodySpec drawn, Vector3D velocity, PeerSet players) = bodies[i];
            ForceSet set = ForceSet.FromMask(forces.Length == 0 ? 0 : drawn.Forces.Mask & (uint.MaxValue >> (32 - forces.Length)));
            BodySpec spec = new(drawn.Radius, drawn.Mass, drawn.Restitution, drawn.Flight, drawn.Step, set, drawn.Tolerance, drawn.Friction, drawn.RollingResistance, drawn.Filter, drawn.Tag);
            builder.AddBody($"{name}b{i}", spec, new Vector3D(x + spec.Radius, 0.1, 1e-17), velocity * (1e8 * least), players, velocity * (drawn.Friction > 50 ? 0 : 1e6 * least / spec.Radius));
            x += (2.01 * spec.Radius) + 0.3;
        }

        for (int i = 0; i < planes.Length && x < 1e11; i++)
        {
            Vector3D unit = new SceneBuilder("u").AddPlane("u", planes[i].Normal, 0).Build().Planes[0].Normal;
            double offset = Vector3D.Dot(unit, planes[i].Point);
            Vector3D far = offset > -4 * (x + 1) ? unit * (-5 * (x + 1) * (1 + Math.Abs(offset) / 1e11)) : planes[i].Point;
            builder.AddPlane($"{name}p{i}", planes[i].Normal, far, i / 3.0, i == 1 ? 100 : i / 7.0, bodies.Length > i ? bodies[^(i + 1)].Spec.Filter : default);
        }

        for (int i = 0; i < sensors.Length; i++)
        {
            sensors[i](builder, $"{name}q{i}", bodies.Length > 0 ? $"{name}b{i % bodies.Length}" : null);
        }

        return builder.Build();
    }
}
