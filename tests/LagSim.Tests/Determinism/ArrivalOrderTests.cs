using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Determinism;

/// <summary>Bodies that are heard of in another order get other slots; no bit may tell.</summary>
public sealed class ArrivalOrderTests
{
    private static readonly SimTime End = SimTime.FromSeconds(2);

    [Fact]
    public void Spawns_OfManyThatMeetAtOnce_InAnyOrder_GiveTheSameBits()
    {
        int together = 0;
        for (int seed = 0; seed < 200; seed++)
        {
            Random random = new(seed);
            List<ExternalEvent> spawns = Star(random);
            Simulation expected = World(spawns);
            together += expected.Timeline(spawns[0].Body).Count(entry => entry.Key.Kind == EventKind.Impact);
            for (int i = 0; i < 4; i++)
            {
                Simulation other = World(spawns.OrderBy(_ => random.Next()).ToList());
                Assert.Equal(expected.StateHash(End), other.StateHash(End));
                Assert.Equal(expected.EventHash(End), other.EventHash(End));
            }
        }

        Assert.True(together > 200, $"Only {together} impacts of the one in the middle.");
    }

    [Fact]
    public void Spawns_OfHeavyEndsAndLightMiddles_InAnyOrder_GiveTheSameBits()
    {
        // So unequal that the solver gives up and all bodies get their common velocity, a sum over all of them.
        for (int seed = 0; seed < 60; seed++)
        {
            Random random = new(seed);
            int count = random.Next(3, 6);
            List<ExternalEvent> spawns = [];
            for (int i = 0; i < count; i++)
            {
                bool end = i == 0 || i == count - 1;
                double mass = (1 + random.NextDouble()) * Math.Pow(10, end ? random.Next(8, 20) : -random.Next(0, 20));
                Vector3D velocity = new(i == 0 ? 1 + random.NextDouble() : end ? -1 - random.NextDouble() : 0, random.NextDouble() * 0.1, 0);
                spawns.Add(ExternalEvent.Spawn(
                    SimTime.Zero, (byte)(1 + (i % 3)), (uint)(9 - i), new BodySpec(0.5, mass, 0.05), new Vector3D(i, 0, 0), velocity));
            }

            Simulation? expected = Floating(spawns);
            for (int i = 0; expected is not null && i < 3; i++)
            {
                Simulation other = Floating(spawns.OrderBy(_ => random.Next()).ToList())!;
                Assert.Equal(expected.StateHash(expected.SimulatedTo), other.StateHash(expected.SimulatedTo));
                Assert.Equal(expected.EventHash(expected.SimulatedTo), other.EventHash(expected.SimulatedTo));
            }
        }
    }

    [Fact]
    public void Spawns_OfOneBitMore_DoNot()
    {
        List<ExternalEvent> spawns = Star(new Random(1));
        List<ExternalEvent> other = [.. spawns];
        ExternalEvent first = other[0];
        other[0] = ExternalEvent.Spawn(
            first.Time, first.Peer, first.Sequence, first.Spec, first.Position, first.Velocity + new Vector3D(Math.BitIncrement(0.0) + 1e-16, 0, 0));

        Assert.NotEqual(World(spawns).StateHash(End), World(other).StateHash(End));
    }

    /// <summary>A short while in a world without gravity; null if even that holds too many events to be a test.</summary>
    private static Simulation? Floating(List<ExternalEvent> spawns)
    {
        Scene scene = new SceneBuilder("floating").WithGravity(Vector3D.Zero).WithSmallestRadius(0.25).Build();
        Simulation simulation = new(scene, new SimulationOptions(default, SimDuration.MaxValue));
        spawns.ForEach(spawn => simulation.Submit(spawn));
        for (int i = 1; i <= 20 && simulation.EventsProcessed < 5000; i++)
        {
            simulation.AdvanceTo(SimTime.FromSeconds(i * 1e-6));
        }

        return simulation.EventsProcessed < 50_000 ? simulation : null;
    }

    /// <summary>Balls of odd masses on a table, one in the middle and some around it that all reach it at the same tick.</summary>
    private static List<ExternalEvent> Star(Random random)
    {
        // Of different sizes, so that who is hit is also pressed onto the table, which then takes part.
        const double middle = 0.4;
        List<ExternalEvent> spawns = [Ball(1, 1, middle, Vector3D.Zero, new Vector3D(0, 0, 0.1))];
        int around = random.Next(3, 6);
        double turn = random.NextDouble();
        for (int i = 0; i < around; i++)
        {
            double angle = turn + (2 * Math.PI * i / around);
            Vector3D out1 = new(Math.Cos(angle), 0, Math.Sin(angle));
            double radius = 0.25 + (0.3 * random.NextDouble());
            double touching = 2 * Math.Sqrt(middle * radius); // across the table
            spawns.Add(Ball((byte)(2 + (i % 3)), (uint)(10 - i), radius, out1 * (1 + touching), (out1 * -1) + new Vector3D(0, 0, 0.1)));
        }

        return spawns;

        ExternalEvent Ball(byte peer, uint sequence, double radius, Vector3D place, Vector3D velocity) => ExternalEvent.Spawn(
            SimTime.Zero, peer, sequence, new BodySpec(radius, 0.3 + random.NextDouble(), 0.1 + (0.9 * random.NextDouble())),
            place + new Vector3D(0, radius, 0), velocity);
    }

    private static Simulation World(List<ExternalEvent> spawns)
    {
        Scene table = new SceneBuilder("table").AddPlane("table", Vector3D.Up, Vector3D.Zero).WithSmallestRadius(0.25).Build();
        Simulation simulation = new(table, new SimulationOptions(default, SimDuration.MaxValue));
        foreach (ExternalEvent spawn in spawns)
        {
            simulation.Submit(spawn);
        }

        simulation.AdvanceTo(End);
        return simulation;
    }
}
