using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Contacts;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Contacts;

/// <summary>Contacts that are struck together give back what they were pressed with, as far as they can.</summary>
public sealed class PoissonImpactTests
{
    /// <summary>Balls that touch one another without walls can always part, so nothing is lost; the control loses a tenth.</summary>
    [Theory]
    [InlineData(1)]
    [InlineData(0.9)]
    public void Solve_WhatCanPart_KeepsAllEnergyWhereRestitutionIsOne(double restitution)
    {
        Random random = new(7);
        for (int n = 0; n < 300; n++)
        {
            Cluster cluster = Cluster.Draw(random, 2 + (n % 7));
            Vector3D momentum = cluster.Momentum;
            double before = cluster.Energy;
            double pressed = cluster.Closing;
            cluster.Solve(restitution);
            Near(0, (cluster.Momentum - momentum).Length, 1e-9 * cluster.Mass);
            Assert.InRange(cluster.Closing, 0, 1e-9);
            Assert.InRange(cluster.Energy, 0, before * (1 + 1e-9));
            Assert.Equal(restitution == 1 || pressed < 1e-9, cluster.Energy > before * (1 - 1e-8));
        }
    }

    /// <summary>Of a ball between two walls nothing is left across them, and all that it moves along them.</summary>
    [Fact]
    public void Solve_WhatIsJammed_LosesWhatClosesAndNoMore()
    {
        ContactPoint[] contacts = [Wall(0, 0, V(1)), Wall(0, 1, V(-1))];
        Vector3D[] velocities = [V(-3, 2, 1)];
        Solve(contacts, [1, 1], [2], velocities);
        Near(V(0, 2, 1), velocities[0], 1e-12);
    }

    /// <summary>A light ball goes to and fro between a wall and a heavy one: the heavy one leaves as fast as it came.</summary>
    [Theory]
    [InlineData(1e3)]
    [InlineData(1e9)]
    [InlineData(1e30)]
    public void Solve_LightBallUnderAHeavyOne_SendsItBack(double mass)
    {
        ContactPoint[] contacts = [Wall(0, 0, V(1)), new(0, 1, -1, default) { Normal = V(-1) }];
        Vector3D[] velocities = [V(1), V(-1)];
        Solve(contacts, [1, 1], [1, mass], velocities);
        Near(1, velocities[1].X, (2 / mass) + 1e-9);
        Assert.InRange(velocities[0].X, 0, velocities[1].X);
    }

    private static ContactPoint Wall(int body, int surface, Vector3D normal) => new(body, ContactPoint.Static, surface, default) { Normal = normal };

    private static void Solve(ContactPoint[] contacts, double[] restitutions, double[] masses, Vector3D[] velocities)
    {
        PoissonImpact impact = new();
        impact.Solve(contacts, restitutions, masses, velocities);
        impact.Apply(contacts, masses, velocities);
    }

    /// <summary>Balls that touch one another, each at least one of those before it.</summary>
    private sealed class Cluster(double[] masses, Vector3D[] velocities, ContactPoint[] contacts)
    {
        internal double Mass => masses.Sum();

        internal Vector3D Momentum => masses.Select((m, i) => velocities[i] * m).Aggregate((a, b) => a + b);

        internal double Energy => masses.Select((m, i) => 0.5 * m * velocities[i].LengthSquared).Sum();

        internal double Closing => Math.Max(0, contacts.Max(c => -ImpactSolver.Opening(c, velocities)));

        internal static Cluster Draw(Random random, int count)
        {
            Vector3D[] places = new Vector3D[count];
            Vector3D[] velocities = new Vector3D[count];
            double[] masses = new double[count];
            List<ContactPoint> contacts = [];
            for (int i = 0; i < count; i++)
            {
                int on = random.Next(Math.Max(1, i));
                Vector3D way = V(random.NextDouble() - 0.5, random.NextDouble() - 0.5, random.NextDouble() - 0.5).Direction;
                places[i] = i == 0 ? V(0) : places[on] + way;
                velocities[i] = V(random.NextDouble() - 0.5, random.NextDouble() - 0.5, random.NextDouble() - 0.5);
                masses[i] = Math.Pow(10, 2 * (random.NextDouble() - 0.5));
                if (i > 0)
                {
                    contacts.Add(new ContactPoint(on, i, -1, default) { Normal = way * -1 });
                }
            }

            return new Cluster(masses, velocities, [.. contacts]);
        }

        internal void Solve(double restitution) =>
            PoissonImpactTests.Solve(contacts, [.. contacts.Select(_ => restitution)], masses, velocities);
    }
}
