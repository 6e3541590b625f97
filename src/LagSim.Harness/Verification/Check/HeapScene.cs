using System;
using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Check;

/// <summary>
/// One or two heaps of balls with friction on an open floor: pyramids of five, which are islands from the start. A few balls lie beside
/// them, on which players mostly act.
/// </summary>
/// <remarks>
/// Each step of an island is an event in every world, some five hundred a second. So rolling resistance soon stops motion, and players act
/// in the first seconds only. No ball is heavier than four others.
/// </remarks>
internal sealed class HeapScene : CheckScene
{
    private const double Radius = 0.25;
    private const double Apart = 3;
    private const int OfHeap = 5;

    /// <summary>Half the side of a heap in which all balls touch at the start without overlap, in metres.</summary>
    private const double Side = Radius + 1e-8;

    private readonly SeededRandom random;
    private readonly double friction;
    private readonly double rolling;
    private readonly double forcedPercent;
    private readonly Vector3D wind;
    private readonly bool hasPeg;
    private readonly double[] centres;

    internal HeapScene(SeededRandom random)
    {
        this.random = random;
        friction = random.Pick(0.5, 1);
        rolling = random.Pick(0.2, 0.4);
        forcedPercent = random.IsLucky(70) ? 40 : 0;
        wind = random.IsLucky(30) ? DrawWind(random) * 0.25 : Vector3D.Zero; // less than friction holds
        hasPeg = random.IsLucky(25);
        centres = random.IsLucky(50) ? [-Apart, Apart] : [0];
        foreach (double centre in centres)
        {
            AddPyramid(centre);
        }

        for (int n = centres.Length; n < 4; n++)
        {
            Add(DrawSpec(), new Vector3D(Apart * (n - 2), Side, Apart), Vector3D.Zero);
        }
    }

    // Two heaps with forces would seldom be within the usual budget.
    internal override long? MaxEvents => 1_000 * centres.Length * (forcedPercent > 0 ? 3 : 2) / 2;

    internal override double BusySeconds => 4;

    internal override int FewestHands => 1;

    internal override double GraspSeconds => 0.8; // while the heaps still stand

    internal override int DrawHeld(SeededRandom from) => from.IsLucky(75) ? from.NextInt(OfHeap * centres.Length) : base.DrawHeld(from);

    internal override BodySpec DrawSpec() => DrawSpec(ForceSet.None);

    private BodySpec DrawSpec(ForceSet forces) => new(
        Radius, random.Pick(0.5, 1, 1, 1, 2), random.Pick(0, 0, 0, 0.3), forces: forces, tolerance: 1e-5, friction: friction, rollingResistance: rolling);

    /// <summary>
    /// One or several of the forces, or none; none that pulls elsewhere, since that heap would never rest. Only on balls in heaps: any
    /// other would roll in steps.
    /// </summary>
    private ForceSet DrawForces()
    {
        ForceSet forces = ForceSet.None;
        while (random.IsLucky(forcedPercent))
        {
            forces |= ForceSet.Of(random.Pick(1, 3, 4, Magnus));
        }

        return forces;
    }

    internal override int DrawBody(SeededRandom from)
    {
        int heaped = OfHeap * centres.Length;
        return from.IsLucky(40) ? from.NextInt(heaped) : heaped + from.NextInt(BodyCount - heaped);
    }

    /// <summary>Above a heap, or beside it where nothing is hit.</summary>
    internal override Vector3D DrawPosition() =>
        new(random.Pick(centres) + random.NextDouble(-0.5, 0.5), random.NextDouble(1.2, 2), random.NextDouble(-0.5, 0.5) + (random.IsLucky(25) ? 0 : -Apart));

    internal override Vector3D DrawSpin(in BodySpec spec) => DrawVelocity(30);

    internal override Vector3D DrawVelocity(double most) =>
        // Slow, so that a kicked ball soon rests again.
        new Vector3D(random.NextDouble(-1, 1), random.NextDouble(-1, 1), random.NextDouble(-1, 1)) * (most / 6);

    protected override void AddSurroundings(SceneBuilder builder)
    {
        builder.AddPlane("floor", Vector3D.Up, Vector3D.Zero, 0.3);
        AddForces(builder, 2, wind);
        for (int n = 0; n < centres.Length && hasPeg; n++)
        {
            builder.AddStaticSphere($"peg {n}", new Vector3D(centres[n], Side, 0), (Side * Math.Sqrt(2)) - Radius - 1e-8, 0.3); // touches all five
        }
    }

    /// <summary>Adds four balls in a square, and one on top of them.</summary>
    private void AddPyramid(double x)
    {
        for (int n = 0; n < 4; n++)
        {
            Add(DrawSpec(DrawForces()), new Vector3D(x + (Side * ((2 * (n / 2)) - 1)), Side, Side * ((2 * (n % 2)) - 1)), Vector3D.Zero);
        }

        Add(DrawSpec(DrawForces()), new Vector3D(x, Side * (1 + Math.Sqrt(2)), 0), Vector3D.Zero);
    }
}
