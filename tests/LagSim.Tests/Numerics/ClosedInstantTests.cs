using System;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Numerics;

/// <summary>An instant in which elastic balls are struck without end is closed, and the world goes on (docs/CONTACT.md, rule 13).</summary>
public sealed class ClosedInstantTests
{
    /// <summary>
    /// Eight balls packed in a box of their size, thrown to one side: nothing can move. What they lose is told. Those that lose a little come
    /// to the same without it.
    /// </summary>
    [Theory]
    [InlineData(1)]
    [InlineData(0.9)]
    public void BallsPackedInABox_StopAndTellWhatIsLost(double restitution)
    {
        Simulation simulation = Run(Packed(restitution, V(3, -2, 1)), 0.1);
        Assert.Equal(restitution == 1 ? 1 : 0, simulation.ImpactsClosed);
        Near(restitution == 1 ? 8 * 7 : 0, simulation.EnergyLostInClosing, 1e-9);
        Assert.InRange(simulation.ImpactsProcessed, 1, 8 * 1024);
        Assert.InRange(Energy(simulation, At(0.1)), 0, 1e-6);
    }

    /// <summary>The control: without a closing that instant has no end.</summary>
    [Fact]
    public void BallsPackedInABox_WithoutAClosing_NeverEnd()
    {
        FaultyEngineParts parts = new() { NeverCollapses = true };
        SimulationOptions options = new SimulationOptions(maxSegments: 100_000).WithParts(parts);
        Assert.Throws<TimelinesFullException>(() => new Simulation(Packed(1, V(3, -2, 1)), options).AdvanceTo(At(0.1)));
    }

    /// <summary>
    /// Balls of 1 kg and of a nanogram in turn that are put at one point: sweeps pass on to a light one between heavy ones only what it weighs, so
    /// an instant would have as many rounds as one weighs more than the other. It ends, and so does the next.
    /// </summary>
    [Fact]
    public void CrowdOfUnlikeMasses_EndsItsInstants()
    {
        Simulation simulation = new(new SceneBuilder("crowd").AddPlane("floor", Vector3D.Up, V(0)).AddPlane("wall", V(1), V(-2))
            .AddBody("a", new BodySpec(0.2, 1, 0.5), V(0, 0.2)).WithSmallestRadius(0.1).Build());
        for (uint n = 0; n < 64; n++)
        {
            BodySpec spec = new(0.1 + (0.001 * (n % 7)), n % 2 == 0 ? 1e-9 : 1, 0, friction: 0.5);
            simulation.Submit(PlayerAction.Spawn(spec, V(0, 0.2), V(n % 3)).Stamp(At(0.5), 1, n + 1));
        }

        simulation.AdvanceTo(At(1.2));
        Assert.InRange(simulation.ImpactsClosed, 1, 8 * 1024);
        Assert.InRange(simulation.ImpactsProcessed, 1, 16 * 1024);
    }

    /// <summary>A late event that takes a ball out before the instant, or one that puts one in, gives the bits of a world that knew it.</summary>
    [Theory]
    [InlineData(0.45)]
    [InlineData(0.55)]
    public void Instant_ThatALateEventMakesAnother_HasTheSameBits(double when)
    {
        // Eight in a box whose lid is a heavy ball that comes at 0.5 s.
        Scene scene = Packed(1, V(0), lid: false);
        ExternalEvent gone = ExternalEvent.Remove(At(when), 1, 1, First);
        Simulation inTime = new(scene, KeepAll), late = new(scene, KeepAll);
        inTime.Submit(gone);
        inTime.AdvanceTo(At(1));
        late.AdvanceTo(At(0.9));
        Assert.True(late.ImpactsClosed > 0);
        late.Submit(gone);
        late.AdvanceTo(At(1));
        Assert.Equal(inTime.StateHash(At(1)), late.StateHash(At(1)));
        Assert.Equal(inTime.EventHash(At(1)), late.EventHash(At(1)));
        late.Retract(gone);
        late.AdvanceTo(At(1.1));
        Simulation never = Run(scene, 1.1);
        Assert.Equal(never.EventHash(At(1.1)), late.EventHash(At(1.1)));
    }

