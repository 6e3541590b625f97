using System;
using System.Collections.Generic;
using LagSim.Scenes;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// A user-defined force acts as the library's force of the same formula does, bit for bit, and its name and version distinguish worlds.
/// </summary>
internal sealed class SuppliedCase : IHardCase
{
    public string Name => "supplied";

    public string Title => "forces that a program supplies, by name and version, against the library's of the same formula";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach (Force force in Forces())
        {
            foreach (HardFlight flight in new[] { HardFlight.Steps(1.0 / 64), HardFlight.Controlled(1e-6) })
            {
                yield return Row(force, flight, Path(context, force, flight), Path(context, Force.Supplied(new SuppliedForce(force)), flight));
            }
        }

        yield return Told(new Numbered("wind", 1), new Numbered("wind", 1), expected: true);
        yield return Told(new Numbered("wind", 1), new Numbered("wind", 2), expected: false);
        yield return Told(new Numbered("wind", 1), new Numbered("gale", 1), expected: false);
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        Force drag = Force.LinearDrag("drag", 0.5), more = Force.LinearDrag("drag", 0.5 * (1 + 1e-15));
        HardFlight flight = HardFlight.Steps(1.0 / 64);
        yield return Row(drag, flight, Path(context, drag, flight), Path(context, Force.Supplied(new SuppliedForce(more)), flight)) with
        {
            Note = "a coefficient off by 1e-15",
        };
        yield return Told(new Numbered("wind", 1), new Numbered("wind", 2), expected: true) with { Note = "another version taken for the same" };
    }

    private static IEnumerable<Force> Forces() =>
    [
        Force.LinearDrag("drag", 0.5, V(1)), Force.QuadraticDrag("air", 0.1, V(0, 0, 2)), Force.Spring("spring", V(0, 1), 4, 0.1),
        Force.Magnetic("field", V(0, 1, 2), 1), Force.Central("sun", V(5, 5, 5), 20),
    ];

    private static IEnumerable<BodyState> Path(HardContext context, Force force, HardFlight flight)
    {
        Scene scene = new SceneBuilder("supplied").AddPlane("floor", Vector3D.Up, V(0, -1)).AddForce(force)
            .AddBody("ball", flight.Ball(0.1, 0.9), default, V(1, 2, 0.5)).Build();
        Simulation simulation = context.Run(scene, 2);
        for (int n = 1; n <= 64; n++)
        {
            yield return Read(simulation, 0, n / 32.0);
        }
    }

    private HardRow Row(Force force, HardFlight flight, IEnumerable<BodyState> own, IEnumerable<BodyState> supplied)
    {
        int others = 0;
        using IEnumerator<BodyState> other = supplied.GetEnumerator();
        foreach (BodyState state in own)
        {
            others += other.MoveNext() && state.IsSameBits(other.Current) ? 0 : 1;
        }

        return new HardRow(
            Name, FormattableString.Invariant($"{force.Kind}, {flight.Text}, bouncing"), others, "states_of_other_bits", 0,
            "the same operations in the same order give the same bits",
            "the library's force of the same formula, at 64 instants");
    }

    /// <summary>Whether two scenes with such forces make the same world.</summary>
    private HardRow Told(IAcceleration one, IAcceleration other, bool expected)
    {
        bool isSame = Hash(one) == Hash(other);
        return new HardRow(
            Name, $"{one.Name} {one.Version} and {other.Name} {other.Version} are {(expected ? "one world" : "two")}", isSame == expected ? 0 : 1, "count", 0,
            "a hash is equal or not", "name and version are all that is told of code");
    }

    private static ulong Hash(IAcceleration supplied) =>
        new SceneBuilder("told").AddForce(Force.Supplied(supplied)).AddBody("ball", new BodySpec(1, 1, 1, forces: ForceSet.Of(0)), default).Build().Hash;

    private sealed class Numbered(string name, int version) : IAcceleration
    {
        public string Name => name;

        public int Version => version;

        public Vector3D At(double seconds, in Vector3D position, in Vector3D velocity) => Vector3D.Zero;
    }
}
