using System.Collections.Generic;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Healing;

/// <summary>
/// Heals by the index of who is near: a body that is ahead of what is being healed moves from shell to shell, and must still be met where
/// it was.
/// </summary>
public sealed class NeighbourListHealingTests
{
    private const double End = 0.6;

    [Theory]
    [InlineData(0)]
    [InlineData(SimulationOptions.DefaultBruteForceLimit)]
    public void Late_ByTheIndex_HealsToTheSameBits(int bruteForceLimit)
    {
        for (ulong seed = 1; seed <= 40; seed++)
        {
            SeededRandom random = new(seed);
            List<ExternalEvent> events = Shaken(random);
            Simulation inTime = new(Room(), new SimulationOptions(default, SimDuration.MaxValue));
            events.ForEach(e => inTime.Submit(e));
            inTime.AdvanceTo(At(End));
            Simulation late = new(Room(), new SimulationOptions(default, SimDuration.MaxValue).WithBruteForceLimit(bruteForceLimit));
            double by = random.NextDouble(0.05, 0.2);
            foreach (ExternalEvent e in events)
            {
                late.AdvanceTo(SimTime.Max(late.SimulatedTo, e.Time + SimDuration.FromSeconds(by)));
                late.Submit(e);
            }

            late.AdvanceTo(SimTime.Max(late.SimulatedTo, At(End)));
            Assert.True(inTime.EventHash(At(End)) == late.EventHash(At(End)), $"seed {seed}, late by {by} s");
        }
    }

    /// <summary>
    /// The index begins with the 65th body, here after a second without any event. What is heard of later strikes a body within that
    /// second. With one body less there is no index yet.
    /// </summary>
    [Theory]
    [InlineData(SimulationOptions.DefaultBruteForceLimit)]
    [InlineData(SimulationOptions.DefaultBruteForceLimit + 1)]
    public void Late_WhereTheIndexBegan_IsMetBeforeThat(int bruteForceLimit)
    {
        SceneBuilder builder = new SceneBuilder("row").WithGravity(Vector3D.Zero)
            .AddBody("mover", new BodySpec(0.1, 1, 1), V(0), V(1)).AddBody("shooter", new BodySpec(0.1, 1, 1), V(0.5, 1));
        for (int n = 2; n < SimulationOptions.DefaultBruteForceLimit; n++)
        {
            builder.AddBody($"other {n}", new BodySpec(0.1, 1, 1), V(n, 50));
        }

        Scene scene = builder.Build();
        ExternalEvent spawn = ExternalEvent.Spawn(At(1), 1, 1, new BodySpec(0.1, 1, 1), V(-5, 50));
        ExternalEvent shot = ExternalEvent.SetVelocity(At(0.1), 1, 2, Second, V(0, -2));
        Simulation inTime = new(scene, new SimulationOptions(default, SimDuration.MaxValue).WithBruteForceLimit(bruteForceLimit));
        Simulation late = new(scene, new SimulationOptions(default, SimDuration.MaxValue).WithBruteForceLimit(bruteForceLimit));
        inTime.Submit(shot);
        inTime.Submit(spawn);
        late.AdvanceTo(At(1));
        late.Submit(spawn);
        late.Submit(shot);
        inTime.AdvanceTo(At(1.5));
        late.AdvanceTo(At(1.5));
        Assert.Equal(1, inTime.ImpactsProcessed);
        Assert.Equal(inTime.EventHash(At(1.5)), late.EventHash(At(1.5)));
    }

    private static List<ExternalEvent> Shaken(SeededRandom random)
    {
        double e = random.Pick(0.5, 0.9, 1), friction = random.Pick(0, 0.3, 1);
        List<ExternalEvent> events = [];
        uint sequence = 1;
        for (int n = 0; n < 60; n++)
        {
            double height = 0.7 + (0.201 * (n / 9)) + (0.001 * random.NextDouble());
            Vector3D place = V(-0.499 + (0.201 * (n % 3)), height, -0.499 + (0.201 * (n / 3 % 3)));
            events.Add(ExternalEvent.Spawn(At(0.06 + (0.002 * n)), 1, sequence++, new BodySpec(0.1, 1, e, friction: friction), place));
        }

        BodyId held = events[random.NextInt(60)].Body;
        events.Add(ExternalEvent.Grab(At(0.35), 1, sequence++, held, V(0)));
        for (int n = 0; n < 4; n++)
        {
            Vector3D place = V(-0.3 + (0.1 * random.NextDouble()), 0.5 + (1.5 * random.NextDouble()), -0.3 + (0.1 * random.NextDouble()));
            events.Add(ExternalEvent.HoldKeyframe(At(0.36 + (0.02 * n)), 1, sequence++, held, place, V(0)));
        }

        return events;
    }

    private static Scene Room() => new SceneBuilder("room").WithSmallestRadius(0.1).AddPlane("floor", Vector3D.Up, 0.0)
        .AddPlane("west", V(1), -0.6).AddPlane("east", V(-1), -0.6).AddPlane("north", V(0, 0, 1), -0.6).AddPlane("south", V(0, 0, -1), -0.6)
        .AddBody("ball", new BodySpec(0.1, 1, 1), V(0.4, 0.3, 0.4)).Build();
}