    /// <summary>
    /// Rooms packed without room, of very unlike masses, in which all but a few balls are elastic: each goes on, and none gains energy. Where
    /// all are elastic, what is missing is what was told; the control does not hear of it.
    /// </summary>
    [Fact]
    public void DrawnRooms_OfElasticBalls_GoOnAndTellWhatIsLost()
    {
        long closed = 0;
        for (int seed = 0; seed < 200; seed++)
        {
            Random random = new(seed);
            bool isElastic = seed % 4 != 0;
            Scene scene = DrawnRoom(random, isElastic);
            double energy = scene.Bodies.Sum(body => 0.5 * body.Spec.Mass * body.Velocity.LengthSquared);
            Simulation simulation = new(scene, KeepAll);
            simulation.AdvanceTo(At(0.02));
            double left = Energy(simulation, At(0.02));
            double lost = simulation.EnergyLostInClosing;
            Assert.InRange(left, -1e-9 * energy, energy * (1 + 1e-9));
            Assert.InRange(lost, -1e-9 * energy, (energy * (1 + 1e-9)) - left);
            if (isElastic)
            {
                Near(energy, left + lost, 1e-6 * energy);
                Assert.True(simulation.ImpactsClosed == 0 || lost > 1e-3 * energy); // the control
            }

            closed += simulation.ImpactsClosed;
        }

        Assert.InRange(closed, 100, 2000);
    }

    private static Scene DrawnRoom(Random random, bool isElastic)
    {
        (int x, int y, int z) = (1 + random.Next(3), 1 + random.Next(2), 1 + random.Next(2));
        SceneBuilder builder = new SceneBuilder("room").WithGravity(Floating)
            .AddPlane("west", V(1), V(0)).AddPlane("east", V(-1), V(x)).AddPlane("floor", V(0, 1), V(0)).AddPlane("lid", V(0, -1), V(0, y))
            .AddPlane("back", V(0, 0, 1), V(0)).AddPlane("front", V(0, 0, -1), V(0, 0, z));
        for (int n = 0; n < x * y * z; n++)
        {
            double mass = Math.Pow(10, 4 * (random.NextDouble() - 0.5));
            Vector3D velocity = V(random.NextDouble() - 0.5, random.NextDouble() - 0.5, random.NextDouble() - 0.5) * 4;
            double restitution = isElastic || random.Next(3) > 0 ? 1 : 0.7 + (0.3 * random.NextDouble());
            builder.AddBody($"ball {n}", new BodySpec(0.5, mass, restitution), V(0.5 + (n % x), 0.5 + (n / x % y), 0.5 + (n / x / y)), velocity);
        }

        return builder.Build();
    }

    private static Scene Packed(double restitution, Vector3D velocity, bool lid = true)
    {
        SceneBuilder builder = new SceneBuilder("box").WithGravity(Floating)
            .AddPlane("floor", V(0, 1), -0.2)
            .AddPlane("west", V(1), -0.2).AddPlane("east", V(-1), -0.2)
            .AddPlane("back", V(0, 0, 1), -0.2).AddPlane("front", V(0, 0, -1), -0.2);
        for (int n = 0; n < 8; n++)
        {
            Vector3D place = V(0.1 - (n % 2 * 0.2), 0.1 - (n / 2 % 2 * 0.2), 0.1 - (n / 4 * 0.2));
            builder.AddBody($"ball {n}", new BodySpec(0.1, 1, restitution), place, velocity);
        }

        return lid ? builder.AddPlane("lid", V(0, -1), -0.2).Build() : builder.AddBody("lid", new BodySpec(0.2, 1e9, 1), V(0, 0.9), V(0, -1)).Build();
    }
}
